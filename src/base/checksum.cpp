// SPDX-License-Identifier: Apache-2.0
#include "base/checksum.h"

#include <algorithm>
#include <cstring>

namespace oriel {
namespace {

/// 2^64 over the golden ratio, odd (D. Knuth, "The Art of Computer Programming" 3, 6.4).
constexpr std::uint64_t kChecksumFactor = 0x9e3779b97f4a7c15ull;
constexpr int kHalfWord = 32;

/// The product carries each bit to those above it, the shift those back to the lower half.
std::uint64_t mixed(std::uint64_t state, std::uint64_t word) {
  state = (state ^ word) * kChecksumFactor;
  return state ^ (state >> kHalfWord);
}

}  // namespace

void Checksum64::take(Lanes& lanes, const unsigned char* block) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    std::uint64_t word;
    std::memcpy(&word, block + i * sizeof word, sizeof word);
    lanes[i] = mixed(lanes[i], word);
  }
}

void Checksum64::add(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  const std::size_t begun = size_ % kBlock;
  size_ += size;
  if (begun > 0) {
    const std::size_t part = std::min(size, kBlock - begun);
    std::memcpy(rest_.data() + begun, bytes, part);
    bytes += part, size -= part;
    if (begun + part < kBlock) return;
    take(lanes_, rest_.data());
  }
  for (; size >= kBlock; bytes += kBlock, size -= kBlock) take(lanes_, bytes);
  if (size > 0) std::memcpy(rest_.data(), bytes, size);
}

std::uint64_t Checksum64::value() const {
  Lanes lanes = lanes_;
  if (const std::size_t begun = size_ % kBlock; begun > 0) {
    std::array<unsigned char, kBlock> last{};
    std::copy_n(rest_.begin(), begun, last.begin());
    take(lanes, last.data());
  }
  std::uint64_t sum = size_;
  for (const std::uint64_t lane : lanes) sum = mixed(mixed(mixed(sum, lane), 0), 0);
  return sum;
}

}  // namespace oriel
