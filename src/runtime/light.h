// SPDX-License-Identifier: Apache-2.0
// Lights in world space, as data: name, shape, placement, shader. src/lights samples them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "runtime/light_photons.h"
#include "runtime/portal.h"
#include "runtime/profile_placement.h"
#include "runtime/shader_node.h"
#include "sampling/rectangle.h"

namespace oriel {

enum class LightShape : std::uint8_t { Point, Directional, Rectangle, Disc, Sphere, Cylinder };

// Conventions
//   mental ray: a Lambert surface of albedo rho facing a light of colour c shows rho * c. With
//   radiance in pixel units L = rho * E / pi, a light of colour c thus brings E = pi * c. The
//   factor enters in lights/sample_light.cpp only; environments return radiance in pixel units
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
  sampling::RectangleAxes axes;  ///< Rectangle: of the edges
  float radius = 0;
  float area = 0;        ///< emitting area; projected area for Sphere and Cylinder
  float cone_angle = 0;  ///< Directional: half-angle of the cone, radians
  float exponent = 2;    ///< distance decay written in the element (physical_light)
  bool visible = false;  ///< rays see the shape
  /// Kind `user`: a point; the shader moves the origin of each sample (LightValue::origin).
  bool placed_by_shader = false;
  LightPhotons photons;                ///< from its element and its shader
  ProfilePlacement profile_placement;  ///< set if the shader uses a photometric profile
  Mat4 to_local;                       ///< world to the light's space
  Mat4 to_world;
  /// Motion: matrices from the written placement to the actual one, world to world, at equal steps
  /// of a ray's time; empty: the light does not move. Samples, hits and photons of a moving light
  /// are computed at its written placement.
  std::vector<Mat4> path;
  const ShaderNode* shader = nullptr;
  const ShaderNode* emitter = nullptr;  ///< evaluated for photons in place of the shader; optional
  SourceLocation where = {};            ///< of the element
  std::unique_ptr<ShaderState> state;   ///< precomputed by the shader for this light
  std::unique_ptr<Portal> portal;       ///< non-null: the light emits the environment behind it
};

/// Light arriving at a point from one sample.
struct LightSample {
  Vec3 wi{0};          ///< unit, from the point to the light
  float distance = 0;  ///< infinity for directional lights
  float reach = 0;     ///< blockers farther away cast no shadow
  Rgb irradiance{0};   ///< radiance / pdf: irradiance of a surface facing the light
  /// Per solid angle; 0 = no ray finds the light: it has no extent, or its shadow rays end
  /// elsewhere.
  float pdf = 0;
  bool shadow = true;
  float shadow_factor = 0;
  float affects_diffuse = 1, affects_specular = 1;  ///< as LightValue
  bool force_specular = false, is_sun = false;
};

/// Whether rays can hit the shape.
inline bool has_extent(LightShape shape) {
  return shape != LightShape::Point && shape != LightShape::Directional;
}

/// Rectangles and discs: they emit to one side.
inline bool is_flat(LightShape shape) {
  return shape == LightShape::Rectangle || shape == LightShape::Disc;
}

}  // namespace oriel
