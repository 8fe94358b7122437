// SPDX-License-Identifier: Apache-2.0
// The pixels of a render in progress: means, variances and numbers of samples.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/vec.h"
#include "render/film_plane.h"
#include "render/filter.h"

namespace oriel {

// Conventions
//   Row 0 is the top row. The film covers the window that is rendered; x and y count inside it.
//   Colours are linear and premultiplied until they are mapped for display.

inline constexpr int kSubPixels = 16;                 ///< parts of a pixel
inline constexpr std::uint32_t kMinSplitSamples = 8;  ///< two halves of four samples

/// The part of a pixel that contains a point, given by x and y in 0..1 over the extent of its
/// filter.
///
/// Model:   a square grid rotated by atan(1/3) and clipped to the pixel: ten whole cells, the
///          others are corners. No two cells start at the same x or y, so vertical and horizontal
///          edges cross them one by one.
/// Checked: Film.MappedEdgesHaveManyLevels
inline std::uint8_t sub_pixel_of(const Vec2& place) {
  const int across = std::clamp(static_cast<int>(std::floor(3 * place.x + place.y)), 0, 3);
  const int up = std::clamp(static_cast<int>(std::floor(3 * place.y - place.x)) + 1, 0, 3);
  return static_cast<std::uint8_t>(4 * across + up);
}

/// Light from a part of a pixel.
struct PartSample {
  std::uint8_t sub_pixel = 0;  ///< see sub_pixel_of()
  Rgb beauty{0};
};

/// The values of one sample.
struct FilmSample {
  Rgb beauty{0};
  float alpha = 0;
  float depth = 0;  ///< scene units; 0 = no hit, not part of the mean
  Vec3 normal{0};
  Rgb albedo{0};
  float irradiance = 0;                ///< of the first surface, luminance; pixel units times pi
  std::uint8_t sub_pixel = 0;          ///< see sub_pixel_of()
  std::span<const PartSample> parts;   ///< if it looked at several parts: instead of sub_pixel
  bool negative = false;               ///< the pixel filter is negative there
  const PathRecord* record = nullptr;  ///< values of the planes; null = an empty record
};

/// Running means of one pixel's samples. A float sum of 65536 equal values drifts by up to .2 %;
/// their running mean is exact.
struct PixelMeans {
  std::uint32_t samples = 0, hits = 0;
  Rgb beauty{0};
  Rgb beauty_m2{0};  ///< summed squared distances from the mean
  Rgb second{0};     ///< mean of every other block of four samples
  /// Mean brightness of the first 2^k samples, 2^(k-1) and 2^(k-2), where 2^k is the largest power
  /// within `samples`.
  std::array<float, 3> at_powers{};
  float alpha = 0, depth = 0, irradiance = 0;
  Vec3 normal{0};
  Rgb albedo{0};

  /// Adds a sample; colours that are not finite count as black.
  /// Source: B. Welford, "Note on a Method for Calculating Corrected Sums of Squares and
  ///         Products", Technometrics 4(3), 1962.
  void add(const FilmSample& sample);
};

/// Mean colours of the parts of a pixel; stored if colours are mapped for display.
struct SubPixelMeans {
  std::array<std::uint16_t, kSubPixels> samples{};  ///< saturated
  std::array<Rgb, kSubPixels> beauty = [] {
    std::array<Rgb, kSubPixels> black;
    black.fill(Rgb(0));
    return black;
  }();
  float m2 = 0;  ///< summed squared distances of brightness from the means of the parts
  void add(const PartSample& sample);
};

/// Optional values of a film.
struct FilmRequest {
  bool aovs = false;
  SurfaceValues surface_values = {};
  std::size_t light_layers = 0;
  std::vector<PlaneRule> user_buffers = {};  ///< one per user buffer
};

/// Maps a linear colour of pixel (x, y) for display by the lens shaders.
using DisplayMap = std::function<Rgb(int x, int y, const Rgb& color)>;

/// The pixels of a render in progress.
///
/// Model:   pixels are independent; different pixels may be written by different threads at once.
///          The display map is applied to the mean colours of four quarters of a pixel, or of
///          sixteen parts if these differ by more than noise, as at edges; the pixel is the mean of
///          the results. Mapping every sample would darken a path-traced picture permanently: few
///          paths carry most of the light, and a compressive curve reduces these. Mapping whole
///          pixels would alias the edges of bright objects (ADR 6).
/// Source:  the test for differences: R. Fisher, "Statistical Methods for Research Workers", 1925
///          (analysis of variance).
/// Checked: Film.* in film_test.cpp
class Film {
 public:
  /// Inputs:  filter: weights of positive and negative samples; map: empty = no mapping.
  Film(int width, int height, const FilterSampler& filter, DisplayMap map = {},
       FilmRequest request = {});

  int width() const { return width_; }
  int height() const { return height_; }
  bool keeps_outputs() const { return request_.aovs; }
  SurfaceValues surface_values() const { return request_.surface_values; }
  bool stores(SurfaceValue value) const {
    return request_.surface_values[static_cast<std::size_t>(value)];
  }
  std::size_t light_layers() const { return request_.light_layers; }
  std::size_t user_buffers() const { return request_.user_buffers.size(); }
  bool mapped() const { return static_cast<bool>(map_); }
  std::size_t pixel_count() const { return positive_.size(); }
  std::size_t bytes() const;  ///< memory of the pixels

