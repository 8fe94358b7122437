// SPDX-License-Identifier: Apache-2.0
// Light map shaders: measured light, and rendering without the maps.
#include "mi/reader.h"
#include "support/probe.h"

namespace oriel::testing {
namespace lightmap_test {

SceneText measured(const char* parameters) {
  SceneText scene;
  return scene.statement(fmt::format("shader \"s\" \"mib_lightmap_sample\" ( {} )", parameters))
      .material("m", "\"reflectivity\" 0, \"diffuse\" 0 0 0, \"additional_color\" = \"s\"")
      .plate("m");
}

TEST(LightMaps, SamplesShowTheLightOfEachSide) {
  for (const auto& [flip, exact] : {std::pair(0, 1.0f), {1, .6f}, {2, 1.6f}}) {
    SceneText scene = measured(fmt::format("\"flip\" {}", flip).c_str());
    scene.light("above", "\"mib_light_infinite\" ( \"color\" 2 2 2 ) direction 0 -.8660254 -.5")
        .light("below", "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction 0 .8 .6");
    Probe probe(scene);
    probe.direct_only();
    expect_exact("front", probe.onto(Vec3(0), kUp, 20, 64), exact);
    expect_exact("the same from behind", probe.onto(Vec3(0), -kUp, 20, 64), exact);
  }
}

TEST(LightMaps, SamplesMayShowIndirectLight) {
  for (const auto& [indirect, exact] : {std::pair("off", 0.0f), {"on", .7f}}) {
    SceneText scene = measured(fmt::format("\"indirect\" {}", indirect).c_str());
    scene.uniform_sky(.7f);
    expect_exact(indirect, Probe(scene).onto(Vec3(0), kUp, 20, 4096), exact, .05f);
  }
}

TEST(LightMaps, MaterialsThatAskForOneAreReportedAndRendered) {
  SceneText scene;
  scene
      .statement(
          "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" .3 .3 .3 ) "
          "lightmap \"mib_lightmap_write\" ( ) end material")
      .plate("m");
  Diagnostics diagnostics;
  mi::ReadOptions options;
  options.packages = builtin_packages();
  options.knows_shader = [](std::string_view n) { return test_registry().find(n) != nullptr; };
  scene::Scene read = mi::read_text(scene.str(), options, diagnostics);
  PrepareReport report;
  const auto world = prepare(read, read.renders.back(), test_registry(), {}, diagnostics, report);
  ASSERT_TRUE(world);
  ASSERT_EQ(diagnostics.all().size(), 1u);
  EXPECT_EQ(diagnostics.all()[0].code, "OR-RT-045");
  ShadingPoint point;
  point.ray_direction = -kUp;
  Closure closure;
  shade(world->materials[0], point, closure);
  EXPECT_NEAR(closure.emission.x, .3f, 1e-6f);
}

}  // namespace lightmap_test
}  // namespace oriel::testing
