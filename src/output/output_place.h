// SPDX-License-Identifier: Apache-2.0
// Where the file of an output lies, and whether it can be written.
#pragma once

#include <string>
#include <vector>

namespace oriel {

/// Where scenes may write.
struct OutputRoots {
  std::string base;                  ///< relative names start here: the scene's folder
  std::vector<std::string> allowed;  ///< folders that files must lie in or below
  /// What a user can do about a file outside of them.
  std::string hint = "name the file with -o";
};

/// The path below one of the roots that `file` means, empty when it is outside of all.
std::string allowed_path(const std::string& file, const OutputRoots& roots);

struct OutputPlace {
  std::string path;    ///< empty: the file lies outside of the roots
  bool moved = false;  ///< an absolute path outside of the roots became a file of the base folder
};

/// The same for a camera's output: backslashes separate folders, and absolute paths (of Windows as
/// well) that lie outside of all roots become their file name in the base folder.
/// Checked: OutputPlace.* in output_place_test.cpp
OutputPlace output_place(const std::string& file, const OutputRoots& roots);

/// Makes the missing folders of a file that lies in or below a root and writes an empty file beside
/// it, which it removes. Returns why the file cannot be written; empty: it can.
std::string output_fault(const std::string& path, const OutputRoots& roots);

}  // namespace oriel
