// SPDX-License-Identifier: Apache-2.0
// The finest level of a texture file in memory, for look-ups without footprint.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "image/texture.h"

namespace oriel::oiio {

/// Decoded pixels, row after row from the top.
class KeptPixels {
 public:
  /// The size of 4096 x 2048 pixels with three channels. Larger pictures are not kept.
  static constexpr std::size_t kMostBytes = std::size_t{96} << 20;

  KeptPixels(int width, int height, int channels, std::vector<float> values)
      : width_(width), height_(height), channels_(channels), values_(std::move(values)) {}

  /// Interpolates bilinearly, as OpenImageIO does at its finest level.
  ///
  /// Inputs:  u, v: after wrapped(), v from the top; wrap_u, wrap_v: for texels beyond the border;
  ///          channels: number of values of `out`, at most those of the file.
  /// Checked: FileTexture.KeptPixelsGiveTheSameValues
  void sample(float u, float v, Wrap wrap_u, Wrap wrap_v, int channels, float* out) const;

 private:
  const float* texel(int x, int y) const {
    return &values_[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(x)) *
                    static_cast<std::size_t>(channels_)];
  }

  int width_, height_, channels_;
  std::vector<float> values_;
};

}  // namespace oriel::oiio
