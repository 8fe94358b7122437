// SPDX-License-Identifier: Apache-2.0
#include "sdk/caller.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <vector>

namespace oriel::sdk {
namespace {

/// Allocates thread numbers; numbers of finished threads are reused.
struct ThreadNumbers {
  std::mutex mutex;
  std::vector<bool> taken;
};
/// Never destroyed: threads may end after static destruction.
ThreadNumbers& thread_numbers() {
  static auto* const numbers = new ThreadNumbers;
  return *numbers;
}

class OwnNumber {
 public:
  OwnNumber() {
    ThreadNumbers& all = thread_numbers();
    const std::lock_guard lock(all.mutex);
    const auto free = std::find(all.taken.begin(), all.taken.end(), false);
    value_ = static_cast<std::size_t>(free - all.taken.begin());
    if (free == all.taken.end())
      all.taken.push_back(true);
    else
      *free = true;
  }
  ~OwnNumber() {
    ThreadNumbers& all = thread_numbers();
    const std::lock_guard lock(all.mutex);
    all.taken[value_] = false;
  }
  OwnNumber(const OwnNumber&) = delete;
  OwnNumber& operator=(const OwnNumber&) = delete;
  std::size_t value() const { return value_; }

 private:
  std::size_t value_ = 0;
};

}  // namespace

Caller& Caller::current() {
  thread_local Caller caller;
  return caller;
}

short thread_number() {
  thread_local const OwnNumber number;
  return static_cast<short>(number.value());
}

std::uint64_t thread_generation() {
  static std::atomic<std::uint64_t> last = 0;
  thread_local const std::uint64_t own = ++last;
  return own;
}

}  // namespace oriel::sdk
