// SPDX-License-Identifier: Apache-2.0
// Transparent blockers that one traversal of the scene meets.
#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "support/probe.h"
#include "transport/shadow.h"

namespace oriel::testing {
namespace shadow_blockers_test {

/// "test_stripes": 0, 1/2 and 1 by turns along x.
constexpr ShaderSpec kTestStripes = {
    .name = "test_stripes",
    .library = "test",
    .apply = kApplyTexture,
    .result = ParamType::Scalar,
    .result_size = sizeof(float),
    .value =
        [](const Call& call, void* result) {
          const auto stripe = static_cast<int>(std::floor(call.point.position.x * 3)) + 300;
          *static_cast<float*>(result) = static_cast<float>(stripe % 3) / 2;
        },
};

const Registry& registry() {
  static const Registry all = test_registry_with({&kTestStripes});
  return all;
}

/// Cut-outs, clear and rough glass, and few opaque surfaces, at random places.
SceneText many_blockers(unsigned seed, int transparent, int opaque) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<float> place(-2, 2), height(0, 4);
  SceneText scene("trace depth 8 8 12 shadow on");
  scene.statement("shader \"stripes\" \"test_stripes\" ( )")
      .material("holes", "\"reflectivity\" 0, \"cutout_opacity\" = \"stripes\"")
      .material("veil", "\"reflectivity\" 0, \"cutout_opacity\" .3")
      .material("glass",
                "\"diffuse_weight\" 0, \"reflectivity\" .2, \"transparency\" .9, "
                "\"refr_color\" .9 .8 .7, \"thin_walled\" on")
      .material("milk",
                "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" .9, "
                "\"refr_color\" .7 .9 .8, \"refr_gloss\" .5, \"thin_walled\" on")
      .lambert("wall", .5f);
  const char* const names[] = {"holes", "veil", "glass", "milk"};
  for (int i = 0; i < transparent + opaque; ++i) {
    const Vec3 centre(place(engine), place(engine), height(engine));
    const Vec3 normal(place(engine), place(engine), place(engine));
    const bool wall = i >= transparent;
    scene.square(wall ? "wall" : names[i % 4], centre, wall ? .3f : 1, normal);
  }
  return scene;
}

TEST(ShadowModes, BlockersOfOneTraversalTransmitAsThoseOneAfterTheOther) {
  int shadowed = 0, dimmed = 0, open_ways = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    const Probe probe(many_blockers(seed, 24, 6).str(), registry());
    const World& world = probe.world();
    std::mt19937 engine(seed + 10);
    std::uniform_real_distribution<float> place(-2, 2);
    for (int i = 0; i < 4000; ++i) {
      ShadingPoint point;
      point.position = Vec3(place(engine), place(engine), -1);
      point.normal = point.geometric_normal = kUp;
      point.world = &world;
      const Vec3 to = Vec3(place(engine), place(engine), 5) - point.position;
      const Vec3 wi = normalize(to);
      RayCounts counts;
      const Transmittance found = shadow_transmittance(world, point, wi, length(to), counts, -1);
      EXPECT_EQ(counts.shadow, 1u);
      geom::Ray ray;
      ray.org = point.position;
      ray.dir = wi;
      ray.tfar = length(to);
      ray.mask = geom::RayMask::Shadow;
      Transmittance expected{Rgb(0), Rgb(0), Rgb(0)};
      if (!world.accel->occluded(ray))
        expected = transparent_transmittance(world, point, wi, length(to), counts, -1);
      for (int k = 0; k < 3; ++k) {
        ASSERT_NEAR(found.all[k], expected.all[k], 1e-5f) << seed << ' ' << i;
        ASSERT_NEAR(found.clear[k], expected.clear[k], 1e-5f) << seed << ' ' << i;
        ASSERT_NEAR(found.cut_outs[k], expected.cut_outs[k], 1e-5f) << seed << ' ' << i;
      }
      (is_black(found.all) ? shadowed : found.all == Rgb(1) ? open_ways : dimmed) += 1;
    }
  }
  EXPECT_GT(std::min({shadowed, dimmed, open_ways}), 500)
      << shadowed << ' ' << dimmed << ' ' << open_ways;
}

