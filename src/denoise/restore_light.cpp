// SPDX-License-Identifier: Apache-2.0
#include "denoise/restore_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace oriel::denoising {
namespace {

/// Three box blurs of this radius are close to a Gaussian of as many pixels. Noise of independent
/// pixels is 1/113 after it.
constexpr int kWideRadius = 32;
/// Smooths the standard error, which is noisy itself.
constexpr int kErrorRadius = 2;
/// Relative standard error from which on pixels get light in proportion to their brightness. Errors
/// have long tails: the rare sample that makes the largest error must not attract the light.
constexpr float kFullError = 0.05f;

/// A blur whose weight from p to q is that from q to p, so that it loses light at the border.
Planes blur_widely(Planes planes) {
  const auto share_inside = [](int at, int size) {
    const int first = std::max(at - kWideRadius, 0), last = std::min(at + kWideRadius, size - 1);
    return float(last - first + 1) / float(2 * kWideRadius + 1);
  };
  for (int pass = 0; pass < 3; ++pass) {
    planes = box_blur(planes, kWideRadius);
    for_each_value(planes, [&](std::size_t i) {
      const int x = int(i % planes.width), y = int(i / planes.width % planes.height);
      planes.values[i] *= share_inside(x, planes.width) * share_inside(y, planes.height);
    });
  }
  return planes;
}

}  // namespace

void restore_light(const Noisy& noisy, Planes& denoised) {
  Planes error = box_blur(noisy.variance, kErrorRadius);
  for_each_value(error, [&](std::size_t i) {
    error.values[i] = std::min(std::sqrt(error.values[i]) * noisy.albedo.values[i],
                               kFullError * denoised.values[i]);
  });
  // Each pixel gives its light to those around it in proportion to their errors: with weights w,
  // light[q] = error[q] * sum over p of w[p][q] lost[p] / (sum over q of w[p][q] error[q]).
  const Planes errors_around = blur_widely(error);
  Planes share = noisy.color;
  for_each_value(share, [&](std::size_t i) {
    const float lost = noisy.color.values[i] - denoised.values[i];
    share.values[i] = errors_around.values[i] > 0 ? lost / errors_around.values[i] : 0;
  });
  share = blur_widely(std::move(share));
  for_each_value(denoised, [&](std::size_t i) {
    denoised.values[i] = std::max(denoised.values[i] + error.values[i] * share.values[i],
                                  std::min(noisy.color.values[i], 0.0f));
  });
}

}  // namespace oriel::denoising
