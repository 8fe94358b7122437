// SPDX-License-Identifier: Apache-2.0
// Bump modes and cut-outs in images: normals from mirrors and lit cards, cut-outs for all ray
// types.
#include "bsdf/terminator.h"
#include "support/probe.h"

namespace oriel::testing {
namespace bump_cases_test {

/// "test_links": 0 in round holes of radius .3 about whole numbers of x and y, else 1.
constexpr ShaderSpec kTestLinks = {
    .name = "test_links",
    .library = "test",
    .apply = kApplyTexture,
    .result = ParamType::Scalar,
    .result_size = sizeof(float),
    .value =
        [](const Call& call, void* result) {
          const Vec3& p = call.point.position;
          const float x = p.x - std::round(p.x), y = p.y - std::round(p.y);
          *static_cast<float*>(result) = x * x + y * y < .09f ? 0 : 1;
        },
};

const Registry& registry() {
  static const Registry all = test_registry_with({&kTestLinks});
  return all;
}

/// The plate z = 0, front up, as an object that is turned by 90 degrees about z and stretched
/// twofold along its x: its x runs along world y, its y against world x.
SceneText plate(const std::string& material) {
  SceneText scene;
  scene.material("m", material)
      .statement("shader \"tilt\" \"test_tilt\" ( \"normal\" -.3 .1 1.8 )")
      .mesh("m", {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}, {{0, 1, 2, 3}},
            {}, "transform 0 -1 0 0  .5 0 0 0  0 0 1 0  0 0 0 1")
      // The camera's x is world y, its y against world x.
      .camera("focal 1 aperture 1 aspect 1 resolution 8 8", "0 -1 0 0  1 0 0 0  0 0 1 0  0 0 0 1");
  return scene;
}

/// The normal that mirrors the view from above.
Vec3 mirroring_normal(const std::string& bump) {
  SceneText scene = plate(
      "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
      "\"brdf_90_degree_refl\" 1, \"no_diffuse_bump\" on, " +
      bump);
  scene.environment("\"test_direction\" ()");
  const Measured m = Probe(scene.str(), registry()).ray(Vec3(0, 0, 1), -kUp, 64);
  return normalize(m.mean * 2 - Rgb(1) + kUp);
}

/// Diffuse light of three suns, and the expected light for a normal n.
const Vec3 kSuns[] = {Vec3(0, 0, 1), Vec3(.6f, 0, .8f), Vec3(0, .6f, .8f)};
Rgb diffuse_light(const std::string& bump) {
  SceneText scene = plate("\"diffuse\" 1 1 1, \"reflectivity\" 0, " + bump);
  const char* const colours[] = {"1 0 0", "0 1 0", "0 0 1"};
  for (int i = 0; i < 3; ++i)
    scene.light(fmt::format("sun{}", i),
                fmt::format("\"mib_light_infinite\" ( \"color\" {} ) direction {}", colours[i],
                            text_of(-kSuns[i])));
  return Probe(scene.str(), registry()).direct_only().ray(Vec3(0, 0, 1), -kUp, 64).mean;
}
Rgb light_on(const Vec3& n) {
  Rgb light;
  for (int i = 0; i < 3; ++i) light[i] = dot(kSuns[i], n) * bsdf::soft_terminator(kUp, n, kSuns[i]);
  return light;
}

void expect_vector(const Vec3& actual, const Vec3& expected, const std::string& name) {
  EXPECT_LT(length(actual - expected), 2e-5f)
      << name << ": " << text_of(actual) << " against " << text_of(expected);
}

/// The vector of all cases, and what it is in the world by the space it is meant in: object x
/// halves (normals shrink where the object stretches) and runs along world y.
const char* const kVector = "-.3 .1 .8";
const Vec3 kInWorld[] = {Vec3(-.3f, .1f, .8f), Vec3(-.3f, .1f, .8f), Vec3(-.1f, -.15f, .8f),
                         Vec3(-.1f, -.3f, .8f)};

// acceptance: B1, B2
TEST(BumpModes, NineModesByTwoInputsMatchAnalyticNormals) {
  for (int mode = 0; mode <= 8; ++mode)
    for (const char* input : {"overall_bump", "standard_bump"}) {
      const std::string name = fmt::format("bump_mode {}, {}", mode, input);
      // The old `bump` acts in mode 0 alone, where the vectors are not read.
      const std::string bump =
          fmt::format("\"bump_mode\" {}, \"{}\" {}, \"bump\" \"tilt\"", mode, input, kVector);
      Vec3 n = Vec3(-.3f, .1f, 1.8f);
      if (mode >= 1) n = kInWorld[(mode - 1) % 4] + (mode <= 4 ? kUp : Vec3(0));
      n = normalize(n);
      expect_vector(mirroring_normal(bump), n, name + ", mirrored");
      expect_vector(diffuse_light(bump + ", \"no_diffuse_bump\" off"), light_on(n),
                    name + ", diffuse");
      const bool spared = mode == 0 || std::string_view(input) == "standard_bump";
      expect_vector(diffuse_light(bump + ", \"no_diffuse_bump\" on"), light_on(spared ? kUp : n),
                    name + ", diffuse without bumps");
    }
}

// acceptance: B2
TEST(BumpModes, StandardIsAddedToOverall) {
  const auto bump = [](int mode) {
    return fmt::format("\"bump_mode\" {}, \"overall_bump\" .4 0 .2, \"standard_bump\" 0 .3 .5",
                       mode);
  };
  const Vec3 overall = normalize(Vec3(.4f, 0, 1.2f));
  const Vec3 both = normalize(overall + Vec3(0, .3f, .5f));
  expect_vector(mirroring_normal(bump(2)), both, "added, mirrored");
  expect_vector(diffuse_light(bump(2) + ", \"no_diffuse_bump\" on"), light_on(overall),
                "added, diffuse without standard");
  // A set normal replaces the previous one.
  expect_vector(mirroring_normal(bump(6)), normalize(Vec3(0, .3f, .5f)), "set, mirrored");
}

// acceptance: B1
TEST(BumpModes, SparedDiffuseLightStaysAndTheReflectionTurns) {
  const auto measure = [](const char* more) {
    SceneText scene = plate(std::string("\"diffuse\" 1 1 1, \"reflectivity\" .5, "
                                        "\"brdf_0_degree_refl\" 1, \"brdf_90_degree_refl\" 1, "
                                        "\"bump_mode\" 0") +
                            more);
    scene.environment("\"test_direction\" ()")
        .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction -.6 0 -.8");
    return Probe(scene.str(), registry())
        .outputs()
        .direct_only()
        .ray(Vec3(0, 0, 1), -kUp, 64)
        .outputs;
  };
  AovValues plain = measure(""), spared = measure(", \"bump\" \"tilt\", \"no_diffuse_bump\" on");
  AovValues bumped = measure(", \"bump\" \"tilt\"");
  expect_vector(spared[Aov::Diffuse], plain[Aov::Diffuse], "diffuse, spared");
  EXPECT_GT(length(bumped[Aov::Diffuse] - plain[Aov::Diffuse]), .05f);
  EXPECT_GT(length(spared[Aov::Reflection] - plain[Aov::Reflection]), .05f);
  expect_vector(spared[Aov::Reflection], bumped[Aov::Reflection], "reflection");
}

/// A fence with round holes at integer positions, at z = 1, in front of an emitter of radiance 2.
SceneText fence(const std::string& more = {}) {
  SceneText scene("trace depth 4 4 8 shadow segments");
  scene.statement("shader \"links\" \"test_links\" ()")
      .material("fence",
                "\"diffuse_weight\" 0, \"reflectivity\" 0, \"cutout_opacity\" = \"links\"" + more);
  return scene;
}
SceneText& with_glow(SceneText& scene) {
  return scene.square("fence", Vec3(0, 0, 1), 60, -kUp)
      .emitter("glow", 2)
      .square("glow", Vec3(0, 0, 2), 60, -kUp);
}

// acceptance: B3
TEST(ChainLink, EveryKindOfRayPassesItsHolesAndNothingElse) {
  const auto at = [](const SceneText& scene, const Vec3& from, const Vec3& d, int samples = 64) {
    return Probe(scene.str(), registry()).ray(from, d, samples);
  };
  SceneText open = fence(), mirrored = fence(), glazed = fence(), blurred = fence();
  with_glow(open);
  with_glow(mirrored)
      .material("mirror", "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1")
      .square("mirror", Vec3(0, 0, 0), 60, kUp);
  with_glow(glazed)
      .material("block",
                "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, "
                "\"refr_ior\" 1.5")
      .box("block", Vec3(-9, -9, .2f), Vec3(9, 9, .4f));
  with_glow(blurred)
      .material("metal",
                "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
                "\"refl_gloss\" .9")
      .square("metal", Vec3(0, 0, 0), 60, kUp);
  SceneText shadowed = fence();
  shadowed.square("fence", Vec3(0, 0, 1), 60, -kUp)
      .lambert("card", 1)
      .square("card", Vec3(0, 0, 0), 60, kUp)
      .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
  for (const auto& [x, y, hole] :
       {std::tuple{0.0f, 0.0f, true}, std::tuple{1.2f, 2.2f, true}, std::tuple{-3.0f, .29f, true},
        std::tuple{.5f, .5f, false}, std::tuple{1.0f, .31f, false}, std::tuple{.3f, -.2f, false}}) {
    const std::string name = fmt::format("at {} {}", x, y);
    EXPECT_NEAR(at(open, Vec3(x, y, 0), kUp).mean.x, hole ? 2 : 0, 1e-4f) << name;
    EXPECT_NEAR(at(mirrored, Vec3(x, y, .5f), -kUp).mean.x, hole ? 2 : 0, 1e-4f) << name;
    EXPECT_NEAR(at(glazed, Vec3(x, y, 0), kUp).mean.x, hole ? 2 : 0, 1e-4f) << name;
    EXPECT_NEAR(at(shadowed, Vec3(x, y, .5f), -kUp).mean.x, hole ? 1 : 0, 1e-4f) << name;
  }
  // Blurred over a width less than the wire: between both at a hole's edge, sharp elsewhere.
  EXPECT_NEAR(at(blurred, Vec3(0, 0, .5f), -kUp, 4096).mean.x, 2, .01f);
  EXPECT_NEAR(at(blurred, Vec3(.5f, .5f, .5f), -kUp, 4096).mean.x, 0, .01f);
  EXPECT_NEAR(at(blurred, Vec3(.3f, 0, .5f), -kUp, 4096).mean.x, 1, .1f);

  // Rays of diffuse bounces see the emitter through the holes, this close to the card.
  SceneText gathered = fence();
  gathered.lambert("card", 1)
      .square("card", Vec3(0, 0, 0), .05f, kUp)
      .square("fence", Vec3(0, 0, 20), 4000, -kUp)
      .emitter("glow", 2)
      .square("glow", Vec3(0, 0, 21), 5000, -kUp);
  const Measured m = Probe(gathered.str(), registry()).ray(Vec3(.01f, 0, .3f), -kUp, 1 << 16);
  EXPECT_NEAR(m.mean.x, 2 * kPi * .09f, .01f);
  figure("glow through the holes' share, on a card", 2 * kPi * .09f, m.mean.x, m.error.x);
}

// acceptance: B3
TEST(ChainLink, DiffersFromTransparencyOfTheSameMap) {
  // As transparency the holes keep their reflection, as cut-out they have none.
  const auto measure = [](const char* hole, float x) {
    SceneText scene("trace depth 4 4 8 shadow segments");
    scene.uniform_sky(1)
        .statement("shader \"links\" \"test_links\" ()")
        .emitter("glow", 2)
        .material("fence", std::string("\"diffuse_weight\" 0, \"reflectivity\" .5, "
                                       "\"brdf_0_degree_refl\" 1, \"brdf_90_degree_refl\" 1, "
                                       "\"thin_walled\" on, ") +
                               hole)
        .square("fence", Vec3(0, 0, 1), 10, -kUp)
        .square("glow", Vec3(0, 0, 2), 60, -kUp);
    return Probe(scene.str(), registry()).ray(Vec3(x, 0, 0), kUp, 1 << 12).mean.x;
  };
  const char* const cut = "\"cutout_opacity\" = \"links\"";
  // Half mirrors the sky of 1; half of the rest transmits an emitter of 2.
  EXPECT_NEAR(measure(cut, 0), 2, 1e-4f);
  EXPECT_NEAR(measure("\"transparency\" 1", 0), .5f + .5f * 2, .01f);
  EXPECT_NEAR(measure(cut, .5f), .5f, 1e-4f);
}

}  // namespace bump_cases_test
}  // namespace oriel::testing
