// SPDX-License-Identifier: Apache-2.0
// What share of bare Embree's ray rate does a path-traced picture keep?
//
// Every ray of the picture is recorded where it enters Embree, then the same rays go through the
// same Embree scene again with nothing around them. Both are timed in turns, in one run.
//
//     path_bench [SCENE.mi ...]      the built-in rooms and the interior when none is named
#include <dlfcn.h>
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "bench_scenes.h"
#include "mi/reader.h"
#include "prepare/prepare.h"
#include "shaders/registry.h"
#include "timing.h"
#include "transport/path/path.h"

namespace {

using Intersect = void (*)(RTCScene, RTCIntersectContext*, RTCRayHit*);
using Occluded = void (*)(RTCScene, RTCIntersectContext*, RTCRay*);

const auto embree_intersect = reinterpret_cast<Intersect>(dlsym(RTLD_NEXT, "rtcIntersect1"));
const auto embree_occluded = reinterpret_cast<Occluded>(dlsym(RTLD_NEXT, "rtcOccluded1"));
Intersect intersect_target = embree_intersect;
Occluded occluded_target = embree_occluded;

}  // namespace

// The program's own entry points stand before the library's. They do what the linker's stub for a
// call into a library does, one jump through a pointer, so the renderer is timed as it is.
extern "C" void rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray) {
  intersect_target(scene, context, ray);
}
extern "C" void rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
  occluded_target(scene, context, ray);
}

namespace {

using namespace oriel;
using bench::median;
using bench::Seconds;
using bench::timed;

/// A ray as Embree was asked.
struct RecordedRay {
  float org[3], tnear, dir[3], tfar;
  std::uint32_t mask;
  bool closest;
};

/// The rays of one line of pixels, in the order they were traced.
thread_local std::vector<RecordedRay>* recording = nullptr;
RTCScene recorded_scene = nullptr;

void record(const RTCRay& r, bool closest) {
  recording->push_back(
      {{r.org_x, r.org_y, r.org_z}, r.tnear, {r.dir_x, r.dir_y, r.dir_z}, r.tfar, r.mask, closest});
}

void record_intersect(RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray) {
  record(ray->ray, true);
  recorded_scene = scene;
  embree_intersect(scene, context, ray);
}

void record_occluded(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
  record(*ray, false);
  embree_occluded(scene, context, ray);
}

using Lines = std::vector<std::vector<RecordedRay>>;

void render(const World& world, int samples, Lines* lines) {
  const int width = world.camera.width, height = world.camera.height;
  parallel_for(static_cast<std::size_t>(height), [&](std::size_t line) {
    recording = lines ? &(*lines)[line] : nullptr;
    const int y = static_cast<int>(line);
    RayCounts counts;
    volatile float sink = 0;  // the picture itself is not wanted
    for (int x = 0; x < width; ++x)
      for (int s = 0; s < samples; ++s) {
        sampling::Sampler sampler(x, y, static_cast<std::uint32_t>(s));
        const Vec2 raster = Vec2(static_cast<float>(x), static_cast<float>(y)) + sampler.next_2d();
        const Camera::Ray eye = world.camera.ray(raster);
        sink = sink + trace_path(world, eye, raster, {}, sampler, counts).radiance.x;
      }
  });
}

void replay(RTCScene scene, const Lines& lines) {
  parallel_for(lines.size(), [&](std::size_t line) {
    for (const RecordedRay& r : lines[line]) {
      RTCIntersectContext context;
      rtcInitIntersectContext(&context);
      RTCRayHit query;
      query.ray = {r.org[0], r.org[1], r.org[2], r.tnear, r.dir[0], r.dir[1],
                   r.dir[2], 0,        r.tfar,   r.mask,  0,        0};
      if (r.closest) {
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        embree_intersect(scene, &context, &query);
      } else {
        embree_occluded(scene, &context, &query.ray);
      }
    }
  });
}

void compare(const World& world, int threads, int samples, int rounds) {
  const ThreadLimit limit(threads);
  Lines lines(static_cast<std::size_t>(world.camera.height));
  intersect_target = record_intersect;
  occluded_target = record_occluded;
  render(world, samples, &lines);
  intersect_target = embree_intersect;
  occluded_target = embree_occluded;
  std::size_t rays = 0, closest = 0;
  for (const auto& line : lines) {
    rays += line.size();
    closest += static_cast<std::size_t>(
        std::count_if(line.begin(), line.end(), [](const RecordedRay& r) { return r.closest; }));
  }

  std::vector<double> ours, bare, wall_ratio, cpu_ratio;
  for (int round = 0; round < rounds; ++round) {
    const Seconds a = timed([&] { render(world, samples, nullptr); });
    const Seconds b = timed([&] { replay(recorded_scene, lines); });
    ours.push_back(1e-6 * static_cast<double>(rays) / a.wall);
    bare.push_back(1e-6 * static_cast<double>(rays) / b.wall);
    wall_ratio.push_back(b.wall / a.wall);
    cpu_ratio.push_back(b.cpu / a.cpu);
  }
  const auto [low, high] = std::minmax_element(cpu_ratio.begin(), cpu_ratio.end());
  fmt::print(
      "  {} thread{}  {:6.2f} M rays ({:2.0f} % closest)  render {:6.2f} Mrays/s  bare {:6.2f} "
      "Mrays/s  ratio {:.3f} by the clock, {:.3f} by processor time ({:.3f} to {:.3f})\n",
      threads, threads == 1 ? " " : "s", 1e-6 * static_cast<double>(rays),
      100.0 * static_cast<double>(closest) / static_cast<double>(rays), median(ours), median(bare),
      median(wall_ratio), median(cpu_ratio), *low, *high);
}

bool run(const std::string& name, const std::string* text) {
  constexpr int kWidth = 300, kHeight = 200, kSamples = 8, kRounds = 7;
  Diagnostics diagnostics;
  mi::ReadOptions options;
  options.packages = builtin_packages();
  options.knows_shader = [](std::string_view type) {
    return builtin_shaders().find(type) != nullptr;
  };
  scene::Scene scene;
  std::unique_ptr<World> world;
  PrepareReport report;
  const Seconds reading = timed([&] {
    scene = text ? mi::read_text(*text, options, diagnostics)
                 : mi::read_scene(name, options, diagnostics);
  });
  const Seconds preparing = timed([&] {
    PrepareOptions prepare_options;
    prepare_options.release_geometry = true;
    prepare_options.width = kWidth;
    prepare_options.height = kHeight;
    if (!scene.renders.empty())
      world = prepare(scene, scene.renders.back(), builtin_shaders(), prepare_options, diagnostics,
                      report);
  });
  for (const Diagnostic& d : diagnostics.all()) fmt::print(stderr, "{}\n", diagnostics.format(d));
  if (!world) {
    fmt::print(stderr, "{}: nothing to render\n", name);
    return false;
  }
  fmt::print("{}: {} triangles, read in {:.3f} s, prepared in {:.3f} s\n", name, report.triangles,
             reading.wall, preparing.wall);
  for (const int threads : {1, 2}) compare(*world, threads, kSamples, kRounds);
  std::fflush(stdout);
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  bool good = true;
  for (int i = 1; i < argc; ++i) good = run(argv[i], nullptr) && good;
  if (argc > 1) return good ? EXIT_SUCCESS : EXIT_FAILURE;
  for (const auto& [name, text] :
       {std::pair{"small room", bench::small_room()}, std::pair{"big room", bench::big_room()}})
    good = run(name, &text) && good;
  good = run(ORIEL_SOURCE_DIR "/scenes/interior/interior.mi", nullptr) && good;
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
