// SPDX-License-Identifier: Apache-2.0
// Probabilities of the lights of a set that were learned for a place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "base/vec.h"

namespace oriel {

/// Probabilities of the lights of one set of the light sampler; borrowed.
struct LightChances {
  std::span<const float> probability;  ///< by the order of the set; sum 1. Empty: unknown
  std::span<const float> until;        ///< sums of those up to each
  /// Share of the samples that ignore them, so that lights which were not seen are found, and a
  /// wrong choice multiplies the noise at most by its reciprocal.
  float unlearned = 1;

  /// Whether a sample ignores them. Inputs:  u: uniform in [0,1); returns a new uniform number.
  bool ignored(float& u) const {
    const bool is = u < unlearned;
    u = std::min(is ? u / unlearned : (u - unlearned) / (1 - unlearned), 0x1.fffffep-1f);
    return is;
  }
  /// Probability of a light that the light tree chooses with probability `by_tree`.
  float mixed(std::size_t light, float by_tree) const {
    return lerp(probability[light], by_tree, unlearned);
  }
  explicit operator bool() const { return !probability.empty(); }
  /// Inputs:  u: uniform in [0,1); returns a new uniform number.
  std::size_t choose(float& u) const {
    const auto found = std::upper_bound(until.begin(), until.end(), u);
    const std::size_t i =
        std::min(static_cast<std::size_t>(found - until.begin()), until.size() - 1);
    const float from = i > 0 ? until[i - 1] : 0;
    if (probability[i] > 0) u = std::clamp((u - from) / probability[i], 0.0f, 0x1.fffffep-1f);
    return i;
  }
};

}  // namespace oriel
