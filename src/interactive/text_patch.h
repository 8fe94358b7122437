// SPDX-License-Identifier: Apache-2.0
// Replacement of values in `.mi` text without changing anything else.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::interactive {

/// A token of scene text.
struct TextToken {
  enum class Kind : unsigned char { End, Word, String, Punct };
  Kind kind = Kind::End;
  std::size_t begin = 0, end = 0;  ///< bytes in the text
  /// Whether it is the word or, in quotes, the string.
  bool is(std::string_view text, std::string_view name) const;
};

/// Reads tokens of scene text; comments are skipped.
class TextScanner {
 public:
  TextScanner(std::string_view text, std::size_t at) : text_(text), at_(at) {}
  TextToken next();

 private:
  void skip_blanks();
  std::string_view text_;
  std::size_t at_;
};

/// A range of text and what replaces it.
struct TextPatch {
  std::size_t begin = 0, end = 0;
  std::string text;
};

/// Offset of a line and column, from 1; the end of the text if there is none.
std::size_t text_offset(std::string_view text, std::size_t line, std::size_t column);

/// The value of a parameter whose name starts at `at`: from after the name to before the comma or
/// parenthesis. Unset if the text has no such form.
/// Checked: TextPatch.*
std::optional<TextPatch> parameter_value(std::string_view text, std::size_t at,
                                         std::string_view name);

/// A place for a new parameter of the call at `at`: after its opening parenthesis.
/// Inputs:  written: name and value.
std::optional<TextPatch> parameter_insertion(std::string_view text, std::size_t at,
                                             const std::string& written);

/// A statement in the body of the element at `at`, which ends with `end kind`.
struct StatementPlace {
  std::string_view kind;     ///< keyword after `end`
  std::string_view keyword;  ///< words of the statement, separated by blanks
  bool quoted = false;       ///< the keyword is in quotes
  std::size_t values = 1;    ///< number of tokens of the present value
};

/// Replaces the values of the last such statement, or inserts one before the end of the element.
std::optional<TextPatch> statement_value(std::string_view text, std::size_t at,
                                         const StatementPlace& place, const std::string& value);

/// The file name of the texture at `at`.
std::optional<TextPatch> texture_file(std::string_view text, std::size_t at);

/// Applies patches, which do not overlap; those at one place in their order.
std::string patched(std::string_view text, std::vector<TextPatch> patches);

}  // namespace oriel::interactive
