// SPDX-License-Identifier: Apache-2.0
#include "mia_stages.h"

#include <fmt/format.h>

#include "base/math.h"
#include "color/luminance.h"
#include "runtime/color_mapping.h"

namespace oriel::effects {

Measured measured_with(const std::string& parameter, const Stage& stage, const std::string& others,
                       const std::string& value) {
  const std::size_t dot = parameter.find('.');
  return stage(
      call_of(parameter.substr(0, dot), others + ", " + parameter.substr(dot + 1) + " " + value));
}

Measured exactly(const Rgb& mean) {
  Measured m;
  m.mean = mean;
  return m;
}

void expect_about(const Rgb& value, const Rgb& expected, float share) {
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(value[k], expected[k], share * std::abs(expected[k]) + 1e-6f) << "channel " << k;
}

Case gives_about(const std::string& parameter, Stage stage, const std::string& others,
                 std::vector<Given> values, float share) {
  return shows(parameter, [=] {
    ASSERT_GE(values.size(), 2u);
    for (const Given& each : values) {
      SCOPED_TRACE(parameter + " " + each.value);
      const Measured m = measured_with(parameter, stage, others, each.value);
      expect_about(m.mean, each.expected, share);
      EXPECT_LE(max_component(m.error), share * max_component(each.expected)) << "too noisy";
    }
  });
}

Case makes(const std::string& parameter, Stage stage, const std::string& others,
           const std::string& base, std::vector<Made> values) {
  return shows(parameter, [=] {
    const Rgb before = measured_with(parameter, stage, others, base).mean;
    EXPECT_GT(max_component(before), 0) << "nothing is changed";
    for (const Made& each : values) {
      SCOPED_TRACE(parameter + " " + each.value);
      expect_about(measured_with(parameter, stage, others, each.value).mean, each.of(before),
                   1e-4f);
    }
  });
}

Vec3 toward(float elevation, float azimuth) {
  const float e = elevation * kPi / 180, a = azimuth * kPi / 180;
  return Vec3(math::cos(e) * math::cos(a), math::cos(e) * math::sin(a), math::sin(e));
}

Stage luminance_of(Stage stage) {
  return [=](const std::string& call) {
    Measured m = stage(call);
    m.error = Rgb(luminance(m.error));
    m.mean = Rgb(luminance(m.mean));
    return m;
  };
}

Stage seen_by(RayKind kind, const Vec3& direction, SceneText scene, float roughness,
              const PrepareOptions& prepared) {
  return [=](const std::string& call) {
    SceneText with = scene;
    const Probe probe(with.environment(call).str(), known_shaders(), prepared);
    const World& world = probe.world();
    return exactly(rgb(environment_radiance(world.environment, world, Vec3(0), normalize(direction),
                                            kind, false, roughness)));
  };
}

Stage level_card(SceneText scene) {
  return [=](const std::string& call) {
    SceneText with = scene;
    const Probe probe(with.environment(call).str(), known_shaders(), kCoarse);
    const World& world = probe.world();
    constexpr int kRings = 64, kSectors = 96;
    Imath::Vec3<double> sum(0.0);  // double: thousands of terms
    for (int i = 0; i < kRings; ++i)
      for (int j = 0; j < kSectors; ++j) {
        // Equal steps in the squared sine: each look-up has the same share.
        const float sin2 = (static_cast<float>(i) + .5f) / kRings;
        const float phi = kTwoPi * (static_cast<float>(j) + .5f) / kSectors;
        const Vec3 d(std::sqrt(sin2) * math::cos(phi), std::sqrt(sin2) * math::sin(phi),
                     std::sqrt(1 - sin2));
        const Rgb c =
            rgb(environment_radiance(world.environment, world, Vec3(0), d, RayKind::FinalGather));
        sum += Imath::Vec3<double>(c.x, c.y, c.z);
      }
    return exactly(Rgb(Imath::V3f(sum / double(kRings * kSectors))));
  };
}

Stage lens_map(const Rgb& color, Vec2 place, const std::string& camera) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.camera("focal 1 aperture 1 aspect 1 resolution 32 32 " + camera + " lens " + call);
    const Probe probe(scene.str(), known_shaders());
    return exactly(map_color(probe.world().lens, probe.world(), place * 32, color));
  };
}

}  // namespace oriel::effects
