// SPDX-License-Identifier: Apache-2.0
// Fast, correctly rounded scanning of decimal numbers in .mi files.
#pragma once

#include <cstdint>

namespace oriel::mi {

// Conventions
//   Text ends with a zero byte (guaranteed by Source), so that scans need no end test.
//   A number is [sign] digits [. digits] [exponent]; `1.` and `.5` are numbers; the exponent letter
//   is e, E, d or D. No letter, digit, dot or underscore may follow it directly.

struct ScannedNumber {
  double value = 0;
  const char* end = nullptr;  ///< one past the last character
  bool integral = false;      ///< no point and no exponent
  bool overflow = false;      ///< clamped to the largest finite number
};

/// Skips white space: all bytes up to and including the blank, except zero.
inline const char* skip_blanks(const char* p) {
  while (static_cast<unsigned char>(*p) <= ' ' && *p != 0) ++p;
  return p;
}

/// 0 to 15, or -1 if c is not a hexadecimal digit.
inline int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const int letter = (c | 0x20) - 'a';
  return letter >= 0 && letter < 6 ? letter + 10 : -1;
}

/// Scans a number that begins at p.
///
/// Returns: false if the text at p is not a number; `out` is then unchanged.
/// Checked: Number.MatchesTheStandardLibraryOnRandomDecimals.
bool scan_number(const char* p, ScannedNumber& out);

/// As scan_number(), for single precision: rounded correctly to float in one step.
///
/// Returns: the end of the number, or null if the text at p is not a number. Overflow clamps to
///          the largest finite float and sets `overflow`, which is never cleared.
const char* scan_float(const char* p, float& out, bool& overflow);

/// Scans an unsigned decimal index of at most nine digits, followed by white space or the end: the
/// usual form in geometry lists. Returns null for any other form; the caller then uses
/// scan_number().
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
