// SPDX-License-Identifier: Apache-2.0
// Processes that compute maps of one picture together.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace oriel {

/// The part of a process in work that it shares with others. All processes call the functions in
/// the same order.
class WorkShare {
 public:
  virtual ~WorkShare() = default;
  virtual bool leads() const = 0;
  /// Whether item i of the work belongs to this process.
  virtual bool owns(std::size_t i) const = 0;
  /// The bytes of the leader, in all processes.
  virtual std::string from_leader(std::string bytes) = 0;
  /// The bytes of all processes, in the same order everywhere. Empty if a process was interrupted:
  /// the work then ends.
  virtual std::vector<std::string> exchange(const std::string& own) = 0;
};

}  // namespace oriel
