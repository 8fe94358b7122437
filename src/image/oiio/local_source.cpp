// SPDX-License-Identifier: Apache-2.0
#include "image/oiio/local_source.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "image/oiio/allowed_formats.h"

namespace oriel::oiio {
namespace {

PixelLevel level_of(const OIIO::ImageSpec& spec) {
  PixelLevel l;
  l.x = spec.x, l.y = spec.y, l.width = spec.width, l.height = spec.height;
  l.full_x = spec.full_x, l.full_y = spec.full_y;
  l.full_width = spec.full_width, l.full_height = spec.full_height;
  l.tile_width = spec.tile_width, l.tile_height = spec.tile_height;
  l.strip_rows = spec.get_int_attribute("tiff:RowsPerStrip", 0);
  l.channels = spec.nchannels, l.alpha_channel = spec.alpha_channel;
  l.type = spec.format.basetype;
  l.type_bytes = static_cast<int>(spec.format.basesize());
  return l;
}

class LocalSource final : public PixelSource {
 public:
  explicit LocalSource(std::unique_ptr<OIIO::ImageInput> input) : input_(std::move(input)) {}

  bool level(int subimage, int miplevel, PixelLevel& level) override {
    if (!input_->seek_subimage(subimage, miplevel)) return false;
    const OIIO::ImageSpec& spec = input_->spec();
    if (spec.deep || spec.depth > 1) return false;
    level = level_of(spec);
    return true;
  }

  bool rows(int subimage, int miplevel, int y_begin, int y_end, std::span<std::byte> out) override {
    PixelLevel l;
    return level(subimage, miplevel, l) &&
           out.size() >= l.row_bytes() * static_cast<std::size_t>(y_end - y_begin) &&
           input_->read_scanlines(subimage, miplevel, y_begin, y_end, 0, 0, l.channels,
                                  input_->spec().format, out.data());
  }

  bool tile(int subimage, int miplevel, int x, int y, std::span<std::byte> out) override {
    PixelLevel l;
    if (!level(subimage, miplevel, l) || l.tile_width < 1 || out.size() < l.tile_bytes())
      return false;
    // Tiles at the border are smaller.
    const int x1 = std::min(x + l.tile_width, l.x + l.width);
    const int y1 = std::min(y + l.tile_height, l.y + l.height);
    const auto pixel = static_cast<OIIO::stride_t>(l.pixel_bytes());
    return input_->read_tiles(subimage, miplevel, x, x1, y, y1, 0, 1, 0, l.channels,
                              input_->spec().format, out.data(), pixel, pixel * l.tile_width);
  }

  std::string error() const override {
    const std::string why = input_->geterror();
    return why.empty() ? "its pixels cannot be read" : why;
  }

 private:
  std::unique_ptr<OIIO::ImageInput> input_;
};

}  // namespace

std::unique_ptr<PixelSource> open_local_source(const std::string& path) {
  OIIO::ImageSpec plain;
  plain.attribute("oiio:UnassociatedAlpha", 1);
  return std::make_unique<LocalSource>(open_allowed(path, &plain));
}

}  // namespace oriel::oiio
