// SPDX-License-Identifier: Apache-2.0
// gzip-compressed scene files.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace oriel::mi {

/// Whether the file has the gzip magic number. Rewinds the file.
bool is_gzip(std::FILE* file);

/// Returns the decompressed text, or nullopt and the reason if the file is damaged, truncated, or
/// its text is larger than `max_size` bytes.
/// Checked: Gzip.*
std::optional<std::string> read_gzip(const std::string& path, std::uint64_t max_size,
                                     std::string& reason);

}  // namespace oriel::mi
