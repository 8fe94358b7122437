// SPDX-License-Identifier: Apache-2.0
// How a render would scale to more threads than this machine has: work and critical path of
// preparation, passes and picture, from the durations of the tasks on one thread.
//
// `scaling_bench [SCENE.mi [WIDTH HEIGHT [METHOD]]]`. The linker replaces parallel_for by the one
// below (see CMakeLists.txt), which runs the tasks of a loop one after the other and measures each.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <queue>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "mi/reader.h"
#include "prepare/prepare.h"
#include "render/session.h"
#include "shaders/registry.h"

namespace {

using namespace oriel;

constexpr std::array<int, 6> kThreads{1, 2, 4, 8, 12, 16};

/// Processor time of this thread, s: time of other programs is not included.
double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Durations of a phase, s.
struct Phase {
  double work = 0, loops = 0;  ///< all; inside of parallel loops
  double longest = 0;          ///< sum of the longest task of each loop
  std::array<double, kThreads.size()> makespans{};
  std::size_t tasks = 0;

  double serial() const { return work - loops; }
  double at(std::size_t i) const { return serial() + makespans[i]; }
  double critical() const { return serial() + longest; }
  Phase operator-(const Phase& o) const {
    Phase d = *this;
    d.work -= o.work, d.loops -= o.loops, d.longest -= o.longest, d.tasks -= o.tasks;
    for (std::size_t i = 0; i < makespans.size(); ++i) d.makespans[i] -= o.makespans[i];
    return d;
  }
};

Phase current;
bool in_task = false;

/// Time until the last task ends if each thread takes the next task when it is free.
double makespan(const std::vector<double>& tasks, int threads) {
  std::priority_queue<double, std::vector<double>, std::greater<>> free;
  for (int i = 0; i < threads; ++i) free.push(0);
  double end = 0;
  for (const double task : tasks) {
    const double done = free.top() + task;
    free.pop();
    free.push(done);
    end = std::max(end, done);
  }
  return end;
}

/// A loop inside of a task is part of the task. A loop of one task is no loop.
void measured_loop(std::size_t count, const std::function<void(std::size_t)>& body) {
  if (in_task || count == 1) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  in_task = true;
  std::vector<double> tasks(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double before = now();
    body(i);
    tasks[i] = now() - before;
  }
  in_task = false;
  for (const double task : tasks) current.loops += task;
  current.tasks += count;
  if (count > 0) current.longest += *std::max_element(tasks.begin(), tasks.end());
  for (std::size_t i = 0; i < kThreads.size(); ++i)
    current.makespans[i] += makespan(tasks, kThreads[i]);
}

template <class F>
Phase measured(F&& f) {
  current = {};
  const double before = now();
  f();
  current.work = now() - before;
  return current;
}

void print(const char* name, const Phase& p) {
  std::string row = fmt::format("| {} | {:.1f} | {:.1f} | {:.1f} | {} |", name, 1e3 * p.work,
                                1e3 * p.serial(), 1e3 * p.critical(), p.tasks);
  for (std::size_t i = 1; i < kThreads.size(); ++i)
    row += fmt::format(" {:.1f} |", p.at(0) / p.at(i));
  std::puts(row.c_str());
}

}  // namespace

extern "C" void __wrap__ZN5oriel12parallel_forEmRKSt8functionIFvmEE(
    std::size_t count, const std::function<void(std::size_t)>& body) {
  measured_loop(count, body);
}

int main(int argc, char** argv) {
  const std::string path = argc > 1 ? argv[1] : ORIEL_SOURCE_DIR "/scenes/interior/interior.mi";
  const int width = argc > 3 ? std::atoi(argv[2]) : 150;
  const int height = argc > 3 ? std::atoi(argv[3]) : 100;
  // One thread, so that no other one runs tasks of Embree.
  const ThreadLimit one(1);
  flush_denormals();
  Diagnostics diagnostics;
  PrepareReport report;
  scene::Scene scene;
  std::unique_ptr<World> world;
  const Phase read = measured([&] {
    mi::ReadOptions options;
    options.packages = builtin_packages();
    options.knows_shader = [](std::string_view n) { return builtin_shaders().find(n) != nullptr; };
    scene = mi::read_scene(path, options, diagnostics);
  });
  if (scene.renders.empty()) {
    std::fprintf(stderr, "%s cannot be rendered\n", path.c_str());
    return 1;
  }
  const Phase preparation = measured([&] {
    PrepareOptions options;
    options.width = width;
    options.height = height;
    world = prepare(scene, scene.renders.back(), builtin_shaders(), options, diagnostics, report);
  });
  if (!world) return 1;
  if (const IntegratorSpec* method = argc > 4 ? find_integrator(argv[4]) : nullptr)
    world->options.indirect = method->method;
  const Window window{0, 0, world->camera.width, world->camera.height};
  const Phase passes = measured([&] {
    RayCounts counts;
    const MapFiles files;
    const ProgressMonitor monitor;
    make_integrator(*world)->prepare({.window = window,
                                      .picture = window,
                                      .files = files,
                                      .diagnostics = diagnostics,
                                      .monitor = monitor,
                                      .after_pass = [] {},
                                      .counts = counts});
  });
  RenderSession session(*world, {.budget = {.samples = 1}});
  const Phase all = measured([&] { session.run(); });
  fmt::print("{}, {} x {}\n\n", path, world->camera.width, world->camera.height);
  std::puts("| part | work, ms | serial | critical path | tasks | 2 threads | 4 | 8 | 12 | 16 |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|");
  print("read", read);
  print("prepare", preparation);
  print("passes", passes);
  print("picture", all - passes);
  Phase sum = read;
  for (const Phase& p : {preparation, all}) {
    sum.work += p.work, sum.loops += p.loops, sum.longest += p.longest, sum.tasks += p.tasks;
    for (std::size_t i = 0; i < kThreads.size(); ++i) sum.makespans[i] += p.makespans[i];
  }
  print("all", sum);
  return 0;
}
