// SPDX-License-Identifier: Apache-2.0
// Final gather maps on disk: records in our own format.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "transport/gather/gather_record.h"

namespace oriel {

// Format, version 1
//   "ORIELFGM", u32 0x01020304 in the writer's byte order, u32 version, u32 floats in a record,
//   u32 0, u64 records; the records as floats, member by member; u64 FNV-1a of all that precedes.

/// Largest map that is read or written.
inline constexpr std::uint64_t kMaxGatherRecords = 1u << 23;

/// Writes records in order, whole or not at all.
///
/// Errors: OR-TR-101 and false.
bool save_gather_map(std::span<const GatherRecord> records, const std::string& path,
                     Diagnostics& diagnostics);

/// The records of a map.
///
/// Returns: nothing where there is no map that can be used; never part of one.
/// Errors:  OR-TR-102, one warning that says why: not readable, not a map of ours (those of other
///          renderers have formats of their own), another version or byte order, damaged.
/// Checked: gather_map_test.cpp
std::optional<std::vector<GatherRecord>> load_gather_map(const std::string& path,
                                                         Diagnostics& diagnostics);

}  // namespace oriel
