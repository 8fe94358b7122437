// SPDX-License-Identifier: Apache-2.0
// The path tracer: the reference every other transport must agree with.
#pragma once

#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/estimator.h"

namespace oriel {

/// What one path through the camera brings to the film.
struct PathResult {
  Rgb radiance{0};  ///< pixel units, linear
  float alpha = 0;
  float depth = 0;  ///< distance to the first surface, scene units; 0 = none
  /// World, shading normal, and sum of the material's levels: of the first surface that is not only
  /// a mirror or clear glass, seen through those; else of the first surface.
  Vec3 normal{0};
  Rgb albedo{0};
};

/// Traces one path.
///
/// Model:   unidirectional, multiple importance sampling of lights and environment against the
///          lobes, Russian roulette after kRouletteDepth diffuse or glossy vertices. Trace depths
///          as the options say, counted anew after each diffuse bounce. Through transparent
///          materials whose shadows are transparent, rays that follow a diffuse bounce go on
///          straight, as the shadow rays they are weighed against do (photons do the same): bent
///          light is caustics.
/// Inputs:  indirect: false = no diffuse bounces and no light from the environment on diffuse
///          lobes, as a scene without final gathering and photons is rendered.
/// Checked: tests/analytic (furnace, skies, form factors, shapes of lights, mirrors, glass, three
///          estimators).
PathResult trace_path(const World& world, const Camera::Ray& eye, Vec2 raster, bool indirect,
                      sampling::Sampler& sampler, RayCounts& counts,
                      Estimator estimator = Estimator::Mis);

}  // namespace oriel
