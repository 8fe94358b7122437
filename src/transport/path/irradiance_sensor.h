// SPDX-License-Identifier: Apache-2.0
// Irradiance: what a cosine-corrected light meter reads, in the air or lying on a surface.
#pragma once

#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/path/path.h"

namespace oriel {

// Conventions
//   Irradiance is in pixel units times pi: a white Lambert surface under irradiance E shows E / pi.
//   Times the cd/m2 of a pixel unit it is in lux.

/// A meter: a white Lambert surface without extent, which hides nothing. All lights of the scene
/// reach it, whatever the lights linked to what it lies on, and all shadows.
struct IrradianceSensor {
  Vec3 position{0};
  Vec3 normal{0, 0, 1};  ///< unit, world: it receives from the half space on this side
  float offset = 0;      ///< rays start this far along the normal; of surfaces it lies on
};

/// What one path says of the irradiance; its mean over paths is that.
///
/// Model:   the path tracer from a white diffuse closure: direct light of all lights and the
///          environment by multiple importance sampling, indirect light by rays. Maps, where the
///          settings have them, are read from the second surface on.
/// Checked: Measure.* in tests/analytic/measure_test.cpp
Rgb sample_irradiance(const World& world, const IrradianceSensor& sensor,
                      const PathSettings& settings, sampling::Sampler& sampler, RayCounts& counts);

}  // namespace oriel
