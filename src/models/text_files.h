// SPDX-License-Identifier: Apache-2.0
// Text files of models as assimp can read them.
#pragma once

#include <assimp/DefaultIOSystem.h>

#include <map>
#include <optional>
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

/// Collada whose cameras have names and whose perspective cameras have a horizontal angle, and an
/// aspect ratio where the vertical angle is given: assimp ignores cameras without a name and
/// vertical angles without an aspect ratio, and divides the tangents of whole angles. Inputs:
/// aspect: of the picture, for cameras with a vertical angle only. Source:  Collada 1.4.1,
/// <perspective>. Checked: ModelCamera.ColladaKeepsTheAnglesThatItDefines
std::string with_whole_cameras(std::string_view xml, float aspect);

/// Opens files for assimp, which gives UTF-16 to readers that do not know it.
class TextFiles : public Assimp::DefaultIOSystem {
 public:
  /// Inputs:  tidy_numbers: see without_blanks_before_numbers; collada_aspect: see
  ///          with_whole_cameras; unset for other formats.
  explicit TextFiles(bool tidy_numbers, std::optional<float> collada_aspect = std::nullopt)
      : tidy_numbers_(tidy_numbers), collada_aspect_(collada_aspect) {}
  Assimp::IOStream* Open(const char* file, const char* mode) override;

 private:
  bool tidy_numbers_;
  std::optional<float> collada_aspect_;
  std::map<std::string, std::string> changed_;  ///< text by file; streams read from it
};

}  // namespace oriel::models
