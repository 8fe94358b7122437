// SPDX-License-Identifier: Apache-2.0
// Eye rays: one camera sample through the lens shaders that bend rays.
#pragma once

#include "render/integrator.h"

namespace oriel {

/// Rays of a camera sample that a lens shader may ask for.
inline constexpr int kMostLensRays = 65536;

/// One camera sample: a path through the middle of the lens, or, where lens shaders bend rays, the
/// mean of as many paths as they ask for.
///
/// Model:   rays of one sample, and those of all samples of a pixel, lie evenly on the lens. Sample
///          counts of materials are shared by all paths of a pixel.
/// Inputs:  samples_of_pixel: the number of camera samples that the pixel gets in all; record:
///          empty, as after reset().
/// Checked: LensBokeh.* in tests/analytic/camera/lens_bokeh_test.cpp
void trace_eye_rays(const World& world, const Integrator& integrator, Vec2 raster,
                    float samples_of_pixel, PathRecord& record, sampling::Sampler& sampler,
                    RayCounts& counts);
/// The same by paths without caches, without optional values.
PathResult trace_eye_rays(const World& world, Vec2 raster, sampling::Sampler& sampler,
                          RayCounts& counts);

}  // namespace oriel
