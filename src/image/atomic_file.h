// SPDX-License-Identifier: Apache-2.0
// Files that appear whole or not at all: written beside the target, then renamed over it.
#pragma once

#include <functional>
#include <string>

namespace oriel {

/// Calls `write` with the name of a temporary file in the folder of `path` (same extension, so that
/// writers that go by it agree), then renames that file to `path`. When `write` throws, the
/// temporary file is removed, an older file at `path` stays, and the exception goes on.
/// Errors:  std::runtime_error when the rename fails.
/// Checked: AtomicFile.* in atomic_file_test.cpp
void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write);

}  // namespace oriel
