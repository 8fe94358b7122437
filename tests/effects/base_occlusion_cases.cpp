// SPDX-License-Identifier: Apache-2.0
// Ambient occlusion: shaders/base/mib_occlusion.cpp.
#include <fmt/format.h>

#include "base_stages.h"
#include "cases.h"

namespace oriel::effects {
namespace base_occlusion {

/// A plate at the origin that shows the call, and an infinite wall in the plane x = `wall`.
SceneText beside_wall(const std::string& shown, float wall) {
  SceneText scene;
  scene.statement(shown).plate("m").lambert("wall", 0);
  return scene.polygon("wall", {Vec3(wall, -1000, -1), Vec3(wall, 1000, -1), Vec3(wall, 1000, 2000),
                                Vec3(wall, -1000, 2000)});
}
Measured seen(const SceneText& scene, int samples, float degrees = 0) {
  return Probe(scene.str(), known_shaders()).onto(Vec3(0), kUp, degrees, samples);
}
/// The wall occludes half of the hemisphere.
Stage half_open(float wall = .001f, int samples = 4096) {
  return [=](const std::string& call) {
    return seen(beside_wall(shown_as_light(call), wall), samples);
  };
}
/// Alpha of the result as grey, next to a wall.
Measured alpha_half_open(const std::string& call) {
  return seen(beside_wall(shown_as_light("\"mib_color_alpha\" ( \"input\" = \"o\", \"factor\" 1 )",
                                         "shader \"o\" " + call),
                          .001f),
              4096);
}
/// A round wall of height 1 at distance 1: directions within 45 degrees of the normal are open.
Measured in_court(const std::string& call) {
  SceneText scene;
  scene.statement(shown_as_light(call)).square("m", Vec3(0), .9f, kUp).lambert("wall", 0);
  for (int i = 0; i < 64; ++i) {
    const auto at = [&](int k, float z) {
      const float a = kTwoPi * float(k) / 64;
      return Vec3(std::cos(a), std::sin(a), z);
    };
    scene.polygon("wall", {at(i, -1), at(i + 1, -1), at(i + 1, 1), at(i, 1)});
  }
  return seen(scene, 4096);
}

/// Beside a wall, with the eye at 45 degrees on the wall's side or on the other. The mirrored view
/// meets the wall from the other side only.
Stage from_side(bool of_wall) {
  return [=](const std::string& call) {
    const SceneText scene = beside_wall(shown_as_light(call), 1);
    const Vec3 away = normalize(Vec3(of_wall ? 1 : -1, 0, 1)) * .5f;
    return Probe(scene.str(), known_shaders()).ray(away, -away, 64);
  };
}

/// A plate in rotated spaces. Its normal is +z in world, -x in camera and -z in object space. The
/// directions +x of these spaces are +x, -z and -x in world space.
Stage in_spaces(const std::string& elements = {}) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement(shown_as_light(call, elements))
        .polygon("m", {Vec3(5, -5, 0), Vec3(-5, -5, 0), Vec3(-5, 5, 0), Vec3(5, 5, 0)},
                 "transform -1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1")
        .camera("focal 1 aperture 1 aspect 1 resolution 32 32", "0 0 1 0 0 1 0 0 -1 0 0 0 0 0 0 1");
    return seen(scene, 64);
  };
}

