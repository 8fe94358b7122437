// SPDX-License-Identifier: Apache-2.0
// Final gather map files, in Oriel's own format.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "transport/gather/gather_record.h"

namespace oriel {

// Format, version 1
//   "ORIELFGM", u32 0x01020304 in the writer's byte order, u32 version, u32 floats per record, u32
//   0, u64 number of records; the records as floats, member by member; u64 FNV-1a hash of all
//   preceding bytes.

/// Maximum number of records of a map that is read or written.
inline constexpr std::uint64_t kMaxGatherRecords = 1u << 23;

/// Writes the records in order. Replaces the file as a whole (DurableFile), and only if it is a
/// final gather map of Oriel or empty.
///
/// Errors:  OR-TR-101; returns false.
bool save_gather_map(std::span<const GatherRecord> records, const std::string& path,
                     Diagnostics& diagnostics);

/// Reads the records of a map.
///
/// Inputs:  most: maximum number of records.
/// Returns: empty if the map cannot be used; never a part of a map.
/// Errors:  OR-TR-102, one warning with the reason: not readable, not an Oriel map (other renderers
///          have their own formats), another version or byte order, damaged.
/// Checked: gather_map_test.cpp
std::optional<std::vector<GatherRecord>> load_gather_map(const std::string& path,
                                                         Diagnostics& diagnostics,
                                                         std::uint64_t most = kMaxGatherRecords);

}  // namespace oriel
