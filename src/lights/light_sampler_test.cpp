// SPDX-License-Identifier: Apache-2.0
#include "lights/light_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "lights/portal_table.h"
#include "runtime/world.h"
#include "sampling/sampler.h"

namespace oriel {
namespace light_sampler_test {

LightValue white_light(const Call&, const LightCall&) { return {.colour = Rgb(1)}; }
/// Brighter toward +x, so that the environment's table has no constant density.
void tilted_sky(const Call& call, void* result) {
  *static_cast<Rgba*>(result) = Rgba(1 + call.point.ray_direction.x);
}
/// A lamp toward +x.
constexpr float kLampCosine = .95f;
void lamp(const Call& call, void* result) {
  *static_cast<Rgba*>(result) = Rgba(call.point.ray_direction.x > kLampCosine ? 100.0f : .1f);
}
const ShaderSpec kLamp{.name = "lamp", .library = "test", .value = lamp};
const ShaderSpec kWhiteLight{.name = "white_light", .library = "test", .light = white_light};
const ShaderSpec kTiltedSky{.name = "tilted_sky", .library = "test", .value = tilted_sky};

class Scene {
 public:
  Scene() { world.accel = std::make_unique<geom::Accel>(); }

  Light& add(LightShape shape) {
    std::uniform_real_distribution<float> u(-2, 2);
    Light light;
    light.shape = shape;
    light.position = Vec3(u(engine_), u(engine_), 4 + u(engine_));
    light.edge_u = Vec3(1, 0, 0);
    light.edge_v = Vec3(0, 1, 0);
    light.axes = {light.edge_u, light.edge_v};
    light.area = 1;
    light.shader = &white_;
    world.lights.push_back(std::move(light));
    return world.lights.back();
  }
  void add_portal() {
    Light& light = add(LightShape::Rectangle);
    light.portal = std::make_unique<Portal>();
    light.portal->own_environment = true;  // white
  }
  /// A square of side 2 at z = 1 over the origin, of two emissive triangles, and one that is none.
  MeshLights add_square() {
    geom::Mesh mesh;
    mesh.positions = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {0, 0, 5}, {}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 1, 4}};
    const geom::MeshId id = world.accel->add_mesh(std::move(mesh));
    world.accel->add_instance({.mesh = id});
    std::vector<LightBounds> bounds(2);
    for (LightBounds& b : bounds) b.box = {Vec3(-1, -1, 1), Vec3(1, 1, 1)};
    bounds[0].falling = 1;
    bounds[1].falling = 3;
    const std::uint32_t count[] = {3};
    return {{{.primitive = 0, .power = 1}, {.primitive = 1, .power = 3}}, bounds, count};
  }
  LightSampler sampler(MeshLights mesh_lights = {}, Openings openings = {}) {
    world.accel->commit();
    EnvironmentLight environment(world);
    open_portals(world, environment.table().detail());
    return LightSampler(world, std::move(environment), std::move(mesh_lights), std::move(openings));
  }
  LitVertex vertex() {
    ShadingPoint point;
    point.world = &world;
    point.geometric_normal = Vec3(0, 0, 1);
    return LitVertex(world, point, closure);
  }

  World world;
  Closure closure;
  const ShaderNode sky{kTiltedSky};

 private:
  const ShaderNode white_{kWhiteLight};
  std::mt19937 engine_{1};
};

/// How often each light is picked, in the mean.
std::vector<double> picked(const LightSampler& sampler, const LitVertex& at, std::size_t lights) {
  constexpr int kDraws = 100000;
  std::vector<double> counts(lights);
  for (int i = 0; i < kDraws; ++i)
    sampler.sample(at, (static_cast<float>(i) + .5f) / kDraws, [&](const LightPick& pick) {
      EXPECT_FLOAT_EQ(pick.expected_samples, sampler.expected_samples(at, pick.light));
      counts[static_cast<std::size_t>(pick.light)] += 1.0 / kDraws;
    });
  return counts;
}

void expect_picked_as_expected(const LightSampler& sampler, const LitVertex& at,
                               std::size_t lights) {
  const std::vector<double> counts = picked(sampler, at, lights);
  for (std::size_t i = 0; i < lights; ++i)
    EXPECT_NEAR(counts[i], sampler.expected_samples(at, static_cast<int>(i)), .002) << i;
}

