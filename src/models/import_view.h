// SPDX-License-Identifier: Apache-2.0
// Cameras and lights of models.
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

/// An element, not named yet, and where it stands in the world.
template <class T>
struct Placed {
  T element;
  Mat4 to_world;
};

/// A camera of the file as one that looks down -z. One that has a target, a node named as it is
/// with ".Target" (3ds Max), looks there whatever its own rotation says.
/// Checked: ModelFbx.*, Model3ds.*, ModelImport.*
Placed<scene::Camera> camera_of(const aiScene& model, const aiCamera& source,
                                const NodePlaces& nodes);

/// A light of the file. Pixels become cd/m2 where the model's lights are in candela and lux, as
/// glTF has them. Unset for kinds that are left out.
/// Checked: ModelImport.LightsAreInCandela, ModelFbx.*
std::optional<Placed<scene::Light>> light_of(const aiLight& source, const NodePlaces& nodes);

}  // namespace oriel::models
