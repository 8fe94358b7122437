// SPDX-License-Identifier: Apache-2.0
// Converts text files of models to a form that assimp can read.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <map>
#include <string>
#include <string_view>

namespace oriel::models {

/// Converts UTF-16 with a byte order mark (either order) to UTF-8 without one; lone surrogates and
/// an odd last byte become U+FFFD. Other text is returned unchanged.
/// Source:  Unicode 15, section 3.9 and 3.10.
/// Checked: ModelTextFiles.Utf16BecomesUtf8
std::string utf8_of(std::string_view bytes);

/// Removes blanks between '>' and a number from XML.
/// Checked: ModelTextFiles.ColladaMayHaveBlanksAroundNumbers
std::string without_blanks_before_numbers(std::string_view xml);

/// File system for assimp that converts UTF-16 for readers without support for it.
class TextFiles : public Assimp::DefaultIOSystem {
 public:
  /// Inputs:  tidy_numbers: apply without_blanks_before_numbers.
  explicit TextFiles(bool tidy_numbers) : tidy_numbers_(tidy_numbers) {}
  Assimp::IOStream* Open(const char* file, const char* mode) override;

 private:
  bool tidy_numbers_;
  std::map<std::string, std::string> changed_;  ///< converted text by file; streams read from it
};

}  // namespace oriel::models
