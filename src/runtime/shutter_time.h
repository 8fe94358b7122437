// SPDX-License-Identifier: Apache-2.0
// When, while the shutter is open, a sample or a photon is.
#pragma once

#include "sampling/sampler.h"
#include "scene/motion.h"

namespace oriel {

/// Ray time for what `sampler` draws: its samples lie evenly over the time that the shutter is
/// open; 0 where nothing moves. A dimension of its own: pictures of still scenes stay as they are.
/// Checked: Motion.* in tests/analytic/motion/motion_test.cpp
inline float shutter_time(const scene::Shutter& shutter, const sampling::Sampler& sampler) {
  constexpr std::uint32_t kTimeBranch = 9000;
  if (!shutter.on) return 0;
  sampling::Sampler stream = sampler.split(0, 1, kTimeBranch);
  stream.set_dimension(0);
  return shutter.at(stream.next_1d());
}

}  // namespace oriel
