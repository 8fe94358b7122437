// SPDX-License-Identifier: Apache-2.0
// From the scene to the World that is rendered: geometry, lights, shaders, camera.
#pragma once

#include <memory>

#include "base/diagnostic.h"
#include "prepare/geometry_cache.h"
#include "prepare/stereo.h"
#include "runtime/binder.h"
#include "runtime/world.h"
#include "scene/scene.h"

namespace oriel {

/// What was prepared, for `oriel check` and the progress line.
struct PrepareReport {
  BindingReport binding;
  std::size_t objects = 0, instances = 0, lights = 0, triangles = 0;
  std::size_t geometry_bytes = 0;  ///< meshes and acceleration structure
};

struct PrepareOptions {
  /// Frees the scene's own copy of geometry as it is tessellated; for the last frame of a file.
  bool release_geometry = false;
  /// Overrides the size of the picture when positive (aspect follows).
  int width = 0, height = 0;
  /// Camera instance to use instead of the render command's.
  std::string camera;
  /// What the frame before left, and what this one leaves: GeometryCache::keep takes the rest.
  GeometryCache* cache = nullptr;
  /// Of cameras with two.
  Eye eye = Eye::Middle;
  /// For a report of the scene, not for a picture: see World::coarse_tables.
  bool coarse_tables = false;
  /// Beside those of the options, and before them.
  std::vector<scene::LightGroup> light_groups;
};

/// Builds the world of one render command.
///
/// Errors:  OR-RN-nnn; null when nothing can be rendered (no camera). Everything else leaves a
///          picture: missing materials are grey, unknown shaders magenta.
std::unique_ptr<World> prepare(scene::Scene& scene, const scene::RenderCommand& command,
                               const Registry& registry, const PrepareOptions& options,
                               Diagnostics& diagnostics, PrepareReport& report);

}  // namespace oriel
