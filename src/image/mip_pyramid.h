// SPDX-License-Identifier: Apache-2.0
// A picture in memory with its coarser levels, and filtered look-ups in it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"
#include "image/texture.h"

namespace oriel {

/// Size and storage of a picture.
struct PictureFormat {
  int width = 0, height = 0;
  int channels = 0;        ///< 1 to 4
  int alpha_channel = -1;  ///< -1: none
  bool bytes = false;      ///< stored as bytes, which a pyramid decodes, else as decoded floats
  float gamma = 1;         ///< decoded values are value^gamma, except alpha
};

/// Converts values to a colour. Inputs:  channels: 1 = grey, 2 = grey and alpha, 3 = RGB, 4 = RGB
/// and alpha.
inline Rgba color_of_channels(const float* c, int channels) {
  switch (channels) {
    case 1:
      return Rgba(c[0], c[0], c[0], 1);
    case 2:
      return Rgba(c[0], c[0], c[0], c[1]);
    case 3:
      return Rgba(c[0], c[1], c[2], 1);
    default:
      return Rgba(c[0], c[1], c[2], c[3]);
  }
}

/// Levels of a picture, each half as large as the one before.
///
/// Model:   box-filtered. The shorter axis of a footprint selects two levels, which are
///          interpolated, and up to `anisotropy` probes lie along the longer axis. Bytes are exact;
///          the coarser levels of bytes are halves, with a relative error of 2^-11.
/// Checked: MemoryTexture.*, TextureTest.*, FileTexture.*
class MipPyramid {
 public:
  /// Memory of all levels.
  static std::uint64_t bytes_of(const PictureFormat& format);

  /// With values of 0; fill all rows, then build().
  explicit MipPyramid(const PictureFormat& format);
  MipPyramid(const MipPyramid&) = delete;
  MipPyramid& operator=(const MipPyramid&) = delete;
  /// The values of a row of the finest level: bytes, or floats. Inputs:  y: 0 at the bottom.
  std::span<std::uint8_t> bytes_of_row(int y);
  std::span<float> floats_of_row(int y);
  /// Computes the coarser levels.
  void build();

  /// As Texture::sample().
  Rgba sample(const Vec2& uv, const TextureFootprint& footprint, const TextureSampling& how) const;

 private:
  enum class Storage : std::uint8_t { Bytes, Halves, Floats };
  struct Level {
    int width, height;
    Storage storage;
    std::vector<std::byte> data;  // with a few bytes more, since four channels are read at once
  };
  using Float4 = float __attribute__((vector_size(16)));

  static std::size_t size_of(Storage storage);
  static Level make_level(int width, int height, int channels, Storage storage);
  template <class T>
  std::span<T> row(int y);
  void set(Level& level, std::size_t texel, const Float4& values) const;
  /// Calls f with the storage of the level as a constant.
  template <class F>
  static auto with_storage(const Level& level, F&& f);
  template <Storage S>
  void halve(const Level& fine, Level& coarse) const;
  template <Storage S>
  Float4 texel(const Level& level, std::size_t index) const;
  template <Storage S>
  Float4 bilinear(const Level& level, float u, float v, const TextureSampling& how) const;
  Float4 bilinear(const Level& level, float u, float v, const TextureSampling& how) const;
  Float4 nearest(const Level& level, float u, float v, const TextureSampling& how) const;
  Float4 trilinear(float u, float v, float level, const TextureSampling& how) const;

  PictureFormat format_;
  std::array<float, 256> linear_, decoded_;
  std::array<const float*, 4> of_byte_;  ///< the table of each channel
  std::vector<Level> levels_;
};

}  // namespace oriel
