// SPDX-License-Identifier: Apache-2.0
// Gather records in checkpoints and messages.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "base/checkpoint_file.h"
#include "transport/gather/gather_record.h"

namespace oriel {

/// The numbers of a record, which precede its shares in memory, without gaps.
inline constexpr std::size_t kBytesOfRecord = offsetof(GatherRecord, shares);
inline constexpr std::size_t kNumbersOfRecord = kBytesOfRecord / sizeof(float);
static_assert(kBytesOfRecord == 5 * sizeof(Vec3) + 4 * sizeof(float) + sizeof(GatherRecord::free) +
                                    sizeof(IncomingLight) + 4 * sizeof(Vec3));

/// Writes records to a CheckpointWriter or ByteWriter.
template <class Out>
void save_records(Out& out, std::span<const GatherRecord> records) {
  std::vector<float> numbers(records.size() * kNumbersOfRecord);
  std::vector<std::uint8_t> counts;
  std::vector<Rgb> shares;  // at most kMaxLightLayers of each record
  std::size_t at = 0;
  for (const GatherRecord& record : records) {
    std::memcpy(&numbers[at], static_cast<const void*>(&record), kBytesOfRecord);
    at += kNumbersOfRecord;
    counts.push_back(static_cast<std::uint8_t>(record.shares.size()));
    shares.insert(shares.end(), record.shares.begin(), record.shares.end());
  }
  out.list(numbers);
  out.list(counts);
  out.list(shares);
}

/// Reads what save_records() wrote, from a CheckpointReader or ByteReader.
/// Errors:  CheckpointError if a record is invalid.
template <class In>
std::vector<GatherRecord> restore_records(In& in) {
  std::vector<float> numbers;
  std::vector<std::uint8_t> counts;
  std::vector<Rgb> shares;
  in.list(numbers);
  in.list(counts);
  in.list(shares);
  const auto require = [](bool condition) {
    if (!condition) throw CheckpointError("its gather points are invalid");
  };
  require(numbers.size() == counts.size() * kNumbersOfRecord);
  require(std::all_of(shares.begin(), shares.end(), [](const Rgb& s) { return is_finite(s); }));
  std::vector<GatherRecord> records(counts.size());
  std::size_t used = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    std::memcpy(static_cast<void*>(&records[i]), &numbers[i * kNumbersOfRecord], kBytesOfRecord);
    require(std::isfinite(records[i].noise));
    const std::size_t count = counts[i];
    require(count <= shares.size() - used);
    const auto first = shares.begin() + static_cast<std::ptrdiff_t>(used);
    records[i].shares.assign(first, first + static_cast<std::ptrdiff_t>(count));
    used += count;
  }
  require(used == shares.size());
  return records;
}

}  // namespace oriel
