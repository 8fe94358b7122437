// SPDX-License-Identifier: Apache-2.0
// Eye rays: one camera sample through the lens shaders that bend rays.
#pragma once

#include "runtime/world.h"
#include "transport/path/path.h"

namespace oriel {

/// Rays of a camera sample that a lens shader may ask for.
inline constexpr int kMostLensRays = 65536;

/// One camera sample: a path through the middle of the lens, or, where lens shaders bend rays, the
/// mean of as many paths as they ask for.
///
/// Model:   rays of one sample, and those of all samples of a pixel, lie evenly on the lens. Counts
///          of samples that materials share (PathSettings::paths_of_pixel) are shared by all paths.
/// Inputs:  record: empty, as after reset().
/// Checked: LensBokeh.* in tests/analytic/camera/lens_bokeh_test.cpp
void trace_eye_rays(const World& world, Vec2 raster, const PathSettings& settings,
                    PathRecord& record, sampling::Sampler& sampler, RayCounts& counts);
/// The same without optional values.
PathResult trace_eye_rays(const World& world, Vec2 raster, const PathSettings& settings,
                          sampling::Sampler& sampler, RayCounts& counts);

}  // namespace oriel
