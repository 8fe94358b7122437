// SPDX-License-Identifier: Apache-2.0
// How large may a scene be? Ten million triangles, a hundred million instanced ones, ten thousand
// texture files: memory and time of the program itself, as the system counts them.
//
// `scale_bench [geometry] [instances] [textures]`. Scenes are written by processes that end before
// `oriel` starts, for a child's peak begins with that of the process it comes from.
#include <ImfHeader.h>
#include <ImfRgba.h>
#include <ImfTiledRgbaFile.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bench_scenes.h"
#include "mi/reader.h"
#include "shaders/registry.h"
#include "timing.h"

namespace {

using namespace oriel;
using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr double kMega = 1e6;

/// What one run of the program took.
struct Run {
  double wall = 0, cpu = 0;              // s
  double first_wall = 0, first_cpu = 0;  // s, until the first pass was there
  double peak = 0, rendering = 0;        // bytes resident: at most; in the last pass
  nlohmann::json done;                   // its last line
};

/// A line of /proc/PID/status, in bytes.
double status_bytes(pid_t process, const std::string& name) {
  std::ifstream status(fmt::format("/proc/{}/status", process));
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return 1024 * std::atof(line.c_str() + name.size() + 1);
  return 0;
}

/// Processor time of all threads so far, s.
double processor_seconds(pid_t process) {
  std::ifstream stat(fmt::format("/proc/{}/stat", process));
  std::string text;
  std::getline(stat, text);
  // Behind the name in brackets, which may hold anything; utime and stime are fields 14 and 15.
  std::istringstream fields(text.substr(text.rfind(')') + 1));
  std::string skipped;
  for (int i = 3; i < 14; ++i) fields >> skipped;
  double user = 0, system = 0;
  fields >> user >> system;
  return (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double seconds_of(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

/// Runs `oriel` from the bench's own folder and reads its lines of JSON.
std::optional<Run> run_oriel(std::vector<std::string> arguments) {
  const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "oriel";
  arguments.insert(arguments.begin(), program.string());
  arguments.emplace_back("--json");
  std::vector<char*> argv;
  argv.reserve(arguments.size() + 1);
  for (std::string& a : arguments) argv.push_back(a.data());
  argv.push_back(nullptr);

  int ends[2];
  if (pipe(ends) != 0) return std::nullopt;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
  posix_spawn_file_actions_addclose(&actions, ends[0]);
  const Clock::time_point start = Clock::now();
  const auto since = [start] {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  pid_t child = 0;
  const int failed = posix_spawn(&child, argv[0], &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  if (failed != 0) return std::nullopt;

  Run run;
  std::FILE* const lines = fdopen(ends[0], "r");
  char* line = nullptr;
  std::size_t room = 0;
  while (getline(&line, &room, lines) > 0) {
    run.done = nlohmann::json::parse(line, nullptr, false);
    if (run.done.value("event", "") != "progress") continue;
    run.rendering = status_bytes(child, "VmRSS");
    if (run.first_wall > 0) continue;
    run.first_wall = since();
    run.first_cpu = processor_seconds(child);
  }
  std::free(line);
  std::fclose(lines);
  rusage usage{};
  int status = 0;
  if (wait4(child, &status, 0, &usage) < 0 || status != 0) return std::nullopt;
  run.wall = since();
  run.cpu = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  run.peak = 1024.0 * static_cast<double>(usage.ru_maxrss);
  return run;
}

/// In a process of its own, so that this one stays small.
void in_child(const std::function<void()>& work) {
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    work();
    std::fflush(nullptr);
    _exit(EXIT_SUCCESS);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0 || status != 0) {
    fmt::print(stderr, "a scene could not be written or read\n");
    std::exit(EXIT_FAILURE);
  }
}

void write_scene(const fs::path& path, const std::function<std::string()>& text) {
  in_child([&] {
    std::ofstream file(path);
    file << text();
    file.close();
    if (!file) _exit(EXIT_FAILURE);
  });
}

std::vector<std::string> small_picture(const fs::path& scene) {
  return {"render", scene.string(), "-o",        (scene.parent_path() / "picture.exr").string(),
          "--size", "240x160",      "--samples", "4"};
}

bool measure_geometry(const fs::path& folder) {
  constexpr int kSide = 2237;
  constexpr double kTriangles = 2.0 * kSide * kSide;
  const fs::path scene = folder / "geometry.mi";
  write_scene(scene, [] { return bench::wall_of_terrains(kSide, 1); });
  const double text = static_cast<double>(fs::file_size(scene));
  in_child([&] {
    mi::ReadOptions options;
    options.packages = builtin_packages();
    Diagnostics diagnostics;
    scene::Scene whole;
    const bench::Seconds time =
        bench::timed([&] { whole = mi::read_scene(scene.string(), options, diagnostics); });
    fmt::print("read alone: {:.0f} MB/s of the processor\n", text / kMega / time.cpu);
  });
  const std::optional<Run> run = run_oriel(small_picture(scene));
  fs::remove(scene);
  if (!run) return false;
  fmt::print(
      "{:.2f} M triangles, shared vertices, {:.0f} MB of text\n"
      "  first pass after {:.1f} s, {:.1f} s of the processor; all {:.1f} s of the processor\n"
      "  resident bytes per triangle, all in: {:.1f} at the peak, {:.1f} while rendering\n",
      kTriangles / kMega, text / kMega, run->first_wall, run->first_cpu, run->cpu,
      run->peak / kTriangles, run->rendering / kTriangles);
  return true;
}

bool measure_instances(const fs::path& folder) {
  constexpr std::pair<int, int> kForms[] = {{224, 1000}, {23, 100'000}};  // side, instances
  for (const auto& [side, count] : kForms) {
    const fs::path scene = folder / "instances.mi";
    write_scene(scene,
                [side = side, count = count] { return bench::wall_of_terrains(side, count); });
    const std::optional<Run> run = run_oriel(small_picture(scene));
    if (!run) return false;
    const double each = 2.0 * side * side;
    fmt::print(
        "{} instances of {:.0f} triangles, {:.1f} M in all\n"
        "  first pass after {:.2f} s, {:.2f} s of the processor; peak {:.0f} MB\n",
        count, each, each * count / kMega, run->first_wall, run->first_cpu, run->peak / kMega);
  }
  return true;
}

/// A tiled, mip-mapped picture without compression; no two are alike.
void write_texture(const fs::path& path, int number, int side) {
  std::vector<Imf::Rgba> pixels(static_cast<std::size_t>(side) * side);
  const auto shade = [number](int i) {
    return .2f + .6f * static_cast<float>((number >> i) & 7) / 7;
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      pixels[static_cast<std::size_t>(y) * side + x] =
          Imf::Rgba(shade(0), shade(3) * static_cast<float>(x) / static_cast<float>(side),
                    shade(6) * static_cast<float>(y) / static_cast<float>(side));
  Imf::Header header(side, side);
  header.compression() = Imf::NO_COMPRESSION;
  Imf::TiledRgbaOutputFile file(path.c_str(), header, Imf::WRITE_RGBA, 64, 64, Imf::MIPMAP_LEVELS,
                                Imf::ROUND_DOWN);
  file.setFrameBuffer(pixels.data(), 1, static_cast<std::size_t>(side));
  for (int level = 0; level < file.numLevels(); ++level)
    file.writeTiles(0, file.numXTiles(level) - 1, 0, file.numYTiles(level) - 1, level);
}

double write_textures(const fs::path& folder, int count) {
  constexpr int kSide = 192;
  in_child([&] {
    for (int i = 0; i < count; ++i) write_texture(folder / fmt::format("{}.exr", i), i, kSide);
  });
  return count * static_cast<double>(fs::file_size(folder / "0.exr"));
}

bool measure_textures(const fs::path& folder) {
  constexpr int kCount = 10'000;
  const double bytes = write_textures(folder, kCount);
  fmt::print("{} texture files, {:.0f} MB\n", kCount, bytes / kMega);
  const double small = bytes / kMega / 10;
  struct Form {
    const char* name;
    float filter;
    double megabytes;
  };
  const Form forms[] = {{"filtered, cache of a tenth", 1, small},
                        {"filtered, cache of all", 1, 2 * bytes / kMega},
                        {"unfiltered, cache of a tenth", 1e-4f, small},
                        {"unfiltered, cache of all", 1e-4f, 2 * bytes / kMega}};
  for (const Form& form : forms) {
    const fs::path scene = folder / "textures.mi";
    write_scene(scene, [&form] { return bench::room_of_pictures(kCount, form.filter); });
    std::vector<std::string> arguments = small_picture(scene);
    arguments[5] = "960x640";
    arguments.insert(arguments.end(), {"--texture-cache", fmt::format("{:.0f}", form.megabytes)});
    const std::optional<Run> run = run_oriel(std::move(arguments));
    if (!run) return false;
    const nlohmann::json& t = run->done["textures"];
    const double requests = t["tile_requests"], misses = t["tile_misses"], read = t["bytes_read"];
    fmt::print(
        "  {} ({:.0f} MB): {:.1f} s, {:.1f} s of the processor; peak {:.0f} MB\n"
        "    {} files, {:.1f} M requests for tiles, {:.3f} % of them in the cache, {:.0f} MB "
        "read\n",
        form.name, form.megabytes, run->wall, run->cpu, run->peak / kMega, t["files"].get<int>(),
        requests / kMega, 100 * (1 - misses / requests), read / kMega);
    std::fflush(stdout);
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> asked(argv + 1, argv + argc);
  const auto wanted = [&](const char* part) {
    return asked.empty() || std::find(asked.begin(), asked.end(), part) != asked.end();
  };
  const fs::path folder = fs::temp_directory_path() / fmt::format("oriel-bench-{}", getpid());
  fs::create_directory(folder);
  bool good = true;
  if (wanted("geometry")) good &= measure_geometry(folder);
  if (wanted("instances")) good &= measure_instances(folder);
  if (wanted("textures")) good &= measure_textures(folder);
  fs::remove_all(folder);
  if (!good) fmt::print(stderr, "oriel failed\n");
  return good ? EXIT_SUCCESS : EXIT_FAILURE;
}
