// SPDX-License-Identifier: Apache-2.0
// Atomic file writing: data goes to a temporary file, which then replaces the target.
#pragma once

#include <functional>
#include <string>

namespace oriel {

/// Calls `write` with the name of a temporary file in the folder of `path`, then renames that file
/// to `path`. The temporary file has the same extension, because some writers select the format by
/// it. If `write` throws, the temporary file is removed, an existing file at `path` is kept, and
/// the exception is rethrown.
/// Errors:  std::runtime_error when the rename fails.
/// Checked: AtomicFile.* in atomic_file_test.cpp
void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write);

}  // namespace oriel
