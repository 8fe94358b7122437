// SPDX-License-Identifier: Apache-2.0
// Packs everything a scene reads into one folder with relative names.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "farm/references.h"

namespace oriel::farm {

struct PackReport {
  std::string scene;  ///< name of the scene in the folder
  std::size_t files = 0;
  std::uint64_t bytes = 0;
  int frames = 0;              ///< render statements
  bool has_libraries = false;  ///< renders need --shader-path FOLDER/shaders
  bool has_code = false;       ///< renders need --trust-code
  std::vector<FileReference> missing;
};

/// Copies a scene and its files to `folder`, with relative names.
///
/// Model:   texts of scenes are changed only where a name of a file has to change; all other bytes
///          are kept. Places: see PackLayout. TILT files of light profiles and headers beside C
///          sources are copied too. The folder is written beside its place and renamed, so that it
///          is complete or does not exist.
/// Inputs:  folder: does not exist, or is empty. keep_missing: keep the names of missing files;
///          otherwise nothing is written if one is missing.
/// Errors:  std::runtime_error.
/// Checked: PackProgram.* in tests/cli
PackReport pack_scene(const SceneSource& source, const std::string& folder, bool keep_missing,
                      Diagnostics& diagnostics);

}  // namespace oriel::farm
