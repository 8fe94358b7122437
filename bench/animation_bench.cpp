// SPDX-License-Identifier: Apache-2.0
// How much sooner is the next frame of an animation prepared for what stayed as it was?
//
// The room of 1.08 million triangles; between frames the camera moves, or one of its balls, or a
// ball is made anew. Each is prepared with the geometry of the frame before and without, in turns;
// printed are medians of processor time and of the ratio.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "base/parallel.h"
#include "bench_scenes.h"
#include "mi/reader.h"
#include "prepare/prepare.h"
#include "shaders/registry.h"
#include "timing.h"

namespace {

using namespace oriel;

constexpr int kTurns = 7;

struct Change {
  const char* name;
  const char* text;
};

constexpr Change kChanges[] = {
    {"the camera moves",
     "incremental instance \"camera_inst\" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -.1 1 end "
     "instance\n"},
    {"one ball of 27 moves",
     "incremental instance \"ball0_inst\" transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 .01 1 end "
     "instance\n"},
    {"one ball is defined again", "touch \"ball0\"\n"}};

/// Prepares all frames of the text; processor seconds of the second.
double second_frame(const std::string& text, bool reuse) {
  Diagnostics diagnostics;
  mi::ReadOptions options;
  options.packages = builtin_packages();
  options.knows_shader = [](std::string_view type) {
    return builtin_shaders().find(type) != nullptr;
  };
  mi::Reader reader = mi::Reader::from_text(text, std::move(options), diagnostics);
  scene::Scene scene;
  GeometryCache cache;
  double seconds = 0;
  while (reader.next_frame(scene)) {
    PrepareReport report;
    PrepareOptions prepare_options;
    if (reuse) prepare_options.cache = &cache;
    std::unique_ptr<World> world;
    seconds = bench::timed([&] {
                world = prepare(scene, scene.renders.back(), builtin_shaders(), prepare_options,
                                diagnostics, report);
              }).cpu;
    if (!world) std::exit(EXIT_FAILURE);
    cache.keep(*world);
  }
  for (const Diagnostic& d : diagnostics.all()) fmt::print(stderr, "{}\n", diagnostics.format(d));
  return seconds;
}

}  // namespace

int main() {
  const ThreadLimit limit(1);
  const std::string room = bench::big_room();
  for (const Change& change : kChanges) {
    const std::string text = room + change.text + "render \"world\" \"camera_inst\" \"options\"\n";
    std::vector<double> with, without, ratio;
    for (int i = 0; i < kTurns; ++i) {
      without.push_back(second_frame(text, false));
      with.push_back(second_frame(text, true));
      ratio.push_back(without.back() / with.back());
    }
    fmt::print("{}: {:.3f} s anew, {:.3f} s with the frame before, {:.1f} x ({:.1f} to {:.1f})\n",
               change.name, bench::median(without), bench::median(with), bench::median(ratio),
               *std::min_element(ratio.begin(), ratio.end()),
               *std::max_element(ratio.begin(), ratio.end()));
  }
}
