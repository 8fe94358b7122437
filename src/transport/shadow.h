// SPDX-License-Identifier: Apache-2.0
// Shadows: the transmittance between a point and a light sample.
#pragma once

#include "runtime/world.h"
#include "transport/counts.h"

namespace oriel {

/// Share of light that arrives, per channel.
struct Transmittance {
  Rgb all{1};       ///< straight through all transparency
  Rgb clear{1};     ///< the same with rough transparency as opaque
  Rgb cut_outs{1};  ///< through cut-outs only
  Transmittance& operator*=(const Transmittance& next) {
    all *= next.all;
    clear *= next.clear;
    cut_outs *= next.cut_outs;
    return *this;
  }
};

/// Computes the transmittance between a point and a light.
///
/// Model:   each transparent blocker multiplies by the weights of its transmitting lobes, and in
///          shadow mode segments by the absorption through its thickness. All are met in one
///          traversal of the scene, in any order; opaque ones come first and the others in order if
///          media absorb light or shadow shaders filter it. Refraction does not bend shadow rays. A
///          shadow shader in the material's slot replaces the lobes. Shadow shaders are called from
///          the point to the light in all modes, with white light at the point; modes on and sort
///          only omit the media. After an opaque blocker no shader is called.
/// Inputs:  point: the lit point; wi: unit, to the light; distance: to it, may be infinite; light:
///          index into World::lights, for shadow shaders; -1 = the environment.
/// Source:  manual 1.6.8.2 and 1.6.8.3 (do_refractive_caustics).
/// Checked: Glass.Shadows*, Glass.SkyThroughASlab*, CutOut.*, ShadowModes.* in tests/analytic.
Transmittance shadow_transmittance(const World& world, const ShadingPoint& point, const Vec3& wi,
                                   float distance, RayCounts& counts, int light = -1);

/// The same where no opaque object is between the point and the light.
Transmittance transparent_transmittance(const World& world, const ShadingPoint& point,
                                        const Vec3& wi, float distance, RayCounts& counts,
                                        int light = -1);

/// Whether rays of lobes hit an object before `distance` that casts no shadow.
///
/// Inputs:  lobes: one bit geom::RayMask::Shadowless*, for the kind of the rays.
/// Checked: ObjectFlags.LightPassesObjectsThatCastNoShadow in tests/analytic.
bool hidden_from_rays(const World& world, const ShadingPoint& point, const Vec3& wi, float distance,
                      std::uint32_t lobes, RayCounts& counts);

/// Whether the hit of a lobe's ray at `distance` is in the shadow of an opaque object that such
/// rays do not see. Checked: ObjectFlags.ObjectsInvisibleToRaysCastFullShadows in tests/analytic.
bool shadowed_by_unseen(const World& world, const ShadingPoint& point, const Vec3& wi,
                        float distance, RayCounts& counts);

/// Whether lights are shadowed at the point: not if the scene or its instance disables them.
inline bool receives_shadows(const World& world, const ShadingPoint& point) {
  if (world.options.shadow == scene::ShadowMode::Off) return false;
  return point.instance < 0 ||
         world.instances[static_cast<std::size_t>(point.instance)].receives_shadow;
}

/// Straight transmission of a closure, for shadow rays and for methods that must agree with them.
Transmittance straight_transmission(const Closure& closure, const scene::RenderOptions& options);

/// The same for a blocker: by its surface, or by the shaders of its slot `shadow`. `by` receives
/// the closure that determines the medium behind.
///
/// Model:   rays behind a diffuse bounce and photons must agree with shadow rays. They evaluate
///          each blocker separately, with white light and no light source: the result equals that
///          of shadow rays to the environment if shadow shaders multiply the light.
/// Checked: ShadowShader.* in tests/analytic.
Rgb straight_through(const Material& material, ShadingPoint& point,
                     const scene::RenderOptions& options, Closure& by);

/// Whether the surface refracts photons and rays behind a diffuse bounce. If not, they pass through
/// its transparency in a straight line, as shadow rays do.
inline bool bends_light(const Closure& closure, const scene::RenderOptions& options) {
  return closure.refractive_caustics && options.caustic.on;
}

/// Whether the medium absorbs rays that pass glass straight, as it does shadow rays.
inline bool straight_rays_fade(const scene::RenderOptions& options) {
  return options.shadow == scene::ShadowMode::Segments;
}

/// Transmittance of a distance in a medium.
Rgb transmittance(const Medium& medium, float distance);

}  // namespace oriel
