// SPDX-License-Identifier: Apache-2.0
#include "mi/number.h"

#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <string>

namespace oriel::mi {
namespace {

// Powers of ten that are exact in double precision. With a mantissa below 2^53, one multiplication
// or division is correctly rounded (W. D. Clinger, How to Read Floating Point Numbers Accurately,
// 1990).
constexpr double kExactPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                   1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                   1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
constexpr int kMaxExactPower = 22;
constexpr int kMaxExactDigits = 15;

bool is_decimal_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }
bool continues_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_decimal_digit(c) || c == '_' ||
         c == '.';
}

// Result of the first pass over the characters.
struct Decimal {
  std::uint64_t mantissa = 0;
  int digits = 0;  // significant digits; mantissa is valid up to kMaxExactDigits
  int exponent = 0;
  bool negative = false, integral = true;
  const char* digits_begin = nullptr;  // after the sign
  const char* end = nullptr;
};

inline bool scan_decimal(const char* p, Decimal& d) {
  if (*p == '-' || *p == '+') d.negative = *p++ == '-';
  d.digits_begin = p;
  const auto take = [&] {
    const char* const start = p;
    for (; is_decimal_digit(*p); ++p) {
      d.mantissa = d.mantissa * 10 + static_cast<unsigned char>(*p - '0');
      d.digits += d.mantissa != 0;
    }
    return static_cast<int>(p - start);
  };
  int seen = take();
  if (*p == '.') {
    ++p;
    d.integral = false;
    const int fraction = take();
    seen += fraction;
    d.exponent = -fraction;
  }
  if (seen == 0) return false;
  if ((*p | 0x20) == 'e' || (*p | 0x20) == 'd') {
    const char* q = p + 1;
    const bool minus = *q == '-';
    if (*q == '-' || *q == '+') ++q;
    if (!is_decimal_digit(*q)) return false;
    int e = 0;
    for (; is_decimal_digit(*q); ++q) e = e < 100000 ? e * 10 + (*q - '0') : e;
    d.exponent += minus ? -e : e;
    d.integral = false;
    p = q;
  }
  d.end = p;
  return !continues_word(*p);
}

inline bool exact_double(const Decimal& d, double& out) {
  if (d.digits > kMaxExactDigits || d.exponent > kMaxExactPower || d.exponent < -kMaxExactPower)
    return false;
  const double m = static_cast<double>(d.mantissa);
  out = d.exponent < 0 ? m / kExactPowers[-d.exponent] : m * kExactPowers[d.exponent];
  return true;
}

// Conversion by the standard library, for numbers without an exact short path. std::from_chars does
// not accept the exponent letter d.
template <class T>
T convert(const Decimal& d, bool& overflow) {
  std::string text(d.digits_begin, d.end);
  for (char& c : text)
    if ((c | 0x20) == 'd') c = 'e';
  T value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc::result_out_of_range) {
    // Overflow or underflow; the decimal exponent of the leading digit distinguishes them.
    const bool large = static_cast<long>(d.exponent) + d.digits > 0;
    overflow |= large;
    return large ? std::numeric_limits<T>::max() : T(0);
  }
  return value;
}

}  // namespace

bool scan_number(const char* p, ScannedNumber& out) {
  Decimal d;
  if (!scan_decimal(p, d)) return false;
  out.overflow = false;
  if (!exact_double(d, out.value)) out.value = convert<double>(d, out.overflow);
  if (d.negative) out.value = -out.value;
  out.end = d.end;
  out.integral = d.integral;
  return true;
}

const char* scan_float(const char* p, float& out, bool& overflow) {
  Decimal d;
  if (!scan_decimal(p, d)) return nullptr;
  double value = 0;
  // Rounding to double and then to float is wrong only if the double lies exactly between two
  // floats, i.e. if its lower 29 bits are 1 followed by zeros. Denormal floats have fewer bits, so
  // small values use the long path too.
  constexpr std::uint64_t kBelowFloat = (1ull << 29) - 1, kHalfway = 1ull << 28;
  const bool direct = exact_double(d, value) && (value == 0 || (value > 1e-37 && value < 3e38)) &&
                      (std::bit_cast<std::uint64_t>(value) & kBelowFloat) != kHalfway;
  const float magnitude = direct ? static_cast<float>(value) : convert<float>(d, overflow);
  out = d.negative ? -magnitude : magnitude;
  return d.end;
}

}  // namespace oriel::mi