TEST(LightSampler, PickFrequenciesMatchThePmf) {
  Scene scene;
  for (int i = 0; i < 6; ++i) scene.add(LightShape::Directional);
  for (int i = 0; i < 7; ++i) scene.add(i % 2 ? LightShape::Point : LightShape::Rectangle);
  for (int i = 0; i < 3; ++i) scene.add_portal();
  const LightSampler sampler = scene.sampler();
  const LitVertex at = scene.vertex();
  EXPECT_TRUE(sampler.needs_random(at));
  expect_picked_as_expected(sampler, at, scene.world.lights.size());
  // One sample of each set.
  double sums[3] = {};
  for (int i = 0; i < 16; ++i) sums[i < 6 ? 0 : i < 13 ? 1 : 2] += sampler.expected_samples(at, i);
  for (const double sum : sums) EXPECT_NEAR(sum, 1, 1e-5);
}

TEST(LightSampler, SamplesAllOfFewLights) {
  Scene scene;
  for (int i = 0; i < 4; ++i) scene.add(LightShape::Directional);
  for (int i = 0; i < 4; ++i) scene.add(LightShape::Point);
  scene.add_portal();
  const LightSampler sampler = scene.sampler();
  const LitVertex at = scene.vertex();
  EXPECT_FALSE(sampler.needs_random(at));
  for (const double count : picked(sampler, at, 9)) EXPECT_NEAR(count, 1, 1e-6);
}

TEST(LightSampler, HeedsListsLinksAndPhotonLights) {
  Scene scene;
  for (int i = 0; i < 8; ++i) scene.add(LightShape::Point);
  scene.world.lights[2].photons.only = true;
  const LightSampler sampler = scene.sampler();
  const LightRef list[] = {{0}, {2}, {3}, {4}, {5}, {6}, {-1}};
  scene.closure.lights = {list, 7};
  const auto expect_lit_by = [&](const LitVertex& at, std::initializer_list<int> lights) {
    expect_picked_as_expected(sampler, at, 8);
    for (int i = 0; i < 8; ++i)
      EXPECT_EQ(sampler.expected_samples(at, i) > 0,
                std::find(lights.begin(), lights.end(), i) != lights.end())
          << i;
  };
  scene.closure.light_mode = 1;
  expect_lit_by(scene.vertex(), {0, 3, 4, 5, 6});
  EXPECT_FLOAT_EQ(sampler.expected_samples(scene.vertex(), 3), 1 / 7.0f);
  scene.closure.light_mode = 2;
  expect_lit_by(scene.vertex(), {1, 7});
  scene.closure.light_mode = 4;
  expect_lit_by(scene.vertex(), {0, 1, 3, 4, 5, 6, 7});
  expect_lit_by(LitVertex(), {});
}

TEST(LightSampler, OneSampleIsWeightedByTheExpectedSampleCount) {
  Scene scene;
  for (int i = 0; i < 6; ++i) scene.add(LightShape::Rectangle);
  const LightSampler sampler = scene.sampler();
  ShadingPoint point;
  point.world = &scene.world;
  const auto one = sampler.sample_picked({3, 1}, point, Vec2(.3f, .6f));
  const auto quarter = sampler.sample_picked({3, .25f}, point, Vec2(.3f, .6f));
  ASSERT_TRUE(one && quarter);
  EXPECT_FLOAT_EQ(quarter->irradiance.x, 4 * one->irradiance.x);
  EXPECT_FLOAT_EQ(quarter->pdf, one->pdf / 4);
}

TEST(LightSampler, EnvironmentSamplesMatchTheirCountAndPdf) {
  Scene scene;
  LitVertex at = scene.vertex();
  EXPECT_EQ(scene.sampler().environment_chances(at, true, false).samples, 0) << "there is none";
  scene.world.environment = {&scene.sky};
  EXPECT_EQ(scene.sampler().environment_chances(at, true, false).samples, 1);
  scene.add_portal();
  const LightSampler sampler = scene.sampler();
  EXPECT_EQ(sampler.environment_chances(at, false, false).samples, 1);
  at.environment = sampler.environment_chances(at, true, false);
  EXPECT_GT(at.environment.samples, 0);
  EXPECT_LT(at.environment.samples, 1);
  constexpr int kDraws = 40000;
  double drawn = 0, solid_angle = 0, radiance = 0;
  for (int i = 0; i < kDraws; ++i) {
    sampling::Sampler random(i, 0, 0);
    const auto s = sampler.sample_environment(at, random.next_2d(), true);
    if (!s) continue;
    drawn += 1.0 / kDraws;
    // Densities with the chance of a sample: the mean of 1 / pdf is the solid angle of the sphere.
    solid_angle += 1.0 / kDraws / static_cast<double>(s->pdf);
    radiance += (1.0 + s->wi.x) / kDraws / static_cast<double>(s->pdf);
  }
  EXPECT_NEAR(drawn, at.environment.samples, .01);
  EXPECT_NEAR(solid_angle / (4 * M_PI), 1, .05);
  EXPECT_NEAR(radiance / (4 * M_PI), 1, .02);
  // What is combined with rays has a density of its own.
  for (int i = 0; i < 100; ++i) {
    sampling::Sampler random(i, 1, 0);
    const auto s = sampler.sample_environment(at, random.next_2d(), false);
    if (!s) continue;
    EXPECT_NEAR(sampler.find_environment(&at, {.direction = s->wi}).pdf / s->pdf, 1, 1e-3);
  }
}

