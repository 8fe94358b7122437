// SPDX-License-Identifier: Apache-2.0
#include "light_meter.h"

#include <algorithm>
#include <cmath>

#include "color/luminance.h"
#include "quick_look.h"

namespace oriel::app {

float metered_shutter(scene::Scene& scene, float f_number) {
  constexpr double kMeter = 12.5, kIso = 100;
  constexpr QuickLook kLook{.width = 96, .samples = 32, .seconds = 10};
  double sum = 0;
  int lit = 0;
  quick_look(scene, {}, kLook, [&](const QuickLookResult& look) {
    const Film& film = look.session.film();
    for (int y = 0; y < film.height(); ++y)
      for (int x = 0; x < film.width(); ++x) {
        const double value = luminance(rgb(film.pixel(x, y).beauty));
        if (!(value > 0) || !std::isfinite(value)) continue;
        sum += std::log(value);
        ++lit;
      }
  });
  if (lit == 0) return 0;
  const double shutter = std::exp(sum / lit) * kIso / (kMeter * f_number * f_number);
  return static_cast<float>(std::clamp(shutter, 1e-6, 1e6));
}

}  // namespace oriel::app
