// SPDX-License-Identifier: Apache-2.0
#include "render/film_plane.h"

#include <algorithm>
#include <cmath>

namespace oriel {

FilmPlane::FilmPlane(const Spec& spec, std::size_t pixels, std::size_t negative_pixels)
    : spec_(spec),
      positive_(pixels * width(), spec.initial),
      negative_(spec.rule == PlaneRule::Mean ? negative_pixels * width() : 0, spec.initial) {}

void FilmPlane::add(std::size_t pixel, bool negative, std::uint32_t samples, bool first,
                    const PathRecord& record) {
  if (spec_.rule == PlaneRule::FirstSample && !first) return;
  const bool to_negative = negative && !negative_.empty();
  float* mean = &(to_negative ? negative_ : positive_)[pixel * width()];
  const float* sample = spec_.source(record, spec_.index);
  const bool is_mean = spec_.rule == PlaneRule::Mean;
  const float share = 1 / static_cast<float>(samples);
  const auto is_number = [](float x) { return std::isfinite(x); };
  for (std::size_t i = 0; i < spec_.values; ++i) {
    const bool known = sample && std::all_of(sample, sample + spec_.channels, is_number);
    for (int c = 0; c < spec_.channels; ++c) {
      const float value = known ? sample[c] : 0;
      mean[c] = is_mean ? mean[c] + (value - mean[c]) * share : value;
    }
    mean += spec_.channels;
    if (sample) sample += spec_.channels;
  }
}

void FilmPlane::clear() {
  std::fill(positive_.begin(), positive_.end(), spec_.initial);
  std::fill(negative_.begin(), negative_.end(), spec_.initial);
}

void FilmPlane::read(std::size_t pixel, std::size_t value, const FilterShares& shares,
                     float* to) const {
  const std::size_t at = pixel * width() + value * static_cast<std::size_t>(spec_.channels);
  const float weight = spec_.rule == PlaneRule::Mean ? shares.positive : 1;
  for (std::size_t c = 0; c < static_cast<std::size_t>(spec_.channels); ++c) {
    to[c] = positive_[at + c] * weight;
    if (!negative_.empty()) to[c] += negative_[at + c] * shares.negative;
  }
}

bool FilmPlane::is_written() const {
  const auto holds = [](const std::vector<float>& values) {
    return std::any_of(values.begin(), values.end(), [](float x) { return x != 0; });
  };
  return holds(positive_) || holds(negative_);
}

bool FilmPlane::is_finite() const {
  const auto finite = [](const std::vector<float>& values) {
    return std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
  };
  return finite(positive_) && finite(negative_);
}

}  // namespace oriel
