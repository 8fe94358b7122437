// SPDX-License-Identifier: Apache-2.0
// Blur of the lens and of environments: mia_lens_bokeh.cpp and mia_envblur.cpp in
// shaders/architectural.
#include <fmt/format.h>

#include <atomic>

#include "base/math.h"
#include "cases.h"
#include "mia_stages.h"
#include "render/eye_rays.h"

namespace oriel::effects {
namespace mia_blur {

/// Pictures of lens openings: a half, or a colour.
const char* const kPictures =
    "color texture \"left\" [2 1 3] 'ffffff' '000000' "
    "color texture \"right\" [2 1 3] '000000' 'ffffff' "
    "color texture \"top\" [1 2 3] '000000' 'ffffff' "
    "color texture \"tinted\" [1 1 3] 'ff3300' ";

/// The shader as lens of a camera that sees a wall 4 units away: the mean of `of` over the points
/// where rays of the middle of the picture meet the wall (the origin of x and y without a lens).
/// `tint` is the factor of the lens on the wall's light.
Stage lens_points(const std::function<Rgb(const Vec2& point, const Rgb& tint)>& of) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement(kPictures)
        .statement("shader \"place\" \"test_place\" ( \"scale\" 1 1 0 )")
        .statement(
            "material \"m\" \"test_show\" ( \"color\" = \"place\", \"scalar\" 100 ) end material")
        .square("m", Vec3(0, 0, -4), 50, Vec3(0, 0, 1))
        .camera("focal 1 aperture 1 aspect 1 resolution 32 32 lens " + call);
    const Probe probe(scene.str(), known_shaders());
    Measured m;
    Imath::Vec3<double> sum(0.0);  // double: thousands of terms
    constexpr int kRays = 4096;
    for (int i = 0; i < kRays; ++i) {
      sampling::Sampler sampler(3, 4, static_cast<std::uint32_t>(i));
      const Rgb c = trace_eye_rays(probe.world(), Vec2(16), sampler, m.counts).radiance;
      // The wall's blue is 100 everywhere.
      const Rgb value = of(Vec2(c.x - 100, c.y - 100), c / 100);
      sum += Imath::Vec3<double>(value.x, value.y, value.z);
    }
    m.mean = Rgb(Imath::V3f(sum / double(kRays)));
    m.samples = kRays;
    return m;
  };
}
/// Mean squared distance from the middle, which is that on the lens times (1 - 4 / plane)^2.
const Stage kSpread =
    lens_points([](const Vec2& p, const Rgb&) { return Rgb(p.x * p.x + p.y * p.y); });
/// Mean place, and the spread.
const Stage kPlace =
    lens_points([](const Vec2& p, const Rgb&) { return Rgb(p.x, p.y, p.x * p.x + p.y * p.y); });
/// Mean cube of the place as a complex number, which turns three times as fast as the lens.
const Stage kCube = lens_points([](const Vec2& p, const Rgb&) {
  return Rgb(p.x * p.x * p.x - 3 * p.x * p.y * p.y, 3 * p.x * p.x * p.y - p.y * p.y * p.y, 0);
});

Case lens(const std::string& parameter, const Stage& stage, const std::string& others,
          const std::vector<Given>& values) {
  // In focus at 2, the wall at 4: a place on the wall is minus that on the lens.
  return shows("mia_lens_bokeh." + parameter, [=] {
    for (const Given& each : values) {
      SCOPED_TRACE(each.value);
      const Rgb mean = measured_with("mia_lens_bokeh." + parameter, stage,
                                     "samples 1, plane 2, " + others, each.value)
                           .mean;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(mean[k], each.expected[k], 4e-3f);
    }
  });
}

