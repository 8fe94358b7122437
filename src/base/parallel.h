// SPDX-License-Identifier: Apache-2.0
// Parallel loops with oneTBB; worker threads flush denormals to zero.
#pragma once

#include <cstddef>
#include <functional>

namespace oriel {

/// Limits all parallel loops of the process to `count` threads during its lifetime; 0 = all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int count);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// Flushes denormals to zero on the calling thread, as Embree recommends.
void flush_denormals();

/// Calls body(i) for each i in [0, count), in any order, on any thread.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

}  // namespace oriel
