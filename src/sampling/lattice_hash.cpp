// SPDX-License-Identifier: Apache-2.0
#include "sampling/lattice_hash.h"

#include <algorithm>
#include <array>
#include <bit>

namespace oriel::sampling {
namespace {

struct HashState {
  std::uint32_t a, b, c;
};

/// Reversible mixing of three words between blocks of the key.
void mix_words(HashState& s) {
  const auto step = [](std::uint32_t& x, std::uint32_t& y, std::uint32_t& z, int turn) {
    x -= z;
    x ^= std::rotl(z, turn);
    z += y;
  };
  step(s.a, s.b, s.c, 4);
  step(s.b, s.c, s.a, 6);
  step(s.c, s.a, s.b, 8);
  step(s.a, s.b, s.c, 16);
  step(s.b, s.c, s.a, 19);
  step(s.c, s.a, s.b, 4);
}

/// Final mixing, after which every bit of the key affects every bit of c.
void finish_words(HashState& s) {
  const auto step = [](std::uint32_t& x, std::uint32_t y, int turn) {
    x ^= y;
    x -= std::rotl(y, turn);
  };
  step(s.c, s.b, 14);
  step(s.a, s.c, 11);
  step(s.b, s.a, 25);
  step(s.c, s.b, 16);
  step(s.a, s.c, 4);
  step(s.b, s.a, 14);
  step(s.c, s.b, 24);
}

}  // namespace

std::uint32_t lattice_hash(std::span<const std::uint32_t> words) {
  const std::uint32_t start = 0xdeadbeefu + (static_cast<std::uint32_t>(words.size()) << 2) + 13;
  HashState s{start, start, start};
  std::size_t first = 0;
  if (words.size() > 3) {
    s.a += words[0], s.b += words[1], s.c += words[2];
    mix_words(s);
    first = 3;
  }
  std::uint32_t* const parts[] = {&s.a, &s.b, &s.c};
  for (std::size_t i = first; i < words.size() && i < first + 3; ++i) *parts[i - first] += words[i];
  finish_words(s);
  return s.c;
}

float position_hash(std::span<const float> numbers) {
  std::array<std::uint32_t, 4> words{};
  const std::size_t count = std::min(numbers.size(), words.size());
  for (std::size_t i = 0; i < count; ++i) words[i] = std::bit_cast<std::uint32_t>(numbers[i]);
  return static_cast<float>(lattice_hash({words.data(), count})) / 4294967295.0f;
}

std::array<float, 3> position_color(std::span<const float> numbers) {
  const float first = position_hash(numbers);
  if (numbers.size() >= 4) {
    const float x = numbers[0], y = numbers[1], z = numbers[2], w = numbers[3];
    const float second[] = {z, x, w, y}, third[] = {w, z, y, x};
    return {first, position_hash(second), position_hash(third)};
  }
  std::array<float, 4> key{};
  std::copy(numbers.begin(), numbers.end(), key.begin());
  const auto with = [&](float last) {
    key[numbers.size()] = last;
    return position_hash({key.data(), numbers.size() + 1});
  };
  return {first, with(1), with(2)};
}

}  // namespace oriel::sampling
