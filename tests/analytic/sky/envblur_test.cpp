// SPDX-License-Identifier: Apache-2.0
// Blurred environment lookups compared with many sharp lookups.
#include <atomic>

#include "support/probe.h"

namespace oriel::testing {
namespace envblur_test {

/// "test_lamps": a dim gradient and round bright spots of several sizes. Counts its calls.
std::atomic<int> lamps_asked{0};
Rgba lamps(const Vec3& d) {
  const struct {
    Vec3 to;
    Rgb colour;
    float width;
  } all[] = {{Vec3(0, 0, 1), Rgb(8, 6, 3), .1f},
             {Vec3(.8f, .3f, .6f), Rgb(20, 20, 25), .06f},
             {Vec3(-.5f, .6f, .5f), Rgb(2, 4, 2), .3f},
             {Vec3(-.3f, -.9f, .4f), Rgb(30, 10, 10), .06f}};
  Rgb c = Rgb(.3f, .3f, .4f) * (1.2f + d.z);
  for (const auto& lamp : all)
    c += lamp.colour * std::exp((dot(d, normalize(lamp.to)) - 1) / sqr(lamp.width));
  return Rgba(c.x, c.y, c.z, 1);
}
constexpr ShaderSpec kTestLamps = {
    .name = "test_lamps",
    .library = "test",
    .apply = kApplyEnvironment,
    .value =
        [](const Call& call, void* result) {
          ++lamps_asked;
          *static_cast<Rgba*>(result) = lamps(call.point.ray_direction);
        },
};

const Registry& registry() {
  static const Registry all = test_registry_with({&kTestLamps});
  return all;
}

/// The spots, blurred with a map of few samples by default.
std::string blurred(const std::string& parameters) {
  const char* coarse =
      parameters.find("resolution") == std::string::npos ? "\"resolution\" 100" : "";
  const char* comma = *coarse && !parameters.empty() ? ", " : "";
  return fmt::format("\"mia_envblur\" ( \"environment\" \"lamps\", {}{}{} )", coarse, comma,
                     parameters);
}

/// A plate that only reflects, under the spots.
SceneText plate(const std::string& reflection, const std::string& environment) {
  SceneText scene;
  scene.statement("shader \"lamps\" \"test_lamps\" ()")
      .material("m",
                "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
                "\"brdf_90_degree_refl\" 1, " +
                    reflection)
      .plate("m")
      .environment(environment);
  return scene;
}
Measured seen(const SceneText& scene, float degrees, int samples) {
  return Probe(scene.str(), registry()).direct_only().onto(Vec3(0), kUp, degrees, samples);
}

const std::string kSharp = "\"test_lamps\" ()";

/// What a reflection looks up in a direction.
Rgb looked_up(const World& world, const Vec3& d, float roughness = 0,
              RayKind kind = RayKind::Reflect) {
  return rgb(environment_radiance(world.environment, world, Vec3(0), d, kind, false, roughness));
}
Vec3 spread(int i, int n) {
  const float z = 1 - 2 * (static_cast<float>(i) + .5f) / static_cast<float>(n);
  const float r = std::sqrt(1 - z * z), phi = 2.399963f * static_cast<float>(i);
  return Vec3(r * std::cos(phi), r * std::sin(phi), z);
}

// acceptance: V1
TEST(EnvBlur, NoBlurIsTheEnvironmentItself) {
  const Probe off(plate("", blurred("\"mia_material_blur\" off")).str(), registry());
  const Probe on(plate("", blurred("")).str(), registry());
  for (int i = 0; i < 500; ++i) {
    const Vec3 d = spread(i, 500);
    EXPECT_EQ(looked_up(off.world(), d, .3f), rgb(lamps(d)));
    EXPECT_EQ(looked_up(on.world(), d), rgb(lamps(d)));
  }
}

// acceptance: V1
TEST(EnvBlur, KeepsConstantsAndMeans) {
  SceneText even = plate("", "");
  even.statement("shader \"even\" \"test_sky\" ( \"above\" .3 .2 .1, \"below\" .3 .2 .1 )");
  for (const float blur : {.3f, 1.0f}) {
    SceneText constant = even;
    constant.environment(
        fmt::format("\"mia_envblur\" ( \"environment\" \"even\", \"blur\" {}, "
                    "\"resolution\" 100 )",
                    blur));
    const Probe c(constant.str(), registry());
    const Probe p(plate("", blurred(fmt::format("\"blur\" {}", blur))).str(), registry());
    constexpr int kN = 4000;
    Imath::Vec3<double> mean(0.0), exact(0.0);  // double: many terms
    for (int i = 0; i < kN; ++i) {
      const Vec3 d = spread(i, kN);
      EXPECT_LT(length(looked_up(c.world(), d) - Rgb(.3f, .2f, .1f)), 1e-5f);
      const Rgb a = looked_up(p.world(), d), b = rgb(lamps(d));
      mean += Imath::Vec3<double>(a.x, a.y, a.z);
      exact += Imath::Vec3<double>(b.x, b.y, b.z);
    }
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mean[k] / exact[k], 1, .01) << blur;
    figure(fmt::format("mean at blur {}", blur), 1, mean.x / exact.x, 0);
  }
}

// acceptance: V2
TEST(EnvBlur, TabulatesTheEnvironmentOnce) {
  for (const auto& [resolution, side] : {std::pair(100, 48), std::pair(200, 96)}) {
    lamps_asked = 0;
    const Probe probe(plate("\"refl_gloss\" .3, \"single_env_sample\" on",
                            blurred(fmt::format("\"resolution\" {}", resolution)))
                          .str(),
                      registry());
    const int tables = lamps_asked;
    // Four for each sample, with the samples beyond edges; and the table of the environment, nine
    // for each cell and one more for each sixteenth, from elsewhere. Its test with glossy rays asks
    // the first table, but for the sharpest of them.
    const int asked = 4 * 6 * (side + 2) * (side + 2) + 9 * 256 * 256 + 64 * 64;
    EXPECT_GE(tables, asked);
    EXPECT_LE(tables, asked + 64 * 64 / 32);
    EXPECT_GE(6 * side * side, resolution * resolution);
    Probe direct(plate("\"refl_gloss\" .3, \"single_env_sample\" on", blurred("")).str(),
                 registry());
    lamps_asked = 0;
    direct.direct_only().onto(Vec3(0), kUp, 20, 512);
    EXPECT_EQ(lamps_asked, 0);
  }
}

TEST(EnvBlur, CoarseTablesCallTheEnvironmentSomeThousandTimes) {
  lamps_asked = 0;
  const Probe probe(plate("\"single_env_sample\" on", blurred("\"resolution\" 200")).str(),
                    registry(), {.coarse_tables = true});
  EXPECT_GT(lamps_asked, 0);
  EXPECT_LE(lamps_asked, 4 * 6 * 18 * 18 + 4 * 16 * 16 + 2 * 4 * 4);
}

// acceptance: V3
TEST(EnvBlur, OneLookUpIsWhatManyRaysConvergeTo) {
  for (const float gloss : {.9f, .7f, .5f, .3f, .1f, 0.0f}) {
    const std::string g = fmt::format("\"refl_gloss\" {}", gloss);
    Probe sharp(plate(g, kSharp).str(), registry());
    Probe blur(plate(g + ", \"single_env_sample\" on", blurred("\"resolution\" 200")).str(),
               registry());
    for (const float degrees : {0.0f, 30.0f, 60.0f, 75.0f}) {
      const Measured many = sharp.direct_only().onto(Vec3(0), kUp, degrees, 1 << 13);
      const Measured one = blur.direct_only().onto(Vec3(0), kUp, degrees, 64);
      // The blur is round, the lobe is not where it is wide and seen from aside.
      const float tolerance =
          degrees == 0 ? (gloss > 0 ? .025f : .05f) : (degrees < 70 ? .08f : .11f);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(one.mean[k] / many.mean[k], 1, tolerance + 4 * many.error[k] / many.mean[k])
            << gloss << " at " << degrees;
      figure(fmt::format("gloss {} seen at {} degrees", gloss, degrees), many.mean.x, one.mean.x,
             many.error.x);
    }
  }
}

// acceptance: V3
TEST(EnvBlur, FollowsAMappedGloss) {
  // The glossiness is x, and the same from point to point as with the number itself.
  const std::string single = ", \"single_env_sample\" on";
  SceneText scene;
  scene.statement("shader \"place\" \"test_place\" ( \"scale\" 3 0 0 )")
      .statement("shader \"lamps\" \"test_lamps\" ()")
      .material("m",
                "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
                "\"brdf_90_degree_refl\" 1, \"refl_gloss\" = \"place\"" +
                    single)
      .plate("m")
      .environment(blurred(""));
  for (const float gloss : {.2f, .5f, .8f}) {
    const Measured by_map =
        Probe(scene.str(), registry()).direct_only().onto(Vec3(gloss, 0, 0), kUp, 30, 64);
    const Measured fixed =
        seen(plate(fmt::format("\"refl_gloss\" {}{}", gloss, single), blurred("")), 30, 64);
    EXPECT_LT(length(by_map.mean - fixed.mean), 1e-3f) << gloss;
  }
}

TEST(EnvBlur, ManyRaysAreNotBlurredTwice) {
  // Each takes its share of the lobe: 32 are wider by 1.6 %, and the map's samples add to that.
  for (const float paths : {1.0f, 1e6f})
    for (const float degrees : {0.0f, 30.0f}) {
      const std::string g = "\"refl_gloss\" .3, \"refl_gloss_samples\" 32";
      const auto measure = [&](const std::string& environment) {
        return Probe(plate(g, environment).str(), registry())
            .direct_only()
            .paths_of_pixel(paths)
            .onto(Vec3(0), kUp, degrees, paths > 1 ? 1 << 16 : 1 << 11);
      };
      const Measured sharp = measure(kSharp), soft = measure(blurred("\"resolution\" 200"));
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(soft.mean[k] / sharp.mean[k], 1,
                    .06f + 4 * std::hypot(soft.error[k], sharp.error[k]) / sharp.mean[k])
            << paths << " at " << degrees;
    }
}

// acceptance: V4, R11
TEST(EnvBlur, OneLookUpForEachPointLeavesNoNoise) {
  const std::string g = "\"refl_gloss\" .3, \"refl_gloss_samples\" 8";
  const auto measure = [&](const std::string& more, const std::string& environment) {
    return Probe(plate(g + more, environment).str(), registry())
        .direct_only()
        .paths_of_pixel(1)
        .onto(Vec3(0), kUp, 10, 512);
  };
  const Measured sharp = measure("", kSharp);
  const Measured soft = measure(", \"single_env_sample\" on", blurred(""));
  EXPECT_EQ(soft.each(soft.counts.environment), 1);
  EXPECT_NEAR(sharp.each(sharp.counts.environment), 8, .1);
  EXPECT_LT(soft.error.x, 2e-3f * soft.mean.x);
  EXPECT_GT(sharp.error.x, 5 * soft.error.x);
  figure("noise of 8 samples, blurred over sharp", 0, soft.error.x / sharp.error.x, 0);
}

TEST(EnvBlur, LightOfDiffuseSurfacesStays) {
  SceneText scene;
  scene.statement("shader \"lamps\" \"test_lamps\" ()")
      .lambert("m", 1)
      .plate("m")
      .environment(kSharp);
  const Measured sharp = Probe(scene.str(), registry()).onto(Vec3(0), kUp, 0, 1 << 15);
  for (const char* more : {"", "\"blur\" .5"}) {
    scene.environment(blurred(more));
    expect_same("diffuse light", Probe(scene.str(), registry()).onto(Vec3(0), kUp, 0, 1 << 15),
                sharp, .01f);
  }
}

TEST(EnvBlur, WorksInMaterialsWithTheCameraEnvironmentByDefault) {
  const std::string lamps_shader = "shader \"lamps\" \"test_lamps\" ()";
  const auto with = [&](const std::string& inside, const std::string& camera) {
    SceneText scene;
    scene.statement(lamps_shader)
        .statement(
            "shader \"m_s\" \"mia_material_x\" ( \"diffuse_weight\" 0, \"reflectivity\" 1, "
            "\"brdf_0_degree_refl\" 1, \"brdf_90_degree_refl\" 1, \"refl_gloss\" .5, "
            "\"single_env_sample\" on )\n"
            "material \"m\" = \"m_s\" " +
            inside + " end material")
        .plate("m")
        .environment(camera);
    return Probe(scene.str(), registry()).direct_only().onto(Vec3(0), kUp, 10, 64).mean;
  };
  const Rgb of_camera = with("", blurred(""));
  EXPECT_LT(length(with("environment " + blurred(""), "\"test_sky\" ()") - of_camera), 1e-4f);
  EXPECT_LT(length(with("environment \"mia_envblur\" ( \"resolution\" 100 )", kSharp) - of_camera),
            1e-4f);
}

}  // namespace envblur_test
}  // namespace oriel::testing
