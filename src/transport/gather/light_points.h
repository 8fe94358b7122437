// SPDX-License-Identifier: Apache-2.0
// Measures the lights at points of a scene.
#pragma once

#include "transport/gather/gather_points.h"
#include "transport/learned_lights.h"

namespace oriel {

/// What reaches the points of the lights of which paths choose one, with `samples` samples of each.
/// Empty: paths sample all lights.
LearnedLights measure_lights(const World& world, std::span<const GatherPoint> points, int samples,
                             std::uint32_t seed, RayCounts& counts);

/// The same of the parts of the mesh lights. Empty: there are none.
LearnedLights measure_emitters(const World& world, std::span<const GatherPoint> points, int samples,
                               std::uint32_t seed, RayCounts& counts);

}  // namespace oriel
