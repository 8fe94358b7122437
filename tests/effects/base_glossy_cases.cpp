// SPDX-License-Identifier: Apache-2.0
// Blurred rays: shaders/base/mib_glossy.cpp.
#include <fmt/format.h>

#include "base_stages.h"
#include "cases.h"

namespace oriel::effects {
namespace base_glossy {

const Vec3 kFront(0, 0, 1);
const Rgb kAbove(1, .8f, .6f), kBelow(.2f, .4f, .1f);

/// Emissive shaders "red" and "blue".
const std::string kBases =
    "shader \"red\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" 1 0 0 )\n"
    "shader \"blue\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" 0 0 1 )\n";

SceneText plate_of(const std::string& call) {
  SceneText scene;
  return scene.statement(kBases + "material \"m\" " + call + " end material")
      .square("m", Vec3(0), 5, kFront);
}

/// A horizontal plate in a sky of two colours, seen at that angle from its normal.
Stage plate(float degrees, bool back = false) {
  return [=](const std::string& call) {
    SceneText scene = plate_of(call);
    scene.environment(fmt::format("\"test_sky\" ( \"above\" {}, \"below\" {} )",
                                  text_of(Vec3(kAbove)), text_of(Vec3(kBelow))));
    return Probe(scene.str(), known_shaders()).onto(Vec3(0), back ? -kFront : kFront, degrees, 256);
  };
}

/// A sky that is white in the half space of `side` and black in the other. The eye is 10 degrees
/// off the normal toward `side`, so that both the mirrored and the straight ray see black.
Measured split_sky(const std::string& call, const Vec3& side, float pixel_paths = 0) {
  SceneText scene = plate_of(call);
  scene.environment(fmt::format("\"test_sky\" ( \"above\" 1 1 1, \"up\" {} )", text_of(side)));
  const float angle = 10 * kPi / 180;
  const Vec3 away = side * std::sin(angle) + kFront * std::cos(angle);
  Probe probe(scene.str(), known_shaders());
  if (pixel_paths > 0) probe.paths_of_pixel(pixel_paths);
  return probe.ray(away, -away, 2048);
}
Stage split_along(const Vec3& side) {
  return [=](const std::string& call) { return split_sky(call, side); };
}
const Vec3 kX(1, 0, 0), kY(0, 1, 0);

/// `p`: "reflection" or "refraction"; `full`: parameters by which the rays have all of the weight.
void add_blur(Cases& all, const std::string& p, const std::string& full,
              std::uint64_t RayCounts::*rays) {
  const std::string shader = "mib_glossy_" + p;
  // More blur toward the white half of the sky sees more of it.
  const std::string along_x = full + ", u_axis 1 0 0, ";
  all.push_back(
      rises(shader + ".u_spread", split_along(kX), along_x + "v_spread .03", {".1", ".25", ".6"}));
  all.push_back(
      rises(shader + ".v_spread", split_along(kY), along_x + "u_spread .03", {".1", ".25", ".6"}));
  // The blur is wide along one axis alone: more of the white half is seen as that axis turns to it.
  const std::string one = full + ", u_spread .4, v_spread .04";
  all.push_back(rises(shader + ".u_axis", split_along(kX), one, {"0 1 0", "1 1 0", "1 0 0"}));
  all.push_back(rises(shader + ".v_axis", split_along(kX), one, {"1 0 0", "1 1 0", "0 1 0"}));
  all.push_back(shows(shader + ".samples", [=] {
    const auto with = [&](int samples) {
      return split_sky(
          call_of(shader, fmt::format("{}, u_spread .4, v_spread .4, samples {}", full, samples)),
          kX, 1);
    };
    EXPECT_EQ(with(0).mean, Rgb(0)) << "not blurred";
    const Measured four = with(4), sixteen = with(16);
    EXPECT_GT(four.mean.x, .1f);
    // Directions on the wrong side of the surface are not traced.
    EXPECT_GT(four.each(four.counts.*rays), 3);
    EXPECT_LE(four.each(four.counts.*rays), 4);
    EXPECT_NEAR(sixteen.each(sixteen.counts.*rays) / four.each(four.counts.*rays), 4, .05);
  }));
}

