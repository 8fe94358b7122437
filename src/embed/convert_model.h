// SPDX-License-Identifier: Apache-2.0
// Models become scenes by the oriel program.
#pragma once

#include <filesystem>
#include <string>

namespace oriel::embed {

/// Whether a path names a scene, from its suffix; other files are models.
bool is_scene(const std::filesystem::path& path);

/// Runs `oriel convert MODEL -o SCENE --daylight`.
/// Inputs:  program: path, or a name that is found by PATH.
/// Errors:  EmbedError.
void convert_model(const std::string& program, const std::string& model, const std::string& scene);

}  // namespace oriel::embed
