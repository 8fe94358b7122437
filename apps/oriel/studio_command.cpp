// SPDX-License-Identifier: Apache-2.0
// oriel studio: a scene in a browser, rendered while it is edited.
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "base/parallel.h"
#include "command.h"
#include "convert_model.h"
#include "explain_text.h"
#include "image/reader_process.h"
#include "interactive/journal.h"
#include "render_frames.h"
#include "render_plan.h"
#include "scene_code.h"
#include "shaders/registry.h"
#include "studio/controller.h"
#include "studio/server.h"
#include "studio/token.h"
#include "templates.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct StudioArguments {
  RenderArguments render;
  std::string listen, page;
  unsigned short port = 0;
  bool open = false, insecure = false;
  std::string model;  ///< the file that the user named, if it is a model
};

/// The folder of the page: beside the program's data, or in the source tree.
fs::path page_folder(const StudioArguments& a) {
  if (!a.page.empty()) return a.page;
  const fs::path data = data_folder();
  std::error_code error;
  if (fs::exists(data / "studio" / "index.html", error)) return data / "studio";
  return data.parent_path() / "integrations" / "studio";
}

/// The scene of a model, beside it: converted unless it is there and newer.
void convert_for_studio(StudioArguments& a) {
  SceneArguments& scene = a.render.scene;
  if (is_mi(scene.path)) return;
  a.model = scene.path;
  const fs::path to = fs::path(scene.path).replace_extension(".mi");
  std::error_code error;
  const bool is_newer = fs::exists(to, error) &&
                        fs::last_write_time(to, error) >= fs::last_write_time(a.model, error);
  ConvertArguments convert;
  convert.model = a.model;
  convert.daylight = true;
  convert.quiet = a.render.quiet;
  convert.trust = scene.trust;
  scene.trust = trust_of_result(convert);
  scene.path = to.string();
  if (!is_newer) convert_model(convert, scene.path);
}

nlohmann::json explain_for_studio(const Explanation& facts, const World& world,
                                  const IndirectPlan& plan, const UnitLuminance& unit) {
  const ExplainReport report{facts, world, plan, unit};
  return {{"text", explain_text(report)}, {"facts", explain_json(report)}};
}

std::vector<std::string> options_for_jobs(const SceneArguments& a) {
  std::vector<std::string> words = trust_words(a.trust);
  for (const std::string& folder : a.include_paths) words.insert(words.end(), {"-I", folder});
  if (!a.shader_path.empty()) words.insert(words.end(), {"--shader-path", a.shader_path});
  if (a.trust_code) words.emplace_back("--trust-code");
  return words;
}

studio::StudioSettings studio_settings(const StudioArguments& a, const RenderPlan& plan,
                                       SceneCode& code) {
  const SceneArguments& scene = a.render.scene;
  studio::StudioSettings settings;
  interactive::SceneSource& source = settings.source;
  source.path = scene.path;
  source.read = read_options(scene, builtin_shaders());
  source.registry = &builtin_shaders();
  source.folders = code.trusted_folders();
  source.after_reading = [&code](scene::Scene& read) {
    code.compile(read);
    return code.trusted_folders();
  };
  source.unit_luminance = a.render.unit_luminance;
  source.indirect = plan.gi;
  settings.loop.seed = a.render.seed;
  settings.loop.clamp = a.render.clamp;
  settings.shown_name = a.model.empty() ? scene.path : a.model;
  settings.is_model = !a.model.empty();
  settings.journal = interactive::journal_path(scene.path);
  return settings;
}

/// Serves until the server ends; in a process of its own.
int serve(const StudioArguments& a, studio::ServerSettings server_settings,
          const std::string& crash) {
  const RenderPlan plan = render_plan(a.render);
  const ThreadLimit limit(a.render.threads);
  if (a.render.isolate_readers || a.render.scene.trust.untrusted) isolate_readers({});
  flush_denormals();
  Diagnostics code_diagnostics;
  SceneCode code(a.render.scene, code_diagnostics);
  studio::StudioSettings settings = studio_settings(a, plan, code);
  settings.crash = crash;
  studio::StudioServices services;
  services.explain = explain_for_studio;
  services.program = fs::read_symlink("/proc/self/exe").string();
  services.options = options_for_jobs(a.render.scene);
  studio::Controller controller(std::move(settings), std::move(services));
  studio::StudioServer server(std::move(server_settings), controller);
  controller.connect([&server](std::string message) { server.send(std::move(message)); },
                     [&server] { server.picture_changed(); });
  server.run();
  controller.connect({}, {});
  return kExitDone;
}

pid_t server_process = 0;

void forward_signal(int number) {
  if (server_process > 0) kill(server_process, number);
}

