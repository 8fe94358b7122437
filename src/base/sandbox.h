// SPDX-License-Identifier: Apache-2.0
// Limits of a process that decodes untrusted files: no file, network or process access.
#pragma once

#include <cstddef>
#include <string>

namespace oriel {

/// Limits of the process.
struct SandboxLimits {
  std::size_t memory_bytes = 0;       ///< of private data (RLIMIT_DATA); 0 = none
  std::size_t processor_seconds = 0;  ///< in all (RLIMIT_CPU); 0 = none
};

/// Confines the calling process, which must have one thread, for its remaining life.
///
/// Model:   resource limits, then a seccomp filter. Allowed are reading and writing of open
///          descriptors, memory without execution rights, and time. Everything else fails with
///          EPERM. Functions that open or examine a path raise a signal, whose handler answers for
///          the granted file and for /proc/self/fd/N of an open descriptor, and refuses all others.
/// Errors:  std::runtime_error if the kernel does not support the filter.
/// Source:  seccomp(2), Documentation/userspace-api/seccomp_filter.rst of Linux.
/// Checked: Sandbox.*
void enter_sandbox(const SandboxLimits& limits);

/// Makes one path readable: opening it duplicates the descriptor. Replaces the grant before.
/// Inputs:  path: not copied; null: no file.
void grant_file(const char* path, int descriptor);

}  // namespace oriel
