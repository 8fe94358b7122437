// SPDX-License-Identifier: Apache-2.0
// Textures of models: files beside them, or pictures within them, which become files.
#pragma once

#include <map>
#include <string>
#include <utility>

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

  /// Light, which the gamma of pictures holds for, or numbers, which are read as they are stored.
  enum class Holds { Colors, Numbers };

  /// Name of a texture element; empty, after OR-MD-004, where there is no such picture. `written`
  /// is a path or, for pictures within the model, "*number" or their name.
  std::string picture(const aiScene& model, const std::string& written, Holds holds,
                      const std::string& user);
  /// Name of a shader that looks a picture up at a texture space, repeated; empty for none.
  std::string lookup(const std::string& picture, unsigned space);

 private:
  /// Path of the picture's file, relative to the scene's folder where it lies below; empty: none.
  std::string file_of(const aiScene& model, const std::string& written);
  std::string relative(const std::string& path) const;
  /// Name of a shader that gives a texture space within 0..1.
  std::string coordinate(unsigned space);

  const ImportOptions& options_;
  std::string folder_;
  scene::Scene& scene_;
  Diagnostics& diagnostics_;
  std::map<std::pair<std::string, Holds>, std::string> pictures_;
  std::map<std::pair<std::string, unsigned>, std::string> lookups_;
  std::map<unsigned, std::string> coordinates_;
};

}  // namespace oriel::models
