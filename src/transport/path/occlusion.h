// SPDX-License-Identifier: Apache-2.0
// Ambient occlusion: how much of what a surface faces is near.
#pragma once

#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"

namespace oriel {

/// Share of the hemisphere about `normal` that is free, by cosine: 1 = nothing is near.
///
/// Model:   a surface met at t counts 1 - t / distance, so that nothing changes abruptly at the
///          distance; without a distance each counts fully. Unlit: transparent things occlude too.
/// Inputs:  distance: scene units, 0 = any; samples: > 0.
/// Source:  manual 1.6.7.1; the linear fade is a guess.
/// Checked: Occlusion.* in tests/analytic/occlusion_test.cpp (corner, slab, closed box).
float free_share(const World& world, const ShadingPoint& point, const Vec3& normal, float distance,
                 int samples, sampling::Sampler& sampler, RayCounts& counts);

}  // namespace oriel
