// SPDX-License-Identifier: Apache-2.0
#include "transport/path/pilot_paths.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

#include "base/parallel.h"
#include "color/luminance.h"

namespace oriel {
namespace {

constexpr std::size_t kPixelsOfGroup = 64;
/// Noise is relative to the light of a pixel, which the middle of its four means gives, but at
/// least to a share of that of its block and of that of all. Where most paths miss the light, the
/// middle is too dark. The mean of a block leaves out its brightest pixels, of which some may be
/// lamps.
constexpr float kShareOfBlock = 0.5f, kShareOfAll = 0.03f;
constexpr int kBlocksOnASide = 8;
constexpr double kKeptOfBlock = 0.9;
/// The result where only one choice has noise.
constexpr float kMostRatio = 256;
/// Share of the pixels that noise is computed from; those with the largest differences are left
/// out, so that a few do not decide.
constexpr double kKeptShare = 0.99;
/// Light that only the others have in the kept pixels is in the few that were left out, where it is
/// noise: of its square divided by their share, at least. It counts from so many standard errors
/// on.
constexpr double kCertain = 2;
/// Cost of a shadow ray in rays of paths, which are followed by the shading of a surface.
constexpr double kShadowCost = 0.5;
/// Samples of a pixel are stratified, which reduces the noise of some settings more than that of
/// others.
constexpr std::uint32_t kSamplesOfMean = kPilotPathsOfPixel / 2;

double cost_of(const RayCounts& counts) {
  return static_cast<double>(counts.eye + counts.reflect + counts.refract + counts.gather) +
         kShadowCost * static_cast<double>(counts.shadow);
}

float ratio_of(double own, double of_others) {
  return own > 0 ? static_cast<float>(of_others / own) : of_others > 0 ? kMostRatio : 1.0f;
}

float mean_of_darkest(std::vector<float>& block) {
  if (block.empty()) return 0;
  std::sort(block.begin(), block.end());
  block.resize(
      static_cast<std::size_t>(std::ceil(kKeptOfBlock * static_cast<double>(block.size()))));
  return std::accumulate(block.begin(), block.end(), 0.0f) / static_cast<float>(block.size());
}

}  // namespace

PilotPaths::Pixel PilotPaths::trace(const World& world, const Window& window,
                                    const PathSettings& settings, std::uint32_t pixel,
                                    std::uint32_t seed, RayCounts& counts) {
  Pixel result;
  sampling::Sampler place(1, 0, pixel, seed);
  const Vec2 u = place.next_2d();
  const auto place_of = [](float u, int from, int size) {
    return std::floor(static_cast<float>(from) + u * static_cast<float>(size));
  };
  const Vec2 corner(place_of(u.x, window.x0, window.width()),
                    place_of(u.y, window.y0, window.height()));
  for (std::uint32_t i = 0; i < 2; ++i)
    for (std::uint32_t sample = 0; sample < kSamplesOfMean; ++sample) {
      sampling::Sampler sampler(static_cast<int>(pixel), static_cast<int>(i), sample, seed);
      const Vec2 raster = corner + sampler.next_2d();
      const PathResult path =
          trace_path(world, world.camera.ray(raster), raster, settings, sampler, counts);
      if (std::isfinite(luminance(path.radiance)))
        result.means[i] += path.radiance / kSamplesOfMean;
    }
  const auto block_of = [](float u) {
    return std::min(static_cast<std::size_t>(u * kBlocksOnASide), std::size_t{kBlocksOnASide - 1});
  };
  result.block = block_of(u.y) * kBlocksOnASide + block_of(u.x);
  return result;
}

PilotPaths::PilotPaths(const World& world, const Window& window, const PathSettings& settings,
                       std::uint32_t seed, RayCounts& counts, std::size_t pixels) {
  if (window.width() <= 0 || window.height() <= 0) return;
  pixels -= pixels % kPixelsOfGroup;
  pixels_.resize(pixels);
  std::vector<RayCounts> traced(pixels / kPixelsOfGroup);
  parallel_for(traced.size(), [&](std::size_t group) {
    for (std::size_t i = group * kPixelsOfGroup; i < (group + 1) * kPixelsOfGroup; ++i)
      pixels_[i] =
          trace(world, window, settings, static_cast<std::uint32_t>(i), seed, traced[group]);
  });
  for (const RayCounts& of_group : traced) {
    counts += of_group;
    cost_ += cost_of(of_group);
  }
}

std::vector<Rgb> PilotPaths::levels(const PilotPaths& a, const PilotPaths& b) {
  std::vector<Rgb> levels(a.pixels_.size(), Rgb(0));
  for (int c = 0; c < 3; ++c) {
    std::array<std::vector<float>, kBlocksOnASide * kBlocksOnASide> blocks;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      std::array means{std::abs(a.pixels_[i].means[0][c]), std::abs(a.pixels_[i].means[1][c]),
                       std::abs(b.pixels_[i].means[0][c]), std::abs(b.pixels_[i].means[1][c])};
      std::sort(means.begin(), means.end());
      levels[i][c] = (means[1] + means[2]) / 2;
      blocks[a.pixels_[i].block].push_back((means[0] + means[1] + means[2] + means[3]) / 4);
    }
    double of_all = 0;  // double: thousands of terms
    std::array<float, kBlocksOnASide * kBlocksOnASide> least{};
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      of_all += std::accumulate(blocks[i].begin(), blocks[i].end(), 0.0);
      least[i] = kShareOfBlock * mean_of_darkest(blocks[i]);
    }
    const float of_pixel = static_cast<float>(of_all) / static_cast<float>(levels.size());
    for (std::size_t i = 0; i < levels.size(); ++i)
      levels[i][c] = std::max({levels[i][c], least[a.pixels_[i].block], kShareOfAll * of_pixel});
  }
  return levels;
}

