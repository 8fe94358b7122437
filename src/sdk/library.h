// SPDX-License-Identifier: Apache-2.0
// A shared library of users' shaders: where it may come from, what it lacks.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace oriel::sdk {

/// Folders whose native code may run: told by the user, never by a scene.
using TrustedFolders = std::vector<std::filesystem::path>;

/// Folders of --shader-path and then of the environment variable ORIEL_SHADER_PATH, both separated
/// by colons.
TrustedFolders trusted_folders(const std::string& told);

/// File name of a path of any system, without the suffix of a shared library.
std::string library_stem(const std::string& written);

class Library {
 public:
  /// Loads what a `link` statement names: its file name alone, with any system's suffix, is looked
  /// for in the folders, in order.
  ///
  /// Errors:  null where there is no such file; null with OR-SDK-002 wrong architecture or not a
  /// library, -003
  ///          functions that Oriel does not offer, each by name. Throws OR-SDK-005 where a static
  ///          constructor crashes: the system's loader cannot be used after that.
  static std::unique_ptr<Library> open(const std::string& written, SourceLocation where,
                                       const TrustedFolders& folders, Diagnostics& diagnostics);
  ~Library();
  /// Unloads it. Returns what its static destructors did wrong; empty: nothing.
  std::string close();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::string& file_name() const { return file_name_; }
  /// Address of a function, null when the library has none.
  void* find(const std::string& name) const;

 private:
  Library() = default;
  std::filesystem::path path_;
  std::string file_name_;
  void* handle_ = nullptr;
};

}  // namespace oriel::sdk
