// SPDX-License-Identifier: Apache-2.0
#include "light_meter.h"
#include "base/math.h"

#include <algorithm>
#include <cmath>

#include "color/luminance.h"
#include "quick_look.h"

namespace oriel::app {
namespace {

constexpr int kBlock = 8;  // pixels

/// Mean luminance of the finite pixels of a block; 0: there are none.
double block_mean(const Film& film, int left, int top) {
  double sum = 0;
  int seen = 0;
  for (int y = top; y < std::min(top + kBlock, film.height()); ++y)
    for (int x = left; x < std::min(left + kBlock, film.width()); ++x) {
      const double value = luminance(rgb(film.pixel(x, y).beauty));
      if (!std::isfinite(value)) continue;
      sum += std::max(value, 0.0);
      ++seen;
    }
  return seen > 0 ? sum / seen : 0;
}

}  // namespace

float metered_shutter(scene::Scene& scene, float f_number) {
  constexpr double kMeter = 12.5, kIso = 100;
  constexpr QuickLook kLook{.width = 96, .samples = 32, .seconds = 10};
  double sum = 0;
  int lit = 0;
  quick_look(scene, {}, kLook, [&](const QuickLookResult& look) {
    const Film& film = look.session.film();
    // Blocks, because light of rare paths makes single pixels black or far too bright.
    for (int top = 0; top < film.height(); top += kBlock)
      for (int left = 0; left < film.width(); left += kBlock) {
        const double value = block_mean(film, left, top);
        if (!(value > 0)) continue;
        sum += math::log(value);
        ++lit;
      }
  });
  if (lit == 0) return 0;
  const double shutter = math::exp(sum / lit) * kIso / (kMeter * f_number * f_number);
  return static_cast<float>(std::clamp(shutter, 1e-6, 1e6));
}

}  // namespace oriel::app
