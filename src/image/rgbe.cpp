// SPDX-License-Identifier: Apache-2.0
#include "image/rgbe.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace oriel {

Rgbe encode_rgbe(const Rgb& color) {
  int exponent = 0;
  const float largest = std::max({0.0f, color.x, color.y, color.z});
  std::frexp(std::min(largest, 1e38f), &exponent);
  // Compare with a normal number: on processors that flush denormals to zero nothing is below
  // 1e-38.
  if (!(largest >= std::numeric_limits<float>::min())) exponent = -128;
  const auto mantissa = [exponent](float v) {
    return static_cast<std::uint8_t>(
        clamp(std::floor(std::ldexp(std::max(0.0f, v), 8 - exponent)), 0, 255));
  };
  return {mantissa(color.x), mantissa(color.y), mantissa(color.z),
          static_cast<std::uint8_t>(exponent + 128)};
}

Rgb decode_rgbe(const Rgbe& code) {
  if (code[3] == 0) return Rgb(0);
  const auto channel = [&code](std::size_t k) {
    return std::ldexp(static_cast<float>(code[k]) + 0.5f, code[3] - 136);
  };
  return Rgb(channel(0), channel(1), channel(2));
}

}  // namespace oriel
