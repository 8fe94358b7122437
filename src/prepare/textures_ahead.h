// SPDX-License-Identifier: Apache-2.0
// Opens the texture files of a picture in parallel, before its shaders are bound.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "image/texture.h"
#include "scene/hierarchy.h"
#include "scene/scene.h"

namespace oriel {

/// Names of the file textures that the camera's environment and the materials of the leaves use, in
/// the order of their first use. Textures inside phenomena are left out.
/// Checked: TexturesAhead.*
std::vector<std::string> used_textures(const scene::Scene& scene, const scene::Camera& camera,
                                       const std::vector<scene::Leaf>& leaves);

/// Opens textures by tasks that run until the destructor, which cancels those that have not
/// started. Messages are reported by the binder, when it opens the textures itself.
///
/// Model:   the first file loads the image files module, which takes a tenth of a second; the other
///          files wait for it.
class TexturesAhead {
 public:
  /// Inputs:  scene, system: used until the destructor.
  TexturesAhead(const scene::Scene& scene, std::vector<std::string> names, TextureSystem& system,
                float gamma);
  ~TexturesAhead();
  TexturesAhead(const TexturesAhead&) = delete;
  TexturesAhead& operator=(const TexturesAhead&) = delete;

 private:
  struct Tasks;
  std::unique_ptr<Tasks> tasks_;  ///< null without textures
};

}  // namespace oriel
