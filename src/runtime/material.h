// SPDX-License-Identifier: Apache-2.0
// A bound material: the shaders of its slots and their constant properties.
#pragma once

#include <optional>
#include <string>

#include "runtime/closure.h"
#include "runtime/shader_node.h"

namespace oriel {

struct Material {
  std::string name;
  NodeList surface;
  NodeList environment;
  NodeList photon;          ///< scatters photons, instead of the surface's closure
  NodeList photon_surface;  ///< the closure for photons; empty = the surface's
  NodeList volume;          ///< between entry and exit of the object
  NodeList displace;        ///< their sum displaces vertices along their normals
  // These replace the surface's closure for shadow rays. Both are empty if the surface shader is
  // also the shadow shader.
  NodeList shadow;          ///< shadow shaders, each with the light left by the previous one
  NodeList shadow_surface;  ///< material shaders whose closure transmits light as a surface's does
  /// Gives the light that passes to shadow rays by the angle alone; null: its closure gives it.
  const ShaderNode* straight_by_angle = nullptr;
  /// The emission where it is the same everywhere and the surface is opaque.
  std::optional<Rgb> even_emission = {};
  bool has_shadow_shader = false;  ///< without one a blocker is opaque
  bool may_transmit = false;       ///< shadow rays must shade the surface
  bool may_have_holes = false;     ///< cut-outs; for rays that pass nothing else
  bool opaque = false;
  bool has_messages = false;  ///< messages were reported while it was bound
  bool outputs = true;        ///< false: the result is the only output (multiple_outputs off)

  /// Whether shaders other than the surface's determine shadows.
  bool filters_shadows() const { return !shadow.empty() || !shadow_surface.empty(); }
};

/// Runs the surface shaders. The closure is that of the last material shader in the list; without
/// one it is opaque and black.
void shade(const Material& material, ShadingPoint& point, Closure& closure);
/// The same for photons.
void shade_for_photons(const Material& material, ShadingPoint& point, Closure& closure);
/// The same for a list of shaders without a material.
void shade(const NodeList& surface, ShadingPoint& point, Closure& closure);
/// The closure that determines the shadow of a blocker; a thin wall if there are only shadow
/// shaders.
void shade_blocker(const Material& material, ShadingPoint& point, Closure& closure);
/// Applies the shadow shaders to the light.
Rgb filter_light(const Material& material, ShadingPoint& point, Rgb light);

}  // namespace oriel
