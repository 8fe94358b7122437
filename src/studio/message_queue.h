// SPDX-License-Identifier: Apache-2.0
// Messages that wait for the thread that sends them.
#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace oriel::studio {

/// Keeps messages in the order of push(). Handlers posted to an io_context do not keep it: those
/// that its own thread posts may run after those that other threads post later.
class MessageQueue {
 public:
  // From any thread:
  void push(std::string message) {
    const std::scoped_lock lock(mutex_);
    messages_.push_back(std::move(message));
  }
  std::vector<std::string> take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(messages_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

}  // namespace oriel::studio
