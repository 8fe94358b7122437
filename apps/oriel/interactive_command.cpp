// SPDX-License-Identifier: Apache-2.0
// oriel interactive: a scene that another program edits while it renders.
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <nlohmann/json.hpp>

#include "base/parallel.h"
#include "command.h"
#include "image/reader_process.h"
#include "interactive/interactive_session.h"
#include "interactive_requests.h"
#include "render_frames.h"
#include "render_plan.h"
#include "scene_code.h"
#include "shaders/registry.h"

namespace oriel::app {
namespace {

constexpr std::size_t kMaxRequest = std::size_t{256} << 20;

/// Calls `use` for each line of a descriptor until its end or a line that is too long.
void for_each_line(int descriptor, const std::function<void(const std::string&)>& use) {
  std::string rest;
  std::string block(std::size_t{1} << 16, '\0');
  for (;;) {
    const ssize_t got = ::read(descriptor, block.data(), block.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return;
    rest.append(block, 0, static_cast<std::size_t>(got));
    std::size_t begin = 0;
    for (std::size_t end = rest.find('\n'); end != std::string::npos;
         end = rest.find('\n', begin)) {
      use(rest.substr(begin, end - begin));
      begin = end + 1;
    }
    rest.erase(0, begin);
    if (rest.size() > kMaxRequest) throw UserError("a request is too long");
  }
}

int run_interactive(const RenderArguments& a) {
  const RenderPlan plan = render_plan(a);
  const ThreadLimit limit(a.threads);
  if (a.isolate_readers || a.scene.trust.untrusted) isolate_readers({});
  flush_denormals();
  Diagnostics code_diagnostics;
  SceneCode code(a.scene, code_diagnostics);
  interactive::SceneSource source;
  source.path = a.scene.path;
  source.read = read_options(a.scene, builtin_shaders());
  source.registry = &builtin_shaders();
  source.folders = code.trusted_folders();
  source.after_reading = [&code](scene::Scene& read) {
    code.compile(read);
    return code.trusted_folders();
  };
  source.unit_luminance = a.unit_luminance;
  source.indirect = plan.gi;
  InteractiveRequests requests(std::move(source), {.seed = a.seed, .clamp = a.clamp},
                               STDOUT_FILENO);
  for_each_line(STDIN_FILENO, [&requests](const std::string& line) { requests.handle(line); });
  return kExitDone;
}

}  // namespace

Command add_interactive_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "interactive",
      "Render a scene that another program edits: requests on standard input, pictures on standard "
      "output (docs/dev/interactive-protocol.md)");
  auto a = std::make_shared<RenderArguments>();
  add_scene_arguments(*app, a->scene);
  app->add_option("--gi", a->gi, "Method of indirect light, as in oriel render");
  app->add_option("--unit-luminance", a->unit_luminance,
                  "cd/m2 of one pixel unit, as in oriel render");
  app->add_option("--seed", a->seed, "Random seed (default 0)");
  app->add_option("--threads", a->threads, "Number of threads, 0 = all (default 0)")
      ->check(CLI::Range(0, 4096));
  app->add_flag("--isolate-readers", a->isolate_readers,
                "Decode image files in confined processes, for scenes of unknown origin");
  return {app, [a] { return run_interactive(*a); }};
}

}  // namespace oriel::app
