// SPDX-License-Identifier: Apache-2.0
// Interface contract of lights: every light shader on every shape.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>
#include <string>

#include "lights/sample_light.h"
#include "prepare/testing/prepared_scene.h"
#include "sampling/testing/chi_square.h"

namespace oriel {
namespace light_contract_test {

struct Case {
  std::string shader;
  std::string shape_name, shape;
  friend void PrintTo(const Case& c, std::ostream* out) {
    *out << c.shader << " on " << c.shape_name;
  }
};

constexpr int kFirstExtended = 3;
constexpr std::pair<const char*, const char*> kShapes[] = {
    {"Point", "origin 0 0 2"},
    {"Spot", "origin 0 0 2 direction 0 0 -1 spread .7"},
    {"Directional", "direction .3 .2 -1"},
    {"Rectangle", "origin 0 0 2 direction 0 0 -1 rectangle 1.5 .2 0 -.1 1 0"},
    {"Disc", "origin 0 0 2 direction 0 0 -1 disc 0 .1 -1 .8"},
    {"Sphere", "origin 0 0 2 sphere .7"},
    {"Cylinder", "origin 0 0 2 cylinder .8 .1 0 .3"},
};

std::vector<Case> cases(bool extended = false) {
  std::vector<Case> all;
  for (const ShaderSpec* spec : builtin_shaders().all())
    if (spec->light.evaluate)
      for (const auto& [name, shape] : kShapes)
        if (!extended || &name >= &kShapes[kFirstExtended].first)
          all.push_back({spec->name, name, shape});
  return all;
}

// Places below the light; the first straight below, one almost level with flat lights.
const Vec3 kPlaces[] = {Vec3(0, 0, 0), Vec3(1.2f, -0.7f, 0.6f), Vec3(2.5f, 1, 1.2f)};

/// The cone around a light as seen from a place, as a square of equal solid angles. In double: the
/// yardstick.
class Cone {
 public:
  Cone(const Light& light, const Vec3& place) : frame_(normalize(light.position - place)) {
    double reach = light.radius;
    if (light.shape == LightShape::Rectangle)
      reach = (length(light.edge_u) + length(light.edge_v)) / 2;
    if (light.shape == LightShape::Cylinder) reach = length(light.edge_u) + light.radius;
    const double sine = std::min(0.99, 1.001 * reach / length(light.position - place));
    height_ = 1 - std::sqrt(1 - sine * sine);
  }
  double solid_angle() const { return 2 * kPiDouble * height_; }
  Vec3 direction(double u, double v) const {
    const double z = 1 - height_ * u, r = std::sqrt(1 - z * z), phi = 2 * kPiDouble * v;
    return frame_.to_world(Vec3(static_cast<float>(r * std::cos(phi)),
                                static_cast<float>(r * std::sin(phi)), static_cast<float>(z)));
  }
  Vec2 to_square(const Vec3& world) const {
    const Vec3 d = frame_.to_local(world);
    const double phi = std::atan2(double{d.y}, double{d.x});
    return Vec2(static_cast<float>((1 - d.z) / height_),
                static_cast<float>(phi < 0 ? phi / (2 * kPiDouble) + 1 : phi / (2 * kPiDouble)));
  }

