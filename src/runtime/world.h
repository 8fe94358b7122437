// SPDX-License-Identifier: Apache-2.0
// The scene made ready for rendering: geometry, bound shaders, lights, camera. Read-only
// afterwards.
#pragma once

#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "geom/accel.h"
#include "runtime/camera.h"
#include "runtime/environment.h"
#include "runtime/light.h"
#include "runtime/material.h"
#include "runtime/shader_node.h"
#include "runtime/texture_node.h"
#include "scene/render_options.h"

namespace oriel {

/// One leaf of the instance graph that holds geometry.
struct InstanceData {
  std::string name;
  Mat4 to_object, to_world;
  std::vector<int> materials;  ///< per material slot of its mesh, index into World::materials
  /// Lights linked to the instance: indices into World::lights; used when `linked`.
  std::vector<int> lights;
  bool linked = false;
  bool lights_exclusive = false;
  bool receives_shadow = true;
};

struct World {
  scene::RenderOptions options;
  Camera camera;
  std::unique_ptr<geom::Accel> accel;
  std::vector<InstanceData> instances;
  std::vector<Material> materials;
  std::vector<Light> lights;
  std::vector<int> portals;      ///< indices into lights
  bool has_gels = false;         ///< some portal dims what is seen through it
  bool has_area_lights = false;  ///< some light has a shape that rays can meet
  EnvironmentLight environment;
  NodeList lens;       ///< colour-mapping lens shaders, in the order in which they map
  NodeList lens_rays;  ///< lens shaders that bend eye rays, in order
  const TextureNode* preview = nullptr;   ///< shown in place of a rendering; null = none
  NodeList air;                           ///< volume shaders of the camera: around all rays
  NodeList air_of_eye;                    ///< those that stand as its lens: eye rays alone
  bool has_transparent_blockers = false;  ///< some material may let light pass

  std::deque<std::unique_ptr<ShaderNode>> nodes;
  TextureSystem texture_system;
  std::deque<std::unique_ptr<TextureNode>> textures;
  std::deque<std::vector<std::byte>> arrays;  ///< elements of array parameters
  std::deque<std::string> strings;
};

}  // namespace oriel
