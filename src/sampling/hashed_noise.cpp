// SPDX-License-Identifier: Apache-2.0
#include "sampling/hashed_noise.h"

#include <array>
#include <cmath>
#include <cstdint>

#include "sampling/lattice_hash.h"

namespace oriel::sampling {
namespace {

constexpr std::size_t kMostDimensions = 4;
/// Factors that bring the noise of 1 to 4 dimensions to the range of -1 to 1.
constexpr std::array<float, kMostDimensions> kNoiseScale = {0.25f, 0.6616f, 0.982f, 0.8344f};

float with_sign(float x, bool negative) { return negative ? -x : x; }

float faded(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Dot product of the gradient of a lattice point and the offset from it.
float slope(std::uint32_t hash, std::span<const float> offset) {
  const bool first = hash & 1u, second = hash & 2u;
  switch (offset.size()) {
    case 1:
      return with_sign(1 + static_cast<float>(hash & 7u), hash & 8u) * offset[0];
    case 2: {
      const bool low = (hash & 7u) < 4;
      return with_sign(offset[low ? 0 : 1], first) + with_sign(2 * offset[low ? 1 : 0], second);
    }
    case 3: {
      const std::uint32_t h = hash & 15u;
      const float u = offset[h < 8 ? 0 : 1];
      const float v = h < 4 ? offset[1] : offset[h == 12 || h == 14 ? 0 : 2];
      return with_sign(u, first) + with_sign(v, second);
    }
    default: {
      const std::uint32_t h = hash & 31u;
      return with_sign(offset[h < 24 ? 0 : 1], first) + with_sign(offset[h < 16 ? 1 : 2], second) +
             with_sign(offset[h < 8 ? 2 : 3], hash & 4u);
    }
  }
}

}  // namespace

float hashed_noise(std::span<const float> at) {
  const std::size_t n = at.size();
  if (n == 0 || n > kMostDimensions) return 0;
  std::array<std::int32_t, kMostDimensions> cell{};
  std::array<float, kMostDimensions> part{};
  for (std::size_t i = 0; i < n; ++i) {
    if (!(std::abs(at[i]) < 1073741824.0f)) return 0;
    const float low = std::floor(at[i]);
    cell[i] = static_cast<std::int32_t>(low);
    part[i] = at[i] - low;
  }
  // Slopes at the corners, then interpolation along one axis after the other.
  std::array<float, 1u << kMostDimensions> values{};
  for (std::size_t corner = 0; corner < (std::size_t{1} << n); ++corner) {
    std::array<std::uint32_t, kMostDimensions> key{};
    std::array<float, kMostDimensions> offset{};
    for (std::size_t i = 0; i < n; ++i) {
      const bool high = corner >> i & 1u;
      key[i] = static_cast<std::uint32_t>(cell[i]) + high;
      offset[i] = part[i] - static_cast<float>(high);
    }
    values[corner] = slope(lattice_hash({key.data(), n}), {offset.data(), n});
  }
  for (std::size_t i = 0; i < n; ++i) {
    const float t = faded(part[i]);
    for (std::size_t k = 0; k < (std::size_t{1} << (n - 1 - i)); ++k)
      values[k] = (1 - t) * values[2 * k] + t * values[2 * k + 1];
  }
  return values[0] * kNoiseScale[n - 1];
}

}  // namespace oriel::sampling
