// SPDX-License-Identifier: Apache-2.0
// From a .mi file of a million triangles to a committed acceleration structure: how long, how big?
//
// Each form of the text is measured in a process of its own, so that no memory of the one before
// is counted. Memory is what the system gave the process beyond what it had when it started.
#include <fmt/format.h>
#include <malloc.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "base/parallel.h"
#include "bench_scenes.h"
#include "mi/reader.h"
#include "prepare/prepare.h"
#include "shaders/registry.h"
#include "timing.h"

namespace {

using namespace oriel;
using bench::Seconds;
using bench::timed;
namespace fs = std::filesystem;

constexpr int kSide = 708;  // 2 * 708^2 = 1,002,528 triangles
constexpr double kTriangles = 2.0 * kSide * kSide;

/// A line of /proc/self/status, in bytes.
double status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return 1024 * std::atof(line.c_str() + name.size() + 1);
  return 0;
}

/// Lets the peak start anew from what the process holds now.
void forget_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

int measure(const std::string& form, const std::string& path, int threads) {
  const ThreadLimit limit(threads);
  const double text = static_cast<double>(fs::file_size(path));
  Diagnostics diagnostics;
  mi::ReadOptions options;
  options.packages = builtin_packages();
  options.knows_shader = [](std::string_view type) {
    return builtin_shaders().find(type) != nullptr;
  };
  forget_peak();
  const double start = status_bytes("VmRSS");
  scene::Scene scene;
  const Seconds reading =
      timed([&] { scene = mi::read_scene(path, std::move(options), diagnostics); });
  const double read_peak = status_bytes("VmHWM") - start - text;
  forget_peak();
  const double scene_bytes = status_bytes("VmRSS") - start;

  PrepareReport report;
  PrepareOptions prepare_options;
  prepare_options.release_geometry = true;
  std::unique_ptr<World> world;
  const Seconds preparing = timed([&] {
    world = prepare(scene, scene.renders.back(), builtin_shaders(), prepare_options, diagnostics,
                    report);
  });
  const double prepare_peak = status_bytes("VmHWM") - start;
  malloc_trim(0);
  const double kept = status_bytes("VmRSS") - start;
  for (const Diagnostic& d : diagnostics.all()) fmt::print(stderr, "{}\n", diagnostics.format(d));
  if (!world || report.triangles != static_cast<std::size_t>(kTriangles)) {
    fmt::print(stderr, "the scene was not read completely\n");
    return EXIT_FAILURE;
  }
  const geom::AccelMemory memory = world->accel->memory();
  const auto each = [](auto bytes) { return static_cast<double>(bytes) / kTriangles; };
  fmt::print(
      "{}, {:.0f} MB of text, {} thread{}\n"
      "  time      read {:.3f} s   prepare {:.3f} s\n"
      "  processor read {:.3f} s ({:.0f} MB/s)   prepare {:.3f} s\n"
      "  B/triangle at the end   scene as read {:.1f}   meshes {:.1f}   Embree {:.1f}   process "
      "{:.1f}\n"
      "  B/triangle at the peak  while reading, beyond the text {:.1f}   while preparing {:.1f}\n",
      form, 1e-6 * text, threads, threads == 1 ? "" : "s", reading.wall, preparing.wall,
      reading.cpu, 1e-6 * text / reading.cpu, preparing.cpu, each(scene_bytes), each(memory.meshes),
      each(memory.embree), each(kept), each(read_peak), each(prepare_peak));
  std::fflush(stdout);
  return EXIT_SUCCESS;
}

int measure_in_child(const std::string& form, const std::string& path, int threads) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) _exit(measure(form, path, threads));
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0 || !WIFEXITED(status)) return EXIT_FAILURE;
  return WEXITSTATUS(status);
}

}  // namespace

int main() {
  const fs::path folder = fs::temp_directory_path() / fmt::format("oriel-bench-{}", getpid());
  fs::create_directory(folder);
  int result = EXIT_SUCCESS;
  constexpr std::pair<const char*, std::string (*)(int)> kForms[] = {
      {"shared vertices", bench::shared_vertices}, {"vertex per corner", bench::vertex_per_corner}};
  for (const auto& [form, make] : kForms) {
    const std::string path = (folder / "scene.mi").string();
    std::ofstream(path) << bench::around_object(make(kSide));
    malloc_trim(0);
    for (const int threads : {1, 2})
      if (measure_in_child(form, path, threads) != EXIT_SUCCESS) result = EXIT_FAILURE;
  }
  fs::remove_all(folder);
  return result;
}
