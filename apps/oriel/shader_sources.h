// SPDX-License-Identifier: Apache-2.0
// Sources of shaders among files and in folders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shader_manifest.h"

namespace oriel::app {

bool is_c_source(const std::filesystem::path& file);

/// Headers in a folder, sorted.
std::vector<std::string> headers_in(const std::filesystem::path& folder);

/// Sources among files and in folders, with `recursive` also in the folders in them (those whose
/// names begin with a dot left out), without those that a manifest skips.
///
/// Errors: UserError where there are none.
std::vector<std::string> find_shader_sources(const std::vector<std::string>& paths,
                                             bool recursive = false,
                                             const std::vector<ShaderManifest>& manifests = {});

}  // namespace oriel::app
