// SPDX-License-Identifier: Apache-2.0
// Light that was scattered below a surface.
#pragma once

#include "runtime/shading_point.h"

namespace oriel {

/// Whether light is scattered below the surface at this point: only as the camera sees it, directly
/// or in mirrors and through glass. Elsewhere, as for photons and diffuse bounces, the surface
/// reflects it where it enters.
bool scatters_below(const ShadingPoint& point);

/// Light of a white layer that leaves the surface at the point: an estimate of the irradiance of
/// the same material around it, weighted by a bsdf::DiffusionProfile, over pi.
///
/// Model:   one probe ray through the sphere of the radius around the point, along the normal or a
///          tangent, chosen by multiple importance sampling; all lights and the indirect light at
///          one of the surfaces of the same instance and material that it hits.
/// Source:  A. King et al., "BSSRDF Importance Sampling", SIGGRAPH 2013 talks.
/// Inputs:  radius > 0, scene units; scatters_below(point).
/// Checked: SubsurfaceScattering.* in tests/analytic
Rgb scattered_light(ShadingPoint& point, float radius);

/// Light of a white layer that enters on the other side of the solid and leaves at the point.
///
/// Model:   the irradiance of the other side, at a distance of the point's normal by a
///          DiffusionProfile, fades linearly with the thickness to 0 at `depth`. Behind a surface
///          without an other side within the depth, the irradiance of its own back.
/// Inputs:  depth > 0, radius >= 0, scene units; scatters_below(point).
Rgb back_scattered_light(ShadingPoint& point, float radius, float depth);

}  // namespace oriel
