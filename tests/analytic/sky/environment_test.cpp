// SPDX-License-Identifier: Apache-2.0
// Environments of materials that replace the environment of the camera.
#include "support/probe.h"

namespace oriel::testing {
namespace environment_test {

/// A material with an even environment of its own.
std::string with_environment(const std::string& name, const std::string& parameters,
                             const Rgb& colour) {
  return fmt::format(
      "shader \"{0}_s\" \"mia_material_x\" ( {1} )\n"
      "material \"{0}\" = \"{0}_s\" shadow = \"{0}_s\" "
      "environment \"test_sky\" ( \"above\" {2}, \"below\" {2} ) end material",
      name, parameters, text_of(colour));
}

const Rgb kOwn(3, .5f, .25f), kCamera(1, 2, .5f);

SceneText under_camera_sky() {
  SceneText scene;
  scene.environment(fmt::format("\"test_sky\" ( \"above\" {0}, \"below\" {0} )", text_of(kCamera)));
  return scene;
}

// acceptance: B5
TEST(MaterialEnvironment, IsSeenByRaysOfAllLobes) {
  struct Case {
    const char* name;
    std::string parameters;
    float share;
  };
  const std::string reflects =
      "\"diffuse_weight\" 0, \"reflectivity\" .5, \"brdf_0_degree_refl\" 1, "
      "\"brdf_90_degree_refl\" 1, \"refl_gloss\" ";
  const std::string passes =
      "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" .5, \"thin_walled\" on, "
      "\"refr_gloss\" ";
  const Case cases[] = {
      {"mirror", reflects + "1", .5f},
      {"glossy", reflects + ".3", .5f},
      {"limited", reflects + ".9, \"single_env_sample\" on", .5f},
      {"faded", reflects + "1, \"refl_falloff_on\" on, \"refl_falloff_dist\" 1", .5f},
      {"pane", passes + "1", .5f},
      {"frosted", passes + ".3", .5f}};
  for (const Case& c : cases)
    for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
      const std::string name = fmt::format("{}, estimator {}", c.name, static_cast<int>(e));
      SceneText own = under_camera_sky();
      own.statement(with_environment("m", c.parameters, kOwn)).plate("m");
      const Measured m = Probe(own).estimator(e).onto(Vec3(0), kUp, 20, 1 << 14);
      for (int k = 0; k < 3; ++k)  // glossy lobes are white by a table, to a thousandth
        EXPECT_NEAR(m.mean[k], kOwn[k] * c.share, 4 * m.error[k] + .001f * kOwn[k]) << name;
      EXPECT_LT(m.error.x, .02f) << name;
      figure("own environment, " + name, kOwn.x * c.share, m.mean.x, m.error.x);
    }
}

// acceptance: B5
TEST(MaterialEnvironment, EachSurfaceHasItsOwn) {
  // The view is mirrored by one surface onto another, which sends it to its environment.
  const auto seen = [](bool first_has, bool second_has) {
    const std::string mirror = "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1";
    SceneText scene = under_camera_sky();
    if (first_has)
      scene.statement(with_environment("a", mirror, Rgb(7)));
    else
      scene.material("a", mirror);
    if (second_has)
      scene.statement(with_environment("b", mirror, kOwn));
    else
      scene.material("b", mirror);
    scene.square("a", Vec3(0), 1, kUp).square("b", Vec3(1, 0, 1), 1, Vec3(-1, 0, 0));
    return Probe(scene).ray(Vec3(-.5f, 0, .5f), Vec3(.5f, 0, -.5f), 64);
  };
  expect_exact("only the second", seen(false, true), kOwn);
  expect_exact("both", seen(true, true), kOwn);
  expect_exact("only the first", seen(true, false), kCamera);
  expect_exact("none", seen(false, false), kCamera);
}

}  // namespace environment_test
}  // namespace oriel::testing
