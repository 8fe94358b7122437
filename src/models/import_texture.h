// SPDX-License-Identifier: Apache-2.0
// Textures of models: files beside them, or pictures within them, which become files.
#pragma once

#include <map>
#include <string>

#include "base/diagnostic.h"
#include "models/import.h"
#include "scene/scene.h"

struct aiScene;

namespace oriel::models {

/// Makes the texture elements and lookups of one import, each file's once.
class TextureMaker {
 public:
  /// Inputs:  folder: of the model file, which its textures are relative to.
  TextureMaker(const ImportOptions& options, std::string folder, scene::Scene& scene,
               Diagnostics& diagnostics)
      : options_(options), folder_(std::move(folder)), scene_(scene), diagnostics_(diagnostics) {}

  /// Name of a shader that looks the picture up at the first texture space, repeated; empty, after
  /// OR-MD-004, where there is no such picture. `written` is a path or, for pictures within the
  /// model, "*number" or their name.
  std::string lookup(const aiScene& model, const std::string& written, const std::string& user);

 private:
  /// Path of the picture's file, relative to the scene's folder where it lies below; empty: none.
  std::string file_of(const aiScene& model, const std::string& written);
  std::string relative(const std::string& path) const;

  const ImportOptions& options_;
  std::string folder_;
  scene::Scene& scene_;
  Diagnostics& diagnostics_;
  std::map<std::string, std::string> known_;
};

}  // namespace oriel::models
