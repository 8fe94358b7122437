// SPDX-License-Identifier: Apache-2.0
// Scene files that were compressed by gzip.
#pragma once

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>

namespace oriel::mi {

/// Whether the file begins as such files do; it is read from its begin again afterwards.
bool is_gzip(std::FILE* file);

/// The text of such a file; unset, and the reason, where it is damaged, cut off, or larger than
/// `max_size` bytes.
/// Checked: Gzip.*
std::optional<std::string> read_gzip(const std::string& path, std::uint64_t max_size,
                                     std::string& reason);

}  // namespace oriel::mi
