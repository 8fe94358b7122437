// SPDX-License-Identifier: Apache-2.0
// Imports textures: files, or embedded pictures, which are written to files.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "base/diagnostic.h"
#include "models/import.h"
#include "scene/scene.h"

struct aiScene;

namespace oriel::models {

/// Whether embedded pictures are written with this suffix (without a dot).
bool is_texture_suffix(std::string_view suffix);

/// Makes the texture elements and lookup shaders of one import, once per file.
class TextureMaker {
 public:
  /// Inputs:  folder: folder of the model file, which its texture paths are relative to.
  TextureMaker(const ImportOptions& options, std::string folder, scene::Scene& scene,
               Diagnostics& diagnostics)
      : options_(options), folder_(std::move(folder)), scene_(scene), diagnostics_(diagnostics) {}

  /// Colours, which are decoded with the gamma of pictures, or numbers, which are not.
  enum class Holds { Colors, Numbers };

  /// Name of a texture element; empty after OR-MD-004 if there is no such picture. `written` is a
  /// path or, for embedded pictures, "*number" or their name.
  std::string picture(const aiScene& model, const std::string& written, Holds holds,
                      const std::string& user);
  /// Name of a shader that looks up a picture in a texture space with repetition; empty if there is
  /// no picture.
  std::string lookup(const std::string& picture, unsigned space);
  /// mean_color() of a texture element; unset if there is none.
  std::optional<Vec3> mean_color(const std::string& picture) const;

 private:
  /// Path of the picture file, relative to the scene folder if it is inside; empty if not found.
  /// Unset: the texture cannot be written; the reason was reported. Empty: there is no such file.
  std::optional<std::string> file_of(const aiScene& model, const std::string& written);
  std::string relative(const std::string& path) const;
  /// Name of a shader that returns the coordinates of a texture space in 0..1.
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
