// SPDX-License-Identifier: Apache-2.0
// Geometry of the previous frame, reused by the next one where it is unchanged.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "geom/accel.h"
#include "runtime/world.h"
#include "scene/approximation.h"

namespace oriel {

/// Model:   an object whose element is unchanged keeps its mesh and, if instanced, its acceleration
///          structure. Moved and new objects are rebuilt; nothing is rebuilt if all instances are
///          unchanged. Displaced meshes depend on shaders and are always rebuilt.
/// Checked: Animation.* in tests/analytic/motion/animation_test.cpp
struct GeometryCache {
  struct Form {
    /// scene::Scene::revision of the object and of its approximation settings.
    std::vector<std::uint64_t> revisions;
    scene::TessellationView view;  ///< if tessellation depends on it
    geom::MeshId mesh{};
    bool same_shape(const Form& o) const {
      return revisions == o.revisions && view.object_to_camera == o.view.object_to_camera &&
             view.pixels_per_unit == o.view.pixels_per_unit &&
             view.orthographic == o.view.orthographic;
    }
  };
  std::map<std::string, std::vector<Form>, std::less<>> forms;  ///< by object name
  /// of the motion keys of the meshes
  scene::Shutter shutter;
  /// See geom::Accel::keep_apart(); SIZE_MAX = never.
  std::size_t least_apart = SIZE_MAX;
  bool hair = true;  ///< whether meshes contain their curves
  std::unique_ptr<geom::Accel> accel;
  std::size_t reused = 0;  ///< number of objects reused from the previous frame

  /// Takes the geometry of a world that is no longer rendered.
  void keep(World& world) { accel = std::move(world.accel); }
};

}  // namespace oriel
