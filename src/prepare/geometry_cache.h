// SPDX-License-Identifier: Apache-2.0
// Geometry of the frame before, of which the next takes over what did not change.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geom/accel.h"
#include "runtime/world.h"
#include "scene/approximation.h"

namespace oriel {

/// Model:   an object whose element is as it was keeps its mesh, and what the ray tracer built for
///          it where it is instanced; what moved or is new is made anew, and where all instances
///          are as they were nothing is. Displaced meshes depend on shaders: always made anew.
/// Checked: Animation.* in tests/analytic/animation_test.cpp
struct GeometryCache {
  struct Form {
    /// scene::Scene::revision of the object, and of what says how finely it is tessellated.
    std::vector<std::uint64_t> revisions;
    scene::TessellationView view;  ///< where that counts
    geom::MeshId mesh{};
    bool same_shape(const Form& o) const {
      return revisions == o.revisions && view.object_to_camera == o.view.object_to_camera &&
             view.pixels_per_unit == o.view.pixels_per_unit &&
             view.orthographic == o.view.orthographic;
    }
  };
  std::map<std::string, std::vector<Form>, std::less<>> forms;  ///< by the object's name
  scene::Shutter shutter;                                       ///< that keys of the meshes are for
  bool hair = true;  ///< whether meshes have their curves
  std::unique_ptr<geom::Accel> accel;
  std::size_t reused = 0;  ///< objects of the last frame that were taken over

  /// Takes the geometry out of a world that is not rendered any more.
  void keep(World& world) { accel = std::move(world.accel); }
};

}  // namespace oriel
