// SPDX-License-Identifier: Apache-2.0
// A shared library of user shaders: search, loading, missing symbols.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/diagnostic.h"

namespace oriel::sdk {

/// Folders from which native code may be loaded; set by the user, never by a scene.
using TrustedFolders = std::vector<std::filesystem::path>;

/// Folders of --shader-path, then of the environment variable ORIEL_SHADER_PATH, separated by
/// colons. Inputs: untrusted: the scene is untrusted; the environment is ignored.
TrustedFolders trusted_folders(const std::string& told, bool untrusted = false);

/// File name of a path of any system, without the suffix of a shared library.
std::string library_stem(const std::string& written);

class Library {
 public:
  /// Loads the library of a `link` statement: its file name, with the suffix of this system, is
  /// searched in the folders in order.
  ///
  /// Errors:  null if there is no such file; null with OR-SDK-002 wrong architecture or not a
  ///          library, -003 undefined functions, each named. Throws OR-SDK-005 if a static
  ///          constructor crashes, since the loader of the system is unusable afterwards.
  static std::unique_ptr<Library> open(const std::string& written, SourceLocation where,
                                       const TrustedFolders& folders, Diagnostics& diagnostics);
  ~Library();
  /// Unloads the library. Returns a description of a crash in its static destructors, or empty.
  std::string close();
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::string& file_name() const { return file_name_; }
  /// Address of a function; null if the library does not contain it.
  void* find(const std::string& name) const;

 private:
  Library() = default;
  std::filesystem::path path_;
  std::string file_name_;
  void* handle_ = nullptr;
};

}  // namespace oriel::sdk
