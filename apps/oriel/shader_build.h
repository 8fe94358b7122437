// SPDX-License-Identifier: Apache-2.0
// Sources of shaders in C and C++ to a library that scenes link.
#pragma once

#include <string>
#include <vector>

namespace oriel::app {

struct ShaderBuild {
  std::vector<std::string> sources;     ///< files
  std::string output;                   ///< the library
  std::vector<std::string> flags = {};  ///< further words for the compiler
  /// Compilers and the folder of shader.h; empty: as environment and installation have them.
  std::string cc = {}, cxx = {}, include = {};
};

/// Sources among files and in folders. Errors: UserError where there are none.
std::vector<std::string> find_shader_sources(const std::vector<std::string>& paths);

/// Compiles and links; messages of compilers go to stderr.
///
/// Errors:  UserError; then nothing is written.
/// Checked: ShaderBuildProgram.*, SceneCode.* in tests/cli
void build_shaders(const ShaderBuild& build);

}  // namespace oriel::app