/// The weights by angle, with black below.
void add_weights(Cases& all, const std::string& p, const Rgb& seen) {
  const std::string shader = "mib_glossy_" + p + ".", base = p + "_base_weight";
  const std::string edge = p + "_edge_weight";
  const std::string call = fmt::format("samples 0, {}_color 1 1 1 1, ", p);
  all.push_back(
      gives(shader + p + "_color", plate(0), fmt::format("samples 0, {} 1, {} 1", base, edge),
            {{"0 0 0 1", Rgb(0)}, {"1 1 1 1", seen}, {".5 1 .25 0", seen * Rgb(.5f, 1, .25f)}}));
  // At 0 degrees the base weight counts alone; at 60 degrees and a factor of 1 each counts half.
  all.push_back(both(gives(shader + base, plate(0), call + edge + " 1",
                           {{"0", Rgb(0)}, {".5", seen * .5f}, {"1", seen}}),
                     gives(shader + base, plate(60), call + edge + " 1, edge_factor 1",
                           {{"0", seen * .5f}, {"1", seen}})));
  all.push_back(both(
      gives(shader + edge, plate(0), call + base + " .5", {{"0", seen * .5f}, {"1", seen * .5f}}),
      gives(shader + edge, plate(60), call + base + " .5, edge_factor 1",
            {{"0", seen * .25f}, {".5", seen * .5f}, {"1", seen * .75f}})));
  // At 85 degrees the edge weight counts by (1 - cosine)^5.
  const float share = std::pow(1 - std::cos(85 * kPi / 180), 5.0f);
  all.back() =
      both(all.back(), gives(shader + edge, plate(85), call + base + " 0",
                             {{".25", seen * (.25f * share)}, {".75", seen * (.75f * share)}}));
  // A higher factor makes the edge narrower.
  all.push_back(both(
      falls(shader + "edge_factor", plate(60), call + base + " 0, " + edge + " 1", {"1", "2", "5"}),
      falls(shader + "edge_factor", plate(80), call + base + " 0, " + edge + " 1",
            {"1", "2", "5"})));
}

void add_reflection(Cases& all) {
  const std::string shader = "mib_glossy_reflection.";
  const std::string full =
      "reflection_color 1 1 1 1, reflection_base_weight 1, reflection_edge_weight 1";
  all.push_back(gives(shader + "base_material", plate(0), "reflection_color 0 0 0 1",
                      {{"\"red\"", Rgb(1, 0, 0)}, {"\"blue\"", Rgb(0, 0, 1)}}));
  add_weights(all, "reflection", kAbove);
  add_blur(all, "reflection", full + ", single_env_sample off", &RayCounts::reflect);
  // A light at distance 3: beyond max_distance the environment is visible, near it a mix.
  const Stage below_lamp = [](const std::string& call) {
    SceneText scene = plate_of(call).uniform_sky(1);
    scene.emitter("lamp", 7).square("lamp", Vec3(0, 0, 3), 4, -kFront);
    return Probe(scene.str(), known_shaders()).onto(Vec3(0), kFront, 0, 256);
  };
  all.push_back(
      both(gives(shader + "max_distance", below_lamp, full + ", samples 0",
                 {{"0", Rgb(7)}, {"2", Rgb(1)}}),
           rises(shader + "max_distance", below_lamp, full + ", samples 0", {"3.5", "6", "20"})));
  // One look-up is made in the mirrored direction; several also see the white half.
  all.push_back(shows(shader + "single_env_sample", [=] {
    const auto with = [&](const char* flag) {
      return split_sky(
          call_of("mib_glossy_reflection",
                  fmt::format("{}, u_spread .4, v_spread .4, single_env_sample {}", full, flag)),
          kX);
    };
    EXPECT_EQ(with("on").mean, Rgb(0));
    EXPECT_GT(with("off").mean.x, .1f);
  }));
}

void add_refraction(Cases& all) {
  const std::string shader = "mib_glossy_refraction.";
  const std::string full =
      "refraction_color 1 1 1 1, refraction_base_weight 1, refraction_edge_weight 1";
  const std::vector<Given> colors = {{"\"red\"", Rgb(1, 0, 0)}, {"\"blue\"", Rgb(0, 0, 1)}};
  const std::vector<Given> red = {{"\"red\"", Rgb(1, 0, 0)}, {"\"blue\"", Rgb(1, 0, 0)}};
  const std::string none = "refraction_color 0 0 0 1";
  const std::string top = shader + "top_material", back = shader + "back_material";
  all.push_back(both(gives(top, plate(0), none, colors),
                     gives(top, plate(0, true), none + ", back_material \"red\"", red)));
  all.push_back(both(gives(back, plate(0, true), none, colors),
                     gives(back, plate(0), none + ", top_material \"red\"", red)));
  add_weights(all, "refraction", kBelow);
  add_blur(all, "refraction", full + ", ior 1", &RayCounts::refract);
  all.push_back(
      gives(shader + "ior", refracted_place(), full + ", samples 0",
            {{"0", snell(1)}, {"1", snell(1)}, {"1.5", snell(1.5f)}, {"2.5", snell(2.5f)}}));
  // A light at distance 3 in the solid.
  const Stage above_lamp = [](const std::string& call) {
    SceneText scene = plate_of(call);
    scene.emitter("lamp", 7).square("lamp", Vec3(0, 0, -3), 4, kFront);
    return Probe(scene.str(), known_shaders()).onto(Vec3(0), kFront, 0, 256);
  };
  all.push_back(both(gives(shader + "max_distance", above_lamp, full + ", samples 0, ior 1.5",
                           {{"0", Rgb(7)}, {"2", Rgb(0)}}),
                     rises(shader + "max_distance", above_lamp, full + ", samples 0, ior 1.5",
                           {"3.5", "6", "20"})));
}

Cases cases() {
  Cases all;
  add_reflection(all);
  add_refraction(all);
  return all;
}

}  // namespace base_glossy

Cases base_glossy_cases() { return base_glossy::cases(); }

}  // namespace oriel::effects
