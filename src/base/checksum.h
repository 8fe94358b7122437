// SPDX-License-Identifier: Apache-2.0
// A fast checksum of bytes, against damage and mistakes, not against attackers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace oriel {

/// A 64-bit checksum of a stream of bytes.
///
/// Model:   four lanes, each of which takes every fourth word of eight bytes by an exclusive or, an
///          odd factor and a shift. Each step is invertible, so two streams of equal length that
///          differ in one word always have different checksums.
/// Checked: Checksum64.*
class Checksum64 {
 public:
  void add(const void* data, std::size_t size);
  void add(std::string_view text) { add(text.data(), text.size()); }
  /// Of all bytes so far; more may be added.
  std::uint64_t value() const;

 private:
  static constexpr std::size_t kLanes = 4, kBlock = kLanes * sizeof(std::uint64_t);
  using Lanes = std::array<std::uint64_t, kLanes>;
  static void take(Lanes& lanes, const unsigned char* block);

  Lanes lanes_{1, 2, 3, 4};
  std::array<unsigned char, kBlock> rest_{};
  std::uint64_t size_ = 0;
};

}  // namespace oriel
