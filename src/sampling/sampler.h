// SPDX-License-Identifier: Apache-2.0
// Random numbers: padded, Owen-scrambled Sobol pairs keyed by pixel and sample.
#pragma once

#include <cstdint>

#include "base/vec.h"

namespace oriel::sampling {

/// Mixes 64 bits such that every output bit depends on every input bit.
/// Source: the finaliser of Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators",
///         OOPSLA 2014, with Stafford's constants (variant 13).
constexpr std::uint64_t mix_bits(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ull;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebull;
  return v ^ (v >> 31);
}

/// The random numbers of one sample of one pixel, by dimension.
///
/// Model:   each draw uses a new dimension: the (0,2)-sequence of Sobol with its index shuffled by
///          a nested uniform permutation, and each coordinate Owen-scrambled. Any aligned block of
///          2^k samples of a pixel is a (0,k,2)-net in each 2D draw; different draws and pixels are
///          independent. A copy continues with the same numbers.
/// Inputs:  sample indices start at 0 and may be used in any order.
/// Returns: numbers in [0, 1), never 1.
/// Errors:  total.
/// Source:  Burley, "Practical Hash-based Owen Scrambling", JCGT 9(4), 2020.
/// Checked: Sampler.EveryAlignedBlockIsANet, Sampler.ErrorFallsFasterThanRandom,
///          Sampler.DimensionsAreIndependent.
class Sampler {
 public:
  Sampler() = default;
  Sampler(int pixel_x, int pixel_y, std::uint32_t sample, std::uint32_t seed = 0) {
    start(pixel_x, pixel_y, sample, seed);
  }

  /// Starts sample `sample` of a pixel at dimension 0. Equal arguments give equal numbers.
  void start(int pixel_x, int pixel_y, std::uint32_t sample, std::uint32_t seed = 0) {
    const auto x = static_cast<std::uint32_t>(pixel_x), y = static_cast<std::uint32_t>(pixel_y);
    key_ = mix_bits(mix_bits((std::uint64_t{y} << 32) | x) + seed + 1);
    reversed_index_ = reverse_bits(sample);
    dimension_ = 0;
  }

  float next_1d() {
    const std::uint64_t h = next_hash();
    const std::uint32_t shuffled = scramble(reversed_index_, static_cast<std::uint32_t>(h));
    return to_unit(
        reverse_bits(scramble(reverse_bits(shuffled), static_cast<std::uint32_t>(h >> 32))));
  }

  Vec2 next_2d() {
    const std::uint64_t h = next_hash();
    const auto hx = static_cast<std::uint32_t>(h >> 32);
    const auto hy = static_cast<std::uint32_t>((h * 0x9e3779b97f4a7c15ull) >> 32);
    // The shuffled index with reversed bits, read as a fraction, is Sobol's first coordinate.
    const std::uint32_t x = reverse_bits(scramble(reversed_index_, static_cast<std::uint32_t>(h)));
    const std::uint32_t y = pascal(x);
    // Both coordinates have reversed bits, as scramble() requires.
    const std::uint64_t both =
        reverse_bits((std::uint64_t{scramble(y, hy)} << 32) | scramble(x, hx));
    return Vec2(to_unit(static_cast<std::uint32_t>(both >> 32)),
                to_unit(static_cast<std::uint32_t>(both)));
  }

  /// Stream i of n that this sample splits into; `branch` distinguishes groups of streams. If all
  /// samples of a pixel split into n streams, these are stratified like n times as many samples.
  Sampler split(std::uint32_t i, std::uint32_t n, std::uint32_t branch) const {
    Sampler s = *this;
    s.key_ = mix_bits(key_ + 0xd1b54a32d192ed03ull * (branch + 1));
    s.reversed_index_ = reverse_bits(reverse_bits(reversed_index_) * n + i);
    return s;
  }

  /// Skips a draw, so that later draws keep their dimensions.
  void skip() { ++dimension_; }

  /// The number of draws so far; setting it continues at that draw.
  std::uint32_t dimension() const { return dimension_; }
  void set_dimension(std::uint32_t dimension) { dimension_ = dimension; }

 private:
  std::uint64_t next_hash() { return mix_bits(key_ + 0x9e3779b97f4a7c15ull * ++dimension_); }

  static std::uint32_t reverse_bits(std::uint32_t v) {
    v = __builtin_bswap32(v);
    v = ((v >> 4) & 0x0f0f0f0fu) | ((v & 0x0f0f0f0fu) << 4);
    v = ((v >> 2) & 0x33333333u) | ((v & 0x33333333u) << 2);
    return ((v >> 1) & 0x55555555u) | ((v & 0x55555555u) << 1);
  }
  static std::uint64_t reverse_bits(std::uint64_t v) {
    v = __builtin_bswap64(v);
    v = ((v >> 4) & 0x0f0f0f0f0f0f0f0full) | ((v & 0x0f0f0f0f0f0f0f0full) << 4);
    v = ((v >> 2) & 0x3333333333333333ull) | ((v & 0x3333333333333333ull) << 2);
    return ((v >> 1) & 0x5555555555555555ull) | ((v & 0x5555555555555555ull) << 1);
  }

  /// A random permutation in which each bit depends only on itself and lower bits: an Owen scramble
  /// of bit-reversed values.
  /// Source: Laine, Karras, "Stratified Sampling for Stochastic Transparency", EGSR 2011; constants
  ///         of Vegdahl, "Building a Better LK Hash", 2021.
  static std::uint32_t scramble(std::uint32_t v, std::uint32_t seed) {
    v ^= v * 0x3d20adeau;
    v += seed;
    v *= (seed >> 16) | 1u;
    v ^= v * 0x05526c56u;
    v ^= v * 0x53a22864u;
    return v;
  }

  /// Computes Sobol's second coordinate from the first, both bit-reversed: multiplication with the
  /// Pascal matrix modulo 2. The matrix is a Kronecker power of [1 1; 0 1], so one step per bit of
  /// the index is sufficient.
  static std::uint32_t pascal(std::uint32_t v) {
    v ^= (v & 0xffff0000u) >> 16;
    v ^= (v & 0xff00ff00u) >> 8;
    v ^= (v & 0xf0f0f0f0u) >> 4;
    v ^= (v & 0xccccccccu) >> 2;
    return v ^ ((v & 0xaaaaaaaau) >> 1);
  }

  /// 24 bits are exactly representable in [0, 1), so the result never rounds to 1.
  static float to_unit(std::uint32_t v) { return static_cast<float>(v >> 8) * 0x1p-24f; }

  std::uint64_t key_ = 0;
  std::uint32_t reversed_index_ = 0;
  std::uint32_t dimension_ = 0;
};

}  // namespace oriel::sampling
