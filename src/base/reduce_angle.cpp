// SPDX-License-Identifier: Apache-2.0
#include "base/reduce_angle.h"

#include <bit>

namespace oriel::math {

namespace {

/// pi/2 as a sum; the first two terms have trailing zeros, so that their products with k are exact.
constexpr double kHalfPi[3] = {0x1.921fb5p+0, 0x1.110b46p-26, 0x1.1a62633145c07p-54};
constexpr double kTwoOverPi = 0x1.45f306dc9c883p-1;

/// Cody and Waite: exact products for |x| <= 2^27.
Reduced reduce_small(double x) {
  const double k = round_to_int(x * kTwoOverPi);
  const double near = __builtin_fma(-k, kHalfPi[0], x);
  const double high = __builtin_fma(-k, kHalfPi[1], near);
  const double lost = (near - high) - k * kHalfPi[1];
  const double tail = __builtin_fma(-k, kHalfPi[2], lost);
  const double r = high + tail;
  return {r, (high - r) + tail, static_cast<std::uint32_t>(static_cast<std::int64_t>(k))};
}

/// Payne and Hanek: multiplies x = m 2^e by the 128 bits of 2/pi that determine the quarter and the
/// fraction.
Reduced reduce_large(double x) {
  static constexpr std::uint64_t kBits[] = {// of 2/pi; word 0 is the integer part
                                            0,
                                            0xa2f9836e4e441529,
                                            0xfc2757d1f534ddc0,
                                            0xdb6295993c439041,
                                            0xfe5163abdebbc561,
                                            0xb7246e3a424dd2e0,
                                            0x06492eea09d1921c,
                                            0xfe1deb1cb129a73e,
                                            0xe88235f52ebb4484,
                                            0xe99c7026b45f7e41,
                                            0x3991d639835339f4,
                                            0x9c845f8bbdf9283b,
                                            0x1ff897ffde05980f,
                                            0xef2f118b5a0a6d1f,
                                            0x6d367ecf27cb09b7,
                                            0x4f463f669e5fea2d,
                                            0x7527bac7ebe5f17b,
                                            0x3d0739f78a5292ea,
                                            0x6bfb5fb11f8d5d08,
                                            0x56033046fc7b6bab,
                                            0xf0cfbc209af4361d};
  const auto bits = std::bit_cast<std::uint64_t>(__builtin_fabs(x));
  const std::uint64_t m = (bits & ((std::uint64_t{1} << 52) - 1)) | (std::uint64_t{1} << 52);
  const int e = static_cast<int>(bits >> 52) - 1075;  // |x| = m 2^e
  // Bits of 2/pi before position e - 2 give multiples of 4 quarters; use three words from there on.
  const int start = 64 + e - 2;
  const auto word = [&](int i) {
    const int at = start / 64 + i, shift = start % 64;
    const std::uint64_t high = kBits[at], low = kBits[at + 1];
    return shift == 0 ? high : (high << shift) | (low >> (64 - shift));
  };
  using Wide = unsigned __int128;
  const Wide low = static_cast<Wide>(m) * word(2);
  const Wide middle = static_cast<Wide>(m) * word(1) + (low >> 64);
  const std::uint64_t top =
      m * word(0) + static_cast<std::uint64_t>(middle >> 64);  // modulo 4 quarters
  const std::uint64_t second = static_cast<std::uint64_t>(middle);
  std::uint64_t quarter = top >> 62;
  // The fraction after the quarter as a signed multiple of 2^-126, relative to the nearest quarter.
  auto fraction =
      static_cast<__int128>((static_cast<Wide>(top) << 66) | (static_cast<Wide>(second) << 2));
  if (fraction < 0) ++quarter;  // at least one half: relative to the next quarter
  const double high = static_cast<double>(static_cast<std::int64_t>(fraction >> 64)) * 0x1p-64;
  const double rest = static_cast<double>(static_cast<std::uint64_t>(fraction)) * 0x1p-128;
  const double half_pi = kHalfPi[0] + kHalfPi[1];
  const double turn = high + rest;  // in units of a quarter
  const double turn_low = (high - turn) + rest;
  const double r = turn * half_pi;
  const double low_r = __builtin_fma(turn, half_pi, -r) + turn * kHalfPi[2] + turn_low * half_pi;
  const bool negative = x < 0;
  if (negative) quarter = 0 - quarter;
  return {negative ? -r : r, negative ? -low_r : low_r, static_cast<std::uint32_t>(quarter)};
}

}  // namespace

Reduced reduce_angle(double x) {
  return __builtin_fabs(x) <= 0x1p27 ? reduce_small(x) : reduce_large(x);
}

}  // namespace oriel::math
