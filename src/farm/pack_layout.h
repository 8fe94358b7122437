// SPDX-License-Identifier: Apache-2.0
// Places of files in a packed scene.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>

namespace oriel::farm {

/// Name of the description of a packed folder.
inline constexpr const char* kPackManifest = "pack.json";
/// Folder of compiled shaders in a packed folder.
inline constexpr const char* kPackedShaders = "shaders";
/// Folder of files from outside of the scene's own folder.
inline constexpr const char* kPackedExternal = "external";

/// Assigns a relative path to each file of a scene.
///
/// Model:   files below the folder of the scene keep their relative path. Files of another folder
///          stay together, in external/NAME with the last part of the name of their folder, so that
///          files which refer to each other by name find each other, and files of the same name in
///          different folders do not collide. The scene keeps its name, which pictures contain.
/// Checked: PackLayout.*
class PackLayout {
 public:
  /// `scene`: path of the scene file.
  explicit PackLayout(const std::filesystem::path& scene);

  /// The relative path of a file with slashes; the same for the same file.
  std::string place(const std::filesystem::path& file);
  /// The relative path of a compiled shader library.
  std::string place_library(const std::filesystem::path& file);

  /// Relative paths by source.
  const std::map<std::filesystem::path, std::string>& places() const { return places_; }

 private:
  std::string external_folder(const std::filesystem::path& folder);
  std::string free_name(const std::string& wanted);

  std::filesystem::path scene_, folder_;  // absolute, normal
  std::map<std::filesystem::path, std::string> places_;
  std::map<std::filesystem::path, std::string> folders_;  // external ones
  std::set<std::string> used_;                            // relative paths, in lower case
};

/// A name without characters that need quotes anywhere: letters, digits, "._-+ " and bytes beyond
/// ASCII are kept, others become "_".
/// Checked: PackLayout.NamesNeedNoQuotes
std::string plain_name(const std::string& name);

}  // namespace oriel::farm
