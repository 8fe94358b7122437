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
//   A portal is a rectangle with an inside, the side that it illuminates, and an outside. In each
//   direction its radiance is that of the environment seen through it, so the sum over directions
//   equals the light that rays through the window would find. Diffuse rays from inside therefore
//   end at it, as do samples of the environment; rays from outside pass. Mirrors, glass and the
//   camera see through it, unless the portal is visible. Where a portal moves, the environment does
//   not.

/// Parameters of a portal, from its shader.
struct PortalTraits {
  bool own_environment = false;             ///< otherwise the camera's
  const ShaderNode* environment = nullptr;  ///< its own one; null = white in all directions
  RayKind lookup = RayKind::FinalGather;    ///< ray kind of environment look-ups
  Rgb scale{1};                             ///< of the environment's radiance
  bool reverse = false;                     ///< inside is -z of the light's space, else +z
  float cutoff = 0;  ///< smaller values of the light's colour at the lit point are ignored
  bool shadows = true;
  /// Shadow rays begin this far outside; negative: inside, and nearer surfaces do not block. Scene
  /// units, along the ray.
  float shadow_extension = 0;
  bool visible = false;       ///< camera, reflection and refraction rays end at it
  Rgb transparency{1};        ///< applied to the surface or the view through it
  bool photons_only = false;  ///< no direct light; diffuse rays pass
};

/// A portal in the scene.
struct Portal : PortalTraits {
  const World* world = nullptr;
  NodeList shaders;  ///< of the environment
  /// Null: constant, not rectangular, or with non-linear motion.
  std::shared_ptr<const PortalTable> table;
  float half_u = 0, half_v = 0;
  Vec3 across_u{0}, across_v{0};  ///< half edges: -1 to 1 cover the rectangle

  bool blocks_diffuse_rays() const { return !photons_only; }
};

}  // namespace oriel
