// SPDX-License-Identifier: Apache-2.0
// Textures with pixels from the scene description: a mip pyramid in memory.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "base/math.h"
#include "image/texture.h"
#include "image/texture_wrap.h"

namespace oriel {
namespace {

constexpr int kLargestSide = 1 << 15;

int wrapped_index(int i, int n, Wrap mode) {
  if (mode == Wrap::Periodic) return (i % n + n) % n;
  if (mode == Wrap::Mirror) {
    const int m = (i % (2 * n) + 2 * n) % (2 * n);
    return m < n ? m : 2 * n - 1 - m;
  }
  return std::clamp(i, 0, n - 1);
}

struct Level {
  int width, height;
  std::vector<Rgba> texels;  // row 0 at the bottom

  const Rgba& at(int x, int y, const TextureSampling& how) const {
    return texels[std::size_t(wrapped_index(y, height, how.wrap_v)) * width +
                  wrapped_index(x, width, how.wrap_u)];
  }

  Rgba nearest(float u, float v, const TextureSampling& how) const {
    return at(int(std::floor(u * width)), int(std::floor(v * height)), how);
  }

  Rgba bilinear(float u, float v, const TextureSampling& how) const {
    const float x = u * width - 0.5f, y = v * height - 0.5f;
    const float fx = std::floor(x), fy = std::floor(y);
    const float s = x - fx, t = y - fy;
    const int i = int(fx), j = int(fy);
    return (at(i, j, how) * (1 - s) + at(i + 1, j, how) * s) * (1 - t) +
           (at(i, j + 1, how) * (1 - s) + at(i + 1, j + 1, how) * s) * t;
  }
};

/// The next mip level; an odd last row or column is distributed by exact area weights.
Level halved(const Level& fine) {
  Level out{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
  out.texels.resize(std::size_t(out.width) * out.height);
  const float sx = float(fine.width) / out.width, sy = float(fine.height) / out.height;
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const float x0 = x * sx, x1 = x0 + sx, y0 = y * sy, y1 = y0 + sy;
      Rgba sum(0, 0, 0, 0);
      float area = 0;
      for (int j = int(y0); j < fine.height && j < y1; ++j)
        for (int i = int(x0); i < fine.width && i < x1; ++i) {
          const float w = (std::min(x1, i + 1.0f) - std::max(x0, float(i))) *
                          (std::min(y1, j + 1.0f) - std::max(y0, float(j)));
          if (w <= 0) continue;
          sum += fine.texels[std::size_t(j) * fine.width + i] * w;
          area += w;
        }
      out.texels[std::size_t(y) * out.width + x] = sum * (1 / area);
    }
  return out;
}

class MemoryTexture final : public Texture {
 public:
  MemoryTexture(Level finest, int components) {
    width_ = finest.width;
    height_ = finest.height;
    channels_ = components;
    levels_.push_back(std::move(finest));
    while (levels_.back().width > 1 || levels_.back().height > 1)
      levels_.push_back(halved(levels_.back()));
  }

  Rgba sample(const Vec2& uv, const TextureFootprint& footprint,
              const TextureSampling& how) const override {
    const auto u = wrapped(uv.x, how.wrap_u), v = wrapped(uv.y, how.wrap_v);
    if (!u || !v) return Rgba(0, 0, 0, 0);
    if (how.interpolation == Interpolation::Nearest) return levels_[0].nearest(*u, *v, how);

    // The footprint in texels: the shorter axis selects the mip level, probes are placed along the
    // longer one.
    Vec2 major(bounded_derivative(footprint.dx.x), bounded_derivative(footprint.dx.y));
    Vec2 minor(bounded_derivative(footprint.dy.x), bounded_derivative(footprint.dy.y));
    const Vec2 size{float(width_), float(height_)};
    float longer = (major * size).length(), shorter = (minor * size).length();
    if (longer < shorter) {
      std::swap(major, minor);
      std::swap(longer, shorter);
    }
    if (longer <= 1) return levels_[0].bilinear(*u, *v, how);
    const float most = std::clamp(how.anisotropy, 1.0f, 64.0f);
    const float width = std::max({shorter, longer / most, 1.0f});
    const int probes = std::clamp(int(std::ceil(longer / width)), 1, int(most));

    // Average of the probes along the longer axis.
    Rgba sum(0, 0, 0, 0);
    const float level = math::log2(width);
    for (int i = 0; i < probes; ++i) {
      const float t = (i + 0.5f) / probes - 0.5f;
      sum += trilinear(*u + major.x * t, *v + major.y * t, level, how);
    }
    return sum * (1.0f / probes);
  }

 private:
  Rgba trilinear(float u, float v, float level, const TextureSampling& how) const {
    const float top = float(levels_.size() - 1);
    const float l = std::clamp(level, 0.0f, top);
    const std::size_t fine = std::size_t(l);
    const float t = l - float(fine);
    const Rgba a = levels_[fine].bilinear(u, v, how);
    return t > 0 ? a * (1 - t) + levels_[fine + 1].bilinear(u, v, how) * t : a;
  }

  std::vector<Level> levels_;
};

}  // namespace

std::unique_ptr<Texture> make_memory_texture(int width, int height, int components,
                                             std::span<const std::uint8_t> bytes, float gamma,
                                             RowOrder order) {
  if (width < 1 || height < 1 || width > kLargestSide || height > kLargestSide) return nullptr;
  if (components < 1 || components > 4) return nullptr;
  if (bytes.size() != std::size_t(width) * height * components) return nullptr;

  std::array<float, 256> decoded;
  for (int i = 0; i < 256; ++i)
    decoded[i] = gamma > 0 && gamma != 1 ? math::pow(i / 255.0f, gamma) : i / 255.0f;

  Level finest{width, height, std::vector<Rgba>(std::size_t(width) * height)};
  for (int y = 0; y < height; ++y) {
    const int row = order == RowOrder::BottomUp ? y : height - 1 - y;
    const std::uint8_t* in = bytes.data() + std::size_t(row) * width * components;
    for (int x = 0; x < width; ++x, in += components) {
      const bool grey = components < 3;
      const float alpha = components % 2 == 0 ? in[components - 1] / 255.0f : 1.0f;
      finest.texels[std::size_t(y) * width + x] =
          Rgba(decoded[in[0]], decoded[in[grey ? 0 : 1]], decoded[in[grey ? 0 : 2]], alpha);
    }
  }
  return std::make_unique<MemoryTexture>(std::move(finest), components);
}

}  // namespace oriel
