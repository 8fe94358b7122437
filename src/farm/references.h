// SPDX-License-Identifier: Apache-2.0
// The files that a scene refers to: where their names are written, and where the files are.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "mi/reader.h"

namespace oriel::farm {

/// A file name in the text of a scene.
struct FileReference {
  enum class Kind : std::uint8_t {
    Include,
    Placeholder,  ///< file of an object or assembly, read as an include
    Texture,
    Profile,
    UserData,
    Map,      ///< of photons or final gather points; missing maps are not reported: renders write
              ///< them
    Library,  ///< compiled shaders; found by name in trusted folders, not by path
    Code,     ///< C source of `code`
    String,   ///< string parameter of a user's shader that is the path of a file
  };
  Kind kind = Kind::Texture;
  std::string written;
  std::string path;        ///< empty: the file was not found
  std::string reason;      ///< why it was not found; may be empty
  SourceLocation where;    ///< of the name, or of a statement before it
  int strings_before = 0;  ///< number of strings between `where` and the name
};

/// All files of a scene.
struct SceneFiles {
  std::vector<FileReference> references;  ///< in order of reading, each place once
  int frames = 0;                         ///< render statements
};

/// Where a scene is and how it is read.
struct SceneSource {
  std::string path;
  mi::ReadOptions read;
  /// The path of a compiled shader library by the name in `link`; empty if it is not found. Unset:
  /// Oriel has its shaders.
  std::function<std::optional<std::string>(const std::string& name)> find_library;
};

/// Reads all frames of a scene and lists the files it refers to, without opening the files
/// themselves.
///
/// Inputs:  source.read.knows_shader: shaders of Oriel, whose string parameters are not files.
/// Errors:  std::runtime_error if the scene cannot be read; diagnostics of the reader.
/// Checked: PackProgram.* in tests/cli
SceneFiles find_files(const SceneSource& source, Diagnostics& diagnostics);

std::string_view kind_name(FileReference::Kind kind);

}  // namespace oriel::farm
