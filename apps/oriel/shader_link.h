// SPDX-License-Identifier: Apache-2.0
// Links object files to a shader library and names what stays undefined.
#pragma once

#include <string>
#include <vector>

#include "shader_compile.h"

namespace oriel::app {

/// What one library is linked from.
struct ShaderLink {
  std::vector<const CompiledSource*> sources;
  std::vector<std::string> archives;  ///< after the sources
  std::vector<std::string> flags;     ///< after the archives
};

/// Links to `path`; messages of the linker go to stderr.
///
/// Errors: UserError where the linker fails, and where a symbol stays undefined that neither this
///         program nor a library of the link offers. Each is named on stderr before, with the
///         sources that need it; `helpers` are searched for these as well.
void link_shaders(const ShaderLink& link, const std::vector<CompiledSource>& helpers,
                  const std::string& path, const std::string& work, ShaderCompilers& compilers,
                  BuildHints& hints);

/// Puts object files into an archive. Errors: UserError.
void archive_objects(const std::vector<CompiledSource>& sources, const std::string& path,
                     const std::string& work);

}  // namespace oriel::app
