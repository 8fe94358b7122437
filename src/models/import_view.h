// SPDX-License-Identifier: Apache-2.0
// Imports cameras and lights.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "base/diagnostic.h"
#include "scene/scene.h"

struct aiCamera;
struct aiLight;
struct aiScene;

namespace oriel::models {

/// Width by height of cameras that do not define it, as of full-frame film.
inline constexpr float kCameraAspect = 1.5f;

/// Where the nodes of a model stand in the world, by name.
using NodePlaces = std::map<std::string, Mat4>;

/// An element without a name, and its world transform.
template <class T>
struct Placed {
  T element;
  Mat4 to_world;
};

/// Converts a camera to one that looks down -z. If it has a target (a node with its name and
/// ".Target", 3ds Max), it is rotated towards the target.
/// Checked: ModelFbx.*, Model3ds.*, ModelImport.*
Placed<scene::Camera> camera_of(const aiScene& model, const aiCamera& source,
                                const NodePlaces& nodes);

/// Converts a light. Pixels are cd/m2 if the lights of the model are in candela and lux, as in
/// glTF. Unset for unsupported types.
/// Checked: ModelImport.LightsAreInCandela, ModelFbx.*
std::optional<Placed<scene::Light>> light_of(const aiLight& source, const NodePlaces& nodes);

}  // namespace oriel::models