 private:
  static constexpr double kPiDouble = 3.14159265358979323846;
  Frame frame_;
  double height_ = 1;
};

class LightContract : public ::testing::TestWithParam<Case> {
 protected:
  LightContract() {
    const Case& c = GetParam();
    const ShaderSpec* spec = builtin_shaders().find(c.shader);
    std::string arguments;
    for (const ParamSpec& row : spec->params) {
      if (std::string_view(row.name) == "color") arguments += "\"color\" 3 2 1, ";
      if (std::string_view(row.name) == "cone") arguments += "\"cone\" .9, ";
      // Wide enough that not only a corner of a shape shines.
      if (std::string_view(row.name) == "coneAngle") arguments += "\"coneAngle\" 1.4, ";
    }
    scene_ = std::make_unique<testing::PreparedScene>(testing::scene_text(
        fmt::format(
            "material \"m\" \"mib_illum_lambert\" ( ) end material light \"l\" \"{}\" ( {} ) "
            "{} end light instance \"li\" \"l\" end instance",
            c.shader, arguments, c.shape),
        "\"li\""));
    EXPECT_TRUE(scene_->world && scene_->world->lights.size() == 1) << scene_->messages();
  }
  const Light& light() const { return scene_->world->lights.at(0); }
  bool has_extent() const {
    return light().shape != LightShape::Point && light().shape != LightShape::Directional;
  }
  ShadingPoint at(const Vec3& place) const {
    ShadingPoint point;
    point.position = place;
    point.world = scene_->world.get();
    return point;
  }
  std::unique_ptr<testing::PreparedScene> scene_;
};

/// The same for the shapes that rays can meet.
class ExtendedLightContract : public LightContract {};

TEST_P(LightContract, SamplesAreSoundAndLieOnTheLight) {
  for (const Vec3& place : kPlaces) {
    ShadingPoint point = at(place);
    for (int n = 0; n < 500; ++n) {
      sampling::Sampler sampler(n, 1, 0);
      const auto s = sample_light(light(), point, sampler.next_2d());
      if (!s) continue;
      ASSERT_NEAR(length(s->wi), 1, 1e-4);
      ASSERT_GT(s->distance, 0);
      ASSERT_TRUE(is_finite(Vec3(s->irradiance.x, s->irradiance.y, s->irradiance.z)));
      ASSERT_TRUE(s->irradiance.x >= 0 && s->irradiance.y >= 0 && s->irradiance.z >= 0);
      ASSERT_EQ(s->pdf > 0, has_extent());
      ASSERT_TRUE(s->shadow_factor >= 0 && s->shadow_factor <= 1);
      if (!has_extent()) {
        ASSERT_FALSE(intersect_light(light(), point, s->wi, 1e6f));
        continue;
      }
      // The same direction, found by a ray: same place, same density, same light. At the very rim
      // rounding decides.
      const auto hit = intersect_light(light(), point, s->wi, 1e6f);
      if (!hit) continue;
      ASSERT_NEAR(hit->t / s->distance, 1, 2e-3);
      ASSERT_NEAR(hit->pdf / s->pdf, 1, 0.02);
      for (int i = 0; i < 3; ++i)
        ASSERT_NEAR(hit->radiance[i], s->irradiance[i] * s->pdf, 0.02f * hit->radiance[i] + 1e-6f);
    }
  }
}

TEST_P(ExtendedLightContract, DirectionsFollowTheDensity) {
  const double least = testing::sidak(0.01, 2 * static_cast<int>(cases().size()));
  for (const Vec3& place : {kPlaces[0], kPlaces[1]}) {
    ShadingPoint point = at(place);
    const Cone cone(light(), place);
    constexpr int kRings = 12, kSpokes = 16, kFine = 64, kDraws = 20000;
    std::vector<double> expected(kRings * kSpokes), observed(kRings * kSpokes);
    int drawn = 0;
    for (int n = 0; n < kDraws; ++n) {
      sampling::Sampler sampler(n, 23, 0);
      const auto s = sample_light(light(), point, sampler.next_2d());
      if (!s) continue;
      ++drawn;
      const Vec2 uv = cone.to_square(s->wi);
      ASSERT_TRUE(uv.x >= 0 && uv.x < 1) << "outside of the light";
      observed[static_cast<std::size_t>(static_cast<int>(uv.x * kRings) * kSpokes +
                                        std::min(static_cast<int>(uv.y * kSpokes), kSpokes - 1))] +=
          1;
    }
    if (drawn == 0) continue;  // this shader gives no light on this shape
    // Edges of lights cross cells: only many points see them, no order of a rule does.
    double integral = 0;
    for (int i = 0; i < kRings * kFine; ++i)
      for (int j = 0; j < kSpokes * kFine; ++j) {
        const Vec3 d = cone.direction((i + .5) / (kRings * kFine), (j + .5) / (kSpokes * kFine));
        const auto hit = intersect_light(light(), point, d, 1e6f);
        if (!hit || is_black(hit->radiance)) continue;
        const double share = hit->pdf * cone.solid_angle() / (kRings * kFine * kSpokes * kFine);
        expected[static_cast<std::size_t>(i / kFine * kSpokes + j / kFine)] += share * kDraws;
        integral += share;
      }
    EXPECT_NEAR(integral, static_cast<double>(drawn) / kDraws, 0.01);
    EXPECT_GT(testing::chi_square(observed, expected).p_value, least)
        << GetParam().shader << ' ' << GetParam().shape_name;
  }
}

TEST_P(ExtendedLightContract, MeanOfSamplesIsTheIntegralOverTheShape) {
  for (const Vec3& place : {kPlaces[0], kPlaces[1]}) {
    ShadingPoint point = at(place);
    double mean = 0, squares = 0;
    constexpr int kDraws = 20000;
    for (int n = 0; n < kDraws; ++n) {
      sampling::Sampler sampler(n, 2, 0);
      const auto s = sample_light(light(), point, sampler.next_2d());
      if (!s) continue;
      mean += s->irradiance.x;
      squares += double{s->irradiance.x} * s->irradiance.x;
    }
    mean /= kDraws;
    const double error = std::sqrt(std::max(0.0, squares / kDraws - mean * mean) / kDraws);
    // The radiance that rays meet.
    const Cone cone(light(), place);
    constexpr int kRings = 1500, kSpokes = 300;
    double integral = 0;
    for (int i = 0; i < kRings; ++i)
      for (int j = 0; j < kSpokes; ++j)
        if (const auto hit = intersect_light(
                light(), point, cone.direction((i + .5) / kRings, (j + .5) / kSpokes), 1e6f))
          integral += hit->radiance.x;
    integral *= cone.solid_angle() / (double{kRings} * kSpokes);
    EXPECT_NEAR(mean, integral, 4 * error + 0.005 * integral)
        << GetParam().shader << ' ' << GetParam().shape_name;
  }
}

// Convention of all lights: a light of colour c gives pi c, for any shape.
TEST(LightConvention, FlatLightsOfConstantColourGivePiTimesTheirColour) {
  for (const char* shape : {"rectangle 1.5 .2 0 -.1 1 0", "rectangle 2 0 0 0 1 0",
                            "rectangle 1 0 0 .9 .6 0", "disc 0 0 -1 .8"}) {
    const testing::PreparedScene s(testing::scene_text(
        fmt::format("material \"m\" \"mib_illum_lambert\" ( ) end material light \"l\" "
                    "\"mib_light_point\" ( \"color\" 3 2 1 ) origin 0 0 2 direction 0 0 -1 {} end "
                    "light instance \"li\" \"l\" end instance",
                    shape),
        "\"li\""));
    ShadingPoint point;
    point.world = s.world.get();
    for (const Vec3& place : kPlaces) {
      point.position = place;
      double mean = 0, squares = 0;
      constexpr int kDraws = 20000;
      for (int n = 0; n < kDraws; ++n) {
        sampling::Sampler sampler(n, 5, 0);
        const auto drawn = sample_light(s.world->lights.at(0), point, sampler.next_2d());
        if (!drawn) continue;
        mean += drawn->irradiance.x / kDraws;
        squares += double{drawn->irradiance.x} * drawn->irradiance.x / kDraws;
      }
      const double error = std::sqrt(std::max(0.0, squares - mean * mean) / kDraws);
      EXPECT_NEAR(mean, 3 * 3.14159265358979, 4 * error + 1e-3) << shape;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(AllLights, LightContract, ::testing::ValuesIn(cases()),
                         [](const auto& param) {
                           return param.param.shader + "_" + param.param.shape_name;
                         });

INSTANTIATE_TEST_SUITE_P(AllLights, ExtendedLightContract, ::testing::ValuesIn(cases(true)),
                         [](const auto& param) {
                           return param.param.shader + "_" + param.param.shape_name;
                         });

}  // namespace light_contract_test
}  // namespace oriel
