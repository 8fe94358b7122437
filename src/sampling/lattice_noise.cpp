// SPDX-License-Identifier: Apache-2.0
#include "sampling/lattice_noise.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/math.h"
#include "sampling/sampler.h"

namespace oriel::sampling {
namespace {

constexpr std::size_t kDirections = 256;

/// Maximum value of a lattice point. With these the variance is about equal at lattice points,
/// where gradients contribute nothing, and between them, where values contribute less.
constexpr float kLatticeValue[3] = {0.5f, 0.5f, 0.35f};

/// Uniformly distributed unit vectors; in one dimension, different lengths instead.
template <int kDimensions>
const std::array<std::array<float, kDimensions>, kDirections>& directions() {
  static const auto table = [] {
    std::array<std::array<float, kDimensions>, kDirections> all{};
    for (std::size_t i = 0; i < kDirections; ++i) {
      const float even = (static_cast<float>(i) + 0.5f) * (2.0f / kDirections) - 1;
      if constexpr (kDimensions == 1) {
        all[i] = {even};
      } else if constexpr (kDimensions == 2) {
        all[i] = {math::cos(3.14159265f * even), math::sin(3.14159265f * even)};
      } else {
        // Spiral with the golden angle.
        const float turn = 2.39996323f * static_cast<float>(i), r = std::sqrt(1 - even * even);
        all[i] = {r * math::cos(turn), r * math::sin(turn), even};
      }
    }
    return all;
  }();
  return table;
}

/// Integer index of a cell; wraps around for distant coordinates.
std::uint32_t cell_number(float floor) {
  const float small = std::abs(floor) < 0x1p30f ? floor : std::fmod(floor, 0x1p30f);
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(small));
}

std::uint64_t hash(const std::array<std::uint32_t, 3>& cell) {
  const std::uint64_t line = (std::uint64_t{cell[1]} << 32) | cell[0];
  return sampling::mix_bits(sampling::mix_bits(line) + 0x9e3779b97f4a7c15ull * (cell[2] + 1ull));
}

/// An odd polynomial of the lattice noise; the logistic function maps its value to 0...1.
struct Curve {
  float linear, cubic = 0, quintic = 0;
};

/// Bell-shaped about .5 with standard deviation .14: 0.65 divided by the standard deviation of the
/// lattice noise, which is .2906, .3126 and .2368 (4 million points).
constexpr Curve kBell[3] = {{2.237f}, {2.080f}, {2.745f}};

/// Log odds of the cumulative distribution of the lattice noise, fitted to 4 million points; the
/// result is uniform within .002.
constexpr Curve kEven[3] = {
    {4.6254f, 4.0652f, 16.7919f}, {4.6736f, 2.8982f, 4.1761f}, {6.3930f, 5.5716f, 12.2233f}};

}  // namespace

template <int kDimensions>
float noise_bound() {
  // Value and gradient contributions of all corners at the centre of the cell.
  return kLatticeValue[kDimensions - 1] + 0.5f * std::sqrt(static_cast<float>(kDimensions));
}

template <int kDimensions>
NoiseAt<kDimensions> lattice_noise(const std::array<float, kDimensions>& at) {
  std::array<std::uint32_t, 3> cell{};
  std::array<float, kDimensions> f, weight[2], rise;
  for (std::size_t d = 0; d < kDimensions; ++d) {
    if (!std::isfinite(at[d])) return {};
    const float floor = std::floor(at[d]);
    cell[d] = cell_number(floor);
    const float t = f[d] = at[d] - floor;
    weight[1][d] = t * t * t * (t * (t * 6 - 15) + 10);
    weight[0][d] = 1 - weight[1][d];
    rise[d] = 30 * t * t * (t - 1) * (t - 1);
  }
  NoiseAt<kDimensions> out;
  const auto& gradients = directions<kDimensions>();
  for (unsigned corner = 0; corner < 1u << kDimensions; ++corner) {
    const auto side = [&](std::size_t d) { return (corner >> d) & 1u; };
    std::array<std::uint32_t, 3> place = cell;
    float share = 1;
    for (std::size_t d = 0; d < kDimensions; ++d) {
      place[d] += side(d);
      share *= weight[side(d)][d];
    }
    const std::uint64_t bits = hash(place);
    const auto& gradient = gradients[bits % kDirections];
    const float even = static_cast<float>(bits >> 40) * 0x1p-23f - 1;
    float value = kLatticeValue[kDimensions - 1] * even;
    for (std::size_t d = 0; d < kDimensions; ++d)
      value += gradient[d] * (f[d] - static_cast<float>(side(d)));
    out.value += share * value;
    for (std::size_t d = 0; d < kDimensions; ++d) {
      float others = side(d) ? rise[d] : -rise[d];
      for (std::size_t e = 0; e < kDimensions; ++e)
        if (e != d) others *= weight[side(e)][e];
      out.slope[d] += share * gradient[d] + others * value;
    }
  }
  return out;
}

template <int kDimensions>
NoiseAt<kDimensions> shaped_noise(const std::array<float, kDimensions>& at, NoiseShape shape) {
  const Curve& curve = (shape == NoiseShape::Bell ? kBell : kEven)[kDimensions - 1];
  NoiseAt<kDimensions> n = lattice_noise<kDimensions>(at);
  const float x = n.value, x2 = x * x;
  const float odds = x * (curve.linear + x2 * (curve.cubic + x2 * curve.quintic));
  const float rise = curve.linear + x2 * (3 * curve.cubic + x2 * 5 * curve.quintic);
  n.value = 1 / (1 + math::exp(-odds));
  for (float& s : n.slope) s *= n.value * (1 - n.value) * rise;
  return n;
}

template NoiseAt<1> lattice_noise<1>(const std::array<float, 1>&);
template NoiseAt<2> lattice_noise<2>(const std::array<float, 2>&);
template NoiseAt<3> lattice_noise<3>(const std::array<float, 3>&);
template NoiseAt<1> shaped_noise<1>(const std::array<float, 1>&, NoiseShape);
template NoiseAt<2> shaped_noise<2>(const std::array<float, 2>&, NoiseShape);
template NoiseAt<3> shaped_noise<3>(const std::array<float, 3>&, NoiseShape);
template float noise_bound<1>();
template float noise_bound<2>();
template float noise_bound<3>();

}  // namespace oriel::sampling
