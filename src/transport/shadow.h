// SPDX-License-Identifier: Apache-2.0
// Shadows: what is left of light between a point and a light sample.
#pragma once

#include "runtime/world.h"
#include "transport/counts.h"

namespace oriel {

/// Share of the light that arrives, per channel.
struct Transmittance {
  Rgb all{1};       ///< straight through whatever lets light pass
  Rgb clear{1};     ///< the same, rough transparency taken as closed
  Rgb cut_outs{1};  ///< through holes of materials alone
};

/// What is open between a point and a light.
///
/// Model:   opaque blockers first; then, when there are any, transparent ones one after another:
///          each passes the levels of its transmitting lobes straight on, with absorption through
///          the thickness in shadow mode segments. Refraction does not bend shadow rays.
///          Where a shadow shader stands in the material's slot it decides in place of the lobes.
///          It is asked from the point to the light in all modes, with white light at the point;
///          modes on and sort leave out only the media in between. Once a blocker is opaque none is
///          asked.
/// Inputs:  point: the lit point; wi: unit, to the light; distance: to it, may be infinite; light:
///          index into World::lights, which shadow shaders may ask for; -1 = the environment.
/// Source:  manual 1.6.8.2 and 1.6.8.3 (do_refractive_caustics).
/// Checked: Glass.Shadows*, Glass.SkyThroughASlab*, CutOut.*, ShadowModes.* in tests/analytic.
Transmittance shadow_transmittance(const World& world, const ShadingPoint& point, const Vec3& wi,
                                   float distance, RayCounts& counts, int light = -1);

/// Whether rays of lobes meet something before `distance` that casts no shadow.
///
/// Inputs:  lobes: one bit geom::RayMask::Shadowless*, for the kind of the rays.
/// Checked: ObjectFlags.LightPassesWhatCastsNoShadow in tests/analytic.
bool hidden_from_rays(const World& world, const ShadingPoint& point, const Vec3& wi, float distance,
                      std::uint32_t lobes, RayCounts& counts);

/// Whether what a ray of a lobe meets at `distance`, and sees, is in the shadow of something opaque
/// that such rays do not see.
/// Checked: ObjectFlags.WhatRaysDoNotSeeCastsItsWholeShadow in tests/analytic.
bool shadowed_by_unseen(const World& world, const ShadingPoint& point, const Vec3& wi,
                        float distance, RayCounts& counts);

/// Whether lights are shadowed at the point: not if the scene or its instance disables them.
bool receives_shadows(const World& world, const ShadingPoint& point);

/// Shares a closure lets pass straight, for shadow rays and what must match them.
Transmittance straight_transmission(const Closure& closure, const scene::RenderOptions& options);

/// The same of a blocker, by the surface or what stands for it in the slot `shadow`. `by` becomes
/// the closure that media behind it go by.
///
/// Model:   rays behind a diffuse bounce and photons stand for shadow rays. They ask each blocker
///          alone, with white light and without a light's name: they pass what shadow rays pass as
///          far as shadow shaders multiply, and take all lights as shadow rays take the
///          environment.
/// Checked: ShadowShader.* in tests/analytic.
Rgb straight_through(const Material& material, ShadingPoint& point,
                     const scene::RenderOptions& options, Closure& by);

/// Whether rays that pass glass straight are dimmed by its medium, as shadow rays are.
inline bool straight_rays_fade(const scene::RenderOptions& options) {
  return options.shadow == scene::ShadowMode::Segments;
}

/// Share left after `distance` in a medium.
Rgb transmittance(const Medium& medium, float distance);

}  // namespace oriel
