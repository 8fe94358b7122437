// SPDX-License-Identifier: Apache-2.0
// Small pictures by paths and how far they are from what is right, for benches of noise.
#pragma once

#include <cstdint>
#include <vector>

#include "base/parallel.h"
#include "color/luminance.h"
#include "runtime/world.h"
#include "transport/path/path.h"

namespace oriel::bench {

/// Radiance, row after row of the camera's picture.
using Picture = std::vector<Rgb>;

inline Picture path_picture(const World& world, int samples, std::uint32_t seed,
                            const PathSettings& settings = {}) {
  const int width = world.camera.width, height = world.camera.height;
  Picture picture(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Rgb(0));
  parallel_for(static_cast<std::size_t>(height), [&](std::size_t line) {
    RayCounts counts;
    const int y = static_cast<int>(line);
    for (int x = 0; x < width; ++x)
      for (int s = 0; s < samples; ++s) {
        sampling::Sampler sampler(x, y, static_cast<std::uint32_t>(s), seed);
        const Vec2 raster = Vec2(static_cast<float>(x), static_cast<float>(y)) + sampler.next_2d();
        picture[line * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] +=
            trace_path(world, world.camera.ray(raster), raster, settings, sampler, counts)
                .radiance /
            static_cast<float>(samples);
      }
  });
  return picture;
}

inline double mean_luminance(const Picture& picture) {
  double sum = 0;
  for (const Rgb& c : picture) sum += static_cast<double>(luminance(c));
  return sum / static_cast<double>(picture.size());
}

/// Mean over pixels of the squared error by the square of what is right; pixels of less than a
/// hundredth of the mean count as that bright.
inline double relative_error(const Picture& a, const Picture& exact) {
  const double mean = mean_luminance(exact);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double e = static_cast<double>(luminance(exact[i]));
    const double d = static_cast<double>(luminance(a[i])) - e;
    sum += d * d / (e * e + 1e-4 * mean * mean);
  }
  return sum / static_cast<double>(a.size());
}

}  // namespace oriel::bench
