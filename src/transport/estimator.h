// SPDX-License-Identifier: Apache-2.0
// By which of the two ways light is found at a vertex, and what each finding counts.
#pragma once

#include <cstdint>

#include "sampling/warp.h"

namespace oriel {

/// All three have the same mean; the single ones exist to be checked against it.
enum class Estimator : std::uint8_t {
  Mis,        ///< samples of lights and of lobes, weighed against each other
  LightOnly,  ///< lights and environment are found by sampling them
  BsdfOnly    ///< lights with a shape and the environment are found by rays of lobes
};

/// Weight of a sample of a light that a lobe's ray might have found with density `bsdf`.
inline float light_sample_weight(Estimator e, float light, float bsdf) {
  if (e == Estimator::Mis) return sampling::power_heuristic(light, bsdf);
  return e == Estimator::LightOnly ? 1.0f : 0.0f;
}

/// Weight of a light found by a lobe's ray, where sampling the light had density `light`.
inline float bsdf_sample_weight(Estimator e, float bsdf, float light) {
  if (e == Estimator::Mis) return sampling::power_heuristic(bsdf, light);
  return e == Estimator::BsdfOnly ? 1.0f : 0.0f;
}

}  // namespace oriel
