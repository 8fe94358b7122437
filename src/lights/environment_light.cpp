// SPDX-License-Identifier: Apache-2.0
#include "lights/environment_light.h"

#include <algorithm>
#include <vector>

#include "runtime/world.h"
#include "sampling/octahedral.h"

namespace oriel {
namespace {

/// Share of the density spread evenly, so that what the table smoothed away is still found.
constexpr float kUniformShare = 0.02f;
/// Share of plain proportion beside what stands out, so that dim parts are never found too seldom
/// where no ray of a lobe finds them.
constexpr float kPlainShare = 0.2f;

/// A direction by a distribution over cells, or evenly. Inputs:  normal: what the distribution
/// takes before other arguments; may be nothing.
EnvironmentLight::Sample sample_from(const auto& distribution, Vec2 u, const auto&... normal) {
  Vec2 uv;
  std::size_t cell = 0;
  float by_cell = 0;
  if (u.x < kUniformShare) {
    uv = Vec2(u.x / kUniformShare, u.y);
    cell = distribution.cell(uv);
    by_cell = distribution.pdf(normal..., cell);
  } else {
    u.x = std::min((u.x - kUniformShare) / (1 - kUniformShare), 0x1.fffffep-1f);
    const auto s = distribution.sample(normal..., u);
    uv = s.uv;
    cell = s.index;
    by_cell = s.pdf;
  }
  const Vec3 wi = sampling::octahedral_direction(uv);
  const float pdf = kUniformShare + (1 - kUniformShare) * by_cell;
  return {wi, pdf / sampling::octahedral_solid_angle(wi), cell};
}

}  // namespace

EnvironmentLight::EnvironmentLight(const World& world, bool draft) : table_(world, draft) {
  const std::size_t side = table_.side();
  if (side == 0) return;
  std::vector<float> luminances = table_.take_luminances(), angles(luminances.size());
  double total = 0, total_angle = 0;  // double: a quarter of a million terms
  for (std::size_t i = 0; i < luminances.size(); ++i) {
    const std::size_t x = i % side, y = i / side;
    const Vec2 centre(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    angles[i] = sampling::octahedral_solid_angle(
        sampling::octahedral_direction(centre / static_cast<float>(side)));
    total += static_cast<double>(luminances[i] * angles[i]);
    total_angle += static_cast<double>(angles[i]);
  }
  mean_luminance_ = static_cast<float>(total / total_angle);
  if (!(mean_luminance_ > 0)) return;
  double above = 0;
  for (std::size_t i = 0; i < luminances.size(); ++i)
    above += static_cast<double>(std::max(0.0f, luminances[i] - mean_luminance_) * angles[i]);
  if (table_.constant()) above = 0;
  unevenness_ = static_cast<float>(above / total);
  // The light less its mean, mixed with the light itself.
  const float stretch = above > 0 ? static_cast<float>((1 - kPlainShare) * total / above) : 0.0f;
  std::vector<float> proportion(luminances.size()), standing_out(luminances.size());
  for (std::size_t i = 0; i < luminances.size(); ++i) {
    proportion[i] = luminances[i] * angles[i];
    standing_out[i] = kPlainShare * proportion[i] +
                      stretch * std::max(0.0f, luminances[i] - mean_luminance_) * angles[i];
  }
  in_proportion_ = std::make_shared<const sampling::Distribution2D>(proportion, side, side);
  standing_out_ = std::make_shared<const sampling::FacingDistribution>(standing_out, side);
}

EnvironmentLight::Sample EnvironmentLight::sample(const Vec3& normal, Vec2 u) const {
  return sample_from(*standing_out_, u, normal);
}

EnvironmentLight::Sample EnvironmentLight::sample_alone(Vec2 u) const {
  return sample_from(*in_proportion_, u);
}

float EnvironmentLight::pdf(const Vec3& normal, const Vec3& direction, std::size_t cell) const {
  const float pdf = kUniformShare + (1 - kUniformShare) * standing_out_->pdf(normal, cell);
  return pdf / sampling::octahedral_solid_angle(direction);
}

}  // namespace oriel
