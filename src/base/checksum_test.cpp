// SPDX-License-Identifier: Apache-2.0
#include "base/checksum.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace oriel {
namespace checksum_test {

std::uint64_t checksum_of(std::string_view text) {
  Checksum64 sum;
  sum.add(text);
  return sum.value();
}

std::string sample_text(std::size_t size) {
  std::string text;
  for (std::size_t i = 0; i < size; ++i) text += static_cast<char>(i * 37 + i / 7);
  return text;
}

TEST(Checksum64, EveryChangedBitChangesIt) {
  for (const std::size_t size : {1, 8, 31, 32, 33, 100}) {
    const std::string text = sample_text(size);
    std::set<std::uint64_t> sums = {checksum_of(text)};
    for (std::size_t bit = 0; bit < size * 8; ++bit) {
      std::string changed = text;
      changed[bit / 8] = static_cast<char>(changed[bit / 8] ^ (1 << bit % 8));
      sums.insert(checksum_of(changed));
    }
    EXPECT_EQ(sums.size(), size * 8 + 1) << size;
  }
}

TEST(Checksum64, EveryLengthHasItsOwn) {
  std::set<std::uint64_t> sums;
  for (std::size_t size = 0; size < 200; ++size) sums.insert(checksum_of(std::string(size, '\0')));
  EXPECT_EQ(sums.size(), 200u);
}

TEST(Checksum64, DivisionIntoPartsDoesNotMatter) {
  const std::string text = sample_text(150);
  for (std::size_t a = 0; a <= text.size(); a += 3)
    for (std::size_t b = a; b <= text.size(); b += 7) {
      Checksum64 sum;
      sum.add(std::string_view(text).substr(0, a));
      sum.add(std::string_view(text).substr(a, b - a));
      sum.value();
      sum.add(std::string_view(text).substr(b));
      ASSERT_EQ(sum.value(), checksum_of(text)) << a << ' ' << b;
    }
}

TEST(Checksum64, WordsInAnotherOrderDiffer) {
  const std::string text = sample_text(64);
  const auto with_swapped = [&](std::size_t a, std::size_t b) {
    std::string other = text;
    for (std::size_t i = 0; i < 8; ++i) std::swap(other[8 * a + i], other[8 * b + i]);
    return checksum_of(other);
  };
  for (std::size_t a = 0; a < 8; ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_NE(with_swapped(a, b), checksum_of(text));
}

}  // namespace checksum_test
}  // namespace oriel
