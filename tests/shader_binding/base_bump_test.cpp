// SPDX-License-Identifier: Apache-2.0
// Bump maps of the base library: resulting normals, computed by hand.
#include <fmt/format.h>

#include "probe.h"
#include "runtime/closure.h"
#include "runtime/material.h"

namespace oriel {
namespace base_bump_test {

// 4 x 1 texels, grey grows by 0.2 a texel; alpha falls by 0.2.
const std::string kRamp =
    "color texture \"t\" [4 1 4] '000000ff' '333333cc' '66666699' '99999966'\n";
const std::string kBasis = "\"u\" 1 0 0, \"v\" 0 1 0, \"coord\" .375 .5 0, \"tex\" \"t\"";

struct BumpScene {
  ProbeScene scene;
  ShadingPoint point;

  explicit BumpScene(const std::string& material) : scene(kRamp + material) {
    EXPECT_TRUE(scene.diagnostics.all().empty()) << scene.messages();
    point.world = scene.world.get();
    point.texture_spaces = 1;
    point.tex[0] = Vec3(.375f, .5f, 0);
    point.bump_u[0] = Vec3(3, 0, 0);
    point.bump_v[0] = Vec3(0, 2, 0);
  }
  static BumpScene map(const std::string& more) {
    return BumpScene("material \"m\" \"mib_bump_map\" ( " + kBasis + more + " ) end material");
  }
  Vec3 vector() { return scene.node()->vector(point); }
  void shade(Closure& closure) { oriel::shade(*scene.material("m"), point, closure); }
};

void expect_vector(const Vec3& v, const Vec3& wanted) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(v[k], wanted[k], 2e-4) << k;
}

TEST(BaseBump, MapTurnsTheNormalByTheChangeOverAStep) {
  BumpScene s = BumpScene::map(", \"step\" .25 .25 0");
  expect_vector(s.vector(), normalize(Vec3(.2f, 0, 1)));
  expect_vector(s.point.normal, normalize(Vec3(.2f, 0, 1)));
}

TEST(BaseBump, ZeroStepAndFactorAreTheirDefaults) {
  // A hundredth of the picture: 0.2 a texel of a quarter.
  expect_vector(BumpScene::map("").vector(), normalize(Vec3(.008f, 0, 1)));
  expect_vector(BumpScene::map(", \"factor\" 50").vector(), normalize(Vec3(.4f, 0, 1)));
  expect_vector(BumpScene::map(", \"factor\" -50").vector(), normalize(Vec3(-.4f, 0, 1)));
}

TEST(BaseBump, AlphaMayReplaceIntensity) {
  expect_vector(BumpScene::map(", \"step\" .25 .25 0, \"alpha\" on").vector(),
                normalize(Vec3(-.2f, 0, 1)));
}

TEST(BaseBump, FlagsSelectTheValueOutsideTheImage) {
  const auto at = [](float u, const char* more) {
    return BumpScene(fmt::format("material \"m\" \"mib_bump_map\" ( \"u\" 1 0 0, \"v\" 0 1 0, "
                                 "\"coord\" {} .5 0, \"tex\" \"t\", \"step\" .25 .25 0{} ) "
                                 "end material",
                                 u, more))
        .vector();
  };
  const Vec3 flat(0, 0, 1), up = normalize(Vec3(.2f, 0, 1));
  expect_vector(at(1.375f, ""), flat);
  expect_vector(at(1.375f, ", \"torus_u\" on"), up);
  expect_vector(at(1.375f, ", \"torus_v\" on"), flat);
  expect_vector(at(1.375f, ", \"torus_u\" on, \"clamp\" on"), flat);
  expect_vector(at(.375f, ", \"clamp\" on"), up);
}

TEST(BaseBump, VectorSeenFromBehindIsThatOfTheFront) {
  BumpScene s = BumpScene::map(", \"step\" .25 .25 0");
  s.point.back_side = true;
  expect_vector(s.vector(), -normalize(Vec3(.2f, 0, 1)));
  expect_vector(s.point.normal, normalize(Vec3(.2f, 0, 1)));
}

TEST(BaseBump, PassthroughMovesTheNormalOfTheMaterialAfterIt) {
  for (const char* shader : {"mib_passthrough_bump_map", "mib_bump_map"}) {
    BumpScene s(
        fmt::format("material \"m\" \"{}\" ( {}, \"step\" .25 .25 0 ) "
                    "\"mib_illum_lambert\" ( \"diffuse\" 1 1 1 ) end material",
                    shader, kBasis));
    Closure closure;
    s.shade(closure);
    ASSERT_EQ(closure.count, 1) << shader;
    expect_vector(closure.lobes[0].frame.n, normalize(Vec3(.2f, 0, 1)));
    EXPECT_EQ(closure.emission, Rgb(0));
  }
}

TEST(BaseBump, Map2BumpsTheMaterialItReturns) {
  BumpScene s(
      "shader \"l\" \"mib_illum_lambert\" ( \"diffuse\" .5 .5 .5 )\n"
      "material \"m\" \"mib_bump_map2\" ( \"tex\" \"t\", \"factor\" 50, \"color\" = \"l\" ) "
      "end material");
  Closure closure;
  s.shade(closure);
  ASSERT_EQ(closure.count, 1);
  expect_vector(closure.lobes[0].frame.n, normalize(Vec3(.4f, 0, 1)));
  EXPECT_EQ(closure.lobes[0].weight, Rgb(.5f));
}

TEST(BaseBump, Map2ScalesTheFirstTextureSpaceAndReturnsItsColour) {
  BumpScene s(
      "material \"m\" \"mib_bump_map2\" ( \"tex\" \"t\", \"factor\" 50, \"scale\" 3, "
      "\"color\" .1 .2 .3 .4 ) end material");
  s.point.tex[0] = Vec3(.125f, 0, 0);
  expect_color(s.scene.node()->color(s.point), .1f, .2f, .3f, .4f);
  // At three eighths as before.
  expect_vector(s.point.normal, normalize(Vec3(.4f, 0, 1)));
}

TEST(BaseBump, ArchitecturalMaterialTakesBumpShaders) {
  const std::string bumps =
      "shader \"b\" \"mib_bump_map2\" ( \"tex\" \"t\", \"factor\" 50 )\n"
      "shader \"v\" \"mib_bump_map\" ( " +
      kBasis + ", \"step\" .25 .25 0, \"factor\" 2 )\n";
  const Vec3 bumped = normalize(Vec3(.4f, 0, 1));
  for (const char* use : {"\"bump\" \"b\", \"bump_mode\" 0", "\"standard_bump\" = \"v\""})
    for (const bool diffuse : {true, false}) {
      BumpScene s(
          fmt::format("{}material \"m\" \"mia_material_x\" ( {}, \"no_diffuse_bump\" {}, "
                      "\"refl_gloss\" .5 ) end material",
                      bumps, use, diffuse ? "off" : "on"));
      s.point.ray_direction = Vec3(0, 0, -1);
      Closure closure;
      s.shade(closure);
      ASSERT_EQ(closure.count, 2);
      expect_vector(closure.lobes[0].frame.n, diffuse ? bumped : Vec3(0, 0, 1));
      expect_vector(closure.lobes[1].frame.n, bumped);
    }
}

struct BasisOut {
  Vec3 u, v;
};

TEST(BaseBump, BasisIsOfTheTextureSpaceOrOfAProjection) {
  const auto basis = [](int project, const Vec3& at = Vec3(0)) {
    BumpScene s(
        fmt::format("material \"m\" \"mib_bump_basis\" ( \"project\" {} ) end material", project));
    s.point.position = at;
    alignas(16) std::byte bytes[kMaxParamBytes];
    s.scene.node()->value(s.point, bytes);
    return *reinterpret_cast<const BasisOut*>(bytes);
  };
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  for (const int space : {-1, 0, 5}) {
    expect_vector(basis(space).u, x);
    expect_vector(basis(space).v, y);
  }
  expect_vector(basis(2).v, z);
  expect_vector(basis(3).u, y);
  // Around y, at the side of z: round towards x, up along y.
  expect_vector(basis(4, z * 2.0f).u, x);
  expect_vector(basis(4, z * 2.0f).v, y);
  expect_vector(basis(4, Vec3(0, 1, 1)).v, normalize(Vec3(0, 1, -1)));
  expect_vector(basis(6, Vec3(0, 1, 1)).v, y);
}

TEST(BaseBump, BasisTurnsWithTheInstance) {
  BumpScene s("material \"m\" \"mib_bump_basis\" ( \"project\" 1 ) end material");
  const Mat4 turned(0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1);
  s.point.to_world = &turned;
  alignas(16) std::byte bytes[kMaxParamBytes];
  s.scene.node()->value(s.point, bytes);
  expect_vector(reinterpret_cast<const BasisOut*>(bytes)->u, Vec3(0, 1, 0));
}

}  // namespace base_bump_test
}  // namespace oriel
