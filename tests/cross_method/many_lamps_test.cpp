// SPDX-License-Identifier: Apache-2.0
// Paths that learned which lamps reach them, and paths that did not.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "lights/light_sampler.h"
#include "render/session.h"
#include "scenes.h"
#include "support/probe.h"
#include "transport/path/pilot_paths.h"

namespace oriel::cross_method {
namespace many_lamps_test {

using testing::kUp;
using testing::Measured;
using testing::Probe;

/// Even random numbers.
struct RandomNumbers {
  explicit RandomNumbers(unsigned seed) : engine(seed) {}
  float operator()(float low, float high) {
    return low + (high - low) * static_cast<float>(engine()) / static_cast<float>(engine.max());
  }
  std::mt19937 engine;
};

/// Boxes on the floor of a room of side 4, of the materials "grey" and "glossy".
void add_boxes(SceneText& scene, RandomNumbers& between, int count) {
  for (int i = 0; i < count; ++i) {
    const Vec3 centre(between(-1.5f, 1.5f), between(-1.5f, 1.5f), between(-2, -.4f));
    const Vec3 half(between(.1f, .4f), between(.1f, .4f), between(.1f, .5f));
    scene.box(i % 3 ? "grey" : "glossy", centre - half, centre + half);
  }
}

/// A closed room of side 4 with opaque boxes and lamps of all shapes, at random.
SceneText random_room(unsigned seed) {
  RandomNumbers between(seed);
  SceneText scene(seed % 2 ? "trace depth 4 4 8 shadow segments" : "trace depth 4 4 8 shadow on");
  scene.lambert("grey", .5f)
      .material("glossy", "\"diffuse\" .4 .4 .4, \"reflectivity\" .4, \"refl_gloss\" .6")
      .box("grey", Vec3(-2), Vec3(2), true);
  add_boxes(scene, between, 8);
  for (int i = 0; i < 12; ++i) {
    const std::string at = fmt::format(" origin {} {} {} ", between(-1.5f, 1.5f),
                                       between(-1.5f, 1.5f), between(.4f, 1.5f));
    const float strength = between(.2f, 6);
    const std::string physical =
        fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} )", strength);
    const std::string shapes[] = {
        physical + at,
        physical + at + "direction .3 .2 -1 spread .7",
        physical + at + "direction 0 0 -1 disc 0 0 -1 .1 2 2",
        physical + at + "direction 0 0 -1 rectangle .3 0 0 0 .2 0 2 2",
        physical + at + "sphere .08 2 2",
        fmt::format("\"mib_light_point\" ( \"color\" {0} {0} {0}, \"shadow\" on )", strength / 20) +
            at};
    scene.light(fmt::format("lamp{}", i), shapes[between.engine() % std::size(shapes)]);
  }
  return scene.camera("focal 1 aperture 1.6 aspect 1 resolution 32 32",
                      "1 0 0 0  0 0 1 0  0 -1 0 0  0 0 -1.9 1");
}

class ManyLamps : public ::testing::TestWithParam<unsigned> {};

// acceptance: Q2
TEST_P(ManyLamps, KeepTheMean) {
  constexpr int kSamples = 1 << 19;
  const SceneText scene = random_room(GetParam());
  Probe learned(scene);
  const Measured with = learned.learned_lights().picture(kSamples);
  const Measured without = Probe(scene).picture(kSamples);
  for (int c = 0; c < 3; ++c) {
    const float error = std::hypot(with.error[c], without.error[c]);
    EXPECT_NEAR(with.mean[c], without.mean[c], 3 * error) << "channel " << c;
    EXPECT_LE(error, .015f * without.mean[c]) << "too noisy";
  }
  testing::figure(fmt::format("lamps {}: squared error, without / with", GetParam()), 1,
                  std::pow(without.error.y / with.error.y, 2.0f), 0);
}

