// SPDX-License-Identifier: Apache-2.0
// mia_lens_bokeh: size and shape of blur discs, kernels, ray counts.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "prepare/testing/prepared_scene.h"
#include "render/session.h"

namespace oriel {
namespace lens_bokeh_test {

using testing::PreparedScene;

constexpr int kSize = 120;  // pixels a side; the picture is as wide as far

/// A glowing square of side `side`, `z` before the camera, seen through that lens list.
std::string emission_at(double z, double side, const std::string& lens,
                        const std::string& elements = {}) {
  return fmt::format(
      "options \"opt\" object space filter box 1 1 end options\n{0}\n"
      "camera \"cam\" focal 1 aperture 1 aspect 1 resolution {1} {1} {2} end camera\n"
      "instance \"cam_i\" \"cam\" end instance\n"
      "shader \"s\" \"mia_material_x\" ( \"diffuse\" 0 0 0, \"reflectivity\" 0, "
      "\"additional_color\" 1 1 1 ) material \"m\" = \"s\" end material\n"
      "object \"o\" visible trace group {3} {3} {4}  {5} {3} {4}  {5} {5} {4}  {3} {5} {4} "
      "v 0 v 1 v 2 v 3 p 0 0 1 2 3 end group end object\n"
      "instance \"o_i\" \"o\" material [ \"m\" ] end instance\n"
      "instgroup \"root\" \"cam_i\" \"o_i\" end instgroup render \"root\" \"cam_i\" \"opt\"\n",
      elements, kSize, lens, -side / 2, -z, side / 2);
}

struct Rendered {
  PreparedScene scene;
  std::unique_ptr<RenderSession> session;
  explicit Rendered(const std::string& text, std::uint32_t samples = 16) : scene(text) {
    EXPECT_EQ(scene.messages(), "");
    SessionSettings settings;
    settings.budget.samples = samples;
    session = std::make_unique<RenderSession>(*scene.world, settings);
    session->run();
  }
  /// Offsets in pixels from the middle, y up.
  Rgba at(int x, int y) const {
    return session->film().pixel(kSize / 2 + x, kSize / 2 - 1 - y).beauty;
  }
  /// Mean over a block of 8 x 8 pixels around such a place.
  Rgb block(int x, int y) const {
    Rgb sum(0);
    for (int j = -4; j < 4; ++j)
      for (int i = -4; i < 4; ++i) sum += rgb(at(x + i, y + j)) / 64.0f;
    return sum;
  }
  /// Root of the mean squared distance of the light from the middle, pixels.
  double spread() const {
    double sum = 0, weight = 0;
    for (int y = -kSize / 2; y < kSize / 2; ++y)
      for (int x = -kSize / 2; x < kSize / 2; ++x) {
        const double w = at(x, y).r;
        sum += w * ((x + .5) * (x + .5) + (y + .5) * (y + .5));
        weight += w;
      }
    return std::sqrt(sum / weight);
  }
};

std::string bokeh(const std::string& parameters) {
  return "lens \"mia_lens_bokeh\" ( " + parameters + " )";
}

/// Radius of the disc that, blurring the square's image, spreads its light so far. Second moments
/// add: r^2 / 2 of a disc, a^2 / 6 of a square, 1 / 6 of the pixels.
double disc_radius(double spread, double square) {
  return std::sqrt(2 * std::max(spread * spread - (square * square + 1) / 6, 0.0));
}

// acceptance: K1
TEST(LensBokeh, BlurDiscsHaveTheRadiusOfAThinLens) {
  constexpr double kPlane = 2;
  struct Row {
    double z, radius;
  };
  for (const Row& row : {Row{4, 1}, Row{4, .6}, Row{8, .5}, Row{1, .3}, Row{1.5, .8}}) {
    const double side = 0.1 * row.z;  // 12 pixels at any distance
    const Rendered r(emission_at(
        row.z, side, bokeh(fmt::format("\"plane\" {}, \"radius\" {}", kPlane, row.radius))));
    const double pixel = kPlane / kSize;  // of the plane in focus
    const double exact = row.radius * std::abs(kPlane - row.z) / row.z / pixel;
    const double measured = disc_radius(r.spread(), 12);
    EXPECT_NEAR(measured, exact, .03 * exact) << row.z;
    if (std::getenv("ORIEL_FIGURES"))
      fmt::print("blur of z {} R {}: {:.3f} pixels, exact {:.3f}\n", row.z, row.radius, measured,
                 exact);
  }
}

// acceptance: K1
TEST(LensBokeh, PointsInTheFocalPlaneAreSharp) {
  const Rendered sharp(emission_at(2, .2, bokeh("\"plane\" 2, \"radius\" 1")));
  const Rendered pinhole(emission_at(2, .2, {}));
  for (int y = -20; y < 20; ++y)
    for (int x = -20; x < 20; ++x) ASSERT_NEAR(sharp.at(x, y).r, pinhole.at(x, y).r, 1e-4f);
  // Hosts that look along -z may write the plane's z.
  const Rendered negative(emission_at(2, .2, bokeh("\"plane\" -2, \"radius\" 1")));
  EXPECT_EQ(negative.spread(), sharp.spread());
}

// acceptance: K2
TEST(LensBokeh, BiasPushesLightToTheMiddleOrToTheRim) {
  const auto spread = [](const char* bias) {
    return Rendered(emission_at(4, .4,
                                bokeh(fmt::format("\"plane\" 2, \"radius\" 1, \"bias\" {}", bias))))
        .spread();
  };
  // Mean square of u^(1 / (2 bias)): 1/3, 1/2, 2/3 of the radius' 30 pixels squared.
  const double rest = (12.0 * 12 + 1) / 6;
  EXPECT_NEAR(spread(".5"), std::sqrt(900 / 3. + rest), .5);
  EXPECT_NEAR(spread("1"), std::sqrt(900 / 2. + rest), .5);
  EXPECT_NEAR(spread("2"), std::sqrt(900 * 2 / 3. + rest), .5);
}

// acceptance: K2
TEST(LensBokeh, BladesMakePolygonsWhoseCornersTurn) {
  const auto blades = [](const char* angle) {
    return Rendered(emission_at(4, .16,
                                bokeh(fmt::format("\"plane\" 2, \"radius\" 1.2, "
                                                  "\"blade_count\" 4, \"blade_angle\" {}",
                                                  angle))));
  };
  // Corners 36 pixels away: along the axes, and an eighth of a turn later along the diagonals.
  const Rendered axes = blades("0"), diagonals = blades(".125"), turn = blades("1");
  EXPECT_GT(axes.block(29, 0).x, 0);
  EXPECT_EQ(axes.block(26, 26).x, 0);
  EXPECT_EQ(axes.block(-26, 22).x, 0);
  EXPECT_EQ(diagonals.block(33, 0).x, 0);
  EXPECT_EQ(diagonals.block(0, -33).x, 0);
  EXPECT_GT(diagonals.block(20, 20).x, 0);
  EXPECT_GT(diagonals.block(-20, 20).x, 0);
  for (int x = -40; x < 40; ++x) ASSERT_NEAR(turn.at(x, 3).r, axes.at(x, 3).r, 1e-3f);
}

/// Rows of 3 x 3 colours, the lowest first.
constexpr const char* kKernel =
    "color texture \"k\" [3 3 3] 'ff0000' '000000' '00ff00' '404040' '0000ff' 'ffffff' "
    "'000000' '808080' 'ffff00'";
const Rgb kCells[3][3] = {{Rgb(1, 0, 0), Rgb(0), Rgb(0, 1, 0)},
                          {Rgb(64 / 255.0f), Rgb(0, 0, 1), Rgb(1)},
                          {Rgb(0), Rgb(128 / 255.0f), Rgb(1, 1, 0)}};

// acceptance: K3
TEST(LensBokeh, PointsOfLightShowTheKernelPicture) {
  // Bias and blades would show if they had an effect.
  const std::string lens = bokeh(
      "\"plane\" 2, \"radius\" 1.6, \"use_bokeh\" on, \"bokeh\" \"k\", \"samples\" 16, "
      "\"blade_count\" 3, \"bias\" 8");
  const Rendered behind(emission_at(4, .64, lens, kKernel), 32);
  Rgb mean(0);
  for (const auto& row : kCells)
    for (const Rgb& c : row) mean += c / 9;
  // The lens sees the square of .64 from .64 of its 3.2 a side; cells lie 32 pixels apart.
  const float share = sqr(.64f / 3.2f) / max_component(mean);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) {
      const Rgb got = behind.block((x - 1) * 32, (y - 1) * 32);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(got[k], kCells[y][x][k] * share, .06f * share) << x << " " << y;
    }
  // Before the plane, upside down: half as far, the blur is as large.
  const Rendered before(emission_at(4 / 3., .213, lens, kKernel), 16);
  EXPECT_GT(before.block(32, 32).x, 5 * before.block(32, 32).y);
  EXPECT_EQ(before.block(0, 32).x, 0);
  EXPECT_GT(before.block(-32, 32).y, 5 * before.block(-32, 32).x);
}

// acceptance: K3
TEST(LensBokeh, ColouredKernelsLeaveFringesAtBlurredEdgesAlone) {
  // Red to the left, cyan to the right: balanced, so where the view is full it is white.
  const std::string kernel = "color texture \"k\" [2 1 3] 'ff0000' '00ffff'";
  const Rendered r(emission_at(4, 2,
                               bokeh("\"plane\" 2, \"radius\" .5, \"use_bokeh\" on, "
                                     "\"bokeh\" \"k\", \"samples\" 16"),
                               kernel));
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(r.block(0, 0)[k], 1, .02);
  // The square's image ends 30 pixels from the middle, blurred over 15 either way.
  EXPECT_GT(r.block(-34, 0).x, 0.05f + r.block(-34, 0).y);
  EXPECT_GT(r.block(34, 0).y, 0.05f + r.block(34, 0).x);
}

// acceptance: K4
TEST(LensBokeh, SamplesAreRaysOfEachEyeRay) {
  const auto rays = [](const std::string& lens) {
    return Rendered(emission_at(4, .4, lens), 4).session->rays().eye;
  };
  const std::uint64_t plain = rays({});
  EXPECT_EQ(plain, std::uint64_t{kSize} * kSize * 4);
  for (int n : {1, 3, 4, 9})
    EXPECT_EQ(rays(bokeh(fmt::format("\"plane\" 2, \"samples\" {}", n))),
              plain * static_cast<std::uint64_t>(n));
  EXPECT_EQ(rays(bokeh("\"plane\" 2")), 4 * plain);
}

// acceptance: K4
TEST(LensBokeh, OffHasNoEffect) {
  const Rendered off(emission_at(4, .4, bokeh("\"on\" off, \"plane\" 2")), 4);
  const Rendered plain(emission_at(4, .4, {}), 4);
  EXPECT_EQ(off.session->rays().eye, plain.session->rays().eye);
  for (int x = -40; x < 40; ++x) ASSERT_EQ(off.at(x, 2).r, plain.at(x, 2).r);
}

// acceptance: K2, K4
TEST(LensBokeh, DefaultsRenderThePictureOfPhysicalLensDof) {
  const Rendered bladed(emission_at(4, .4, bokeh("\"plane\" 2, \"radius\" 1")), 4);
  const Rendered dof(emission_at(4, .4, "lens \"physical_lens_dof\" ( \"plane\" 2, \"radius\" 1 )"),
                     4);
  for (int y = -40; y < 40; ++y)
    for (int x = -40; x < 40; ++x) ASSERT_EQ(dof.at(x, y).r, bladed.at(x, y).r);
  EXPECT_EQ(dof.session->rays().eye, bladed.session->rays().eye);
}

TEST(LensBokeh, MoreRaysMakeSmootherPictures) {
  const auto noise = [](int samples) {
    const Rendered r(
        emission_at(4, .4,
                    bokeh(fmt::format("\"plane\" 2, \"radius\" 1, \"samples\" {}", samples))),
        4);
    double sum = 0, squares = 0;
    for (int y = -15; y < 15; ++y)
      for (int x = -15; x < 15; ++x) sum += r.at(x, y).r, squares += sqr(r.at(x, y).r);
    return std::sqrt(squares / 900 - std::pow(sum / 900, 2));
  };
  EXPECT_LT(noise(16), .6 * noise(1));
}

TEST(LensBokeh, ExposuresInTheSameListStillMap) {
  const std::string lens = "\"mia_lens_bokeh\" ( \"plane\" 2, \"radius\" .1 )";
  const std::string exposure =
      "\"mia_exposure_simple\" ( \"gain\" .5, \"compression\" 0, \"gamma\" 1 )";
  for (const std::string& list : {lens + " " + exposure, exposure + " " + lens}) {
    const Rendered r(emission_at(2, .5, "lens " + list), 1);
    EXPECT_NEAR(r.session->film().shown(kSize / 2, kSize / 2).x, .5f, 1e-5f);
    EXPECT_NEAR(r.at(0, 0).r, 1, 1e-5f);
    EXPECT_EQ(r.session->rays().eye, 4u * kSize * kSize);
  }
}

TEST(LensBokeh, ScaledCamerasBlurInSceneUnits) {
  // The instance matrix maps world to camera space: here the camera is twice as large.
  std::string text = emission_at(4, .4, bokeh("\"plane\" 2, \"radius\" 1"));
  const std::string plain = "instance \"cam_i\" \"cam\" end";
  text.replace(text.find(plain), plain.size(),
               "instance \"cam_i\" \"cam\" transform .5 0 0 0 0 .5 0 0 0 0 .5 0 0 0 0 1 end");
  EXPECT_NEAR(Rendered(text).spread(),
              Rendered(emission_at(4, .4, bokeh("\"plane\" 2, \"radius\" 1"))).spread(), 1e-3);
}

}  // namespace lens_bokeh_test
}  // namespace oriel
