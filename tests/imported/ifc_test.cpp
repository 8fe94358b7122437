// SPDX-License-Identifier: Apache-2.0
// Houses of IFC files: light through their windows, in lux, compared with closed forms.
#include <set>

#include "analysis/measure.h"
#include "ifc_house.h"
#include "models/daylight.h"
#include "pane_models.h"
#include "support/probe.h"

namespace oriel {
namespace ifc_test {

using ifc_house::Glass;
using ifc_house::House;
using models::testing::Made;
using namespace pane_models;

/// What two surfaces of the pane transmit, of transparency .9 each.
constexpr double kThrough = .81;

/// As the importer turns it: y is up.
Vec3 turned(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(z), static_cast<float>(-y)};
}

/// Places in x and z of the file, and what they are behind.
struct Spot {
  const char* behind;
  double x, z;
  bool lit;
};
constexpr Spot kSpots[] = {{"glass", 2, 1.75, true},
                           {"a corner of the glass", 1.15, 1.2, true},
                           {"another corner", 2.85, 2.3, true},
                           {"the left frame", 1.05, 1.75, false},
                           {"the upper frame", 2, 2.45, false},
                           {"the lower frame", 2, 1.05, false},
                           {"the wall", .5, 1.75, false},
                           {"the lintel", 2, 2.75, false}};

/// Illuminances behind the wall, under a sun before it.
std::vector<Reading> illuminances(const std::string& scene) {
  const testing::Probe probe(scene, builtin_shaders());
  std::vector<IrradianceSensor> sensors;
  for (const Spot& spot : kSpots) sensors.push_back({turned(spot.x, .5, spot.z), turned(0, -1, 0)});
  return measure_illuminance(probe.world(), sensors, 1, {.precision = .01, .floor = 20});
}

struct Case {
  const char* what;
  House house;
};

std::vector<Case> cases() {
  const std::string plain = "IFCSURFACESTYLESHADING({},0.9)";
  return {
      {"IFC2X3, metres, mapped window, styles of items",
       {.schema = "IFC2X3", .glass = Glass::Assigned, .mapped = true}},
      {"IFC2X3, millimetres, style of the material of the type",
       {.schema = "IFC2X3", .millimetres = true, .glass = Glass::TypeMaterial, .divided = true}},
      {"IFC2X3, millimetres, GLASS with a highlight",
       {.schema = "IFC2X3",
        .millimetres = true,
        .transparency = "IFCSURFACESTYLERENDERING({},0.9,$,$,$,$,IFCNORMALISEDRATIOMEASURE(0.),"
                        "IFCSPECULARROUGHNESS(0.1),.GLASS.)"}},
      {"IFC4, millimetres, no history, style of the material",
       {.schema = "IFC4", .millimetres = true, .with_history = false, .glass = Glass::Material}},
      {"IFC4, metres, tessellated pane, constituents, shading with transparency",
       {.schema = "IFC4",
        .glass = Glass::Constituent,
        .tessellated = true,
        .mapped = true,
        .transparency = plain}},
      {"IFC4, millimetres, tessellated pane, direct styles",
       {.schema = "IFC4",
        .millimetres = true,
        .glass = Glass::Direct,
        .tessellated = true,
        .transparency = plain}},
  };
}

// Glass passes the sun; its frame, the wall and its lintel do not; the space of the room behind is
// not rendered.
// acceptance: M4
TEST(ImportedIfc, WindowsPassTheSunIntoRooms) {
  for (Case& c : cases()) {
    SCOPED_TRACE(c.what);
    Made made;
    made.import(c.house.text(), "m.ifc");
    ASSERT_TRUE(made.scene);
    Imath::Box3f box;
    for (const Vec3& p : models::testing::world_points(*made.scene)) box.extendBy(p);
    EXPECT_LT((box.min - turned(0, .3, 0)).length(), 1e-4f) << box.min;
    EXPECT_LT((box.max - turned(4, 0, 3)).length(), 1e-4f) << box.max;
    add_sun(*made.scene, turned(0, -1, 0));
    models::add_camera(*made.scene, {});
    const std::vector<Reading> lux = illuminances(text_of(made));
    // The frame and the reveal scatter some light behind the wall.
    constexpr double kStray = .005;
    for (std::size_t i = 0; i < std::size(kSpots); ++i)
      EXPECT_NEAR(lux[i].value, kSpots[i].lit ? kSunLux * kThrough : 0,
                  kSunLux * (kSpots[i].lit ? kThrough * kTolerance : kStray))
          << kSpots[i].behind;
  }
}

// The storey is a group of all products; materials have the names of styles or materials.
// acceptance: M4
TEST(ImportedIfc, StoreysAndMaterialsHaveNames) {
  for (Case& c : cases()) {
    SCOPED_TRACE(c.what);
    Made made;
    made.import(c.house.text(), "m.ifc");
    ASSERT_TRUE(made.scene);
    const auto* storey = made.scene->get<scene::InstanceGroup>("IfcBuildingStorey_Level_1");
    ASSERT_TRUE(storey);
    EXPECT_EQ(storey->members.size(), 3u);  // wall, frame, pane
    std::set<std::string> materials;
    for (const std::string& member : storey->members) {
      EXPECT_EQ(member.find("IfcSpace"), std::string::npos) << member;
      const auto* instance = made.scene->get<scene::Instance>(member);
      ASSERT_TRUE(instance && instance->materials.size() == 1) << member;
      materials.insert(instance->materials[0]);
    }
    EXPECT_EQ(materials, (std::set<std::string>{"Brick__common", "Sash", "Glass__clear"}));
  }
}

}  // namespace ifc_test
}  // namespace oriel
