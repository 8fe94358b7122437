// SPDX-License-Identifier: Apache-2.0
#include "lights/environment_table.h"

#include <gtest/gtest.h>

#include "lights/environment_light.h"
#include "runtime/world.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace oriel {
namespace environment_table_test {

Rgba at(const Call& call, float x, float y, float z) {
  const Vec3& d = call.point.ray_direction;
  return Rgba(1 + x * d.x, 1 + y * d.y, 1 + z * d.z, 1);
}
/// A gradient.
void sky(const Call& call, void* result) { *static_cast<Rgba*>(result) = at(call, .5f, -.3f, .8f); }
void grey(const Call&, void* result) { *static_cast<Rgba*>(result) = Rgba(.5f, .6f, .7f, 1); }
/// The gradient with a lamp of a third of a degree.
const Vec3 kLamp = normalize(Vec3(1, 2, 3));
void lamp(const Call& call, void* result) {
  sky(call, result);
  if (dot(call.point.ray_direction, kLamp) > .999985f) *static_cast<Rgba*>(result) = Rgba(5000);
}
/// A box of side 100 around the origin: depends on where the ray begins.
void box(const Call& call, void* result) {
  const Vec3 p = call.point.ray_origin + call.point.ray_direction * 100;
  *static_cast<Rgba*>(result) = Rgba(1 + p.z / 400);
}
void plate(const Call& call, void* result) {
  *static_cast<Rgba*>(result) = Rgba(1 + call.point.raster.x / 1000);
}
/// What glossy rays see is twice as bright.
void by_kind(const Call& call, void* result) {
  sky(call, result);
  if (call.point.ray_kind != RayKind::FinalGather) *static_cast<Rgba*>(result) *= 2;
}

ShaderSpec spec_of(void (*value)(const Call&, void*)) {
  return {.name = "environment", .library = "test", .value = value};
}

struct Scene {
  explicit Scene(void (*value)(const Call&, void*)) : spec(spec_of(value)), node(spec) {
    world.environment = {&node};
    world.camera.width = world.camera.height = 100;
  }
  Rgb exact(const Vec3& direction, const Vec3& origin = Vec3(0), const Vec2& raster = Vec2(0)) {
    return rgb(environment_radiance(world.environment, world,
                                    {origin, direction, RayKind::FinalGather, raster}));
  }
  ShaderSpec spec;
  ShaderNode node;
  World world;
};

Vec3 direction(std::uint32_t i) {
  return sampling::sample_uniform_sphere(sampling::Sampler(1, 2, i).next_2d());
}

TEST(EnvironmentTable, HoldsASmoothEnvironment) {
  Scene scene(sky);
  const EnvironmentTable table(scene.world);
  EXPECT_FALSE(table.constant());
  EXPECT_EQ(table.detail(), TableDetail::Smooth);
  EXPECT_TRUE(table.same_for_glossy_rays());
  Imath::V3d sum(0), expected(0);
  int same = 0;
  constexpr std::uint32_t kDirections = 20000;
  for (std::uint32_t i = 0; i < kDirections; ++i) {
    const Vec3 d = direction(i);
    const Rgb found = table.radiance(scene.world, {.direction = d}), exact = scene.exact(d);
    // A cell is less than two degrees wide.
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(found[k], exact[k], .02f);
    same += found == exact;
    sum += Imath::V3d(found);
    expected += Imath::V3d(exact);
  }
  EXPECT_LT(same, 100) << "it comes from the table";
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(sum[k] / expected[k], 1, 1e-4);
}

TEST(EnvironmentTable, AConstantIsOneColour) {
  Scene scene(grey);
  const EnvironmentTable table(scene.world);
  EXPECT_TRUE(table.constant());
  const Rgb found = table.radiance(scene.world, {.direction = Vec3(0, 1, 0)});
  EXPECT_NEAR(found.x, .5f, 1e-6f);
  EXPECT_NEAR(found.z, .7f, 1e-6f);
  EXPECT_EQ(EnvironmentLight(scene.world).unevenness(), 0);
}

TEST(EnvironmentTable, ALampIsExact) {
  Scene scene(lamp);
  const EnvironmentTable table(scene.world);
  const Frame around(kLamp);
  double sum = 0, expected = 0;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const Vec2 u = sampling::Sampler(5, 6, i).next_2d();
    const Vec3 d = around.to_world(sampling::sample_cone(u, 1e-4f));
    sum += static_cast<double>(table.radiance(scene.world, {.direction = d}).x);
    expected += static_cast<double>(scene.exact(d).x);
  }
  EXPECT_NEAR(sum / expected, 1, 1e-4);
  EXPECT_EQ(table.radiance(scene.world, {.direction = kLamp}).x, 5000);
}

