// SPDX-License-Identifier: Apache-2.0
// Long work that can be watched and ended early.
#pragma once

#include <atomic>
#include <functional>

namespace oriel {

/// Whoever starts the work keeps what this refers to.
struct ProgressMonitor {
  const std::atomic<bool>* cancel = nullptr;            ///< true: end soon, with what is there
  std::function<void(const char*, double)> progress{};  ///< name of the work, share that is done

  bool cancelled() const { return cancel && *cancel; }
  void report(const char* name, double share) const {
    if (progress) progress(name, share);
  }
};

}  // namespace oriel