/// The lamps of a random room as emissive meshes: spheres, open tubes, squares, and a screen whose
/// picture is black to one side.
SceneText emissive_room(unsigned seed) {
  RandomNumbers between(100 + seed);
  SceneText scene("trace depth 4 4 8 shadow on");
  scene.lambert("grey", .5f)
      .material("glossy", "\"diffuse\" .4 .4 .4, \"reflectivity\" .4, \"refl_gloss\" .6")
      .statement("shader \"place\" \"test_place\" ( \"scale\" 3 0 1 )")
      .material("screen",
                "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"place\"")
      .box("grey", Vec3(-2), Vec3(2), true);
  add_boxes(scene, between, 6);
  for (int i = 0; i < 10; ++i) {
    const std::string name = fmt::format("lamp{}", i);
    const Vec3 centre(between(-1.5f, 1.5f), between(-1.5f, 1.5f), between(-.2f, 1.8f));
    scene.emitter(name, between(1, 20));
    if (i % 3 == 0)
      scene.sphere(name, centre, between(.03f, .1f), 8);
    else if (i % 3 == 1)
      scene.square(name, centre, between(.03f, .15f), kUp);
    else
      scene.box(name, centre - Vec3(.3f, .02f, .02f), centre + Vec3(.3f, .02f, .02f));
  }
  scene.square("screen", Vec3(.5f, -1.9f, .6f), .3f, Vec3(0, 1, 0));
  return scene.camera("focal 1 aperture 1.6 aspect 1 resolution 32 32",
                      "1 0 0 0  0 0 1 0  0 -1 0 0  0 0 -1.9 1");
}

// acceptance: Q2
TEST_P(ManyLamps, OfEmissiveMeshesKeepTheMean) {
  constexpr int kSamples = 1 << 18;
  const SceneText scene = emissive_room(GetParam());
  Probe learned(scene);
  const Measured with = learned.learned_emitters().picture(kSamples);
  const Measured without = Probe(scene).picture(kSamples);
  const Measured by_rays = Probe(scene).mesh_lights(false).picture(4 * kSamples);
  for (int c = 0; c < 3; ++c) {
    const float error = std::hypot(with.error[c], without.error[c]);
    EXPECT_NEAR(with.mean[c], without.mean[c], 3 * error) << "channel " << c;
    EXPECT_NEAR(with.mean[c], by_rays.mean[c], 3 * std::hypot(with.error[c], by_rays.error[c]));
    EXPECT_LE(error, .02f * without.mean[c]) << "too noisy";
  }
  testing::figure(fmt::format("meshes {}: squared error, without / with", GetParam()), 1,
                  std::pow(without.error.y / with.error.y, 2.0f), 0);
}

INSTANTIATE_TEST_SUITE_P(CrossMethod, ManyLamps, ::testing::Range(1u, 11u));

/// Two rooms side by side; the camera is in one, most lamps are in the other.
SceneText lamps_next_door(const std::string& options = "") {
  SceneText scene("trace depth 4 4 8 shadow segments " + options);
  scene.lambert("grey", .5f)
      .box("grey", Vec3(-2), Vec3(2), true)
      .box("grey", Vec3(2.1f, -2, -2), Vec3(6, 2, 2), true);
  for (int i = 0; i < 48; ++i)
    scene.light(fmt::format("lamp{}", i),
                fmt::format("\"physical_light\" ( \"color\" 5 5 5 ) origin {} {} 1.5",
                            i < 3 ? -1 : 2.4f + .05f * float(i), -1.5f + .06f * float(i)));
  return scene.camera("focal 1 aperture 1.6 aspect 1 resolution 96 96",
                      "1 0 0 0  0 0 1 0  0 -1 0 0  0 0 -1.9 1");
}

/// Squared noise of pictures of 96 x 96 without what was learned, relative to that with it, for few
/// paths in each pixel: many stratified ones would take each lamp evenly.
float noise_without(const Probe& with, const Probe& without) {
  const auto pilots = [](const Probe& probe) {
    RayCounts counts;
    return PilotPaths(probe.world(), {0, 0, 96, 96}, probe.settings(), 0, counts, 2048);
  };
  return pilots(with).compare(pilots(without)).noise;
}