TEST(EnvironmentTable, WhatDependsOnMoreThanTheDirectionIsEvaluated) {
  for (const auto value : {box, plate}) {
    Scene scene(value);
    const EnvironmentTable table(scene.world);
    for (std::uint32_t i = 0; i < 100; ++i) {
      const Vec3 d = direction(i), origin = direction(i + 1000) * 30;
      const Vec2 raster(static_cast<float>(i), 7);
      EXPECT_EQ(table.radiance(scene.world, {.origin = origin, .direction = d, .raster = raster}),
                scene.exact(d, origin, raster));
    }
  }
}

TEST(EnvironmentTable, ShadersOfUsersAreEvaluated) {
  // They may read what the shader that traced the ray left them, which no test here can vary.
  Scene scene(sky);
  scene.spec.library = "user";
  const EnvironmentTable table(scene.world);
  EXPECT_FALSE(table.same_for_glossy_rays());
  for (std::uint32_t i = 0; i < 100; ++i) {
    const Vec3 d = direction(i);
    EXPECT_EQ(table.radiance(scene.world, {.direction = d}), scene.exact(d));
  }
}

TEST(EnvironmentTable, TellsWhetherGlossyRaysSeeTheSame) {
  Scene scene(by_kind);
  const EnvironmentTable table(scene.world);
  EXPECT_FALSE(table.same_for_glossy_rays());
  // The kind of the ray is that of diffuse rays.
  const Rgb found = table.radiance(scene.world, {.direction = kLamp, .kind = RayKind::Reflect});
  EXPECT_NEAR(found.x, scene.exact(kLamp).x, .02f);
}

TEST(EnvironmentLight, DensityIsThatOfItsSamples) {
  Scene scene(lamp);
  const EnvironmentLight light(scene.world);
  // The lamp has 2 pi (1 - cos) 5000 of 4 pi.
  EXPECT_NEAR(light.mean_luminance(), 1 + .5 * (1 - .999985) * 5000, .01);
  // Lit from everywhere, and on surfaces that face the lamp, stand beside it, and face away.
  for (const Vec3& normal : {Vec3(0), kLamp, normalize(cross(kLamp, Vec3(1, 0, 0))), -kLamp}) {
    constexpr int kDraws = 40000;
    double solid_angle = 0, lamps = 0;
    int at_borders = 0;  // whose direction is rounded to the next cell
    for (int i = 0; i < kDraws; ++i) {
      const auto s = light.sample(normal, sampling::Sampler(i, 0, 0).next_2d());
      ASSERT_NEAR(light.pdf(normal, s.wi, s.cell) / s.pdf, 1, 1e-4);
      at_borders += light.table().cell_of(s.wi) != s.cell ? 1 : 0;
      ASSERT_NEAR(length(s.wi), 1, 1e-5);
      solid_angle += 1.0 / kDraws / static_cast<double>(s.pdf);
      lamps += dot(s.wi, kLamp) > .999985f ? 1.0 / kDraws / static_cast<double>(s.pdf) : 0;
    }
    EXPECT_LT(at_borders, kDraws / 1000) << normal;
    EXPECT_NEAR(solid_angle / (4 * M_PI), 1, .05) << normal;
    if (dot(normal, kLamp) >= 0) {
      EXPECT_NEAR(lamps / (2 * M_PI * (1 - .999985)), 1, .05) << normal;
    }
  }
}

}  // namespace environment_table_test
}  // namespace oriel
