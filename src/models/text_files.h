// SPDX-License-Identifier: Apache-2.0
// Text files of models as assimp can read them.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <map>
#include <string>
#include <string_view>

namespace oriel::models {

/// UTF-16 with a byte order mark, either order, as UTF-8 without one; lone surrogates and an odd
/// last byte become U+FFFD. Other text as it is.
/// Source:  Unicode 15, section 3.9 and 3.10.
/// Checked: ModelTextFiles.Utf16BecomesUtf8
std::string utf8_of(std::string_view bytes);

/// XML whose numbers follow their tags at once: blanks between '>' and a number go.
/// Checked: ModelTextFiles.ColladaMayHaveBlanksAroundNumbers
std::string without_blanks_before_numbers(std::string_view xml);

/// Opens files for assimp, which gives UTF-16 to readers that do not know it.
class TextFiles : public Assimp::DefaultIOSystem {
 public:
  /// Inputs:  tidy_numbers: see without_blanks_before_numbers.
  explicit TextFiles(bool tidy_numbers) : tidy_numbers_(tidy_numbers) {}
  Assimp::IOStream* Open(const char* file, const char* mode) override;

 private:
  bool tidy_numbers_;
  std::map<std::string, std::string> changed_;  ///< text by file; streams read from it
};

}  // namespace oriel::models
