// SPDX-License-Identifier: Apache-2.0
// From an edit to its first picture: how long do the edit, the preparation and the picture take?
//
//     edit_bench SCENE.mi REPETITIONS ELEMENT.PARAMETER=VALUE...
//
// Each edit is made and taken back. Times are medians in milliseconds, without the program's
// server: of the clock, and in parentheses of all threads, which depends less on what else runs.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "interactive/render_loop.h"
#include "shaders/registry.h"

namespace {

using namespace oriel;
using interactive::RenderLoop;
using Clock = std::chrono::steady_clock;

/// Times of one step in all its repetitions.
struct Step {
  std::vector<double> wall, processor;

  template <class F>
  void run(F&& step) {
    const Clock::time_point start = Clock::now();
    const std::clock_t processor_start = std::clock();
    step();
    processor.push_back(1000.0 * static_cast<double>(std::clock() - processor_start) /
                        CLOCKS_PER_SEC);
    wall.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  static double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
  }
  std::string text() const {
    return fmt::format("{:.1f} ({:.1f})", median(wall), median(processor));
  }
};

struct Times {
  Step edit, prepare, picture;
};

/// Renders until the first picture.
void show_first(RenderLoop& loop, std::atomic<bool>& stop) {
  stop = false;
  loop.run(stop);
}

void measure(RenderLoop& loop, std::atomic<bool>& stop, const std::vector<std::string>& edits,
             Times& times) {
  times.edit.run([&] { loop.set_edits(edits); });
  times.prepare.run([&] { loop.prepare(); });
  times.picture.run([&] { show_first(loop, stop); });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: edit_bench SCENE.mi REPETITIONS EDIT...\n");
    return 2;
  }
  interactive::SceneSource source;
  source.path = argv[1];
  source.registry = &builtin_shaders();
  source.read.packages = builtin_packages();
  source.read.knows_shader = [](std::string_view type) {
    return builtin_shaders().find(type) != nullptr;
  };
  std::atomic<bool> stop = false;
  RenderLoop loop(source, {}, [&](const auto&) { stop = true; });
  if (!loop.read()) return 1;
  Step all;
  all.run([&] { loop.prepare(); });
  fmt::print("| change | edit | prepare | picture | whole preparations |\n|---|---|---|---|---|\n");
  fmt::print("| all | | {} | | |\n", all.text());
  show_first(loop, stop);
  for (int i = 3; i < argc; ++i) {
    Times times;
    const std::size_t before = loop.scene().preparations();
    const int repetitions = std::max(std::atoi(argv[2]), 1);
    for (int k = 0; k < repetitions; ++k) {
      measure(loop, stop, {argv[i]}, times);
      measure(loop, stop, {}, times);
    }
    fmt::print("| {} | {} | {} | {} | {} of {} |\n", argv[i], times.edit.text(),
               times.prepare.text(), times.picture.text(), loop.scene().preparations() - before,
               2 * repetitions);
  }
  return 0;
}
