// SPDX-License-Identifier: Apache-2.0
// Lights in a window that emit the environment behind it, as data. lights/portal_table.h samples
// them.
#pragma once

#include <memory>

#include "runtime/shader_node.h"
#include "runtime/shading_point.h"

namespace oriel {

class PortalTable;
struct World;

// Conventions
//   A portal is a rectangle with an inside, the side it shines to, and an outside. In each
//   direction its radiance is that of the environment seen through it, so that all of them together
//   bring what rays through the window would find. Diffuse rays from inside therefore end at it,
//   and so do samples of the environment; what comes from outside passes. Mirrors, glass and the
//   eye look through, unless the portal is visible. Where a portal moves, the environment does not.

/// Parameters of a portal, from its shader.
struct PortalTraits {
  bool own_environment = false;             ///< else the camera's
  const ShaderNode* environment = nullptr;  ///< the own one; null: white in all directions
  RayKind lookup = RayKind::FinalGather;    ///< ray kind of environment look-ups
  Rgb scale{1};                             ///< of the environment's radiance
  bool reverse = false;                     ///< inside is -z of the light's space, else +z
  float cutoff = 0;  ///< colours of the light below this at the lit point are dropped
  bool shadows = true;
  /// Shadow rays begin this far outside; negative: inside, and what is nearer to the portal does
  /// not block it. Scene units, along the ray.
  float shadow_extension = 0;
  bool visible = false;       ///< eye, reflection and refraction rays end at it
  Rgb transparency{1};        ///< of what they see: of the surface, or through it
  bool photons_only = false;  ///< no direct light, and diffuse rays pass
};

/// A portal in the scene.
struct Portal : PortalTraits {
  const World* world = nullptr;
  NodeList shaders;  ///< of the environment
  /// Null: even, not at right angles, or it moves otherwise than straight.
  std::shared_ptr<const PortalTable> table;
  float half_u = 0, half_v = 0;
  Vec3 across_u{0}, across_v{0};  ///< places from the centre by these: -1 to 1 on the rectangle

  bool blocks_diffuse_rays() const { return !photons_only; }
};

}  // namespace oriel
