// SPDX-License-Identifier: Apache-2.0
// gzip-compressed scene files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/file_access.h"
#include "base/scene_budgets.h"

namespace oriel::mi {

/// Maximum sizes of the text of one file.
struct TextLimits {
  std::uint64_t text = std::uint64_t{1} << 40;       ///< bytes
  std::uint64_t expansion = std::uint64_t{1} << 20;  ///< bytes for each compressed byte
};

/// Why a file cannot be read.
struct SourceFault {
  std::string reason;
  std::optional<Budget> budget;  ///< set if its text exceeds this budget
};

/// Whether the file has the gzip magic number. Does not move its position.
bool is_gzip(const OpenFile& file);

/// Returns the decompressed text, or nullopt and the reason if the file is damaged, truncated, or
/// its text exceeds the limits. The expansion is limited from 64 MB of text.
/// Checked: Gzip.*
std::optional<std::string> read_gzip(const OpenFile& file, const TextLimits& limits,
                                     SourceFault& fault);

}  // namespace oriel::mi
