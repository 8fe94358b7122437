// SPDX-License-Identifier: Apache-2.0
// Eye rays: one camera sample through the lens shaders that generate rays.
#pragma once

#include "render/integrator.h"
#include "render/silhouettes.h"

namespace oriel {

/// Maximum number of rays per camera sample.
inline constexpr int kMaxLensRays = 65536;

/// Traces one camera sample: one path through the centre of the lens, or, with lens shaders that
/// generate rays, the mean of as many paths as they request.
///
/// Model:   the rays of a sample, and those of all samples of a pixel, are stratified on the lens.
///          All paths of a pixel share the sample counts of materials.
/// Inputs:  samples_of_pixel: the number of camera samples that the pixel gets in all; record:
///          empty, as after reset().
/// Checked: LensBokeh.* in tests/analytic/camera/lens_bokeh_test.cpp
void trace_eye_rays(const World& world, const Integrator& integrator, Vec2 raster,
                    float samples_of_pixel, PathRecord& record, sampling::Sampler& sampler,
                    RayCounts& counts);
/// The same without lens shaders where objects end before nothing: one path through a place that
/// meets an object, weighted with the share of such places, and one for the others.
///
/// Inputs:  sample.places: raster positions, each drawn as the place of an ordinary sample is.
/// Returns: the record, and the other values of `sample`.
/// Checked: Silhouettes.AlphaAndLightAreTheExactCoverage
void trace_at_silhouette(const World& world, const Integrator& integrator, SilhouetteSample& sample,
                         float samples_of_pixel, PathRecord& record, sampling::Sampler& sampler,
                         RayCounts& counts);
/// The same with path tracing and no optional values.
PathResult trace_eye_rays(const World& world, Vec2 raster, sampling::Sampler& sampler,
                          RayCounts& counts);

}  // namespace oriel
