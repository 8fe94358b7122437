// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.h"

#include <pmmintrin.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <xmmintrin.h>

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

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::parallel_for(
      std::size_t{0}, count,
      [&](std::size_t i) {
        flush_denormals();
        body(i);
      },
      tbb::simple_partitioner());
}

}  // namespace oriel
