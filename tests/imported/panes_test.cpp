// SPDX-License-Identifier: Apache-2.0
// Light through glass panes of models in all formats, in lux, compared with closed forms.
#include "analysis/measure.h"
#include "image/files.h"
#include "models/daylight.h"
#include "pane_models.h"
#include "support/probe.h"

namespace oriel {
namespace panes_test {

using models::testing::Made;
using namespace pane_models;

struct Extent {
  Vec3 middle{0}, normal{0};
  float thickness = 0;
};

/// Of the model's points; the normal is the axis along which they extend least.
Extent extent_of(const scene::Scene& scene) {
  Imath::Box3f box;
  Vec3 sum(0);
  const std::vector<Vec3> points = models::testing::world_points(scene);
  for (const Vec3& p : points) box.extendBy(p), sum += p;
  Extent extent;
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (box.size()[k] < box.size()[axis]) axis = k;
  extent.normal[axis] = 1;
  extent.middle = sum / static_cast<float>(points.size());
  extent.thickness = box.size()[axis];
  return extent;
}

double lux(const std::string& text, const IrradianceSensor& sensor) {
  const testing::Probe probe(text, builtin_shaders());
  return measure_illuminance(probe.world(), {sensor}, 1, {.precision = .004}).front().value;
}

/// Lux below the pane under a perpendicular sun.
double lux_below(Made& made) {
  if (!made.scene) {
    for (const Diagnostic& d : made.diagnostics.all()) ADD_FAILURE() << made.diagnostics.format(d);
    return -1;
  }
  const Extent pane = extent_of(*made.scene);
  add_sun(*made.scene, pane.normal);
  models::add_camera(*made.scene, {});
  return lux(text_of(made), {pane.middle - pane.normal * (pane.thickness + .3f), pane.normal});
}

/// Red, green, blue and alpha of the only texel of t.png.
void write_texel(Made& made, const Rgba& texel) {
  Image image(1, 1, 4);
  for (int k = 0; k < 4; ++k) image.at(0, 0)[k] = (&texel.r)[k];
  write_image((made.folder.path() / "t.png").string(), image);
}

void expect_share(const std::string& what, Made& made, double share) {
  EXPECT_NEAR(lux_below(made), kSunLux * share, kSunLux * std::max(share * kTolerance, 1e-4))
      << what;
}

// Thin-walled transmission: 1 - F at each surface, tinted by the base colour. Solid: the same at
// each interface, and Beer's law in between.
// acceptance: M1
TEST(ImportedPanes, GltfTransmissionPassesTheSun) {
  const json volume = {{"KHR_materials_volume", {{"thicknessFactor", .02}}}};
  const json absorbing = {{"KHR_materials_volume",
                           {{"thicknessFactor", .02},
                            {"attenuationDistance", .1},
                            {"attenuationColor", {.5, .5, .5}}}}};
  json textured = transmitting(1);
  textured["extensions"]["KHR_materials_transmission"]["transmissionTexture"]["index"] = 0;
  const struct {
    const char* what;
    json material;
    double quad, box;  ///< shares of the sun's light
  } kCases[] = {
      {"thin", transmitting(1), kClear, kClear * kClear},
      {"thin and tinted", transmitting(1, {}, .5), kClear / 2, kClear * kClear / 4},
      // Two sheets of these would light each other.
      {"thin and half transmitting", transmitting(.5), kClear / 2, -1},
      {"thin with a picture", textured, kClear * .4, -1},
      {"solid", transmitting(1, volume), kClear, kClear * kClear},
      {"solid and tinted", transmitting(1, volume, .5), kClear / 2, kClear * kClear / 4},
      // .5 after .1, which is the thickness of the box.
      {"absorbing", transmitting(1, absorbing), -1, kClear * kClear / 2},
  };
  for (const auto& c : kCases)
    for (const float thickness : {0.f, .1f}) {
      const double share = thickness > 0 ? c.box : c.quad;
      if (share < 0) continue;
      Made made;
      write_texel(made, {.4f, 0, 0, 1});
      made.import(gltf_pane(c.material, thickness).text());
      expect_share(fmt::format("{}, {}", c.what, thickness > 0 ? "box" : "quad"), made, share);
    }
}

// Coverage: what is not covered passes all light, untinted.
// acceptance: M1
TEST(ImportedPanes, GltfCoverageLeavesTheRest) {
  const struct {
    const char* what;
    json material;
    double open;
  } kCases[] = {
      {"blended", covering("BLEND", .1), .9},
      {"blended by a picture", covering("BLEND", .5, true), 1 - .4 / 2},
      {"opaque", covering("OPAQUE", .1), 0},
      {"masked, below the cut", covering("MASK", .4), 1},
      {"masked, above the cut", covering("MASK", .6), 0},
      {"masked by a picture, below", covering("MASK", 1, true), 1},
  };
  for (const auto& c : kCases)
    for (const float thickness : {0.f, .1f}) {
      Made made;
      write_texel(made, {1, 1, 1, .4f});
      made.import(gltf_pane(c.material, thickness).text());
      expect_share(fmt::format("{}, {}", c.what, thickness > 0 ? "box" : "quad"), made,
                   thickness > 0 ? c.open * c.open : c.open);
    }
  json low = covering("MASK", 1, true);
  low["alphaCutoff"] = .3;
  Made made;
  write_texel(made, {1, 1, 1, .4f});
  made.import(gltf_pane(low, 0).text());
  expect_share("masked by a picture, above", made, 0);
}

// acceptance: M1
TEST(ImportedPanes, ObjDissolveAndFilterPassTheSun) {
  const struct {
    const char* materials;
    double through;  ///< of each surface
  } kCases[] = {
      {"d 0.1\n", .9},
      {"Tr 0.9\n", .9},
      {"d 0.1\nTr 0.1\n", .9},
      {"d 0.1\nNi 1.5\n", .9},
      {"d 1\nillum 6\nNi 1.5\nTf 0.8 0.8 0.8\n", .8},
      {"d 0.5\nillum 4\nTf 0.8 0.8 0.8\n", .4},
      // Of other writers.
      {"d 1\nillum 2\nTf 1 1 1\n", 0},
      // Of Blender.
      {"Pr 0\nPm 0\nTf 1 1 1\nNi 1.5\nd 1\nillum 2\n", kClear},
      {"Pr 0\nPm 0\nTf 0 0 0\nNi 1.5\nd 1\nillum 2\n", 0},
      {"Pr 0\nPm 0\nNi 1.5\nd 0.1\nillum 2\n", .9 * kClear},
      {"map_d t.png\n", .6},
  };
  for (const auto& c : kCases)
    for (const float thickness : {0.f, .1f}) {
      Made made;
      write_texel(made, {.4f, .4f, .4f, 1});
      made.folder.write("m.mtl", std::string("newmtl pane\nKd 0 0 0\n") + c.materials);
      made.import(obj_pane(thickness), "m.obj");
      expect_share(fmt::format("{}{}", c.materials, thickness > 0 ? "box" : "quad"), made,
                   thickness > 0 ? c.through * c.through : c.through);
    }
}

// acceptance: M1
TEST(ImportedPanes, ColladaTransparencyPassesTheSun) {
  const struct {
    const char* surface;
    double through;
  } kCases[] = {
      {"<transparent><color>1 1 1 1</color></transparent>"
       "<transparency><float>.1</float></transparency>",
       .9},
      {"<transparent opaque=\"RGB_ZERO\"><color>.9 .9 .9 1</color></transparent>"
       "<transparency><float>1</float></transparency>",
       .9},
      {"<transparent opaque=\"A_ZERO\"><color>1 1 1 .9</color></transparent>"
       "<transparency><float>1</float></transparency>",
       .9},
      {"<transparent opaque=\"RGB_ONE\"><color>.1 .1 .1 1</color></transparent>"
       "<transparency><float>1</float></transparency>",
       .9},
      {"", 0},
  };
  for (const auto& c : kCases)
    for (const float thickness : {0.f, .1f}) {
      Made made;
      made.import(collada_pane(c.surface, thickness), "m.dae");
      expect_share(c.surface, made, thickness > 0 ? c.through * c.through : c.through);
    }
}

// acceptance: M1
TEST(ImportedPanes, FbxTransparencyPassesTheSun) {
  const auto number = [](const char* name, double value) {
    return fmt::format("P: \"{}\", \"Number\", \"\", \"A\",{}\n", name, value);
  };
  const auto color = [](const char* name, double r, double g, double b) {
    return fmt::format("P: \"{}\", \"Color\", \"\", \"A\",{},{},{}\n", name, r, g, b);
  };
  const struct {
    std::string properties;
    double through;
  } kCases[] = {
      // Blender: alpha .1 and its base colour.
      {number("TransparencyFactor", .9) + color("TransparentColor", .5, .5, .5) +
           number("Opacity", .1),
       .9},
      // Maya: the factor is always 1.
      {number("TransparencyFactor", 1) + color("TransparentColor", .9, .9, .9), .9},
      {number("TransparencyFactor", 1) + color("TransparentColor", 0, 0, 0), 0},
  };
  for (const auto& c : kCases) {
    Made made;
    made.import(fbx_pane(c.properties), "m.fbx");
    expect_share(c.properties, made, c.through);
  }
}

// A pane of IFC is a solid: light crosses two surfaces.
// acceptance: M1
TEST(ImportedPanes, IfcTransparencyPassesTheSun) {
  for (const char* method : {".NOTDEFINED.", ".GLASS.", ".PHONG."}) {
    Made made;
    // The colour of its highlight is black.
    made.import(ifc_pane(fmt::format(
                    "IFCSURFACESTYLERENDERING(#49,0.9,$,$,$,$,IFCNORMALISEDRATIOMEASURE(0.),"
                    "IFCSPECULAREXPONENT(10.),{})",
                    method)),
                "m.ifc");
    expect_share(method, made, .81);
  }
}

// IFC4: no owner history, the style of the item itself, transparency in its shading.
// acceptance: M1
TEST(ImportedPanes, Ifc4TransparencyPassesTheSun) {
  std::string text = ifc_pane("IFCSURFACESTYLESHADING(#49,0.9)", "IFC4", "$");
  const std::string assigned = "#53=IFCSTYLEDITEM(#33,(#52),$)";
  text.replace(text.find(assigned), assigned.size(), "#53=IFCSTYLEDITEM(#33,(#51),$)");
  text.erase(text.find("#52="), text.find("#53=") - text.find("#52="));
  Made made;
  made.import(text, "m.ifc");
  expect_share("transparency .9", made, .81);
  ASSERT_TRUE(made.scene);
  const auto* storey = made.scene->get<scene::InstanceGroup>("IfcBuildingStorey_Ground_floor");
  ASSERT_TRUE(storey);
  EXPECT_EQ(storey->members, std::vector<std::string>{"IfcPlate_glazing_inst"});
  EXPECT_TRUE(made.scene->get<scene::Material>("clear_glass"));
}

// A tessellated pane, of triangles and of a polygon.
TEST(ImportedPanes, Ifc4TessellationsAreRead) {
  for (const char* shape :
       {"IFCTRIANGULATEDFACESET(#60,$,$,((1,2,3),(1,3,4)),$)",
        "IFCPOLYGONALFACESET(#60,$,(#61),$);\n#61=IFCINDEXEDPOLYGONALFACE((1,2,3,4))"}) {
    std::string text = ifc_pane("IFCSURFACESTYLESHADING(#49,0.9)", "IFC4", "$");
    const std::string solid = "#33=IFCEXTRUDEDAREASOLID(#32,#13,#11,0.02)";
    text.replace(text.find(solid), solid.size(),
                 fmt::format("#60=IFCCARTESIANPOINTLIST3D(((-5.,-5.,0.),(5.,-5.,0.),(5.,5.,0.),"
                             "(-5.,5.,0.)));\n#33={}",
                             shape));
    Made made;
    made.import(text, "m.ifc");
    expect_share(shape, made, .9);
  }
}

/// Removes the sky, so that only the sun remains.
void drop_sky(scene::Scene& scene) {
  for (scene::Element& e : scene.elements())
    if (auto* camera = std::get_if<scene::Camera>(&e)) camera->environment.clear();
}

// The sun at 60 degrees: Schlick's curve has .04 there. Sun and sky together: what is not covered
// passes them, whatever their directions.
// acceptance: M1
TEST(ImportedPanes, DaylightPassesAsTheSunDoes) {
  const auto daylight = [](const json& material, bool with_sky, bool with_pane) {
    Made made;
    GltfFile file = gltf_pane(material, 0);
    // y is up; the pane is seen from below at its middle, far from its edges.
    file.node()["rotation"] = {-.70710678, 0, 0, .70710678};
    file.node()["scale"] = {100, 100, 100};
    file.node()["translation"] = {0, 3, 0};
    if (!with_pane) file.material()["alphaMode"] = "MASK";
    if (!with_pane) file.material()["pbrMetallicRoughness"]["baseColorFactor"] = {0, 0, 0, 0};
    made.import(file.text());
    models::add_camera(*made.scene, {});
    models::add_daylight(*made.scene, {.sun_elevation = 60});
    if (!with_sky) drop_sky(*made.scene);
    return lux(text_of(made), {Vec3(0, 2.9f, 0), Vec3(0, 1, 0)});
  };
  const json glass = transmitting(1), veil = covering("BLEND", .1);
  const double sun = daylight(glass, false, false);
  ASSERT_GT(sun, 1000);
  EXPECT_NEAR(daylight(glass, false, true) / sun, kClear, kClear * kTolerance);
  const double all = daylight(veil, true, false);
  EXPECT_NEAR(daylight(veil, true, true) / all, .9, .9 * kTolerance);
}

}  // namespace panes_test
}  // namespace oriel