TEST(ManyLamps, EmissiveMeshesBehindWallsTakeFewSamples) {
  SceneText scene("trace depth 4 4 8");
  scene.lambert("grey", .5f)
      .emitter("glow", 20)
      .box("grey", Vec3(-2), Vec3(2), true)
      .box("grey", Vec3(2.1f, -2, -2), Vec3(6, 2, 2), true);
  for (int i = 0; i < 62; ++i)
    scene.sphere("glow",
                 Vec3(i < 2 ? -1.0f : 2.4f + .4f * float(i / 8), -1.5f + .4f * float(i % 8), 1.5f),
                 .05f, 4);
  scene.camera("focal 1 aperture 1.6 aspect 1 resolution 96 96",
               "1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1");  // sees the floor
  Probe learned(scene);
  learned.learned_emitters();
  EXPECT_GT(noise_without(learned, Probe(scene)), 1.5f);
}

TEST(ManyLamps, LampsBehindWallsTakeFewSamples) {
  Probe learned(lamps_next_door());
  learned.learned_lights();
  const Measured with = learned.picture(1 << 16),
                 without = Probe(lamps_next_door()).picture(1 << 16);
  EXPECT_LT(std::pow(with.error.y / without.error.y, 2.0f), .7f);
  EXPECT_NEAR(with.mean.y, without.mean.y, 3 * std::hypot(with.error.y, without.error.y));
}

TEST(ManyLamps, ChancesOfACellFollowItsLight) {
  // Two points on each side of a wall, two lights: each side sees one of them.
  const SurfaceTree::Point points[] = {
      {Vec3(0), kUp}, {Vec3(0), kUp}, {Vec3(0), -kUp}, {Vec3(0), -kUp}};
  const float squares[] = {16, 0, 16, 0, 0, 16, 0, 16};
  const std::vector<float> by_tree(8, .5f);
  const LearnedLights learned(points, squares, by_tree);
  // The node above counts as half a point: here all points, whose own node above is black.
  const double all = 32 / 4.5, own = (32 + .5 * all) / 2.5, other = .5 * all / 2.5;
  const double share = std::sqrt(own) / (std::sqrt(own) + std::sqrt(other));
  const LightChances up = learned.at(Vec3(.1f, .2f, 0), kUp), down = learned.at(Vec3(0), -kUp);
  EXPECT_NEAR(up.probability[0], share, 1e-6);
  EXPECT_FLOAT_EQ(up.probability[0] + up.probability[1], 1);
  EXPECT_FLOAT_EQ(up.probability[0], down.probability[1]);
  EXPECT_FLOAT_EQ(up.until[1], 1);
  // Choices follow the probabilities, and the number that is left is uniform.
  int first = 0;
  double rest = 0;
  constexpr int kDraws = 1000;
  for (int i = 0; i < kDraws; ++i) {
    float u = (float(i) + .5f) / kDraws;
    first += up.choose(u) == 0;
    rest += u;
  }
  EXPECT_NEAR(first / double(kDraws), up.probability[0], .002);
  EXPECT_NEAR(rest / kDraws, .5, .01);
}

TEST(ManyLamps, LightsThatReachNeighboursDifferentlyAreNotLearned) {
  // Each of four points of a cell sees another light; the tree finds it nine times in ten. Where
  // all see the same light, which the tree rarely finds, it is learned.
  const std::vector<SurfaceTree::Point> points(4, {Vec3(0), kUp});
  std::vector<float> own(16, 0), same(16, 0), by_tree(16, .1f / 3), blind(16, .9f / 3);
  for (std::size_t i = 0; i < 4; ++i) {
    own[5 * i] = same[4 * i] = 16;
    by_tree[5 * i] = .9f;
    blind[4 * i] = .1f;
  }
  const auto chances = [&](std::span<const float> squares, std::span<const float> tree) {
    return LearnedLights(points, squares, tree).at(Vec3(0), kUp).unlearned;
  };
  EXPECT_EQ(chances(own, by_tree), 1);
  EXPECT_LT(chances(same, blind), .5f);
}

}  // namespace many_lamps_test
}  // namespace oriel::cross_method
