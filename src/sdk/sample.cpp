// SPDX-License-Identifier: Apache-2.0
// Random numbers of shaders: those of the sample, and those of no sample.
#include <atomic>
#include <cstdint>

#include "oriel/sdk/shader/sample.h"
#include "sampling/sampler.h"
#include "sdk/context.h"

namespace {

using oriel::Vec2;
using oriel::sampling::Sampler;

/// Pairs of dimensions that a loop keeps even over its samples; further ones are drawn alone.
constexpr int kPairs = 4;
/// Maximum number of nested loops of one thread.
constexpr int kLoops = 8;

/// A loop of mi_sample, known by its counter: where its pattern of points was shifted to.
struct Loop {
  const int* counter = nullptr;
  Vec2 shift[kPairs];
};
struct Loops {
  Loop of[kLoops];
  int next = 0;
};
thread_local Loops loops;

Loop& begin_loop(const int* counter, int dimensions, const miState* state) {
  Loop* loop = nullptr;
  for (Loop& l : loops.of)
    if (l.counter == counter) loop = &l;
  if (!loop) loop = &loops.of[loops.next++ % kLoops];
  loop->counter = counter;
  for (int k = 0; k < kPairs && 2 * k < dimensions; ++k) loop->shift[k] = oriel::sdk::next(state);
  return *loop;
}

const Loop* running_loop(const int* counter) {
  for (const Loop& l : loops.of)
    if (l.counter == counter) return &l;
  return nullptr;
}

float wrapped(float x) { return x < 1 ? x : x - 1; }

/// The points of all loops: a net, scrambled alike everywhere. The shift makes each of them even in
/// the unit square, and what the samples of a pixel draw for it spreads them over the pixel.
void fill(double* sample, int dimensions, int index, const Loop* loop, const miState* state) {
  Sampler net(0, 0, static_cast<std::uint32_t>(index));
  for (int k = 0; 2 * k < dimensions; ++k) {
    Vec2 u;
    if (loop && k < kPairs) {
      u = net.next_2d() + loop->shift[k];
      u = Vec2(wrapped(u.x), wrapped(u.y));
    } else {
      u = oriel::sdk::next(state);
    }
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

// The count is shared: each number is drawn once, whatever the thread.
miScalar mi_random(void) {
  const std::uint64_t count = random_count.fetch_add(1, std::memory_order_relaxed);
  return static_cast<float>(oriel::sampling::mix_bits(count * 0x9e3779b97f4a7c15ull) >> 40) *
         0x1p-24f;
}

void mi_srandom(long seed) {
  random_count = oriel::sampling::mix_bits(static_cast<std::uint64_t>(seed)) >> 1;
}

// The generator of POSIX erand48, whose seeds these are: x = (0x5deece66d x + 11) mod 2^48.
miScalar mi_erandom(unsigned short seed[3]) {
  const std::uint64_t x =
      std::uint64_t{seed[0]} | (std::uint64_t{seed[1]} << 16) | (std::uint64_t{seed[2]} << 32);
  const std::uint64_t y = (x * 0x5deece66dull + 11) & 0xffffffffffffull;
  seed[0] = static_cast<unsigned short>(y);
  seed[1] = static_cast<unsigned short>(y >> 16);
  seed[2] = static_cast<unsigned short>(y >> 32);
  return static_cast<float>(y >> 24) * 0x1p-24f;
}
