// SPDX-License-Identifier: Apache-2.0
// Samples of the lights that scene elements describe, ray intersections with their shapes, and the
// one place where pi turns a light shader's colour into irradiance.
#pragma once

#include <optional>

#include "runtime/light.h"

namespace oriel {

struct World;

/// A point's time at which moving lights have their written placement.
inline constexpr float kAsWritten = -1;

/// Samples a light from a point.
///
/// Inputs:  point: shading point (its position is lit, at its time), u: uniform in [0,1)^2.
/// Returns: nothing where the light cannot reach the point. With a mental ray light shader an area
///          light is the mean of its shader over the shape (per area; rectangles with decay are
///          sampled by solid angle, which has the same mean and less noise).
/// `kind`: as ask_light_shader.
/// Checked: AreaLight.* in tests/analytic (shapes against closed forms), LightContract.*,
///          ExtendedLightContract.*
std::optional<LightSample> sample_light(const Light& light, ShadingPoint& point, Vec2 u,
                                        RayKind kind = RayKind::Light);

/// The unit direction in which sample_light() finds a directional light that does not move.
Vec3 direction_to(const Light& light, Vec2 u);

/// A ray's hit on the shape of a light.
struct LightHit {
  float t = 0;
  Rgb radiance{0};     ///< toward the ray's origin
  float pdf = 0;       ///< per solid angle, with which sample_light chooses this direction
  bool shadow = true;  ///< false: samples of the light are not weighted
  float affects_diffuse = 1, affects_specular = 1;  ///< as LightValue
  bool force_specular = false;
};

/// Intersects the shape within (0, t_most) and evaluates its radiance; nothing for lights without
/// extent, for rays that miss, and for the dark side of rectangles and discs. `kind`: as
/// ask_light_shader.
std::optional<LightHit> intersect_light(const Light& light, ShadingPoint& from,
                                        const Vec3& direction, float t_most,
                                        RayKind kind = RayKind::Light);

/// Evaluates the light's shader for a sample at `position`: `direction` from there to the lit
/// point, `distance` as long, `emitter_cos` as in LightCall. A light without a shader is black.
/// `kind`: Light for direct light, the ray's kind where a ray sees the shape; kinds of photon
/// emission evaluate its emitter if that has directions, and count as Light otherwise.
LightValue ask_light_shader(const Light& light, ShadingPoint& point, const Vec3& position,
                            const Vec3& direction, float distance, float emitter_cos,
                            RayKind kind = RayKind::Light);

/// Whether a light does more than emit photons.
inline bool gives_direct_light(const Light& light) {
  return !light.photons.only && !(light.portal && light.portal->photons_only);
}

/// Transmittance of the camera's volume shaders on the way of light to a point: from there along
/// wi, over a distance that may be infinite. sample_light and intersect_light include it for kind
/// Light; samples of the environment do not.
Rgb volume_transmittance_to_light(const World& world, const ShadingPoint& point, const Vec3& wi,
                                  float distance);

/// The same for any volume shaders; only those that act on light count.
Rgb volume_transmittance(const World& world, const NodeList& volume, const Vec3& at, const Vec3& wi,
                         float distance);

}  // namespace oriel
