// SPDX-License-Identifier: Apache-2.0
// Decimal numbers as .mi files write them, scanned fast and rounded correctly.
#pragma once

#include <cstdint>

namespace oriel::mi {

// Conventions
//   Text ends with a zero byte (Source guarantees it), so no scan needs to look for the end.
//   A number is [sign] digits [. digits] [exponent]; `1.` and `.5` are numbers; the exponent letter
//   is e, E, d or D. It must not be followed directly by a letter, digit, dot or underscore.

struct ScannedNumber {
  double value = 0;
  const char* end = nullptr;  ///< one past the last character
  bool integral = false;      ///< no point and no exponent
  bool overflow = false;      ///< clamped to the largest finite number
};

/// Past white space, which all below blank is but the end.
inline const char* skip_blanks(const char* p) {
  while (static_cast<unsigned char>(*p) <= ' ' && *p != 0) ++p;
  return p;
}

/// 0 to 15; -1 where it is no hexadecimal digit.
inline int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const int letter = (c | 0x20) - 'a';
  return letter >= 0 && letter < 6 ? letter + 10 : -1;
}

/// Scans a number that begins at p.
///
/// Returns: false, and nothing else, when the text at p is no number.
/// Checked: Number.MatchesTheStandardLibraryOnRandomDecimals.
bool scan_number(const char* p, ScannedNumber& out);

/// The same for single precision: correctly rounded to float in one step.
///
/// Returns: one past the number, or null when the text at p is no number. Overflow clamps to the
///          largest finite float and sets `overflow` (never cleared).
const char* scan_float(const char* p, float& out, bool& overflow);

/// Unsigned decimal index of at most nine digits followed by white space or the end; the form that
/// geometry lists consist of. Returns null for anything else, which then takes the general path.
inline const char* scan_index(const char* p, std::uint32_t& out) {
  std::uint32_t value = 0;
  const char* const start = p;
  for (; static_cast<unsigned char>(*p - '0') < 10; ++p)
    value = value * 10 + static_cast<unsigned char>(*p - '0');
  if (p == start || p - start > 9 || static_cast<unsigned char>(*p) > ' ') return nullptr;
  out = value;
  return p;
}

}  // namespace oriel::mi
