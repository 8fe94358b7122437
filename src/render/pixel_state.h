// SPDX-License-Identifier: Apache-2.0
// Values of some pixels of a film in checkpoints.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace oriel {

/// Writes or reads the values of some pixels of arrays that have values for all pixels: a
/// CheckpointWriter or CheckpointReader for Film::visit_state().
template <class Checkpoint>
class PixelState {
 public:
  static constexpr bool kReads = Checkpoint::kReads;

  /// Inputs:  pixels: their indices, below `pixel_count`.
  PixelState(Checkpoint& checkpoint, const std::vector<std::uint32_t>& pixels,
             std::size_t pixel_count)
      : checkpoint_(checkpoint), pixels_(pixels), pixel_count_(pixel_count) {}

  template <class T>
  void array(std::vector<T>& values) {
    const std::size_t each = pixel_count_ > 0 ? values.size() / pixel_count_ : 0;
    std::vector<T> some(pixels_.size() * each);
    if constexpr (kReads) checkpoint_.array(some);
    for (std::size_t i = 0; i < pixels_.size(); ++i)
      for (std::size_t k = 0; k < each; ++k) {
        T& here = values[pixels_[i] * each + k];
        if constexpr (kReads)
          here = some[i * each + k];
        else
          some[i * each + k] = here;
      }
    if constexpr (!kReads) checkpoint_.array(some);
  }

 private:
  Checkpoint& checkpoint_;
  const std::vector<std::uint32_t>& pixels_;
  std::size_t pixel_count_;
};

}  // namespace oriel
