// SPDX-License-Identifier: Apache-2.0
// Time of a sample or photon within the shutter interval.
#pragma once

#include "sampling/sampler.h"
#include "scene/motion.h"

namespace oriel {

/// Ray time of a sample: samples are stratified over the shutter interval; 0 in static scenes. It
/// has a sample dimension of its own, so that pictures of static scenes do not change.
/// Checked: Motion.* in tests/analytic/motion/motion_test.cpp
inline float shutter_time(const scene::Shutter& shutter, const sampling::Sampler& sampler) {
  constexpr std::uint32_t kTimeBranch = 9000;
  if (!shutter.on) return 0;
  sampling::Sampler stream = sampler.split(0, 1, kTimeBranch);
  stream.set_dimension(0);
  return shutter.at(stream.next_1d());
}

}  // namespace oriel
