// SPDX-License-Identifier: Apache-2.0
// Textures with pixels from the scene description.
#include <algorithm>

#include "image/mip_pyramid.h"
#include "image/texture.h"

namespace oriel {
namespace {

constexpr int kLargestSide = 1 << 15;

class MemoryTexture final : public Texture {
 public:
  MemoryTexture(const PictureFormat& format, std::span<const std::uint8_t> bytes, RowOrder order)
      : pixels_(format) {
    width_ = format.width;
    height_ = format.height;
    channels_ = format.channels;
    for (int y = 0; y < height_; ++y) {
      const std::span<std::uint8_t> row = pixels_.bytes_of_row(y);
      const int from = order == RowOrder::BottomUp ? y : height_ - 1 - y;
      std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(row.size()) * from, row.size(),
                  row.begin());
    }
    pixels_.build();
  }

  Rgba sample(const Vec2& uv, const TextureFootprint& footprint,
              const TextureSampling& how) const override {
    return pixels_.sample(uv, footprint, how);
  }

 private:
  MipPyramid pixels_;
};

}  // namespace

std::unique_ptr<Texture> make_memory_texture(int width, int height, int components,
                                             std::span<const std::uint8_t> bytes, float gamma,
                                             RowOrder order) {
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) return nullptr;
  if (components < 1 || components > 4) return nullptr;
  const PictureFormat format{.width = width,
                             .height = height,
                             .channels = components,
                             .alpha_channel = components % 2 == 0 ? components - 1 : -1,
                             .bytes = true,
                             .gamma = gamma};
  const std::size_t values = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                             static_cast<std::size_t>(components);
  if (bytes.size() != values) return nullptr;
  return std::make_unique<MemoryTexture>(format, bytes, order);
}

}  // namespace oriel