void add_lens(Cases& all) {
  // An even disc of radius 1: half of the radius squared.
  all.push_back(lens("on", kSpread, "", {{"on", Rgb(.5f)}, {"off", Rgb(0)}}));
  all.push_back(lens("plane", kSpread, "",
                     {{"2", Rgb(.5f)}, {"4", Rgb(0)}, {"8", Rgb(.125f)}, {"-8", Rgb(.125f)}}));
  all.push_back(lens("radius", kSpread, "", {{"0", Rgb(0)}, {".5", Rgb(.125f)}, {"1", Rgb(.5f)}}));
  // Eye rays of each camera sample; one point of a mean of many is nearer to the middle.
  all.push_back(shows("mia_lens_bokeh.samples", [] {
    for (const int samples : {1, 4, 9}) {
      const Measured m =
          measured_with("mia_lens_bokeh.samples", kSpread, "plane 2", std::to_string(samples));
      EXPECT_EQ(m.each(m.counts.eye), samples);
      EXPECT_LT(m.mean.x, .51f / float(samples));
    }
  }));
  // Radii of u^(1 / (2 bias)): even at 1, in the middle below, at the rim above.
  all.push_back(
      lens("bias", kSpread, "", {{"1", Rgb(.5f)}, {".5", Rgb(1 / 3.0f)}, {"2", Rgb(2 / 3.0f)}}));
  // Regular polygons of n corners at distance 1: (2 + cos(2 pi / n)) / 6.
  std::vector<Given> blades = {{"0", Rgb(.5f)}};
  for (const int n : {3, 4, 6})
    blades.push_back({std::to_string(n), Rgb((2 + math::cos(kTwoPi / float(n))) / 6)});
  all.push_back(lens("blade_count", kSpread, "", blades));
  // The mean cube of a triangle with a corner at 1 is 1 / 10; on the wall it is upside down.
  std::vector<Given> angles;
  for (const float turns : {0.0f, 1 / 12.0f, 1 / 6.0f, 1 / 3.0f, 1.0f}) {
    const float a = 3 * kTwoPi * turns;
    angles.push_back({fmt::format("{}", turns), Rgb(-math::cos(a) / 10, -math::sin(a) / 10, 0)});
  }
  all.push_back(lens("blade_angle", kCube, "blade_count 3", angles));
  // Half of the square around the disc, for any bias and blades.
  const std::string picture = "bias 3, blade_count 3, ";
  const Rgb left(.5f, 0, 2 / 3.0f), right(-.5f, 0, 2 / 3.0f), top(0, -.5f, 2 / 3.0f);
  all.push_back(
      lens("use_bokeh", kPlace, "bokeh \"left\"", {{"off", Rgb(0, 0, .5f)}, {"on", left}}));
  all.push_back(
      both(lens("bokeh", kPlace, picture + "use_bokeh on",
                {{"\"left\"", left}, {"\"right\"", right}, {"\"top\"", top}}),
           lens("bokeh", lens_points([](const Vec2&, const Rgb& tint) { return tint; }),
                "use_bokeh on, radius 0", {{"\"left\"", Rgb(1)}, {"\"tinted\"", Rgb(1, .2f, 0)}})));
}

/// "test_edge": an environment of 1 above z = 0 and 0 below, or of such stripes, so wide in z.
struct TestEdge {
  float stripes;
};
constexpr ParamSpec kTestEdgeRows[] = {{ORIEL_PARAM(TestEdge, stripes)}};
std::atomic<int> edge_calls{0};
constexpr ShaderSpec kTestEdge = {
    .name = "test_edge",
    .library = "test",
    .apply = kApplyEnvironment,
    .params = kTestEdgeRows,
    .params_size = sizeof(TestEdge),
    .value =
        [](const Call& call, void* result) {
          ++edge_calls;
          const float z = call.point.ray_direction.z, width = call.as<TestEdge>().stripes;
          const bool lit = width > 0 ? static_cast<int>(std::floor(z / width)) % 2 == 0 : z >= 0;
          *static_cast<Rgba*>(result) = lit ? Rgba(1) : Rgba(0, 0, 0, 1);
        },
};
const Registry& with_edge() {
  static const Registry registry([] {
    std::vector<const ShaderSpec*> specs = known_shaders().all();
    specs.push_back(&kTestEdge);
    return specs;
  }());
  return registry;
}

/// A scene with "edge", "stripes", and the even environments "red" and "blue".
SceneText environments() {
  SceneText scene;
  for (const auto& [name, color] : {std::pair("red", "1 0 0"), {"blue", "0 0 1"}})
    scene.statement(
        fmt::format("shader \"{0}\" \"test_sky\" ( \"above\" {1}, \"below\" {1} )", name, color));
  return scene.statement("shader \"edge\" \"test_edge\" ( )")
      .statement("shader \"stripes\" \"test_edge\" ( \"stripes\" .035 )");
}

/// Reflections of an environment. The default is maps of 16 samples each way.
class Around {
 public:
  explicit Around(const std::string& call, const PrepareOptions& prepared = kCoarse)
      : probe_(environments().environment(call).str(), with_edge(), prepared) {}
  Rgb at(const Vec3& direction) const {
    const World& world = probe_.world();
    return rgb(
        environment_radiance(world.environment, world, Vec3(0), direction, RayKind::Reflect));
  }

 private:
  Probe probe_;
};
/// Radiance 10 degrees above the edge.
const Stage kAbove = [](const std::string& call) { return exactly(Around(call).at(toward(10))); };
/// Red above, at and below it.
const Stage kAboutEdge = [](const std::string& call) {
  const Around around(call);
  return exactly(Rgb(around.at(toward(10)).x, around.at(toward(0)).x, around.at(toward(-10)).x));
};

