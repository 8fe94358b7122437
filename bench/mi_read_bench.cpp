// SPDX-License-Identifier: Apache-2.0
// How fast and how lean is a scene of a million triangles read?
//
// Two texts: vertices shared between triangles, as modellers write them, and one vertex per corner
// with its own normal and texture coordinate, as many exporters do. Reports bytes of text per
// second, and bytes of heap per triangle at the peak and at the end, both beyond the text.
#include <benchmark/benchmark.h>
#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <string>

#include "bench_scenes.h"
#include "mi/reader.h"

namespace {

// Counting allocator of this program: what mallinfo cannot tell is the peak.
std::atomic<std::size_t> heap_now{0}, heap_peak{0};

void* counted_allocation(std::size_t size) {
  void* const p = std::malloc(size);
  if (!p) throw std::bad_alloc();
  const std::size_t now = heap_now += malloc_usable_size(p);
  std::size_t peak = heap_peak;
  while (now > peak && !heap_peak.compare_exchange_weak(peak, now)) {
  }
  return p;
}

void counted_release(void* p) {
  if (p) heap_now -= malloc_usable_size(p);
  std::free(p);
}

constexpr int kSide = 708;  // squares along an edge: 2 * 708^2 = 1,002,528 triangles
constexpr int kTriangles = 2 * kSide * kSide;

void read(benchmark::State& state, const std::string& text) {
  std::size_t peak = 0, kept = 0;
  for (auto _ : state) {
    const std::size_t before = heap_now;
    heap_peak = before;
    oriel::Diagnostics diagnostics;
    const oriel::scene::Scene scene = oriel::mi::read_text(text, {}, diagnostics);
    peak = heap_peak - before - text.size();
    kept = heap_now - before;
    const auto* object = scene.get<oriel::scene::Object>("o");
    if (!object || object->groups[0].polygons.size() != kTriangles || !diagnostics.all().empty())
      state.SkipWithError("the scene was not read completely");
  }
  state.SetBytesProcessed(static_cast<std::int64_t>(text.size()) * state.iterations());
  state.counters["peak_B/tri"] = static_cast<double>(peak) / kTriangles;
  state.counters["kept_B/tri"] = static_cast<double>(kept) / kTriangles;
  state.counters["text_MB"] = static_cast<double>(text.size()) / 1e6;
}

void BM_SharedVertices(benchmark::State& state) {
  static const std::string text = oriel::bench::shared_vertices(kSide);
  read(state, text);
}
BENCHMARK(BM_SharedVertices)->Unit(benchmark::kMillisecond);

void BM_VertexPerCorner(benchmark::State& state) {
  static const std::string text = oriel::bench::vertex_per_corner(kSide);
  read(state, text);
}
BENCHMARK(BM_VertexPerCorner)->Unit(benchmark::kMillisecond);

}  // namespace

void* operator new(std::size_t size) { return counted_allocation(size); }
void operator delete(void* p) noexcept { counted_release(p); }
void operator delete(void* p, std::size_t) noexcept { counted_release(p); }

BENCHMARK_MAIN();
