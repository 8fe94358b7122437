// SPDX-License-Identifier: Apache-2.0
// oriel_normal_map: resulting normals, computed by hand from the bytes of the image.
#include <fmt/format.h>

#include "probe.h"
#include "runtime/bump.h"
#include "runtime/closure.h"
#include "runtime/material.h"

namespace oriel {
namespace normal_map_test {

// 2 c / 255 - 1 of the bytes cc, 99, ff: .6, .2, 1.
const std::string kTilted = "vector texture \"t\" [1 1 3] 'cc99ff'\n";

Vec3 tilted(float factor = 1, float v = 1) {
  return normalize(Vec3(.6f * factor, .2f * factor * v, 1));
}

struct NormalScene {
  testing::PreparedScene scene;
  ShadingPoint point;

  explicit NormalScene(const std::string& more, const std::string& picture = kTilted,
                       const std::string& options = "gamma 2.2")
      : scene(testing::scene_text(picture + "material \"m\" \"oriel_normal_map\" ( \"tex\" \"t\"" +
                                      more +
                                      " ) \"mib_illum_lambert\" ( \"diffuse\" 1 1 1 ) "
                                      "end material",
                                  {}, {}, options)) {
    EXPECT_TRUE(scene.diagnostics.all().empty()) << scene.messages();
    point.world = scene.world.get();
    point.texture_spaces = 1;
    point.tex[0] = Vec3(.5f, .5f, 0);
    point.bump_u[0] = point.bump_v[0] = Vec3(0);
    point.dpdu = Vec3(3, 0, 0);
    point.dpdv = Vec3(0, 2, 0);
  }
  Vec3 vector() { return scene.material("m")->surface[0]->vector(point); }
};

void expect_vector(const Vec3& v, const Vec3& wanted) {
  EXPECT_LT(length(v - wanted), 1e-5f) << v.x << ' ' << v.y << ' ' << v.z << " against " << wanted.x
                                       << ' ' << wanted.y << ' ' << wanted.z;
}

TEST(NormalMap, ImageIsReadWithoutGamma) {
  expect_vector(NormalScene("").vector(), tilted());
  expect_vector(NormalScene("", kTilted, "gamma 1").vector(), tilted());
  // A colour picture is light: .8^2.2 and .6^2.2 in place of .8 and .6.
  const Vec3 as_light = NormalScene("", "color texture \"t\" [1 1 3] 'cc99ff'\n").vector();
  expect_vector(as_light,
                normalize(Vec3(2 * std::pow(.8f, 2.2f) - 1, 2 * std::pow(.6f, 2.2f) - 1, 1)));
}

TEST(NormalMap, FactorHoldsForRedAndGreen) {
  expect_vector(NormalScene(", \"factor\" .5").vector(), tilted(.5f));
  expect_vector(NormalScene(", \"factor\" -2").vector(), tilted(-2));
  expect_vector(NormalScene(", \"factor\" 0").vector(), Vec3(0, 0, 1));
}

TEST(NormalMap, FrameIsSquareAndKeepsTheSideOfV) {
  // Sheared and mirrored coordinates: u along (1, 1), v to the right of it.
  NormalScene s("");
  s.point.dpdu = Vec3(2, 2, .5f);
  s.point.dpdv = Vec3(1, 0, 0);
  const Vec3 u = normalize(Vec3(1, 1, 0)), v = normalize(Vec3(1, -1, 0));
  expect_vector(s.vector(), normalize(u * .6f + v * .2f + Vec3(0, 0, 1)));
}

TEST(NormalMap, BumpBasisOverridesDerivatives) {
  NormalScene s("");
  s.point.bump_u[0] = Vec3(0, 5, 0);
  s.point.bump_v[0] = Vec3(-1, 0, 0);
  expect_vector(s.vector(), normalize(Vec3(-.2f, .6f, 1)));
}

TEST(NormalMap, EveryModeGivesTheMaterialTheSameNormal) {
  for (const bool back : {false, true})
    for (int mode = 1; mode <= 8; ++mode) {
      NormalScene s(fmt::format(", \"bump_mode\" {}", mode));
      s.point.back_side = back;
      s.point.normal = s.point.geometric_normal = Vec3(0, 0, back ? -1.0f : 1.0f);
      const Vec3 n = bump_normal(s.point, s.point.normal, s.vector(), mode);
      expect_vector(n, back ? -tilted() : tilted());
      expect_vector(s.point.normal, s.point.geometric_normal);
    }
}

TEST(NormalMap, ModeZeroAndListsTurnTheNormalItself) {
  NormalScene s(", \"bump_mode\" 0");
  EXPECT_EQ(s.vector(), Vec3(0));
  expect_vector(s.point.normal, tilted());
  NormalScene list("");
  Closure closure;
  shade(*list.scene.material("m"), list.point, closure);
  ASSERT_EQ(closure.count, 1);
  expect_vector(closure.lobes[0].frame.n, tilted());
}

TEST(NormalMap, NormalIsUnchangedWithoutAFrame) {
  for (const int what : {0, 1, 2}) {
    NormalScene s("");
    if (what == 0) s.point.texture_spaces = 0;
    if (what == 1) s.point.dpdu = s.point.dpdv = Vec3(0);
    if (what == 2) s.point.dpdu = Vec3(0, 0, 4);
    expect_vector(s.vector(), Vec3(0, 0, 1));
  }
  // 2 c - 1 = 0 in all channels is no direction.
  EXPECT_GT(NormalScene("", "vector texture \"t\" [1 1 3] '808080'\n").vector().z, .5f);
}

}  // namespace normal_map_test
}  // namespace oriel
