// SPDX-License-Identifier: Apache-2.0
// Random numbers of shaders: by sample, and independent ones.
#include <atomic>
#include <cstdint>

#include "oriel/sdk/shader/sample.h"
#include "sampling/shifted_net.h"
#include "sdk/context.h"

namespace {

using oriel::sampling::ShiftedNet;

/// Maximum number of nested loops of one thread.
constexpr int kLoops = 8;

/// A loop of mi_sample, identified by the address of its counter.
struct Loop {
  const int* counter = nullptr;
  ShiftedNet net;
};
struct Loops {
  Loop of[kLoops];
  int next = 0;
};
thread_local Loops loops;

auto numbers_of(const miState* state) {
  return [state] { return oriel::sdk::next(state); };
}

Loop& begin_loop(const int* counter, int dimensions, const miState* state) {
  Loop* loop = nullptr;
  for (Loop& l : loops.of)
    if (l.counter == counter) loop = &l;
  if (!loop) loop = &loops.of[loops.next++ % kLoops];
  loop->counter = counter;
  loop->net.start(dimensions, numbers_of(state));
  return *loop;
}

const Loop* running_loop(const int* counter) {
  for (const Loop& l : loops.of)
    if (l.counter == counter) return &l;
  return nullptr;
}

/// A point of a loop; independent numbers outside of loops.
void fill(double* sample, int dimensions, int index, const Loop* loop, const miState* state) {
  if (loop) return loop->net.fill(sample, dimensions, index, numbers_of(state));
  for (int k = 0; 2 * k < dimensions; ++k) {
    const oriel::Vec2 u = oriel::sdk::next(state);
    sample[2 * k] = u.x;
    if (2 * k + 1 < dimensions) sample[2 * k + 1] = u.y;
  }
}

std::atomic<std::uint64_t> random_count = 0;

}  // namespace

miBoolean mi_sample(double* sample, int* instance, miState* state, miUshort dim, const miUint* n) {
  if (!instance) {
    fill(sample, dim, 0, nullptr, state);
    return miFALSE;
  }
  if (n && (*instance < 0 || static_cast<miUint>(*instance) >= *n)) return miFALSE;
  const Loop* loop = *instance == 0 ? &begin_loop(instance, dim, state) : running_loop(instance);
  fill(sample, dim, *instance, loop, state);
  ++*instance;
  return miTRUE;
}

double mi_par_random(miState* state) { return oriel::sdk::next(state).x; }

// The counter is shared by all threads, so each number is drawn once.
miScalar mi_random(void) {
  const std::uint64_t count = random_count.fetch_add(1, std::memory_order_relaxed);
  return static_cast<float>(oriel::sampling::mix_bits(count * 0x9e3779b97f4a7c15ull) >> 40) *
         0x1p-24f;
}

void mi_srandom(long seed) {
  random_count = oriel::sampling::mix_bits(static_cast<std::uint64_t>(seed)) >> 1;
}

miScalar mi_erandom(unsigned short seed[3]) { return oriel::sampling::erand48(seed); }
