// SPDX-License-Identifier: Apache-2.0
#include "image/mip_pyramid.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>
#include <utility>

#include "base/math.h"
#include "image/texture_wrap.h"

namespace oriel {
namespace {

/// What a read of four floats may take beyond the last texel.
constexpr std::size_t kPadding = 16;

int wrapped_index(int i, int n, Wrap mode) {
  if (i >= 0 && i < n) return i;
  if (mode == Wrap::Periodic) return (i % n + n) % n;
  if (mode == Wrap::Mirror) {
    const int m = (i % (2 * n) + 2 * n) % (2 * n);
    return m < n ? m : 2 * n - 1 - m;
  }
  return std::clamp(i, 0, n - 1);
}

std::size_t texels(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

struct Size {
  int width, height;
  bool is_smallest() const { return width == 1 && height == 1; }
  Size halved() const { return {std::max(1, width / 2), std::max(1, height / 2)}; }
};

}  // namespace

std::size_t MipPyramid::size_of(Storage storage) {
  return storage == Storage::Bytes ? 1 : storage == Storage::Halves ? 2 : 4;
}

MipPyramid::Level MipPyramid::make_level(int width, int height, int channels, Storage storage) {
  const std::size_t values = texels(width, height) * static_cast<std::size_t>(channels);
  return {width, height, storage, std::vector<std::byte>(values * size_of(storage) + kPadding)};
}

std::uint64_t MipPyramid::bytes_of(const PictureFormat& format) {
  const auto channels = static_cast<std::uint64_t>(format.channels);
  Size size{format.width, format.height};
  std::uint64_t finest = texels(size.width, size.height), coarser = 0;
  while (!size.is_smallest()) {
    size = size.halved();
    coarser += texels(size.width, size.height);
  }
  return channels * (finest * (format.bytes ? 1 : 4) + coarser * (format.bytes ? 2 : 4));
}

MipPyramid::MipPyramid(const PictureFormat& format) : format_(format) {
  for (std::size_t i = 0; i < linear_.size(); ++i) {
    linear_[i] = static_cast<float>(i) / 255.0f;
    const bool decodes = format.gamma > 0 && format.gamma != 1;
    decoded_[i] = decodes ? math::pow(linear_[i], format.gamma) : linear_[i];
  }
  for (int c = 0; c < 4; ++c)
    of_byte_[static_cast<std::size_t>(c)] =
        c == format.alpha_channel ? linear_.data() : decoded_.data();
  levels_.push_back(make_level(format.width, format.height, format.channels,
                               format.bytes ? Storage::Bytes : Storage::Floats));
}

template <class T>
std::span<T> MipPyramid::row(int y) {
  const std::size_t values =
      static_cast<std::size_t>(format_.width) * static_cast<std::size_t>(format_.channels);
  return {reinterpret_cast<T*>(levels_[0].data.data()) + values * static_cast<std::size_t>(y),
          values};
}
std::span<std::uint8_t> MipPyramid::bytes_of_row(int y) { return row<std::uint8_t>(y); }
std::span<float> MipPyramid::floats_of_row(int y) { return row<float>(y); }

template <class F>
auto MipPyramid::with_storage(const Level& level, F&& f) {
  switch (level.storage) {
    case Storage::Bytes:
      return f(std::integral_constant<Storage, Storage::Bytes>());
    case Storage::Halves:
      return f(std::integral_constant<Storage, Storage::Halves>());
    default:
      return f(std::integral_constant<Storage, Storage::Floats>());
  }
}

template <MipPyramid::Storage S>
MipPyramid::Float4 MipPyramid::texel(const Level& level, std::size_t index) const {
  const std::byte* at =
      level.data.data() + index * static_cast<std::size_t>(format_.channels) * size_of(S);
  if constexpr (S == Storage::Bytes) {
    const auto value = [&](std::size_t c) { return of_byte_[c][std::to_integer<int>(at[c])]; };
    return Float4{value(0), value(1), value(2), value(3)};
  } else if constexpr (S == Storage::Halves) {
    return _mm_cvtph_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(at)));
  } else {
    return _mm_loadu_ps(reinterpret_cast<const float*>(at));
  }
}

void MipPyramid::set(Level& level, std::size_t texel, const Float4& values) const {
  const auto channels = static_cast<std::size_t>(format_.channels);
  std::byte* at = level.data.data() + texel * channels * size_of(level.storage);
  if (level.storage == Storage::Floats) {
    std::memcpy(at, &values, channels * sizeof(float));
  } else {
    const __m128i halves = _mm_cvtps_ph(values, _MM_FROUND_TO_NEAREST_INT);
    std::memcpy(at, &halves, channels * 2);
  }
}