/// Runs the server in a child process and starts it again if it crashes, on the same socket, so
/// that the page only has to connect again. Crashes before any client could act end the program.
int supervise(const StudioArguments& a, const studio::ServerSettings& settings) {
  using Clock = std::chrono::steady_clock;
  std::string crash;
  int quick_crashes = 0;
  for (;;) {
    const Clock::time_point begun = Clock::now();
    std::fflush(nullptr);
    const pid_t parent = getpid();
    const pid_t child = fork();
    if (child < 0) throw UserError("cannot start the server process");
    if (child == 0) {
      for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_DFL);
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (getppid() != parent) _exit(kExitFailed);
      int code = kExitFailed;
      try {
        code = serve(a, settings, crash);
      } catch (const std::exception& error) {
        fmt::print(stderr, "oriel: {}\n", error.what());
        std::fflush(nullptr);
        _exit(kExitFailed);
      }
      // Without destructors of static objects: threads of libraries may still be running.
      std::fflush(nullptr);
      _exit(code);
    }
    server_process = child;
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, forward_signal);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    server_process = 0;
    if (WIFEXITED(status)) return WEXITSTATUS(status);
    const int number = WTERMSIG(status);
    if (number == SIGINT || number == SIGTERM || number == SIGHUP) return kExitDone;
    fmt::print(stderr, "oriel: the renderer ended by signal {}; it is started again\n", number);
    quick_crashes = Clock::now() - begun < std::chrono::seconds(1) ? quick_crashes + 1 : 0;
    if (quick_crashes > 3) return kExitFailed;
    crash = fmt::format("signal {}: {}", number, strsignal(number));
  }
}

void open_browser(const std::string& url) {
  const pid_t child = fork();
  if (child != 0) return;
  std::freopen("/dev/null", "w", stdout);
  std::freopen("/dev/null", "w", stderr);
  execlp("xdg-open", "xdg-open", url.c_str(), nullptr);
  _exit(kExitFailed);
}

int run_studio(StudioArguments& a) {
  const bool is_public =
      !a.listen.empty() && a.listen != "127.0.0.1" && a.listen != "::1" && a.listen != "localhost";
  if (is_public && !a.insecure)
    throw UsageError(
        "--listen: other machines would reach the server without encryption; use an SSH tunnel "
        "(ssh -L PORT:127.0.0.1:PORT HOST) or add --insecure");
  render_plan(a.render);
  convert_for_studio(a);
  if (!fs::exists(a.render.scene.path))
    throw UserError(fmt::format("{}: there is no such file", a.render.scene.path));
  studio::ServerSettings settings;
  if (!a.listen.empty()) settings.address = a.listen == "localhost" ? "127.0.0.1" : a.listen;
  try {
    const auto [socket, port] = studio::listen_on(settings.address, a.port);
    settings.inherited_socket = socket;
    settings.port = port;
    settings.token = studio::make_token();
  } catch (const std::runtime_error& error) {
    throw UserError(error.what());
  }
  settings.page = page_folder(a);
  settings.program_version = ORIEL_VERSION;
  const std::string host = settings.address.find(':') == std::string::npos
                               ? settings.address
                               : "[" + settings.address + "]";
  const std::string url =
      fmt::format("http://{}:{}/#token={}", host, settings.port, settings.token);
  if (is_public)
    fmt::print(stderr,
               "oriel: warning: the server is reachable from other machines without encryption\n");
  fmt::print("{}\n", url);
  std::fflush(stdout);
  std::signal(SIGPIPE, SIG_IGN);
  if (a.open) open_browser(url);
  return supervise(a, settings);
}

}  // namespace

Command add_studio_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "studio", "Show a scene or model in a browser, rendered while it is edited");
  auto a = std::make_shared<StudioArguments>();
  RenderArguments& r = a->render;
  add_scene_arguments(*app, r.scene);
  app->add_flag("--open", a->open, "Open the page in the default browser");
  app->add_option("--port", a->port, "Port of the server (default: chosen by the system)");
  app->add_option("--listen", a->listen,
                  "Address of the server (default 127.0.0.1). Other addresses than those of this "
                  "machine alone require --insecure")
      ->type_name("ADDRESS");
  app->add_flag("--insecure", a->insecure,
                "Allow --listen on addresses that other machines reach, without encryption");
  app->add_option("--page", a->page, "Folder of the page (default: that of the program)")
      ->type_name("DIR");
  app->add_option("--gi", r.gi, "Method of indirect light, as in oriel render");
  app->add_option("--unit-luminance", r.unit_luminance,
                  "cd/m2 of one pixel unit, as in oriel render");
  app->add_option("--seed", r.seed, "Random seed (default 0)");
  app->add_option("--threads", r.threads, "Number of threads, 0 = all (default 0)")
      ->check(CLI::Range(0, 4096));
  app->add_flag("--isolate-readers", r.isolate_readers,
                "Decode image files in confined processes, for scenes of unknown origin");
  return {app, [a] { return run_studio(*a); }};
}

}  // namespace oriel::app
