// SPDX-License-Identifier: Apache-2.0
// Values per pixel that the film stores beside the beauty, such as AOVs and user buffers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "transport/path/path_record.h"

namespace oriel {

/// How the samples of a pixel make one value.
enum class PlaneRule : std::uint8_t { Mean, FirstSample };

/// Weights of positive and negative filter samples in a pixel; they sum to 1.
struct FilterShares {
  float positive, negative;
};

/// One or more values per pixel, each of up to four channels.
///
/// Model:   running means like those of PixelMeans, apart for positive and negative filter samples;
///          or the value of the first sample. A value with an infinite or undefined channel counts
///          as 0.
/// Checked: Film.* in film_test.cpp
class FilmPlane {
 public:
  struct Spec {
    int channels = 3;
    std::size_t values = 1;  ///< per pixel
    PlaneRule rule = PlaneRule::Mean;
    float initial = 0;  ///< before the first sample
    /// Light and factors of it: samples whose beauty is not finite count as empty records.
    bool of_beauty = false;
    /// Where a record has the values; null = it has none, which counts as 0.
    const float* (*source)(const PathRecord& record, std::size_t index) = nullptr;
    std::size_t index = 0;  ///< passed to `source`
  };

  /// Inputs:  negative_pixels: 0 unless the filter has negative lobes.
  FilmPlane(const Spec& spec, std::size_t pixels, std::size_t negative_pixels);

  const Spec& spec() const { return spec_; }
  /// Inputs:  samples: of this kind in the pixel, with this one. first: no sample of either kind
  ///          came before.
  void add(std::size_t pixel, bool negative, std::uint32_t samples, bool first,
           const PathRecord& record);
  void clear();
  /// Writes the channels of one value.
  void read(std::size_t pixel, std::size_t value, const FilterShares& shares, float* to) const;
  /// Whether any value is not 0.
  bool is_written() const;
  std::size_t bytes() const { return (positive_.size() + negative_.size()) * sizeof(float); }

  /// Writes or reads the values, see Film.
  template <class Checkpoint>
  void visit_state(Checkpoint& checkpoint) {
    checkpoint.array(positive_);
    checkpoint.array(negative_);
  }
  bool is_finite() const;

 private:
  std::size_t width() const { return spec_.values * static_cast<std::size_t>(spec_.channels); }

  Spec spec_;
  std::vector<float> positive_, negative_;
};

}  // namespace oriel
