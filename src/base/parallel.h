// SPDX-License-Identifier: Apache-2.0
// Parallel loops with oneTBB; worker threads flush denormals to zero.
#pragma once

#include <algorithm>
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

/// The same for short bodies: a thread takes `block` consecutive i at a time. Inputs:  block: at
/// least 1.
/// Checked: Parallel.*
template <class Body>
void parallel_for_blocks(std::size_t count, std::size_t block, const Body& body) {
  const std::size_t blocks = count / block + (count % block != 0 ? 1 : 0);
  parallel_for(blocks, [&](std::size_t b) {
    const std::size_t end = std::min(count, (b + 1) * block);
    for (std::size_t i = b * block; i < end; ++i) body(i);
  });
}

}  // namespace oriel
