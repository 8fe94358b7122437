// SPDX-License-Identifier: Apache-2.0
// What has been seen so far of every pixel: means, variances and the number of samples.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vec.h"
#include "render/filter.h"

namespace oriel {

// Conventions
//   Row 0 is the top row. The film covers the window that is rendered; x and y count inside it.
//   Colours are linear and premultiplied; `display` is what lens shaders made of a sample.

/// What one sample brings to its pixel.
struct FilmSample {
  Rgb beauty{0};
  float alpha = 0;
  float depth = 0;  ///< scene units; 0 = nothing was hit, which does not count
  Vec3 normal{0};
  Rgb albedo{0};
  Rgb display{0};
  bool negative = false;  ///< fell where the pixel filter is negative
};

/// Running means of one pixel's samples. Means, because a float sum of 65536 equal values drifts
/// by up to .2 %, while their mean stays what they are.
struct PixelMeans {
  std::uint32_t samples = 0, hits = 0;
  Rgb beauty{0};
  Rgb beauty_m2{0};  ///< summed squared distances from the mean
  Rgb display{0};
  float alpha = 0, depth = 0;
  float level = 0, level_m2 = 0;  ///< brightness of what is shown, for the noise estimate
  Vec3 normal{0};
  Rgb albedo{0};

  /// Adds a sample; not a number and infinite colours count as black.
  /// Source: B. Welford, "Note on a Method for Calculating Corrected Sums of Squares and
  ///         Products", Technometrics 4(3), 1962.
  void add(const FilmSample& sample, bool mapped);
};

/// The pixels of a render in progress.
///
/// Model:   pixels are independent; different pixels may be written by different threads at once.
/// Checked: Film.* in film_test.cpp
class Film {
 public:
  /// Inputs:  filter: its shares weigh the samples; mapped: lens shaders fill in `display`, and
  ///          noise is judged there.
  Film(int width, int height, const FilterSampler& filter, bool mapped);

  int width() const { return width_; }
  int height() const { return height_; }
  bool mapped() const { return mapped_; }
  std::size_t pixel_count() const { return plain_.size(); }

  void add(int x, int y, const FilmSample& sample);

  std::uint32_t samples(int x, int y) const { return samples(index(x, y)); }
  std::uint32_t samples(std::size_t pixel) const {
    return plain_[pixel].samples + (marked_.empty() ? 0 : marked_[pixel].samples);
  }
  /// Mean number of samples of a pixel.
  double mean_samples() const;

  /// One pixel, filtered. The normal is not normalised (0 where there is none).
  struct Pixel {
    Rgba beauty{0, 0, 0, 0};
    Rgb display{0};
    Rgb variance{0};  ///< of the beauty's mean; 0 below two samples
    float depth = 0;  ///< mean over samples that hit something; 0 = none did
    Vec3 normal{0};
    Rgb albedo{0};
  };
  Pixel pixel(int x, int y) const;

  /// Brightness of what is shown (mean of three channels) and the standard error of it; the error
  /// is infinite below two samples.
  struct Level {
    float mean, error;
  };
  Level level(std::size_t pixel) const;

  /// The state as bytes go to a checkpoint and come back.
  const std::vector<PixelMeans>& plain() const { return plain_; }
  const std::vector<PixelMeans>& marked() const { return marked_; }
  std::vector<PixelMeans>& plain() { return plain_; }
  std::vector<PixelMeans>& marked() { return marked_; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  /// Weights of both kinds of samples in the pixel; they sum to 1.
  struct Shares {
    float plain, marked;
  };
  Shares shares(std::size_t pixel) const;

  int width_, height_;
  bool mapped_, clips_;
  float plain_share_, marked_share_;
  std::vector<PixelMeans> plain_;
  std::vector<PixelMeans> marked_;  ///< empty unless the filter has negative lobes
};

}  // namespace oriel