/// Draws samples of a sky with a square opening of half side 1 at distance 1 above the vertex.
struct ThroughOpening {
  double solid_angle = 0, irradiance = 0, radiance = 0;  ///< of the opening, and of all directions
  explicit ThroughOpening(const ShaderNode& sky, const std::function<double(const Vec3&)>& value) {
    Scene scene;
    scene.world.environment = {&sky};
    const LightSampler sampler = scene.sampler(
        {}, Openings({{Vec3(-1, -1, 1), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(0, 0, -1)}}));
    LitVertex at = scene.vertex();
    at.environment = sampler.environment_chances(at, true, false);
    EXPECT_EQ(at.environment.samples, 1);
    constexpr int kDraws = 40000;
    int other_cells = 0;
    for (int i = 0; i < kDraws; ++i) {
      sampling::Sampler random(i, 0, 0);
      const auto s = sampler.sample_environment(at, random.next_2d(), false);
      if (!s) {
        ADD_FAILURE();
        continue;
      }
      // Directions at the rim of a cell of the environment may be found in its neighbour.
      const float found = sampler.find_environment(&at, {.direction = s->wi}).pdf;
      if (std::abs(found / s->pdf - 1) > 1e-3f) ++other_cells;
      const double weight = 1.0 / kDraws / static_cast<double>(s->pdf);
      radiance += weight * value(s->wi);
      if (std::max(std::abs(s->wi.x), std::abs(s->wi.y)) >= s->wi.z) continue;
      solid_angle += weight;
      irradiance += weight * value(s->wi);
    }
    EXPECT_LT(other_cells, kDraws / 1000);
  }
};

TEST(LightSampler, EnvironmentSamplesThroughOpeningsMatchTheirPdf) {
  const ShaderNode sky{kTiltedSky};
  const ThroughOpening tilted(sky, [](const Vec3& d) { return 1.0 + d.x; });
  // A square of half side a at distance a: 4 asin(1 / 2).
  EXPECT_NEAR(tilted.solid_angle / (2 * M_PI / 3), 1, .01);
  EXPECT_NEAR(tilted.irradiance / (2 * M_PI / 3), 1, .01) << "the tilt has no effect";
  EXPECT_NEAR(tilted.radiance / tilted.irradiance, 1, 1e-6) << "only the opening is sampled";
}

TEST(LightSampler, LampsOutsideOfOpeningsAreSampled) {
  const ShaderNode sky{kLamp};
  const ThroughOpening lamp(sky, [](const Vec3& d) { return d.x > kLampCosine ? 100.0 : .1; });
  EXPECT_NEAR(lamp.irradiance / (.1 * 2 * M_PI / 3), 1, .02);
  const double cap = 2 * M_PI * (1 - static_cast<double>(kLampCosine));
  EXPECT_NEAR(lamp.radiance / (100 * cap + .1 * (4 * M_PI - cap)), 1, .05);
}

TEST(LightSampler, TrianglesAreFoundWithTheirDensity) {
  Scene scene;
  const LightSampler sampler = scene.sampler(scene.add_square());
  const LitPoint at{Vec3(0), Vec3(0, 0, 1)};
  constexpr int kDraws = 40000;
  double solid_angle = 0;
  for (int i = 0; i < kDraws; ++i) {
    sampling::Sampler random(i, 0, 0);
    const Vec2 u_choice = random.next_2d();
    const auto s = sampler.sample_triangle(at, {}, 0, u_choice, random.next_2d());
    ASSERT_TRUE(s);
    const Vec3 found = s->wi * s->distance;
    ASSERT_NEAR(found.z, 1, 1e-5);
    ASSERT_NEAR(sampler.triangle_pdf(at, {}, 0, s->instance, s->primitive, found, s->wi) / s->pdf,
                1, 1e-4);
    solid_angle += 1.0 / kDraws / static_cast<double>(s->pdf);
  }
  // A square of half side a at distance a: 4 asin(1 / 2).
  EXPECT_NEAR(solid_angle / (2 * M_PI / 3), 1, .02);
  const Vec3 beside = Vec3(0, -.9f, 1.5f);
  EXPECT_EQ(sampler.triangle_pdf(at, {}, 0, 0, 2, beside, normalize(beside)), 0) << "emits nothing";
}

}  // namespace light_sampler_test
}  // namespace oriel
