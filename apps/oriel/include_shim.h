// SPDX-License-Identifier: Apache-2.0
// Lets sources find the shader headers that they include by somebody's own path.
#pragma once

#include <string>
#include <vector>

namespace oriel::app {

/// An include that only a change of the source can put right.
struct StrayInclude {
  std::string file;
  int line;
  std::string name;
};

/// Writes, below `folder`, a header for each include in `files` that names a header of `sdk` by a
/// path that does not exist here ("D:\mray\include\shader.h", "../../mray/shader.h"), or by another
/// case of letters. Each includes the header of that name. So do includes of the sources' own
/// headers that are found only with other slashes or another case of letters ("..\common\Util.h"),
/// beside the file that includes them or in `folders`; headers that are reached so are read as
/// well.
///
/// Returns: the folder to look for includes in; empty when there was nothing to write.
/// Inputs:  stray: receives includes by an absolute path, for which no such header can be written.
std::string write_include_shim(const std::vector<std::string>& files, const std::string& sdk,
                               const std::vector<std::string>& folders, const std::string& folder,
                               std::vector<StrayInclude>& stray);

}  // namespace oriel::app