double PilotPaths::noise(const std::vector<Rgb>& levels, const PilotPaths& others) const {
  struct OfPixel {
    double noise = 0, missing = 0;  ///< missing: light that the others have
  };
  std::vector<OfPixel> of_pixels(pixels_.size());
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const Rgb difference = pixels_[i].means[0] - pixels_[i].means[1];
    const Rgb missing = (others.pixels_[i].means[0] + others.pixels_[i].means[1] -
                         pixels_[i].means[0] - pixels_[i].means[1]) /
                        2.0f;
    for (int c = 0; c < 3; ++c) {
      if (!(levels[i][c] > 0)) continue;
      const double noise = static_cast<double>(difference[c] / levels[i][c]);
      of_pixels[i].noise += noise * noise / 3;
      of_pixels[i].missing += static_cast<double>(missing[c] / levels[i][c]) / 3;
    }
  }
  std::sort(of_pixels.begin(), of_pixels.end(),
            [](const OfPixel& a, const OfPixel& b) { return a.noise < b.noise; });
  of_pixels.resize(
      static_cast<std::size_t>(std::ceil(kKeptShare * static_cast<double>(of_pixels.size()))));
  const double n = static_cast<double>(of_pixels.size());
  double noise = 0, missing = 0, squares = 0;
  for (const OfPixel& pixel : of_pixels) {
    noise += pixel.noise / n;
    missing += pixel.missing / n;
    squares += pixel.missing * pixel.missing / n;
  }
  const double error = std::sqrt(std::max(squares - missing * missing, 0.0) / n);
  const double certain = std::max(missing - kCertain * error, 0.0);
  return noise + certain * certain / (1 - kKeptShare);
}

double PilotPaths::noise_of_path() const {
  // The difference of two means has twice their variance.
  return noise(levels(*this, *this), *this) * (kSamplesOfMean / 2.0);
}

PilotComparison PilotPaths::compare_finds(const PilotPaths& others) const {
  if (pixels_.empty()) return {};
  const std::vector<Rgb> light = levels(*this, others);
  double found = 0;
  for (std::size_t i = 0; i < pixels_.size(); ++i) {
    const auto by_chance = [&](std::size_t k) {
      return others.pixels_[i].means[k] - pixels_[i].means[k];
    };
    const Rgb difference = by_chance(0) - by_chance(1);
    for (int c = 0; c < 3; ++c)
      if (light[i][c] > 0) found += static_cast<double>(sqr(difference[c] / light[i][c])) / 3;
  }
  found /= static_cast<double>(pixels_.size());
  const double own = noise(light, *this);
  return {ratio_of(own, own + found), ratio_of(cost_, others.cost_)};
}

PilotComparison PilotPaths::compare(const PilotPaths& others) const {
  if (pixels_.empty()) return {};
  const std::vector<Rgb> light = levels(*this, others);
  return {ratio_of(noise(light, others), others.noise(light, *this)),
          ratio_of(cost_, others.cost_)};
}

}  // namespace oriel
