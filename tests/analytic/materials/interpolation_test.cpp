// SPDX-License-Identifier: Apache-2.0
// Interpolated reflections: documented grid densities, smoothing with more points, detail distance,
// and cost compared with a mirror.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "prepare/testing/prepared_scene.h"
#include "render/session.h"
#include "transport/path/glossy_grid.h"

namespace oriel {
namespace interpolation_test {

using testing::PreparedScene;

/// A reflecting square at z = -5 before the camera shows two edges between bright and black, both
/// in the plane x = 0: of a wall far behind the camera, in the upper half of the picture, and of a
/// board that stands on the square, in the lower half.
std::string two_edges(const std::string& material) {
  return testing::scene_text(
      "shader \"m_s\" \"mia_material_x\" ( \"diffuse\" 0 0 0, \"reflectivity\" 1, "
      "\"brdf_0_degree_refl\" 1, " +
          material +
          " ) material \"m\" = \"m_s\" end material\n"
          "shader \"glow_s\" \"mia_material_x\" ( \"diffuse\" 0 0 0, \"reflectivity\" 0, "
          "\"additional_color\" 1 1 1 ) material \"glow\" = \"glow_s\" end material\n"
          "object \"wall\" visible trace shadow tagged group "
          "0 0 9  40 0 9  40 40 9  0 40 9  v 0 v 1 v 2 v 3 p 0 0 3 2 1 end group end object\n"
          "instance \"wall_inst\" \"wall\" material [ \"glow\" ] end instance\n"
          "object \"board\" visible trace shadow tagged group "
          "0 -9 -4.9  9 -9 -4.9  9 -.3 -4.9  0 -.3 -4.9  v 0 v 1 v 2 v 3 p 0 0 3 2 1 "
          "end group end object\n"
          "instance \"board_inst\" \"board\" visible off material [ \"glow\" ] end instance\n",
      "\"wall_inst\" \"board_inst\"", "resolution 64 48");
}

struct Rendered {
  PreparedScene scene;
  std::unique_ptr<RenderSession> session;
  explicit Rendered(const std::string& material, std::uint32_t samples = 4)
      : scene(two_edges(material)) {
    EXPECT_EQ(scene.messages(), "");
    SessionSettings settings;
    settings.budget.samples = samples;
    session = std::make_unique<RenderSession>(*scene.world, settings);
    session->run();
  }
  float at(int x, int y) const { return session->film().pixel(x, y).beauty.r; }
  /// Pixels along a line of the picture (0 = top) that are neither bright nor black.
  int width_of_edge(int y) const {
    int width = 0;
    for (int x = 0; x < 64; ++x)
      if (at(x, y) > 0.03f && at(x, y) < 0.97f) ++width;
    return width;
  }
};
constexpr int kFar = 8, kNear = 40;  // lines of the picture

const std::string kOn = ", \"refl_interpolate\" on";

// acceptance: P1
TEST(Interpolation, DensitiesAreTheManualsAndRaysFallWithThem) {
  const float points[] = {2, 1, .5f, 1 / 3.0f, .25f, .2f};
  std::uint64_t last = ~std::uint64_t{0};
  for (int d = 0; d < 6; ++d) {
    EXPECT_FLOAT_EQ(GlossyGrid::resolution(d), points[d]);
    const PreparedScene s(two_edges("\"refl_gloss\" .4, \"refl_gloss_samples\" 4" + kOn +
                                    ", \"intr_grid_density\" " + std::to_string(d)));
    ASSERT_TRUE(s.world);
    RayCounts counts;
    const GlossyGrid grid(*s.world, {}, 0, counts);
    EXPECT_EQ(grid.width(d), static_cast<int>(std::ceil(64 * points[d])));
    EXPECT_EQ(grid.height(d), static_cast<int>(std::ceil(48 * points[d])));
    EXPECT_EQ(counts.eye, static_cast<std::uint64_t>(grid.width(d) * grid.height(d)));
    EXPECT_LT(counts.rays(), last);
    last = counts.rays();
  }
}

// acceptance: P2
TEST(Interpolation, MorePointsSmoothMore) {
  const PreparedScene s(
      two_edges("\"refl_gloss\" .2, \"refl_gloss_samples\" 2" + kOn + ", \"intr_grid_density\" 1"));
  ASSERT_TRUE(s.world);
  RayCounts counts;
  const GlossyGrid grid(*s.world, {}, 0, counts);
  const Material& m = *s.material("m");
  // Noise along the edge, where the reflection is half of both.
  const auto variance = [&](int n) {
    double sum = 0, squares = 0;
    int count = 0;
    for (int y = 28; y < 46; ++y) {
      const auto c =
          grid.reflection(Vec2(32, static_cast<float>(y) + .5f), 1, n, 0, m, Vec3(0, 0, 1));
      if (!c) continue;
      sum += double{c->light.x}, squares += double{c->light.x} * double{c->light.x};
      ++count;
    }
    EXPECT_EQ(count, 18) << n;
    return squares / count - sum / count * sum / count;
  };
  // A tent over N points has the weight of about .44 N of them along each side.
  const double one = variance(1), two = variance(2), four = variance(4), eight = variance(8);
  EXPECT_GT(one, 0.01);
  EXPECT_LT(two, 0.75 * one);
  EXPECT_LT(four, 0.5 * two);
  EXPECT_LT(eight, 0.6 * four);
}

// acceptance: P2
TEST(Interpolation, BlursOverThePointsItLooksUp) {
  const std::string mirror = "\"refl_gloss_samples\" 0";
  EXPECT_LE(Rendered(mirror).width_of_edge(kFar), 1);
  const int two = Rendered(mirror + kOn + ", \"intr_grid_density\" 2, \"intr_refl_samples\" 2")
                      .width_of_edge(kFar);
  const int six = Rendered(mirror + kOn + ", \"intr_grid_density\" 2, \"intr_refl_samples\" 6")
                      .width_of_edge(kFar);
  EXPECT_NEAR(two, 3, 2);
  EXPECT_NEAR(six, 10, 3);
}

// acceptance: P3
TEST(Interpolation, DetailRaysKeepNearThingsClear) {
  const std::string smooth =
      "\"refl_gloss_samples\" 0" + kOn + ", \"intr_grid_density\" 3, \"intr_refl_samples\" 4";
  const Rendered without(smooth);
  const Rendered with(smooth + ", \"intr_refl_ddist_on\" on, \"intr_refl_ddist\" 2");
  EXPECT_GE(without.width_of_edge(kNear), 6);
  EXPECT_GE(with.width_of_edge(kFar), 6);
  // The board is .1 above the mirror: traced light has a weight of 95 % there.
  float steepest = 0;
  for (int x = 1; x < 64; ++x)
    steepest = std::max(steepest, std::abs(with.at(x, kNear) - with.at(x - 1, kNear)));
  EXPECT_GT(steepest, 0.4f);
  float blurred = 0;
  for (int x = 1; x < 64; ++x)
    blurred = std::max(blurred, std::abs(without.at(x, kNear) - without.at(x - 1, kNear)));
  EXPECT_LT(blurred, 0.3f);
}

// acceptance: P4
TEST(Interpolation, WithoutSamplesItLooksGlossyForFewerRaysThanAMirror) {
  const Rendered mirror("\"refl_gloss_samples\" 0");
  const Rendered trick("\"refl_gloss_samples\" 0" + kOn +
                       ", \"intr_grid_density\" 3, \"intr_refl_samples\" 4");
  EXPECT_LT(trick.session->rays().rays(), mirror.session->rays().rays());
  EXPECT_GE(trick.width_of_edge(kFar), 6);
  // The same light all in all.
  double a = 0, b = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) a += double{mirror.at(x, y)}, b += double{trick.at(x, y)};
  EXPECT_NEAR(b / a, 1, 0.02);
}

TEST(Interpolation, RefractionsAreSmoothedToo) {
  const std::string glass =
      "\"transparency\" 1, \"reflectivity\" 0, \"thin_walled\" on, \"refr_gloss_samples\" 0, "
      "\"refr_gloss\" 1, \"intr_grid_density\" 3, \"intr_refr_samples\" 4";
  const std::string text = two_edges(glass);
  // The wall behind the glass.
  const auto put_behind = [](std::string t) {
    const std::string from = "0 0 9  40 0 9  40 40 9  0 40 9",
                      to = "0 0 -9  40 0 -9  40 40 -9  0 40 -9";
    t.replace(t.find(from), from.size(), to);
    return t;
  };
  const auto edge = [&](const std::string& t) {
    PreparedScene s(put_behind(t));
    SessionSettings settings;
    settings.budget.samples = 4;
    RenderSession session(*s.world, settings);
    session.run();
    int width = 0;
    for (int x = 0; x < 64; ++x) {
      const float v = session.film().pixel(x, kFar).beauty.r;
      if (v > 0.03f && v < 0.97f) ++width;
    }
    return width;
  };
  EXPECT_LE(edge(text), 1);
  EXPECT_GE(edge(two_edges(glass + ", \"refr_interpolate\" on")), 6);
}

}  // namespace interpolation_test
}  // namespace oriel
