// SPDX-License-Identifier: Apache-2.0
#include "image/oiio/read_picture.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <span>
#include <stdexcept>
#include <vector>

#include "image/oiio/texture_input.h"

namespace oriel::oiio {
namespace {

/// Reads the finest level in strips, as the file stores them: rows of tiles, or some rows.
class StripReader {
 public:
  StripReader(PixelSource& source, const PixelLevel& level)
      : source_(source),
        level_(level),
        tiled_(level.tile_width > 0 && level.tile_height > 0),
        rows_(tiled_ ? level.tile_height : kRows),
        strip_(level.row_bytes() * static_cast<std::size_t>(rows_)),
        tile_(tiled_ ? level.tile_bytes() : 0) {}

  int rows() const { return rows_; }
  /// Rows y_begin to y_end; y_begin is a multiple of rows().
  std::span<const std::byte> read(int y_begin, int y_end) {
    if (!tiled_) {
      check(source_.rows(0, 0, y_begin, y_end, strip_));
      return strip_;
    }
    const auto tile_row = level_.pixel_bytes() * static_cast<std::size_t>(level_.tile_width);
    for (int x = 0; x < level_.width; x += level_.tile_width) {
      check(source_.tile(0, 0, x, y_begin, tile_));
      const int width = std::min(level_.tile_width, level_.width - x);
      for (int y = 0; y < y_end - y_begin; ++y)
        std::memcpy(&strip_[static_cast<std::size_t>(y) * level_.row_bytes() +
                            static_cast<std::size_t>(x) * level_.pixel_bytes()],
                    &tile_[static_cast<std::size_t>(y) * tile_row],
                    static_cast<std::size_t>(width) * level_.pixel_bytes());
    }
    return strip_;
  }

 private:
  static constexpr int kRows = 64;

  void check(bool good) const {
    if (!good) throw std::runtime_error(source_.error());
  }

  PixelSource& source_;
  const PixelLevel& level_;
  bool tiled_;
  int rows_;
  std::vector<std::byte> strip_, tile_;
};

/// The first channels of each pixel.
template <class T>
void take_channels(const T* from, int channels, std::span<T> to, int taken) {
  const auto all = static_cast<std::size_t>(channels), first = static_cast<std::size_t>(taken);
  for (std::size_t i = 0; i * first < to.size(); ++i)
    std::copy_n(from + i * all, first, to.data() + i * first);
}

}  // namespace

std::unique_ptr<MipPyramid> read_picture(const std::string& path, const PixelLevel& level,
                                         const PictureFormat& format) {
  const std::unique_ptr<PixelSource> source = open_source(path);
  PixelLevel now;
  if (!source->level(0, 0, now)) throw std::runtime_error(source->error());
  if (now.width != level.width || now.height != level.height || now.type != level.type ||
      now.channels != level.channels)
    throw std::runtime_error("the file was changed during the render");
  auto picture = std::make_unique<MipPyramid>(format);
  StripReader reader(*source, now);
  const OIIO::TypeDesc type(static_cast<OIIO::TypeDesc::BASETYPE>(level.type));
  std::vector<float> values(static_cast<std::size_t>(level.width) *
                            static_cast<std::size_t>(level.channels));
  std::span<const std::byte> strip;
  for (int y = 0; y < level.height; ++y) {
    const int in_strip = y % reader.rows();
    if (in_strip == 0) strip = reader.read(y, std::min(y + reader.rows(), level.height));
    const std::byte* row = strip.data() + level.row_bytes() * static_cast<std::size_t>(in_strip);
    const int from_below = level.height - 1 - y;
    if (format.bytes) {
      take_channels(reinterpret_cast<const std::uint8_t*>(row), level.channels,
                    picture->bytes_of_row(from_below), format.channels);
      continue;
    }
    OIIO::convert_pixel_values(type, row, OIIO::TypeDesc::FLOAT, values.data(),
                               static_cast<int>(values.size()));
    if (format.gamma != 1) decode(values, level.channels, level.alpha_channel, format.gamma);
    take_channels<float>(values.data(), level.channels, picture->floats_of_row(from_below),
                         format.channels);
  }
  picture->build();
  return picture;
}

}  // namespace oriel::oiio
