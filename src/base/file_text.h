// SPDX-License-Identifier: Apache-2.0
// Reads small files.
#pragma once

#include <filesystem>
#include <string>

#include "base/file_access.h"

namespace oriel {

/// The content of the file; empty if it cannot be read or is not a regular file.
inline std::string file_text(const std::filesystem::path& path) {
  OpenFile file = open_regular(path.string());
  return file ? file.read() : std::string();
}

}  // namespace oriel