/// The parameters that mib_amb_occlusion and mib_fast_occlusion share. `wide` sets the cone to the
/// hemisphere, `narrow` to one direction.
void add_common(Cases& all, const std::string& shader, const std::string& wide,
                const std::string& narrow) {
  const std::string name = shader + ".", grey = wide + ", bright 1 1 1 1, dark 0 0 0 0, samples 4";
  const Stage half = half_open();
  all.push_back(
      gives(name + "bright", half, wide + ", samples 4, dark 0 0 0 0",
            {{"0 0 0 0", Rgb(0)}, {"1 1 1 1", Rgb(.5f)}, {"2 1 .5 1", Rgb(1, .5f, .25f)}}));
  all.push_back(
      gives(name + "dark", half, wide + ", samples 4, bright 1 1 1 1",
            {{"0 0 0 0", Rgb(.5f)}, {"1 1 1 1", Rgb(1)}, {".5 .25 2 1", Rgb(.75f, .625f, 1.5f)}}));
  // A wall at .5 beyond max_distance does not occlude; it occludes more as max_distance grows.
  all.push_back(
      both(gives(name + "max_distance", half_open(.5f), grey, {{".4", Rgb(1)}, {"0", Rgb(.5f)}}),
           falls(name + "max_distance", half_open(.5f), grey, {".6", "1", "4", "0"})));
  const std::string mirrored = narrow + ", bright 1 1 1 1, dark 0 0 0 0, samples 4";
  all.push_back(both(
      gives(name + "reflective", from_side(true), mirrored, {{"off", Rgb(1)}, {"on", Rgb(1)}}),
      gives(name + "reflective", from_side(false), mirrored, {{"off", Rgb(1)}, {"on", Rgb(0)}})));
  // Mode 1: half of a sky of .6. Modes 2 to 4: the normal in world, camera and object space.
  const Stage below_sky = [](const std::string& call) {
    return seen(beside_wall(shown_as_light(call), .001f).uniform_sky(.6f), 4096);
  };
  all.push_back(
      both(gives(name + "output_mode", below_sky, grey, {{"0", Rgb(.5f)}, {"1", Rgb(.3f)}}),
           gives(name + "output_mode", in_spaces(), narrow + ", samples 4",
                 {{"2", Rgb(.5f, .5f, 1)}, {"3", Rgb(0, .5f, .5f)}, {"4", Rgb(.5f, .5f, 0)}})));
  all.back() = both(all.back(), shows(name + "output_mode", [=] {
                      // The bent normal points away from the wall.
                      const Rgb bent = half(call_of(shader, grey + ", output_mode 2")).mean;
                      EXPECT_LT(bent.x, .45f);
                      EXPECT_NEAR(bent.y, .5f, .05f);
                    }));
  all.push_back(gives(name + "occlusion_in_alpha", alpha_half_open, grey + ", output_mode 2",
                      {{"off", Rgb(1)}, {"on", Rgb(.5f)}}));
  all.push_back(shows(name + "samples", [=] {
    const auto with = [&](int samples) {
      return half(call_of(shader, fmt::format("{}, samples {}", grey, samples)));
    };
    const Measured one = with(1), four = with(4);
    testing::expect_exact("one ray", one, .5f, .05f);
    EXPECT_NEAR(four.each(four.counts.probe), 4 * one.each(one.counts.probe), 1e-3);
    EXPECT_GT(one.each(one.counts.probe), .5);
  }));
}

void add_occlusion(Cases& all) {
  const std::string open = "bright 1 1 1 1, dark 0 0 0 0, samples 4";
  const std::string amb = "mib_amb_occlusion", fast = "mib_fast_occlusion";
  add_common(all, amb, "spread 1", "spread 0");
  // The half angle is a share of 90 degrees: 27 degrees are above the wall.
  all.push_back(both(gives(amb + ".spread", in_court, open, {{"0", Rgb(1)}, {".3", Rgb(1)}}),
                     falls(amb + ".spread", in_court, open, {".45", ".6", ".8", "1"})));
  // A larger exponent makes far hits occlude less. Without a max_distance it has no effect.
  const std::string reach = open + ", spread 1, max_distance 2";
  all.push_back(both(rises(amb + ".falloff", half_open(.5f), reach, {".5", "1", "2", "4"}),
                     scales(amb + ".falloff", half_open(.5f), open + ", spread 1", "1", "4", 1)));
  add_common(all, fast, "spread 0", "spread 1");
  // The cosine of the half angle; above .707 the cone is above the wall.
  all.push_back(both(gives(fast + ".spread", in_court, open, {{"1", Rgb(1)}, {".75", Rgb(1)}}),
                     rises(fast + ".spread", in_court, open, {"0", ".3", ".6"})));
  all.push_back(rises(fast + ".spread_exp", in_court, open, {"1", "3", "9"}));
}

void add_gathered(Cases& all) {
  const std::string name = "mib_fg_occlusion.result_when_fg_is_off";
  const Stage gathered = [](const std::string& call) {
    SceneText scene("trace depth 8 8 12 finalgather on");
    scene.statement(shown_as_light(call)).plate("m");
    return seen(scene, 64);
  };
  const std::string color = ".3 .2 .1 1";
  all.push_back(
      both(gives(name, half_open(), "", {{color, Rgb(.3f, .2f, .1f)}, {"1 1 1 1", Rgb(1)}}),
           gives(name, gathered, "", {{color, Rgb(1)}, {"1 1 1 1", Rgb(1)}})));
}

