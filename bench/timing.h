// SPDX-License-Identifier: Apache-2.0
// How benches take time.
#pragma once

#include <algorithm>
#include <chrono>
#include <ctime>
#include <vector>

namespace oriel::bench {

struct Seconds {
  double wall = 0, cpu = 0;
};

/// Time on the clock, and of all threads of the process: other programs' work is not in it.
template <class F>
Seconds timed(F&& f) {
  const auto cpu = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  const double cpu_before = cpu();
  const auto before = std::chrono::steady_clock::now();
  f();
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count(),
          cpu() - cpu_before};
}

template <class T>
T median(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

}  // namespace oriel::bench
