// SPDX-License-Identifier: Apache-2.0
#include "image/compare.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace oriel {

Difference compare(const Image& test, const Image& reference, float epsilon) {
  if (test.width != reference.width || test.height != reference.height ||
      test.channels != reference.channels) {
    const auto shape = [](const Image& i) {
      return std::to_string(i.width) + " x " + std::to_string(i.height) + " x " +
             std::to_string(i.channels);
    };
    throw std::runtime_error("the pictures differ in shape: " + shape(test) + " and " +
                             shape(reference));
  }
  Difference out;
  // double: sums over tens of millions of values.
  double squares = 0, absolutes = 0, relatives = 0;
  std::size_t counted = 0, worst = 0;
  for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
    const float t = test.pixels[i], r = reference.pixels[i];
    if (!std::isfinite(t) || !std::isfinite(r)) {
      ++out.not_finite;
      continue;
    }
    const double d = double(t) - double(r);
    ++counted;
    squares += d * d;
    absolutes += std::abs(d);
    relatives += d * d / (double(r) * double(r) + double(epsilon));
    if (float(std::abs(d)) > out.max_abs) {
      out.max_abs = float(std::abs(d));
      worst = i;
    }
  }
  if (counted > 0) {
    out.rmse = std::sqrt(squares / double(counted));
    out.mean_abs = absolutes / double(counted);
    out.relative_mse = relatives / double(counted);
    const std::size_t pixel = worst / reference.channels;
    out.max_channel = int(worst % reference.channels);
    out.max_x = int(pixel % reference.width);
    out.max_y = int(pixel / reference.width);
  }
  return out;
}

}  // namespace oriel
