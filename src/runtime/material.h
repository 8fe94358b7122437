// SPDX-License-Identifier: Apache-2.0
// A bound material: the shaders of its slots and what is known of it before any ray.
#pragma once

#include <string>

#include "runtime/closure.h"
#include "runtime/shader_node.h"

namespace oriel {

struct Material {
  std::string name;
  NodeList surface;
  NodeList environment;
  NodeList photon;          ///< scatters photons, in place of the surface's closure
  NodeList photon_surface;  ///< the closure that photons meet; empty: the surface's
  NodeList volume;          ///< acts between where a ray enters the object and where it leaves
  NodeList displace;        ///< added up, they move the vertices of the surface along their normals
  // What decides in place of the surface's closure how much light passes. Both are empty where the
  // surface stands in its own slot `shadow`.
  NodeList shadow;          ///< shadow shaders, each on what the one before left of the light
  NodeList shadow_surface;  ///< material shaders, whose closure passes light as a surface's would
  bool has_shadow_shader = false;  ///< without one a blocker is opaque
  bool may_transmit = false;       ///< shadow rays must ask the surface
  bool may_have_holes = false;     ///< cut-outs, for rays that pass nothing else
  bool opaque = false;
  bool outputs = true;  ///< false: the material may only have its result (multiple_outputs off)

  /// Whether light passes by other shaders than the surface's.
  bool filters_shadows() const { return !shadow.empty() || !shadow_surface.empty(); }
};

/// Runs the surface shaders; the closure is that of the last material shader in the list, opaque
/// and black when there is none.
void shade(const Material& material, ShadingPoint& point, Closure& closure);
/// The same as photons meet it.
void shade_for_photons(const Material& material, ShadingPoint& point, Closure& closure);
/// The same for a list of shaders that is no material's.
void shade(const NodeList& surface, ShadingPoint& point, Closure& closure);
/// The closure that light passes a blocker by; as a thin wall where shadow shaders alone decide.
void shade_blocker(const Material& material, ShadingPoint& point, Closure& closure);
/// Runs the shadow shaders on the light so far.
Rgb filter_light(const Material& material, ShadingPoint& point, Rgb light);

}  // namespace oriel
