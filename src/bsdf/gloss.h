// SPDX-License-Identifier: Apache-2.0
// Conversion of glossiness and anisotropy parameters to roughness.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/vec.h"

namespace oriel::bsdf {

/// Smaller roughness is a mirror: the lobe would be narrower than 0.06 degrees.
inline constexpr float kMinAlpha = 5e-4f;
/// Larger roughness along one axis is scaled down with the ratio preserved; gloss 0 at anisotropy
/// 10 would need 1.118. The albedo table ends here.
inline constexpr float kMaxAlpha = 1.2f;
/// Anisotropy is clamped to 1/10 ... 10.
inline constexpr float kMaxAnisotropy = 10;

enum class GlossModel {
  Nvidia,  ///< the mapping of NVIDIA's successor of the material
  Linear,  ///< roughness is (1 - gloss) squared, as used by scene converters
};

/// GGX roughness of a glossiness in [0, 1]; gloss 1 gives 0, a mirror.
/// Source:  NVIDIA MDL-SDK, base.mdl, architectural_gloss_to_rough: sqrt(2 * 2^(-4 - 14 g)).
/// Checked: Gloss.MatchesThePublishedMap.
inline float gloss_to_alpha(float gloss, GlossModel model = GlossModel::Nvidia) {
  const float g = clamp01(gloss);
  if (g >= 1) return 0;
  return model == GlossModel::Nvidia ? math::exp2(-1.5f - 7 * g) : sqr(1 - g);
}

/// Roughness along x and y of the local frame.
struct Roughness {
  float ax = 0, ay = 0;
  bool is_mirror() const { return ax == 0; }
};

/// Distributes roughness over both axes such that the lobe widths have the ratio `anisotropy`, and
/// a and 1/a give the same lobe rotated by 90 degrees.
///
/// Returns: both zero (a mirror) or both within kMinAlpha ... kMaxAlpha.
/// Checked: Gloss.AnisotropyIsTheRatioOfWidths.
inline Roughness anisotropic_roughness(float alpha, float anisotropy) {
  if (!(alpha >= kMinAlpha)) return {};
  const float ratio = clamp(anisotropy, 1 / kMaxAnisotropy, kMaxAnisotropy);
  const float root = std::sqrt(ratio);
  const float longer = alpha * std::max(root, 1 / root);
  const float base = longer > kMaxAlpha ? alpha * (kMaxAlpha / longer) : alpha;
  return {std::max(base * root, kMinAlpha), std::max(base / root, kMinAlpha)};
}

/// Roughness given for both axes, limited in the same way: for axis ratios above the limit the mean
/// is kept and the ratio clamped.
inline Roughness limited_roughness(float ax, float ay) {
  const float x = std::max(ax, kMinAlpha), y = std::max(ay, kMinAlpha);
  return anisotropic_roughness(std::sqrt(x * y), x / y);
}

inline Roughness gloss_to_roughness(float gloss, float anisotropy = 1,
                                    GlossModel model = GlossModel::Nvidia) {
  return anisotropic_roughness(gloss_to_alpha(gloss, model), anisotropy);
}

}  // namespace oriel::bsdf
