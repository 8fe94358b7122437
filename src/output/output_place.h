// SPDX-License-Identifier: Apache-2.0
// Location of output files, and whether they can be written.
#pragma once

#include <string>
#include <vector>

namespace oriel {

/// Folders that scenes may write to.
struct OutputRoots {
  std::string base;                  ///< folder of the scene, which relative names start from
  std::vector<std::string> allowed;  ///< files must be inside these folders
  /// Hint for files outside of them.
  std::string hint = "name the file with -o";
};

/// The absolute path of `file` inside one of the roots; empty if it is outside.
std::string allowed_path(const std::string& file, const OutputRoots& roots);

struct OutputPlace {
  std::string path;  ///< empty: the file is outside of the roots
  /// an absolute path outside of the roots was replaced by a file in the base folder
  bool moved = false;
};

/// Same for the output of a camera: backslashes separate folders, and absolute paths (also of
/// Windows) outside of all roots are replaced by their file name in the base folder.
/// Checked: OutputPlace.* in output_place_test.cpp
OutputPlace output_place(const std::string& file, const OutputRoots& roots);

/// Creates missing folders inside a root and tests writing with an empty temporary file.
/// Returns why the file cannot be written; empty if it can. Names without has_picture_suffix() and
/// files that picture_fault() protects cannot.
std::string output_fault(const std::string& path, const OutputRoots& roots);

}  // namespace oriel
