// SPDX-License-Identifier: Apache-2.0
// The steps of prepare(); each sets its part of the World.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "lights/emission.h"
#include "lights/environment_light.h"
#include "lights/openings.h"
#include "prepare/prepare.h"
#include "scene/hierarchy.h"

namespace oriel {

using LightNames = std::unordered_map<std::string, std::vector<int>>;

/// Places lights in world space, without shaders; returns names of instances and of their groups.
LightNames place_lights(const std::vector<scene::Leaf>& leaves, World& world,
                        Diagnostics& diagnostics);

/// Binds the shaders of the placed lights; leaves in the same order.
void bind_lights(const std::vector<scene::Leaf>& leaves, Binder& binder, World& world,
                 Diagnostics& diagnostics);

/// Places the camera of that instance. Errors: OR-RN-001 if there is none (returns false).
bool place_camera(const scene::Scene& scene, const std::vector<scene::Leaf>& leaves,
                  const std::string& name, const PrepareOptions& options, World& world,
                  const scene::Camera*& camera, Diagnostics& diagnostics);

/// The material of a name in an instance or an object: an element, or a shader that is used as one;
/// grey if there is neither, which is reported.
Material bind_material(const scene::Scene& scene, const std::string& name, SourceLocation where,
                       Binder& binder, Diagnostics& diagnostics);

/// Binds the environment; requires the bound lights. Only the textures of lights and of the
/// environment may be bound.
void bind_environment(const scene::Camera& camera, Binder& binder, World& world);

/// Binds state shaders, lens and volume shaders. options: null = none.
void bind_camera_shaders(const scene::Options* options, const scene::Camera& camera, Binder& binder,
                         World& world, Diagnostics& diagnostics);

/// The openings of a former world.
struct KnownOpenings {
  std::optional<Openings> all;  ///< set if geometry, camera, environment and portals are the same
  OpeningSearch found;          ///< set if geometry and camera are the same, see find_openings()
};

/// Opens the portals and creates the light sampler, from everything else. Returns what the
/// materials emit.
std::vector<EmissionKind> make_light_sampler(EnvironmentLight environment, KnownOpenings known,
                                             World& world);

/// Creates the light layers. Inputs: emissive: of make_light_sampler().
void make_light_layers(const std::vector<scene::Leaf>& leaves, const PrepareOptions& options,
                       const std::vector<EmissionKind>& emissive, World& world,
                       Diagnostics& diagnostics);

/// Creates meshes, instances and their materials; materials of the world are used again.
/// options_name: the options element of the picture.
void place_geometry(scene::Scene& scene, const std::vector<scene::Leaf>& leaves,
                    const LightNames& lights, const std::string& options_name, Binder& binder,
                    const PrepareOptions& options, World& world, Diagnostics& diagnostics,
                    PrepareReport& report);

}  // namespace oriel
