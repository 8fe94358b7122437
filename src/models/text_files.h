// SPDX-License-Identifier: Apache-2.0
// Converts text files of models to a form that assimp can read.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/file_access.h"

namespace oriel::models {

/// Converts UTF-16 with a byte order mark (either order) to UTF-8 without one; lone surrogates and
/// an odd last byte become U+FFFD. Other text is returned unchanged.
/// Source:  Unicode 15, section 3.9 and 3.10.
/// Checked: ModelTextFiles.Utf16BecomesUtf8
std::string utf8_of(std::string_view bytes);

/// Removes blanks between '>' and a number from XML.
/// Checked: ModelTextFiles.ColladaMayHaveBlanksAroundNumbers
std::string without_blanks_before_numbers(std::string_view xml);

/// Collada whose cameras have names and whose perspective cameras have a horizontal angle, and an
/// aspect ratio where the vertical angle is given: assimp ignores cameras without a name and
/// vertical angles without an aspect ratio, and divides the tangents of whole angles. Inputs:
/// aspect: of the picture, for cameras with a vertical angle only. Source:  Collada 1.4.1,
/// <perspective>. Checked: ModelCamera.ColladaKeepsTheAnglesThatItDefines
std::string with_whole_cameras(std::string_view xml, float aspect);

/// Files that a model may read, and those that were refused.
struct ModelFiles {
  FileAccess access;
  std::string model;  ///< path of the model, which may lie anywhere
  FileUse use = FileUse::Scene;
  std::map<std::string, std::string> refused = {};  ///< reasons and hints by name
};

/// Opens files for assimp: regular files that the policy permits, for reading only. It gives UTF-8
/// to readers that do not know UTF-16.
/// Checked: ModelTextFiles.*, Confinement.* in tests/faults/confinement_test.cpp
class TextFiles : public Assimp::DefaultIOSystem {
 public:
  using Rewrite = std::function<std::string(const std::string& text)>;

  /// Inputs:  files: must outlive this object. rewrite: returns what is read in place of the text
  ///          of a file; null: the same.
  explicit TextFiles(ModelFiles& files, Rewrite rewrite = {})
      : files_(files), rewrite_(std::move(rewrite)) {}
  bool Exists(const char* file) const override;
  Assimp::IOStream* Open(const char* file, const char* mode) override;
  bool CreateDirectory(const std::string&) override { return false; }
  bool DeleteFile(const std::string&) override { return false; }

 private:
  OpenFile open(const std::string& file) const;

  ModelFiles& files_;
  Rewrite rewrite_;
  std::map<std::string, std::string> changed_;  ///< text by file; streams read from it
};

}  // namespace oriel::models
