// SPDX-License-Identifier: Apache-2.0
// C sources in a scene (`code "file"`, `code '..'`, `$code`): compiled where the user trusts them.
#pragma once

#include <cstddef>
#include <filesystem>

#include "scene_file.h"
#include "sdk/library.h"

namespace oriel::app {

/// Model:   without --trust-code nothing is compiled; the reader reports it. With it each
///          source becomes a library in the user's cache ($XDG_CACHE_HOME or ~/.cache,
///          oriel/code), named after what it says and what stands beside it, so that it is
///          compiled once; the scene gets a `link` to it. A file is looked for in the folders of
///          --shader-path, then below the scene's own folder.
/// Errors:  OR-SDK-0nn; the shaders are missing then.
/// Checked: SceneCode.* in tests/cli/scene_code_test.cpp
class SceneCode {
 public:
  SceneCode(const SceneArguments& arguments, Diagnostics& diagnostics);
  /// What the scene said since the last call; before each frame.
  void compile(scene::Scene& scene);
  /// Where libraries may be loaded from, the cache included.
  const sdk::TrustedFolders& trusted_folders() const { return trusted_; }

 private:
  void link(const scene::Statement& command, scene::Scene& scene);
  std::filesystem::path find(const std::string& written) const;
  bool make_cache(SourceLocation where);

  const SceneArguments& arguments_;
  Diagnostics& diagnostics_;
  sdk::TrustedFolders trusted_;
  std::filesystem::path cache_;  ///< empty until it is needed
  std::size_t seen_ = 0;         ///< commands of the scene
};

}  // namespace oriel::app
