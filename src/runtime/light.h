// SPDX-License-Identifier: Apache-2.0
// Lights in world space: shape, sampling and the one place where pi turns a light shader's colour
// into irradiance.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/light_photons.h"
#include "runtime/portal.h"
#include "runtime/profile_placement.h"
#include "runtime/shader_node.h"

namespace oriel {

enum class LightShape : std::uint8_t { Point, Directional, Rectangle, Disc, Sphere, Cylinder };

// Conventions
//   mental ray: a Lambert surface of albedo rho facing a light of colour c shows rho * c. With
//   radiance in pixel units L = rho * E / pi, a light of colour c thus brings E = pi * c. The
//   factor enters in light.cpp and nowhere else; environments return radiance in pixel units
//   already.
struct Light {
  std::string name;  ///< of the instance
  LightShape shape = LightShape::Point;
  Vec3 position{0};            ///< centre, world
  Vec3 direction{0, 0, -1};    ///< unit, away from the light
  bool has_direction = false;  ///< the element wrote one: spot and directional
  float spread = -2;           ///< cosine of the outer cone; below -1 = not a spot
  Vec3 edge_u{0}, edge_v{0};   ///< Rectangle: full edges; Disc: unit axes; Cylinder: edge_u = axis,
                               ///< half length each way
  float radius = 0;
  float area = 0;        ///< emitting area; projected area for Sphere and Cylinder
  float cone_angle = 0;  ///< Directional: half-angle of the cone, radians
  float exponent = 2;    ///< distance decay written in the element (physical_light)
  bool visible = false;  ///< the shape is seen by rays
  /// Kind `user`: a point from which the shader moves each sample (LightValue::origin).
  bool placed_by_shader = false;
  LightPhotons photons;                ///< as its element and its shader ask
  ProfilePlacement profile_placement;  ///< set where the shader distributes light by a profile
  Mat4 to_local;                       ///< world to the light's space
  Mat4 to_world;
  /// Where what is written goes, world to world, at equal steps of a ray's time; empty: it stays.
  /// Samples, hits and photons of a light that moves are worked out where it stands as written.
  std::vector<Mat4> path;
  const ShaderNode* shader = nullptr;
  const ShaderNode* emitter = nullptr;  ///< asked for photons in place of the shader; null: none
  std::unique_ptr<ShaderState> state;   ///< what the shader worked out for this light
  std::unique_ptr<Portal> portal;       ///< set: it shines with the environment behind it
};

/// Light arriving at a point from one sample.
struct LightSample {
  Vec3 wi{0};          ///< unit, from the point to the light
  float distance = 0;  ///< infinity for directional lights
  float reach = 0;     ///< up to which things cast shadows
  Rgb irradiance{0};   ///< radiance / pdf: irradiance of a surface facing the light
  /// Per solid angle; 0 = no ray finds the light: it has no extent, or not its own place for
  /// shadows.
  float pdf = 0;
  bool shadow = true;
  float shadow_factor = 0;
  float affects_diffuse = 1, affects_specular = 1;  ///< as LightValue
  bool force_specular = false, is_sun = false;
};

/// A point's time to which lights that move stand as written.
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

/// A ray that met a light's shape.
struct LightHit {
  float t = 0;
  Rgb radiance{0};     ///< toward the ray's origin
  float pdf = 0;       ///< per solid angle with which sample_light would have chosen this direction
  bool shadow = true;  ///< false: samples of the light stand alone
  float affects_diffuse = 1, affects_specular = 1;  ///< as LightValue
  bool force_specular = false;
};

/// Intersects the shape within (0, t_most) and evaluates its radiance; nothing for lights without
/// extent, for rays that miss, and for the dark side of rectangles and discs. `kind`: as
/// ask_light_shader.
std::optional<LightHit> intersect_light(const Light& light, ShadingPoint& from,
                                        const Vec3& direction, float t_most,
                                        RayKind kind = RayKind::Light);

/// What the light's shader says of a sample at `position`: `direction` from there to the lit point,
/// `distance` as long, `emitter_cos` as in LightCall. Nothing for a light without a shader. `kind`:
/// Light for what it brings to a point, the ray's where one sees its shape; kinds of photon
/// emission ask its emitter, where it has one that tells of directions, and are Light where not.
LightValue ask_light_shader(const Light& light, ShadingPoint& point, const Vec3& position,
                            const Vec3& direction, float distance, float emitter_cos,
                            RayKind kind = RayKind::Light);

/// Share of a light's colour that the air leaves on its way to a point: from there along wi, as
/// long, infinity for what is endlessly far. sample_light and intersect_light have it in what they
/// return for kind Light; the environment's light does not.
Rgb volume_transmittance_to_light(const World& world, const ShadingPoint& point, const Vec3& wi,
                                  float distance);

/// The same of volume shaders; those count that act on light.
Rgb volume_transmittance(const World& world, const NodeList& volume, const Vec3& at, const Vec3& wi,
                         float distance);

/// Whether rays may meet it.
inline bool has_extent(LightShape shape) {
  return shape != LightShape::Point && shape != LightShape::Directional;
}

/// Rectangles and discs: they shine to one side.
inline bool is_flat(LightShape shape) {
  return shape == LightShape::Rectangle || shape == LightShape::Disc;
}

/// Whether the edges of a rectangle stand square on each other. The solid angle of other
/// parallelograms has no such simple sampling; they are sampled by area.
bool has_square_corners(const Light& light);

}  // namespace oriel