template <MipPyramid::Storage S>
void MipPyramid::halve(const Level& fine, Level& coarse) const {
  const bool even = fine.width == 2 * coarse.width && fine.height == 2 * coarse.height;
  const auto at = [&](int x, int y) {
    return texel<S>(fine, texels(fine.width, y) + static_cast<std::size_t>(x));
  };
  const float sx = static_cast<float>(fine.width) / static_cast<float>(coarse.width);
  const float sy = static_cast<float>(fine.height) / static_cast<float>(coarse.height);
  const auto share = [](float from, float to, int texel) {
    const auto begin = static_cast<float>(texel);
    return std::min(to, begin + 1) - std::max(from, begin);
  };
  // An odd last row or column is distributed by exact area weights.
  const auto mean_of_area = [&](int x, int y) {
    const float x0 = static_cast<float>(x) * sx, x1 = x0 + sx;
    const float y0 = static_cast<float>(y) * sy, y1 = y0 + sy;
    Float4 sum{};
    float area = 0;
    for (int j = static_cast<int>(y0); j < fine.height && static_cast<float>(j) < y1; ++j)
      for (int i = static_cast<int>(x0); i < fine.width && static_cast<float>(i) < x1; ++i) {
        const float weight = share(x0, x1, i) * share(y0, y1, j);
        if (weight <= 0) continue;
        sum += at(i, j) * weight;
        area += weight;
      }
    return sum * (1 / area);
  };
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      const int i = 2 * x, j = 2 * y;
      set(coarse, texels(coarse.width, y) + static_cast<std::size_t>(x),
          even ? (at(i, j) + at(i + 1, j) + at(i, j + 1) + at(i + 1, j + 1)) * 0.25f
               : mean_of_area(x, y));
    }
}

void MipPyramid::build() {
  Size size{format_.width, format_.height};
  while (!size.is_smallest()) {
    size = size.halved();
    levels_.push_back(make_level(size.width, size.height, format_.channels,
                                 format_.bytes ? Storage::Halves : Storage::Floats));
    const Level& fine = levels_[levels_.size() - 2];
    with_storage(fine, [&](auto storage) { halve<storage>(fine, levels_.back()); });
  }
}

MipPyramid::Float4 MipPyramid::nearest(const Level& level, float u, float v,
                                       const TextureSampling& how) const {
  const auto index = [](float x, int size, Wrap mode) {
    return wrapped_index(static_cast<int>(std::floor(x * static_cast<float>(size))), size, mode);
  };
  const std::size_t at = texels(level.width, index(v, level.height, how.wrap_v)) +
                         static_cast<std::size_t>(index(u, level.width, how.wrap_u));
  return with_storage(level, [&](auto storage) { return texel<storage>(level, at); });
}

template <MipPyramid::Storage S>
MipPyramid::Float4 MipPyramid::bilinear(const Level& level, float u, float v,
                                        const TextureSampling& how) const {
  const float x = u * static_cast<float>(level.width) - 0.5f;
  const float y = v * static_cast<float>(level.height) - 0.5f;
  const float left = std::floor(x), below = std::floor(y);
  const float s = x - left, t = y - below;
  const auto column = [&](int i) {
    return static_cast<std::size_t>(
        wrapped_index(static_cast<int>(left) + i, level.width, how.wrap_u));
  };
  const auto start = [&](int j) {
    return texels(level.width,
                  wrapped_index(static_cast<int>(below) + j, level.height, how.wrap_v));
  };
  const std::size_t x0 = column(0), x1 = column(1), y0 = start(0), y1 = start(1);
  const auto at = [&](std::size_t i) { return texel<S>(level, i); };
  const Float4 lower = at(y0 + x0) * (1 - s) + at(y0 + x1) * s;
  const Float4 upper = at(y1 + x0) * (1 - s) + at(y1 + x1) * s;
  return lower * (1 - t) + upper * t;
}

MipPyramid::Float4 MipPyramid::bilinear(const Level& level, float u, float v,
                                        const TextureSampling& how) const {
  return with_storage(level, [&](auto storage) { return bilinear<storage>(level, u, v, how); });
}

MipPyramid::Float4 MipPyramid::trilinear(float u, float v, float level,
                                         const TextureSampling& how) const {
  const float l = std::clamp(level, 0.0f, static_cast<float>(levels_.size() - 1));
  const auto fine = static_cast<std::size_t>(l);
  const float t = l - static_cast<float>(fine);
  const Float4 a = bilinear(levels_[fine], u, v, how);
  return t > 0 ? a * (1 - t) + bilinear(levels_[fine + 1], u, v, how) * t : a;
}

Rgba MipPyramid::sample(const Vec2& uv, const TextureFootprint& footprint,
                        const TextureSampling& how) const {
  const auto u = wrapped(uv.x, how.wrap_u), v = wrapped(uv.y, how.wrap_v);
  if (!u || !v) return Rgba(0, 0, 0, 0);
  const auto color = [&](const Float4& c) {
    return color_of_channels(reinterpret_cast<const float*>(&c), format_.channels);
  };
  if (how.interpolation == Interpolation::Nearest) return color(nearest(levels_[0], *u, *v, how));

  // The footprint in texels: the shorter axis selects the mip level, probes are placed along the
  // longer one.
  Vec2 major(bounded_derivative(footprint.dx.x), bounded_derivative(footprint.dx.y));
  Vec2 minor(bounded_derivative(footprint.dy.x), bounded_derivative(footprint.dy.y));
  const Vec2 size{static_cast<float>(format_.width), static_cast<float>(format_.height)};
  float longer = (major * size).length(), shorter = (minor * size).length();
  if (longer < shorter) {
    std::swap(major, minor);
    std::swap(longer, shorter);
  }
  if (longer <= 1) return color(bilinear(levels_[0], *u, *v, how));
  const float most = std::clamp(how.anisotropy, 1.0f, 64.0f);
  const float width = std::max({shorter, longer / most, 1.0f});
  const int probes =
      std::clamp(static_cast<int>(std::ceil(longer / width)), 1, static_cast<int>(most));

  Float4 sum{};
  const float level = math::log2(width);
  for (int i = 0; i < probes; ++i) {
    const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(probes) - 0.5f;
    sum += trilinear(*u + major.x * t, *v + major.y * t, level, how);
  }
  return color(sum * (1.0f / static_cast<float>(probes)));
}

}  // namespace oriel
