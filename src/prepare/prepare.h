// SPDX-License-Identifier: Apache-2.0
// Prepares a scene for rendering as a World: geometry, lights, shaders, camera.
#pragma once

#include <memory>
#include <set>
#include <string>

#include "base/diagnostic.h"
#include "prepare/geometry_cache.h"
#include "prepare/stereo.h"
#include "runtime/binder.h"
#include "runtime/world.h"
#include "scene/scene.h"

namespace oriel {

/// Statistics of the preparation, for `oriel check` and the progress line.
struct PrepareReport {
  BindingReport binding;
  std::size_t objects = 0, instances = 0, lights = 0, triangles = 0;
  std::size_t geometry_bytes = 0;  ///< meshes and acceleration structure
};

struct PrepareOptions {
  /// Frees the scene's geometry during tessellation; for the last frame of a file.
  bool release_geometry = false;
  /// Overrides the size of the picture if positive (the aspect follows).
  int width = 0, height = 0;
  /// Camera instance that overrides that of the render command.
  std::string camera;
  /// Geometry of the previous frame, and receives that of this one: GeometryCache::keep.
  GeometryCache* cache = nullptr;
  /// For stereo cameras.
  Eye eye = Eye::Middle;
  /// For a report of the scene without a picture: see World::coarse_tables.
  bool coarse_tables = false;
  /// In addition to those of the options, and with priority over them.
  std::vector<scene::LightGroup> light_groups;
};

/// Creates the world of one render command.
///
/// Errors:  OR-RN-nnn; null if nothing can be rendered (no camera). In all other cases a picture is
///          possible: missing materials are grey, unknown shaders magenta.
std::unique_ptr<World> prepare(scene::Scene& scene, const scene::RenderCommand& command,
                               const Registry& registry, const PrepareOptions& options,
                               Diagnostics& diagnostics, PrepareReport& report);

/// Places the camera of a prepared world again, after a change of its instance, its film or of
/// PrepareOptions::width, height and camera.
///
/// Returns: false if more than the camera depends on the change: tessellation that depends on the
///          view, or another camera element. The world has then to be prepared again.
/// Checked: EditTable.* in tests/interactive
bool place_camera_again(const scene::Scene& scene, const scene::RenderCommand& command,
                        const PrepareOptions& options, World& world, Diagnostics& diagnostics);

/// Prepares again what depends on elements of the scene that have changed, for reduced pictures:
/// before others, complete_light_sampler() is necessary.
///
/// Model:   materials are bound again; a light renews all lights and their sampler; what refers to
///          a changed light or shader is bound again; an instance renews all instances, with the
///          same meshes; emission renews the sampler. The table of a changed environment is small,
///          and changed geometry keeps the openings of the former one, which costs noise alone.
///          Once completed, the world is equal to a new one.
/// Inputs:  changed: names of materials, lights, named shaders, textures, instances, and of cameras
///          whose shaders changed. options: with the cache of the world's geometry.
/// Returns: false if more depends on the change, or might: the names of lights or instances,
///          shaders of users, displacement, volumes, another camera placement, messages that were
///          or are reported. The world cannot be rendered then and has to be prepared again.
/// Checked: EditTable.*, EditSequence.* in tests/interactive
bool update_world(scene::Scene& scene, const scene::RenderCommand& command,
                  const Registry& registry, const PrepareOptions& options,
                  const std::set<std::string>& changed, World& world);

/// Makes the tables of the environment and searches its openings where these are drafts. Inputs:
/// world: its camera is the one whose view is searched for openings.
void complete_light_sampler(World& world);

}  // namespace oriel
