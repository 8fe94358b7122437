// SPDX-License-Identifier: Apache-2.0
// Sources of shaders in C and C++ to libraries that scenes link.
#pragma once

#include <string>
#include <vector>

#include "shader_manifest.h"

namespace oriel::app {

struct ShaderBuild {
  std::vector<std::string> sources;     ///< files
  std::string output;                   ///< the library; with `each` the folder of libraries
  std::vector<std::string> flags = {};  ///< further words for the compiler
  /// Compilers and the folder of shader.h; empty: as environment and installation have them.
  std::string cc = {}, cxx = {}, include = {};
  std::vector<std::string> include_folders = {};  ///< of further headers
  std::vector<std::string> standards = {};        ///< "gnu99", "c++98": each for its language
  std::vector<std::string> helpers = {};          ///< sources that all libraries share
  std::vector<std::string> archives = {};         ///< .a files that all libraries share
  std::vector<ShaderManifest> manifests = {};     ///< flags of single sources
  bool each = false;                              ///< one library for each source
  int jobs = 1;                                   ///< compilers that run at the same time
};

struct BuiltLibrary {
  std::string path;
  std::size_t sources = 0;
};

/// Compiles and links; messages of compilers, and hints, go to stderr.
///
/// Returns: the libraries in the order of their names.
/// Errors:  UserError where a source does not compile or a symbol stays undefined that neither the
///          sources nor Oriel nor a system library defines; then no library is written.
/// Checked: ShaderBuildProgram.*, ShaderTreeProgram.*, SceneCode.* in tests/cli
std::vector<BuiltLibrary> build_shaders(const ShaderBuild& build);

}  // namespace oriel::app
