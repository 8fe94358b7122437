// SPDX-License-Identifier: Apache-2.0
// Pixels of an image file by rows and tiles: read in this process or in a reader process.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

namespace oriel {

/// Size and pixel type of one picture of a file (a MIP level of a subimage).
struct PixelLevel {
  std::int32_t x = 0, y = 0, width = 0, height = 0;
  std::int32_t full_x = 0, full_y = 0, full_width = 0, full_height = 0;
  std::int32_t tile_width = 0, tile_height = 0;  ///< 0 = rows
  std::int32_t strip_rows = 0;                   ///< rows that are stored together; 0 = unknown
  std::int32_t channels = 0, alpha_channel = -1;
  std::int32_t type = 0;  ///< OIIO::TypeDesc::BASETYPE: an integer, half, float or double
  std::int32_t type_bytes = 0;

  std::size_t pixel_bytes() const {
    return static_cast<std::size_t>(channels) * static_cast<std::size_t>(type_bytes);
  }
  std::size_t row_bytes() const { return static_cast<std::size_t>(width) * pixel_bytes(); }
  std::size_t tile_bytes() const {
    return static_cast<std::size_t>(tile_width) * static_cast<std::size_t>(tile_height) *
           pixel_bytes();
  }
};

/// The pictures of one file. Not thread-safe.
class PixelSource {
 public:
  virtual ~PixelSource() = default;

  /// False if there is no such picture.
  virtual bool level(int subimage, int miplevel, PixelLevel& level) = 0;
  /// Rows y_begin to y_end, of the data window. False on errors.
  virtual bool rows(int subimage, int miplevel, int y_begin, int y_end,
                    std::span<std::byte> out) = 0;
  /// The tile with the corner (x, y).
  virtual bool tile(int subimage, int miplevel, int x, int y, std::span<std::byte> out) = 0;
  /// The last error.
  virtual std::string error() const = 0;
};

/// Throws std::runtime_error with the reason only.
using PixelSourceOpener = std::function<std::unique_ptr<PixelSource>(const std::string& path)>;

}  // namespace oriel
