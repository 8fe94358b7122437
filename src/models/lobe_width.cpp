// SPDX-License-Identifier: Apache-2.0
#include "models/lobe_width.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/vec.h"
#include "bsdf/gloss.h"

namespace oriel::models {

float gloss_of_roughness(float roughness) {
  // The inverse of bsdf::gloss_to_alpha, alpha = 2^(-1.5 - 7 g).
  const float alpha = sqr(clamp01(roughness));
  if (alpha < 1e-5f) return 1;
  return clamp01(-(math::log2(alpha) + 1.5f) / 7);
}

Brushed brushed(float roughness, float strength) {
  const float across = std::max(sqr(clamp01(roughness)), bsdf::kMinAlpha);
  const float along = lerp(across, 1, sqr(strength));
  // The glossiness of a roughness whose square is the mean of both.
  return {gloss_of_roughness(std::sqrt(std::sqrt(across * along))),
          std::min(along / across, bsdf::kMaxAnisotropy)};
}

}  // namespace oriel::models
