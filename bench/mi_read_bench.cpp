// SPDX-License-Identifier: Apache-2.0
// How fast and how lean is a scene of a million triangles read?
//
// Two texts: vertices shared between triangles, as modellers write them, and one vertex per corner
// with its own normal and texture coordinate, as many exporters do. Reports bytes of text per
// second, and bytes of heap per triangle at the peak and at the end, both beyond the text.
#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <malloc.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <new>
#include <string>

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

using Text = std::back_insert_iterator<std::string>;

float height(int x, int y) {
  return 0.25f * std::sin(0.05f * static_cast<float>(x)) * std::cos(0.07f * static_cast<float>(y));
}

void write_point(Text out, int x, int y) {
  fmt::format_to(out, "{:.6g} {:.6g} {:.6g}\n", static_cast<float>(x) * 0.013f, height(x, y),
                 static_cast<float>(y) * 0.013f);
}

std::string shared_vertices() {
  std::string text = "object \"o\" visible trace shadow\ngroup\n";
  const Text out = std::back_inserter(text);
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x) write_point(out, x, y);
  for (int i = 0; i < (kSide + 1) * (kSide + 1); ++i) fmt::format_to(out, "v {}\n", i);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const int a = y * (kSide + 1) + x, b = a + 1, c = a + kSide + 2, d = a + kSide + 1;
      fmt::format_to(out, "p {} {} {}\np {} {} {}\n", a, b, c, a, c, d);
    }
  return text + "end group\nend object\n";
}

std::string vertex_per_corner() {
  std::string text = "object \"o\" visible trace shadow\ngroup\n";
  const Text out = std::back_inserter(text);
  const int points = (kSide + 1) * (kSide + 1);
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x) write_point(out, x, y);
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x)
      fmt::format_to(out, "{:.5f} {:.5f} {:.5f}\n", height(y, x), 1 - height(x, x), height(y, y));
  int corner = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const int a = y * (kSide + 1) + x, b = a + 1, c = a + kSide + 2, d = a + kSide + 1;
      for (const int i : {a, b, c, a, c, d})
        fmt::format_to(out, "v {} n {} t {}\n", i, points + i, i);
    }
  for (int i = 0; i < kTriangles; ++i, corner += 3)
    fmt::format_to(out, "p \"m\" {} {} {}\n", corner, corner + 1, corner + 2);
  return text + "end group\nend object\n";
}

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
  static const std::string text = shared_vertices();
  read(state, text);
}
BENCHMARK(BM_SharedVertices)->Unit(benchmark::kMillisecond);

void BM_VertexPerCorner(benchmark::State& state) {
  static const std::string text = vertex_per_corner();
  read(state, text);
}
BENCHMARK(BM_VertexPerCorner)->Unit(benchmark::kMillisecond);

}  // namespace

void* operator new(std::size_t size) { return counted_allocation(size); }
void operator delete(void* p) noexcept { counted_release(p); }
void operator delete(void* p, std::size_t) noexcept { counted_release(p); }

BENCHMARK_MAIN();
