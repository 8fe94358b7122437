// SPDX-License-Identifier: Apache-2.0
// Shadows: what is left of light between a point and a light sample.
#pragma once

#include "runtime/world.h"
#include "transport/counts.h"

namespace oriel {

/// Share of the light that arrives, per channel.
struct Openness {
  Rgb all{1};       ///< straight through whatever lets light pass
  Rgb clear{1};     ///< the same, rough transparency taken as closed
  Rgb cut_outs{1};  ///< through holes of materials alone
};

/// What is open between a point and a light.
///
/// Model:   opaque blockers first; then, when there are any, transparent ones one after another:
///          each passes the levels of its transmitting lobes straight on, with absorption through
///          the thickness in shadow mode segments. Refraction does not bend shadow rays.
/// Inputs:  point: the lit point; wi: unit, to the light; distance: to it, may be infinite.
/// Source:  manual 1.6.8.2 and 1.6.8.3 (do_refractive_caustics).
/// Checked: Glass.Shadows*, Glass.SkyThroughASlab*, CutOut.* in tests/analytic.
Openness shadow_transmittance(const World& world, const ShadingPoint& point, const Vec3& wi,
                              float distance, RayCounts& counts);

/// Whether lights are shadowed at the point: not when the scene or its instance says so.
bool takes_shadows(const World& world, const ShadingPoint& point);

/// Shares a closure lets pass straight, for shadow rays and what must match them.
Openness straight_transmission(const Closure& closure, const scene::RenderOptions& options);

/// Share left after `distance` in a medium.
Rgb transmittance(const Medium& medium, float distance);

}  // namespace oriel