void add_bent(Cases& all) {
  const std::string name = "mib_bent_normal_env.";
  // An environment that is white above and red below.
  const std::string skies =
      "shader \"sky\" \"test_sky\" ( \"above\" 1 1 1, \"below\" 1 0 0 )\n"
      "shader \"blue\" \"test_sky\" ( \"above\" 0 0 1, \"below\" 0 0 1 )\n";
  const Stage here = value(skies);
  const std::string up = "bent_normals .5 .5 1 .5, environment \"sky\", ";
  const Rgb white(1), red(1, 0, 0);
  all.push_back(gives(name + "bent_normals", here, "strength 1, environment \"sky\"",
                      {{".5 .5 1 1", white}, {".5 .5 0 1", red}, {"1 .2 .6 .25", white * .25f}}));
  all.push_back(gives(name + "occlusion_in_alpha", here, up + "strength 1, occlusion .3 .2 .1 1",
                      {{"on", white * .5f}, {"off", Rgb(.3f, .2f, .1f)}}));
  all.push_back(both(gives(name + "occlusion", here, up + "strength 1, occlusion_in_alpha off",
                           {{"1 1 1 1", white}, {".5 .25 0 1", Rgb(.5f, .25f, 0)}}),
                     gives(name + "occlusion", here, up + "strength 1",
                           {{"1 1 1 1", white * .5f}, {".5 .25 0 1", white * .5f}})));
  all.push_back(gives(name + "strength", here, up + "occlusion_in_alpha off",
                      {{"0", Rgb(0)}, {".2", white * .2f}, {"2", white * 2.0f}}));
  // Its own environment, else the scene's.
  const Stage below_sky = [skies](const std::string& call) {
    SceneText scene;
    scene.statement(shown_as_light(call, skies)).plate("m").uniform_sky(.25f);
    return seen(scene, 64);
  };
  const std::string open_up = "bent_normals .5 .5 1 1, strength 1";
  all.push_back(both(gives(name + "environment", below_sky, open_up,
                           {{"\"sky\"", white}, {"\"blue\"", Rgb(0, 0, 1)}}),
                     shows(name + "environment", [=] {
                       testing::expect_exact(
                           "the scene's", below_sky(call_of("mib_bent_normal_env", open_up)), .25f);
                     })));
  // The direction +x of each space, looked up in a picture around the scene.
  const Stage spaces =
      in_spaces(kRampTexture + "shader \"around\" \"mib_lookup_spherical\" ( \"tex\" \"t\" )\n");
  const std::string along_x = "bent_normals 1 .5 .5 1, strength 1, environment \"around\"";
  const Rgb x = ramp_color(.75f, .5f), minus_x = ramp_color(.25f, .5f),
            ahead = ramp_color(.5f, .5f);
  all.push_back(gives(name + "coordinate_space", spaces,
                      along_x + ", matrix 0 0 -1 0 0 1 0 0 1 0 0 0 0 0 0 1",
                      {{"0", ahead}, {"2", x}, {"3", ahead}, {"4", minus_x}}));
  all.push_back(gives(name + "matrix", spaces, along_x + ", coordinate_space 0",
                      {{"1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", x},
                       {"0 0 -1 0 0 1 0 0 1 0 0 0 0 0 0 1", ahead},
                       {"-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1", minus_x}}));
  // The direction is 30 degrees above the horizon: only a wide cone reaches below it.
  const std::string low = "bent_normals .933 .5 .75 1, strength 1, environment \"sky\"";
  const auto many = [=](const std::string& call) {
    SceneText scene;
    scene.statement(shown_as_light(call, skies)).plate("m");
    return seen(scene, 4096);
  };
  all.push_back(both(gives(name + "samples_spread", many, low, {{"0", white}, {".3", white}}),
                     falls(name + "samples_spread", many, low, {".3", ".5", "1"}, 1)));
  all.push_back(shows(name + "env_samples", [=] {
    const auto with = [&](int samples) {
      return many(call_of("mib_bent_normal_env",
                          fmt::format("{}, samples_spread 1, env_samples {}", low, samples)));
    };
    const Measured one = with(1), four = with(4);
    testing::expect_same("mean", four, one, .05f);
    EXPECT_LT(four.error.y, .8f * one.error.y) << "more look-ups are smoother";
  }));
}

Cases cases() {
  Cases all;
  add_occlusion(all);
  add_gathered(all);
  add_bent(all);
  return all;
}

}  // namespace base_occlusion

Cases base_occlusion_cases() { return base_occlusion::cases(); }

}  // namespace oriel::effects
