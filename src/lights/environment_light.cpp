// SPDX-License-Identifier: Apache-2.0
#include "lights/environment_light.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "base/parallel.h"
#include "color/luminance.h"
#include "runtime/environment.h"
#include "runtime/world.h"

namespace oriel {
namespace {

/// Width of the table: 0.35 degrees in azimuth resolve lamps in a photographed sky; a sky from
/// formulas is smooth, and a table that fits the processor's cache is faster.
constexpr int kPhotographedWidth = 1024, kSmoothWidth = 256, kCoarseWidth = 16;
/// Share of the density spread evenly, so that what the table smoothed away is still found.
constexpr float kUniformShare = 0.02f;
/// Share of plain proportion beside what stands out, so that dim parts are never found too seldom
/// where no ray of a lobe finds them.
constexpr float kPlainShare = 0.2f;

/// The values less their mean, mixed with the values themselves.
std::vector<float> standing_out(const std::vector<float>& values, float mean) {
  double above = 0;  // half a million terms
  for (const float v : values) above += std::max(0.0f, v - mean);
  if (!(above > 0)) return values;
  const double all = static_cast<double>(mean) * static_cast<double>(values.size());
  const auto stretch = static_cast<float>((1 - kPlainShare) * all / above);
  std::vector<float> mixed(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    mixed[i] = kPlainShare * values[i] + stretch * std::max(0.0f, values[i] - mean);
  return mixed;
}

Vec3 direction_of(const Vec2& uv) {
  const float z = 1 - 2 * uv.y;
  const float r = std::sqrt(std::max(0.0f, 1 - z * z));
  const float phi = kTwoPi * uv.x;
  return Vec3(r * math::cos(phi), r * math::sin(phi), z);
}

Vec2 uv_of(const Vec3& d) {
  float u = math::atan2(d.y, d.x) / kTwoPi;
  if (u < 0) u += 1;
  return Vec2(std::min(u, 0x1.fffffep-1f), clamp((1 - d.z) / 2, 0.0f, 0x1.fffffep-1f));
}

}  // namespace

EnvironmentLight::EnvironmentLight(const World& world) {
  if (world.environment.empty()) return;
  const std::size_t width = world.coarse_tables      ? kCoarseWidth
                            : world.textures.empty() ? kSmoothWidth
                                                     : kPhotographedWidth;
  const std::size_t height = width / 2;
  std::vector<float> values(width * height);
  parallel_for(height, [&](std::size_t y) {
    for (std::size_t x = 0; x < width; ++x) {
      // Four points of a texel: a small bright source between two centres must not be missed.
      float sum = 0;
      for (int k = 0; k < 4; ++k) {
        const Vec2 uv(
            (static_cast<float>(x) + (k & 1 ? 0.75f : 0.25f)) / static_cast<float>(width),
            (static_cast<float>(y) + (k & 2 ? 0.75f : 0.25f)) / static_cast<float>(height));
        const Rgba c = environment_radiance(world.environment, world, Vec3(0), direction_of(uv),
                                            RayKind::FinalGather);
        const float l = luminance(rgb(c));
        if (std::isfinite(l)) sum += std::max(0.0f, l);
      }
      values[y * width + x] = sum / 4;
    }
  });
  double total = 0;  // double: half a million terms of very different size
  for (const float v : values) total += v;
  mean_luminance_ = static_cast<float>(total / static_cast<double>(values.size()));
  if (!(mean_luminance_ > 0)) return;
  table_ = std::make_unique<sampling::Distribution2D>(values, width, height);
  standing_out_ = std::make_unique<sampling::Distribution2D>(standing_out(values, mean_luminance_),
                                                             width, height);
}

EnvironmentLight::Sample EnvironmentLight::sample_from(const sampling::Distribution2D& table,
                                                       Vec2 u) {
  Vec2 uv;
  if (u.x < kUniformShare) {
    uv = Vec2(u.x / kUniformShare, u.y);
  } else {
    u.x = std::min((u.x - kUniformShare) / (1 - kUniformShare), 0x1.fffffep-1f);
    uv = table.sample(u).uv;
  }
  const float pdf = table.pdf(uv);
  return {direction_of(uv), (kUniformShare + (1 - kUniformShare) * pdf) / (4 * kPi)};
}

float EnvironmentLight::pdf(const Vec3& direction) const {
  return (kUniformShare + (1 - kUniformShare) * standing_out_->pdf(uv_of(direction))) / (4 * kPi);
}

}  // namespace oriel
