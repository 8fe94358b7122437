// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <pmmintrin.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <xmmintrin.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>

namespace oriel {

ThreadLimit::ThreadLimit(int count)
    : control_(count > 0 ? new tbb::global_control(tbb::global_control::max_allowed_parallelism,
                                                   static_cast<std::size_t>(count))
                         : nullptr) {}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

void flush_denormals() {
  _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
  _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
}

#if defined(__SANITIZE_THREAD__)

// The thread sanitizer does not see how TBB orders its tasks, since TBB is not built with it. These
// threads show it the order that callers of parallel_for() may rely on, and no other.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  const std::size_t most =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::atomic<bool> failed{false};
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < std::min(most, count); ++k)
    threads.emplace_back([&] {
      flush_denormals();
      for (std::size_t i = next++; i < count && !failed; i = next++) try {
          body(i);
        } catch (...) {
          if (!failed.exchange(true)) failure = std::current_exception();
        }
    });
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

#else

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::parallel_for(
      std::size_t{0}, count,
      [&](std::size_t i) {
        flush_denormals();
        body(i);
      },
      tbb::simple_partitioner());
}

#endif

}  // namespace oriel
