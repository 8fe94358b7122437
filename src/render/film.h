// SPDX-License-Identifier: Apache-2.0
// What has been seen so far of every pixel: means, variances and the number of samples.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/vec.h"
#include "render/film_plane.h"
#include "render/filter.h"

namespace oriel {

// Conventions
//   Row 0 is the top row. The film covers the window that is rendered; x and y count inside it.
//   Colours are linear and premultiplied until they are mapped for display.

inline constexpr int kSubPixels = 16;  ///< parts of a pixel

/// The part of a pixel that a place falls into, by x and y of 0 to 1 over the reach of its filter.
///
/// Model:   a square grid turned by atan(1/3), cut at the pixel's sides: ten whole cells fit into
///          it, the rest are corners. No two cells begin at the same x or y, so that upright and
///          level edges pass them one by one.
/// Checked: Film.MappedEdgesHaveManyLevels
inline std::uint8_t sub_pixel_of(const Vec2& place) {
  const int across = std::clamp(static_cast<int>(std::floor(3 * place.x + place.y)), 0, 3);
  const int up = std::clamp(static_cast<int>(std::floor(3 * place.y - place.x)) + 1, 0, 3);
  return static_cast<std::uint8_t>(4 * across + up);
}

/// What one sample brings to its pixel.
struct FilmSample {
  Rgb beauty{0};
  float alpha = 0;
  float depth = 0;  ///< scene units; 0 = nothing was hit, which does not count
  Vec3 normal{0};
  Rgb albedo{0};
  float irradiance = 0;                ///< of what was hit, by luminance; pixel units times pi
  std::uint8_t sub_pixel = 0;          ///< see sub_pixel_of()
  bool negative = false;               ///< fell where the pixel filter is negative
  const PathRecord* record = nullptr;  ///< values of the planes; null = an empty record
};

/// Running means of one pixel's samples. Means, because a float sum of 65536 equal values drifts
/// by up to .2 %, while their mean stays what they are.
struct PixelMeans {
  std::uint32_t samples = 0, hits = 0;
  Rgb beauty{0};
  Rgb beauty_m2{0};  ///< summed squared distances from the mean
  Rgb second{0};     ///< mean of every other four samples: a half that has seen none of the rest
  float alpha = 0, depth = 0, irradiance = 0;
  Vec3 normal{0};
  Rgb albedo{0};

  /// Adds a sample; not a number and infinite colours count as black.
  /// Source: B. Welford, "Note on a Method for Calculating Corrected Sums of Squares and
  ///         Products", Technometrics 4(3), 1962.
  void add(const FilmSample& sample);
};

/// Mean colours of the parts of a pixel, kept where colours are mapped for display.
struct SubPixelMeans {
  std::array<std::uint16_t, kSubPixels> samples{};  ///< no more than fit are counted
  std::array<Rgb, kSubPixels> beauty = [] {
    std::array<Rgb, kSubPixels> black;
    black.fill(Rgb(0));
    return black;
  }();
  float m2 = 0;  ///< summed squared distances of brightness from the means of the parts
  void add(const FilmSample& sample);
};

/// Optional values of a film.
struct FilmRequest {
  bool aovs = false;
  SurfaceValues surface_values = {};
  std::size_t light_layers = 0;
  std::vector<PlaneRule> user_buffers = {};  ///< one for each buffer that shaders write
};

/// Maps a linear colour of pixel (x, y) for display, as lens shaders do.
using DisplayMap = std::function<Rgb(int x, int y, const Rgb& color)>;

/// The pixels of a render in progress.
///
/// Model:   pixels are independent; different pixels may be written by different threads at once.
///          Mapping for display acts on the mean colours of four quarters of a pixel, or of sixteen
///          parts where these differ by more than noise makes them, as at edges; the pixel is the
///          mean of that. Mapping every sample, as renderers do whose samples are smooth,
///          would darken a path-traced picture for good: most paths find no light, few find much,
///          and a curve that compresses takes it from the few. Mapping whole pixels would leave
///          edges of bright things jagged (ADR 6).
/// Source:  the test for differences: R. Fisher, "Statistical Methods for Research Workers", 1925
///          (analysis of variance).
/// Checked: Film.* in film_test.cpp
class Film {
 public:
  /// Inputs:  filter: its shares weigh the samples; map: empty = colours are shown as they are.
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

  void add(int x, int y, const FilmSample& sample);
  /// Removes all samples.
  void clear();

  std::uint32_t samples(int x, int y) const { return samples(index(x, y)); }
  std::uint32_t samples(std::size_t pixel) const {
    return positive_[pixel].samples + (negative_.empty() ? 0 : negative_[pixel].samples);
  }
  /// Mean number of samples of a pixel.
  double mean_samples() const;

  /// One pixel, filtered. The normal is not normalised (0 where there is none).
  struct Pixel {
    Rgba beauty{0, 0, 0, 0};
    Rgb variance{0};          ///< of the beauty's mean; 0 below two samples
    Rgb split_difference{0};  ///< half of (mean of one half of the samples - mean of the other)
    float depth = 0;          ///< mean over samples that hit something; 0 = none did
    float irradiance = 0;     ///< likewise
    Vec3 normal{0};
    Rgb albedo{0};
  };
  Pixel pixel(int x, int y) const;
  /// Its parts, filtered as the beauty is; their results sum to it.
  AovValues outputs(int x, int y) const;
  /// The beauty by a layer of lights, filtered as the beauty is; all layers sum to it.
  Rgb light(int x, int y, std::size_t layer) const;
  /// A user's buffer: filtered as the beauty is, though never clipped; or what the first sample
  /// left there.
  Rgba user_buffer(int x, int y, std::size_t buffer) const;
  /// Of the first sample's first surface; 0 where it is not stored.
  Vec3 surface_value(int x, int y, SurfaceValue value) const;
  /// Whether any pixel of it holds anything but 0.
  bool is_written(std::size_t buffer) const;

  /// The colour that is looked at: mapped, where there is a map; else the beauty.
  Rgb shown(int x, int y) const;

  /// What is shown of a pixel whose noise has been taken out of `color`: where quadrants differ by
  /// more than noise does, as at edges, they do so around the new colour.
  Rgb shown(int x, int y, const Rgb& color) const;

  using Shares = FilterShares;
  Shares shares_of(int x, int y) const { return shares(index(x, y)); }

  /// Whether every pixel has two halves of samples, of four at least.
  bool has_split_samples() const;

  /// Brightness of what is shown (mean of three channels) and the standard error of it, which for
  /// mapped colours is how far the map moves when the colour moves by its error. The error is
  /// infinite below two samples.
  struct Estimate {
    float mean, error;
  };
  Estimate estimate(std::size_t pixel) const;

  const std::vector<PixelMeans>& positive() const { return positive_; }

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
  /// A mean and how many samples it is of; 0 = none.
  struct Part {
    Rgb color{0};
    float samples = 0;
  };
  Part part(std::size_t pixel, std::size_t cell) const;
  /// All parts, the quarters that they form, and how parts spread.
  struct Parts {
    std::array<Part, kSubPixels> all;
    std::array<Part, 4> quarters;
    Rgb mean{0};
    float samples = 0;
    float spread = 0;  ///< mean squared distance of brightness from the mean
    float noise = 0;   ///< what that would be if the parts were alike
    /// How far parts are mapped separately: 0 where they spread `alike` times as much
    /// as noise makes them, 1 from `apart` times on.
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