  void add(int x, int y, const FilmSample& sample);
  /// Removes all samples.
  void clear();

  std::uint32_t samples(int x, int y) const { return samples(index(x, y)); }
  std::uint32_t samples(std::size_t pixel) const {
    return positive_[pixel].samples + (negative_.empty() ? 0 : negative_[pixel].samples);
  }
  /// Mean number of samples of a pixel.
  double mean_samples() const;

  /// One pixel, filtered. The normal is not normalised; 0 = none.
  struct Pixel {
    Rgba beauty{0, 0, 0, 0};
    Rgb variance{0};          ///< of the beauty's mean; 0 below two samples
    Rgb split_difference{0};  ///< half of (mean of one half of the samples - mean of the other)
    float depth = 0;          ///< mean over samples with a hit; 0 = none
    float irradiance = 0;     ///< the same
    Vec3 normal{0};
    Rgb albedo{0};
  };
  Pixel pixel(int x, int y) const;
  /// The AOVs of a pixel, filtered like the beauty; their results sum to it.
  AovValues outputs(int x, int y) const;
  /// The beauty of a light layer, filtered like the beauty; all layers sum to it.
  Rgb light(int x, int y, std::size_t layer) const;
  /// A user buffer: filtered like the beauty but not clipped, or the value of the first sample.
  Rgba user_buffer(int x, int y, std::size_t buffer) const;
  /// A value of the first surface of the first sample; 0 if not stored.
  Vec3 surface_value(int x, int y, SurfaceValue value) const;
  /// Whether any pixel of the buffer is not 0.
  bool is_written(std::size_t buffer) const;

  /// The colour for display: mapped if there is a map, else the beauty.
  Rgb shown(int x, int y) const;

  /// The colour for display of a pixel with the denoised mean `color`. Quarters that differ by more
  /// than noise, as at edges, keep their differences from the mean.
  Rgb shown(int x, int y, const Rgb& color) const;

  using Shares = FilterShares;
  Shares shares_of(int x, int y) const { return shares(index(x, y)); }

  /// Whether every pixel has kMinSplitSamples.
  bool has_split_samples() const;

  /// Brightness for display (mean of three channels) and its standard error; for mapped colours the
  /// change of the mapped colour if the colour changes by its error. The error is infinite below
  /// two samples.
  struct Estimate {
    float mean = 0, error = 0;
    /// Change of the shown brightness when the number of samples was last doubled, and at the
    /// doubling before: an error that depends on nothing but luck, while the standard error is low
    /// where rare samples are missing, and high where samples are spread evenly. The first is the
    /// standard error, the second 0 below kMinSplitSamples.
    float doubling = 0, doubling_before = 0;
  };
  Estimate estimate(std::size_t pixel) const;

  const std::vector<PixelMeans>& positive() const { return positive_; }

  /// Writes all pixels to a CheckpointWriter, or reads them from a CheckpointReader into a film of
  /// the same settings.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    checkpoint.array(positive_), checkpoint.array(negative_);
    checkpoint.array(positive_parts_), checkpoint.array(negative_parts_);
    for (FilmPlane& plane : planes_) plane.visit_state(checkpoint);
  }
  /// Whether all values are finite and no pixel has more than `most` samples; of a film that was
  /// read.
  bool is_valid(std::uint32_t most) const;

 private:
  void add_planes();
  void clip(std::size_t pixel, Rgb& part) const;
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  Shares shares(std::size_t pixel) const;
  Rgb color(std::size_t pixel) const;
  Rgb color_error(std::size_t pixel) const;
  Rgb split_difference(std::size_t pixel) const;
  /// A mean and its number of samples; 0 = none.
  struct Part {
    Rgb color{0};
    float samples = 0;
  };
  Part part(std::size_t pixel, std::size_t cell) const;
  /// All parts, the quarters that they form, and the variance between parts.
  struct Parts {
    std::array<Part, kSubPixels> all;
    std::array<Part, 4> quarters;
    Rgb mean{0};
    float samples = 0;
    float spread = 0;  ///< mean squared distance of brightness from the mean
    float noise = 0;   ///< its expected value if the parts were equal
    /// Weight of mapping the parts separately: 0 if the spread is `alike` times the noise, 1 from
    /// `apart` times on.
    float kept(float alike, float apart) const;
  };
  Parts parts(std::size_t pixel) const;

  int width_, height_;
  bool clips_;
  float positive_share_, negative_share_;
  std::vector<PixelMeans> positive_;
  std::vector<PixelMeans> negative_;  ///< empty unless the filter has negative lobes
  DisplayMap map_;
  FilmRequest request_;
  std::vector<FilmPlane> planes_;  ///< in the order of add_planes()
  std::size_t light_plane_ = 0, buffer_plane_ = 0;
  std::array<std::size_t, kSurfaceValues> surface_planes_{};
  std::vector<SubPixelMeans> positive_parts_, negative_parts_;  ///< empty without a map
};

}  // namespace oriel