/// Glass whose transmission depends on the angle, at random places; its tint constant, or an input.
SceneText tinted_glass(const char* tint) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<float> place(-2, 2), height(0, 4);
  SceneText scene("trace depth 8 8 12 shadow on");
  scene.statement("shader \"tint\" \"mib_color_mix\" ( \"num\" 0, \"color_base\" .7 .9 .8 )");
  const char* const kinds[] = {
      "\"brdf_fresnel\" on, \"refr_ior\" 1.6, \"cutout_opacity\" .9",
      "\"brdf_fresnel\" on, \"refr_ior\" 1.4, \"thin_walled\" on, \"refr_gloss\" .6",
      "\"refl_color\" .9 .5 .3, \"brdf_0_degree_refl\" .1, \"brdf_curve\" 3, "
      "\"refr_translucency\" on, \"refr_trans_weight\" .2, \"do_refractive_caustics\" on"};
  for (int i = 0; i < 9; ++i) {
    const std::string name = fmt::format("glass{}", i % 3);
    if (i < 3)
      scene.material(name, fmt::format("\"diffuse_weight\" .3, \"reflectivity\" 1, "
                                       "\"transparency\" .9, \"refr_color\" {}, {}",
                                       tint, kinds[i]));
    const auto somewhere = [&] { return Vec3(place(engine), place(engine), height(engine)); };
    scene.square(name, somewhere(), 1, somewhere());
    // Few rings: the normals differ from those of the triangles.
    scene.sphere(name, somewhere(), .8f, 6);
  }
  return scene;
}

TEST(ShadowModes, GlassTransmitsByItsAngleAsItsClosureDoes) {
  const Probe constant(tinted_glass(".7 .9 .8"));
  const Probe shaded(tinted_glass("= \"tint\""));
  ASSERT_TRUE(constant.world().materials.back().straight_by_angle);
  ASSERT_FALSE(shaded.world().materials.back().straight_by_angle);
  std::mt19937 engine(6);
  std::uniform_real_distribution<float> place(-2, 2);
  int dimmed = 0;
  for (int i = 0; i < 4000; ++i) {
    ShadingPoint point;
    point.position = Vec3(place(engine), place(engine), -1);
    point.normal = point.geometric_normal = kUp;
    const Vec3 to = Vec3(place(engine), place(engine), 5) - point.position;
    RayCounts counts;
    const auto through = [&](const Probe& probe) {
      point.world = &probe.world();
      return shadow_transmittance(probe.world(), point, normalize(to), length(to), counts);
    };
    const Transmittance by_angle = through(constant), by_closure = through(shaded);
    for (int k = 0; k < 3; ++k) {
      ASSERT_NEAR(by_angle.all[k], by_closure.all[k], 1e-6f) << i;
      ASSERT_NEAR(by_angle.clear[k], by_closure.clear[k], 1e-6f) << i;
      ASSERT_NEAR(by_angle.cut_outs[k], by_closure.cut_outs[k], 1e-6f) << i;
    }
    dimmed += by_angle.all.x > 0 && by_angle.all.x < 1;
  }
  EXPECT_GT(dimmed, 2000);
}

TEST(ShadowModes, SurfacesAtOnePlaceCountOnce) {
  SceneText scene("trace depth 8 8 12 shadow on");
  scene.material("veil", "\"reflectivity\" 0, \"cutout_opacity\" .5")
      .square("veil", Vec3(0, 0, 1), 5, kUp)
      .square("veil", Vec3(0, 0, 1), 4, kUp)
      .square("veil", Vec3(0, 0, 2), 5, kUp);
  const Probe probe(scene);
  ShadingPoint point;
  point.normal = point.geometric_normal = kUp;
  point.position = Vec3(.3f, .1f, 0);
  RayCounts counts;
  const Transmittance open = shadow_transmittance(probe.world(), point, kUp, 5, counts, -1);
  EXPECT_EQ(open.all, Rgb(.25f));
}

TEST(ShadowModes, SurfacesThatAreCutOutEntirelyAreNotCounted) {
  SceneText scene("trace depth 8 8 12 shadow on");
  scene.material("nothing", "\"reflectivity\" 0, \"cutout_opacity\" 0");
  constexpr int kSurfaces = 300;  // more than a shadow ray counts
  for (int i = 1; i <= kSurfaces; ++i)
    scene.square("nothing", Vec3(0, 0, 5.0f * static_cast<float>(i) / (kSurfaces + 1)), 4, kUp);
  const Probe probe(scene);
  ASSERT_TRUE(probe.world().materials.back().straight_by_angle);
  ShadingPoint point;
  point.normal = point.geometric_normal = kUp;
  point.position = Vec3(.3f, .1f, 0);
  RayCounts counts;
  const Transmittance open = shadow_transmittance(probe.world(), point, kUp, 5, counts, -1);
  EXPECT_EQ(open.all, Rgb(1));
}

}  // namespace shadow_blockers_test
}  // namespace oriel::testing