/// The shader as the environment of a plate that mirrors the view straight back, to 5 degrees above
/// the edge.
Stage mirrored(const std::string& gloss = "1", int samples = 64) {
  return [=](const std::string& call) {
    const Vec3 normal = toward(5);
    SceneText scene = environments();
    scene
        .material("m",
                  "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
                  "\"brdf_90_degree_refl\" 1, \"single_env_sample\" on, \"refl_gloss\" " +
                      gloss)
        .square("m", Vec3(0), 5, normal)
        .environment(call);
    return Probe(scene.str(), with_edge()).direct_only().onto(Vec3(0), normal, 0, samples);
  };
}

void add_environment(Cases& all) {
  const std::string name = "mia_envblur.";
  const std::string edge = "environment \"edge\", mia_material_blur off";
  all.push_back(both(gives(name + "environment", kAbove, "blur .5",
                           {{"\"red\"", Rgb(1, 0, 0)}, {"\"blue\"", Rgb(0, 0, 1)}}),
                     shows(name + "environment", [] {
                       // None: that of the camera, in a material's list of environments.
                       SceneText scene;
                       scene.environment("\"test_sky\" ( \"above\" .3 .2 .1, \"below\" .3 .2 .1 )")
                           .statement(
                               "shader \"s\" \"mia_material_x\" ( \"diffuse_weight\" 0, "
                               "\"reflectivity\" 1, \"brdf_0_degree_refl\" 1 )\n"
                               "material \"m\" = \"s\" environment \"mia_envblur\" "
                               "( \"blur\" .5, \"resolution\" 16 ) end material")
                           .plate("m");
                       testing::expect_exact(
                           "camera's environment",
                           Probe(scene).direct_only().onto(Vec3(0), Vec3(0, 0, 1), 0, 64),
                           Rgb(.3f, .2f, .1f));
                     })));
  // 0 is the environment itself. At the edge any blur shows half of white and black; beside it,
  // more blur is nearer to that.
  all.push_back(shows(name + "blur", [=] {
    const auto with = [=](const char* blur) {
      return measured_with(name + "blur", kAboutEdge, edge, blur).mean;
    };
    Rgb before = with("0");
    expect_about(before, Rgb(1, 1, 0), 1e-6f);
    for (const char* blur : {".6", "1"}) {
      const Rgb now = with(blur);
      EXPECT_LT(now.x, before.x - .01f) << blur;
      EXPECT_GT(now.z, before.z + .01f) << blur;
      EXPECT_NEAR(now.x + now.z, 1, 1e-3f) << blur;
      before = now;
    }
    EXPECT_NEAR(before.y, .5f, .01f);
  }));
  // As the reflection's gloss would have it: .5 is a blur of .5.
  all.push_back(shows(name + "mia_material_blur", [=] {
    const auto with = [=](const char* gloss, const std::string& blur, const char* on) {
      return measured_with(name + "mia_material_blur", mirrored(gloss),
                           "environment \"edge\", resolution 100, blur " + blur, on)
          .mean;
    };
    // What a rough surface loses without the environment's blur.
    const Rgb sharp = with(".3", "0", "off"), blurred = with(".3", "0", "on");
    expect_about(sharp, Rgb(1), .02f);
    expect_about(blurred, with("1", ".7", "off") * sharp, 1e-3f);
    EXPECT_LT(blurred.x, .9f);
  }));
  // So many samples each way are taken; narrow stripes, blurred, are even where they resolve them.
  all.push_back(shows(name + "resolution", [=] {
    const auto with = [=](const char* resolution) {
      const int before = edge_calls;
      const Around around(
          call_of("mia_envblur",
                  fmt::format("environment \"stripes\", blur .8, resolution {}", resolution)),
          {});
      const int calls = edge_calls - before;
      float uneven = 0;
      for (int i = 0; i < 32; ++i)
        uneven += std::abs(around.at(toward(float(i % 8), float(i) * 11)).x - .5f) / 32;
      return std::pair(calls, uneven);
    };
    const auto coarse = with("16"), fine = with("120");
    EXPECT_GE(fine.first - coarse.first, 120 * 120 - 16 * 16);
    EXPECT_LT(fine.second, .02f);
    EXPECT_GT(coarse.second, 2 * fine.second);
  }));
}

}  // namespace mia_blur

Cases mia_blur_cases() {
  Cases all;
  mia_blur::add_lens(all);
  mia_blur::add_environment(all);
  return all;
}

}  // namespace oriel::effects
