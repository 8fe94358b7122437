// SPDX-License-Identifier: Apache-2.0
// Interface contract of environment sampling, camera rays and lens shaders.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "lights/light_sampler.h"
#include "prepare/testing/prepared_scene.h"
#include "sampling/testing/chi_square.h"
#include "sampling/warp.h"
#include "support/expect_near.h"

namespace oriel {
namespace view_contract_test {

// double: the yardstick of a density over 131072 cells.
constexpr double kPiDouble = 3.14159265358979323846;

using testing::expect_near_relative;
using testing::PreparedScene;
using testing::scene_text;

constexpr std::string_view kGrey = "material \"m\" \"mib_illum_lambert\" ( ) end material\n";

struct Sky {
  const char* name;
  std::string elements, camera;
  friend void PrintTo(const Sky& s, std::ostream* out) { *out << s.name; }
};

std::vector<Sky> skies() {
  const std::string picture =
      "color texture \"t\" [4 2 3] '000000' '1a1a1a' '333333' '4d4d4d' '808080' 'ffffff' '030303' "
      "'000000'\n";
  return {
      {"ClearSky", "", "environment \"mia_physicalsky\" ( \"sun_direction\" 1 1 1 )"},
      {"HazySkyYUp", "",
       "environment \"mia_physicalsky\" ( \"sun_direction\" 1 1 1, \"haze\" 8, \"y_is_up\" on )"},
      {"Picture", picture, "environment \"mib_lookup_spherical\" ( \"tex\" \"t\", \"rotate\" 1 )"},
      {"FrameOfTheCamera", picture, "environment \"mib_lookup_background\" ( \"tex\" \"t\" )"},
  };
}

class EnvironmentContract : public ::testing::TestWithParam<Sky> {
 protected:
  EnvironmentContract()
      : scene_(scene_text(GetParam().elements + std::string(kGrey), {}, GetParam().camera)) {}
  PreparedScene scene_;
};

// Cells at least as fine as the light's own table, in groups: their share of the density is exact.
TEST_P(EnvironmentContract, DirectionsFollowTheDensity) {
  ASSERT_TRUE(scene_.world) << scene_.messages();
  const EnvironmentLight& sky = scene_.world->light_sampler->environment();
  ASSERT_TRUE(sky.lights());
  constexpr int kWidth = 2048, kHeight = 1024, kColumns = 32, kRows = 16, kDraws = 100000;
  // Lit from everywhere, and on a surface.
  for (const Vec3& normal : {Vec3(0), normalize(Vec3(.3f, .8f, -.4f))}) {
    const auto pdf_of = [&](const Vec3& direction) {
      return sky.pdf(normal, direction, sky.table().cell_of(direction));
    };
    std::vector<double> expected(kColumns * kRows), observed(kColumns * kRows);
    double integral = 0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const double z = 1 - 2 * (y + .5) / kHeight, phi = 2 * kPiDouble * (x + .5) / kWidth;
        const double r = std::sqrt(1 - z * z);
        const float pdf =
            pdf_of(Vec3(static_cast<float>(r * std::cos(phi)),
                        static_cast<float>(r * std::sin(phi)), static_cast<float>(z)));
        ASSERT_GT(pdf, 0) << "every direction must be found";
        const double share = pdf * 4 * kPiDouble / (kWidth * kHeight);
        integral += share;
        expected[static_cast<std::size_t>(y / (kHeight / kRows) * kColumns +
                                          x / (kWidth / kColumns))] += share * kDraws;
      }
    EXPECT_NEAR(integral, 1, 1e-3);
    for (int n = 0; n < kDraws; ++n) {
      sampling::Sampler s(n, 9, 0);
      const auto drawn = sky.sample(normal, s.next_2d());
      ASSERT_NEAR(length(drawn.wi), 1, 1e-4);
      ASSERT_NEAR(sky.pdf(normal, drawn.wi, drawn.cell) / drawn.pdf, 1, 1e-4);
      ASSERT_NEAR(pdf_of(drawn.wi) / drawn.pdf, 1, 0.5) << "a texel's border at most";
      double phi = std::atan2(double{drawn.wi.y}, double{drawn.wi.x});
      if (phi < 0) phi += 2 * kPiDouble;
      const int x = std::min(kColumns - 1, static_cast<int>(phi / (2 * kPiDouble) * kColumns));
      const int y = std::clamp(static_cast<int>((1 - drawn.wi.z) / 2 * kRows), 0, kRows - 1);
      observed[static_cast<std::size_t>(y * kColumns + x)] += 1;
    }
    EXPECT_GT(testing::chi_square(observed, expected).p_value, testing::sidak(0.01, 8));
  }
}

// The table only guides: importance sampling and uniform sampling agree on the irradiance.
TEST_P(EnvironmentContract, ImportanceSamplingIsUnbiased) {
  ASSERT_TRUE(scene_.world);
  const World& world = *scene_.world;
  double guided = 0, plain = 0, guided2 = 0, plain2 = 0;
  constexpr int kDraws = 40000;
  for (int n = 0; n < kDraws; ++n) {
    sampling::Sampler s(n, 3, 0);
    const auto value = [&](const Vec3& wi, double pdf) {
      const Rgba c =
          environment_radiance(world.environment, world, Vec3(0), wi, RayKind::FinalGather);
      return std::max(0.0f, wi.y) * c.g / pdf;
    };
    const auto drawn = world.light_sampler->environment().sample(Vec3(0, 1, 0), s.next_2d());
    const double a = value(drawn.wi, drawn.pdf);
    const double b =
        value(sampling::sample_uniform_sphere(s.next_2d()), sampling::kUniformSpherePdf);
    guided += a / kDraws;
    guided2 += a * a / kDraws;
    plain += b / kDraws;
    plain2 += b * b / kDraws;
  }
  const double error = std::sqrt((guided2 - guided * guided + plain2 - plain * plain) / kDraws);
  EXPECT_NEAR(guided, plain, 4 * error);
}

INSTANTIATE_TEST_SUITE_P(Skies, EnvironmentContract, ::testing::ValuesIn(skies()),
                         [](const auto& param) { return std::string(param.param.name); });

/// A camera 40 x 30 pixels, film 2 x 1.5, turned so that it looks along world x with z up.
Camera turned() {
  Camera camera;
  camera.width = 40;
  camera.height = 30;
  camera.focal = 3;
  camera.aperture = 2;
  camera.aspect = 40.0f / 30;
  // Rows: camera x, y, z and origin in world space.
  camera.to_world = Mat4(0, -1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 0, 5, 6, 7, 1);
  camera.to_camera = camera.to_world.inverse();
  return camera;
}

TEST(CameraContract, PerspectiveRaysPassThroughTheirPointOfTheFilm) {
  const Camera camera = turned();
  for (const Vec2& raster :
       {Vec2(20, 15), Vec2(0, 0), Vec2(40, 30), Vec2(.5f, 29.5f), Vec2(33, 4)}) {
    const Camera::Ray ray = camera.ray(raster);
    const float x = raster.x / 40 * 2 - 1, y = (raster.y / 30 - .5f) * 1.5f;
    expect_near_relative(ray.origin, Vec3(5, 6, 7), 1e-5f);
    // Forward 3, right x (world -y), up y (world z).
    expect_near_relative(ray.direction, normalize(Vec3(3, -x, y)), 1e-5f);
    EXPECT_NEAR(ray.cos_to_film, 3 / std::sqrt(9 + x * x + y * y), 1e-6);
  }
}

TEST(CameraContract, OrthographicRaysAreParallelAcrossTheWidthOfView) {
  Camera camera = turned();
  camera.orthographic = true;
  for (const Vec2& raster : {Vec2(20, 15), Vec2(0, 0), Vec2(40, 30)}) {
    const Camera::Ray ray = camera.ray(raster);
    expect_near_relative(ray.direction, Vec3(1, 0, 0), 1e-5f);
    expect_near_relative(ray.origin,
                         Vec3(5, 6 - (raster.x / 20 - 1), 7 + (raster.y / 30 - .5f) * 1.5f), 1e-5f);
    EXPECT_EQ(ray.cos_to_film, 1);
    EXPECT_FLOAT_EQ(ray.width, 2.0f / 40);
  }
}

TEST(CameraContract, OffsetsShiftThePlaneByWholePixels) {
  const Camera still = turned();
  Camera shifted = turned();
  shifted.offset = Vec2(3, -2);
  for (const Vec2& raster : {Vec2(10, 10), Vec2(33.5f, 7)}) {
    expect_near_relative(shifted.ray(raster).direction, still.ray(raster + Vec2(3, -2)).direction,
                         1e-5f);
    Camera a = still, b = shifted;
    a.orthographic = b.orthographic = true;
    expect_near_relative(b.ray(raster).origin, a.ray(raster + Vec2(3, -2)).origin, 1e-5f);
  }
}

TEST(CameraContract, SpreadIsTheAngleBetweenNeighbours) {
  const Camera camera = turned();
  for (const Vec2& raster : {Vec2(20, 15), Vec2(1, 15), Vec2(39, 29)}) {
    const Vec3 a = camera.ray(raster).direction, b = camera.ray(raster + Vec2(1, 0)).direction;
    const float angle = length(cross(a, b));
    EXPECT_NEAR(camera.ray(raster).spread / angle, 1, 0.1);
  }
}

// Instances carry cameras: the world a camera sees is its instance's matrix applied to it.
TEST(CameraContract, TheInstancesMatrixTakesTheWorldToTheCamera) {
  std::string text = scene_text(kGrey);
  const std::string still = "instance \"cam_inst\" \"cam\" end instance";
  text.replace(
      text.find(still), still.size(),
      "instance \"cam_inst\" \"cam\" transform 1 0 0 0 0 1 0 0 0 0 1 0 -2 -3 -4 1 end instance");
  const PreparedScene s(text);
  ASSERT_TRUE(s.world) << s.messages();
  expect_near_relative(s.world->camera.ray(Vec2(8, 6)).origin, Vec3(2, 3, 4), 1e-5f);
  expect_near_relative(s.world->camera.ray(Vec2(8, 6)).direction, Vec3(0, 0, -1), 1e-5f);
}

class LensContract : public ::testing::TestWithParam<const ShaderSpec*> {};

TEST_P(LensContract, AnyColourComesOutFiniteAndNeverNegative) {
  const PreparedScene s(scene_text(kGrey, {}, fmt::format("lens \"{}\" ( )", GetParam()->name)));
  ASSERT_TRUE(s.world && s.world->lens.size() == 1) << s.messages();
  const ShaderNode* node = s.world->lens[0];
  constexpr float kInf = std::numeric_limits<float>::infinity();
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  ShadingPoint point;
  for (const float a : {0.0f, 1.0f, -1.0f, 1e-38f, 3e38f, -3e38f, kInf, -kInf, kNan})
    for (const float b : {0.5f, -2.0f, kInf, kNan})
      for (const float cosine : {1.0f, 0.5f, 0.0f}) {
        const Rgb c = node->with_params(point, [&](const Call& call) {
          return node->spec().lens.map_color(call, {cosine, false}, Rgb(a, b, .2f));
        });
        EXPECT_TRUE(is_finite(Vec3(c.x, c.y, c.z))) << a << ' ' << b;
        EXPECT_TRUE(c.x >= 0 && c.y >= 0 && c.z >= 0) << a << ' ' << b;
      }
}

TEST_P(LensContract, BrighterLightIsNeverDarker) {
  const PreparedScene s(scene_text(kGrey, {}, fmt::format("lens \"{}\" ( )", GetParam()->name)));
  ASSERT_TRUE(s.world && s.world->lens.size() == 1);
  const ShaderNode* node = s.world->lens[0];
  ShadingPoint point;
  float last = -1;
  for (float v = 1e-4f; v < 1e6f; v *= 1.3f) {
    const Rgb c = node->with_params(point, [&](const Call& call) {
      return node->spec().lens.map_color(call, {1, false}, Rgb(v));
    });
    EXPECT_GE(c.x, last - 1e-6f);
    last = c.x;
  }
}

std::vector<const ShaderSpec*> lenses() {
  std::vector<const ShaderSpec*> found;
  for (const ShaderSpec* spec : builtin_shaders().all())
    if (spec->lens.map_color) found.push_back(spec);
  return found;
}

INSTANTIATE_TEST_SUITE_P(AllLenses, LensContract, ::testing::ValuesIn(lenses()),
                         [](const auto& param) { return std::string(param.param->name); });

}  // namespace view_contract_test
}  // namespace oriel
