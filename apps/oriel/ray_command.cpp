// SPDX-License-Identifier: Apache-2.0
// oriel ray: the command line of the old stand-alone program, for scripts that were written for it.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <iterator>

#include "base/parallel.h"
#include "command.h"
#include "mi/writer.h"
#include "ray_flags.h"
#include "render_frames.h"
#include "shaders/registry.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;
using scene::Value;

/// Message levels of the old program.
constexpr int kLevelErrors = 2, kLevelWarnings = 3, kLevelAll = 5;

/// What the line asks for.
struct RayPlan {
  RenderArguments render;
  std::vector<std::string> scenes, links;
  std::vector<scene::Statement> options;
  std::vector<RayCall> camera;
  std::string echo, file_name, file_type, file_dir;
  /// As the old program: in the current folder.
  OutputRoots roots{".", {"."}, "-file_name FILE or -file_dir DIR names another place"};
  std::vector<std::string> without_effect;
  int level = kLevelAll;
  bool renders = true, help = false, version = false;
};

void split_folders(const std::string& text, std::vector<std::string>& folders) {
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find_first_of(":;", at), text.size());
    if (end > at) folders.push_back(text.substr(at, end - at));
    at = end + 1;
  }
}

void set_program(const RayCall& call, RayPlan& plan) {
  const std::string& name = call.flag->name;
  const std::string word = call.words.empty() ? "" : call.words.front();
  const double number =
      call.values.empty() || call.values[0].numbers.empty() ? 0 : call.values[0].numbers[0];
  const bool on = !call.values.empty() && call.values[0].boolean;
  const bool is_boolean = !call.values.empty() && call.values[0].kind == Value::Kind::Boolean;
  if (name == "help") plan.help = true;
  if (name == "version" || name == "copyright") plan.version = true;
  if (name == "verbose" || name == "v")
    plan.level = is_boolean ? (on ? kLevelAll : kLevelErrors) : static_cast<int>(number);
  if (name == "threads") {
    if (number < 0 || number > 4096) throw UsageError("-threads: expected 0 (all) to 4096");
    plan.render.threads = static_cast<int>(number);
  }
  if (name == "render") plan.renders = on;
  if (name == "norendering") plan.renders = false;
  if (name == "include_path" || name == "I") split_folders(word, plan.render.scene.include_paths);
  if (name == "ld_path" || name == "L") {
    std::string& path = plan.render.scene.shader_path;
    path += (path.empty() ? "" : ":") + word;
  }
  if (name == "link") plan.links.insert(plan.links.end(), call.words.begin(), call.words.end());
  if (name == "echo") plan.echo = word;
  if (name == "file_name" || name == "fn") plan.file_name = word;
  if (name == "file_type") plan.file_type = word;
  if (name == "file_dir") plan.file_dir = word;
  TrustArguments& trusted = plan.render.scene.trust;
  if (name == "untrusted") trusted.untrusted = true;
  if (name == "allow") trusted.allowed.push_back(word);
  if (name == "budget") trusted.budgets.push_back(word);
}

void trust(const std::string& folder, RayPlan& plan) {
  plan.roots.allowed.push_back(folder.empty() ? "." : folder);
}

RayPlan plan_of(const RayLine& line) {
  RayPlan plan;
  plan.scenes = line.scenes;
  for (const RayCall& call : line.calls) {
    if (!call.flag->acts) plan.without_effect.push_back("-" + call.flag->name);
    if (call.flag->target == RayTarget::Program) set_program(call, plan);
    if (call.flag->target == RayTarget::Camera) plan.camera.push_back(call);
    if (call.flag->target != RayTarget::Options) continue;
    scene::Statement statement{call.keyword, false, call.values, {}};
    if (call.keyword.starts_with('"')) {
      statement.quoted = true;
      statement.keyword = call.keyword.substr(1, call.keyword.size() - 2);
    }
    // Files that the user names may lie anywhere.
    if (call.keyword == "photonmap file" || call.keyword == "finalgather file")
      trust(fs::path(call.words.front()).parent_path().string(), plan);
    plan.options.push_back(std::move(statement));
  }
  if (!plan.file_name.empty()) trust(fs::path(plan.file_name).parent_path().string(), plan);
  if (!plan.file_dir.empty()) trust(plan.file_dir, plan);
  return plan;
}

/// As written, or with the suffix the old program adds.
std::string scene_path(const std::string& name) {
  if (fs::is_regular_file(name)) return name;
  if (fs::is_regular_file(name + ".mi")) return name + ".mi";
  throw UserError(fmt::format("cannot read '{}'", name));
}

/// What there is to read: a file, or text that stands for several and for standard input.
struct RaySource {
  std::string path, text;
  bool is_text = true;

  mi::Reader open(const SceneArguments& arguments, Diagnostics& diagnostics) const {
    const mi::ReadOptions options = read_options(arguments, builtin_shaders());
    if (is_text) return mi::Reader::from_text(text, options, diagnostics, path);
    return {path, options, diagnostics};
  }
};

RaySource source_of(RayPlan& plan) {
  SceneArguments& arguments = plan.render.scene;
  std::string links;
  for (const std::string& library : plan.links) links += fmt::format("link \"{}\"\n", library);
  if (plan.scenes.empty()) {
    arguments.path = "stdin.mi";
    return {arguments.path, links + std::string(std::istreambuf_iterator<char>(std::cin), {})};
  }
  std::vector<std::string> paths;
  for (const std::string& name : plan.scenes) paths.push_back(scene_path(name));
  arguments.path = paths.front();
  if (paths.size() == 1 && links.empty()) return {paths.front(), {}, false};
  // Several files are read as if they were one.
  std::string text = links;
  for (const std::string& path : paths) {
    const fs::path whole = fs::absolute(path);
    text += fmt::format("$include \"{}\"\n", whole.string());
    arguments.include_paths.push_back(whole.parent_path().string());
  }
  return {arguments.path, text};
}

void set_camera(const RayCall& call, scene::Camera& camera) {
  const auto number = [&](std::size_t i) { return call.values[i].numbers[0]; };
  if (call.keyword == "focal") {
    camera.orthographic = call.values[0].numbers.empty();
    camera.focal.reset();
    if (!camera.orthographic) camera.focal = static_cast<float>(number(0));
  } else if (call.keyword == "aperture") {
    camera.aperture = static_cast<float>(number(0));
  } else if (call.keyword == "aspect") {
    camera.aspect = static_cast<float>(number(0));
  } else if (call.keyword == "resolution") {
    camera.resolution = {static_cast<int>(number(0)), static_cast<int>(number(1))};
  } else {
    std::erase_if(camera.other, [&](const auto& s) { return s.keyword == call.keyword; });
    camera.other.push_back({call.keyword, false, call.values, {}});
  }
}

/// The camera's first file takes the name and type, all of them the folder.
void set_files(const RayPlan& plan, scene::Camera& camera) {
  std::vector<std::string*> names;
  std::string* type = nullptr;
  for (scene::Output& o : camera.outputs) {
    if (!o.shaders.empty() || o.file.empty()) continue;
    if (names.empty()) type = &o.format;
    names.push_back(&o.file);
  }
  for (scene::FrameBuffer& b : camera.frame_buffers) {
    if (b.filename.empty()) continue;
    if (names.empty()) type = &b.filetype;
    names.push_back(&b.filename);
  }
  if (names.empty() && !(plan.file_name.empty() && plan.file_type.empty())) {
    camera.outputs.push_back({"rgba", {}, {}, {}, {}, {}});
    scene::Output& made = camera.outputs.back();
    made.file = fs::path(plan.render.scene.path).stem().string();
    made.file += "." + (plan.file_type.empty() ? "exr" : plan.file_type);
    names.push_back(&made.file), type = &made.format;
  }
  if (!plan.file_name.empty()) {
    *names.front() = plan.file_name;
    // The new name tells its own type.
    if (has_writable_suffix(plan.file_name)) type->clear();
  }
  if (!plan.file_type.empty()) *type = plan.file_type;
  if (!plan.file_dir.empty())
    for (std::string* name : names)
      if (!fs::path(*name).is_absolute()) *name = (fs::path(plan.file_dir) / *name).string();
}

void apply(const RayPlan& plan, scene::Scene& scene) {
  const scene::RenderCommand command = scene.renders.back();
  if (!scene.get<scene::Options>(command.options) && !plan.options.empty()) {
    scene::Options fresh;
    fresh.name = command.options;
    scene.add(std::move(fresh));
  }
  if (auto* options = scene.get<scene::Options>(command.options))
    for (const scene::Statement& statement : plan.options) {
      // Frame by frame the same: what stood there from the frame before goes.
      std::erase(options->statements, statement);
      options->statements.push_back(statement);
    }
  const auto* instance = scene.get<scene::Instance>(command.camera);
  if (auto* camera = scene.get<scene::Camera>(instance ? instance->element : command.camera)) {
    for (const RayCall& call : plan.camera) set_camera(call, *camera);
    set_files(plan, *camera);
  }
}

void print_flags() {
  fmt::print(
      "oriel ray [flags] [SCENE...]\n\nRenders .mi scenes by the command line of mental ray's "
      "stand-alone program. Without a\nscene, reads standard input. Unambiguous prefixes of flags "
      "are accepted. Pictures are written to\nthe current folder.\n\n");
  for (const RayFlag& flag : ray_flags())
    fmt::print("  {:<44} {}{}\n", "-" + flag.name + (flag.form.empty() ? "" : " " + flag.form),
               flag.meaning,
               flag.acts              ? ""
               : flag.meaning.empty() ? "(no effect)"
                                      : " (no effect)");
}

/// Messages of reading come when the scene is read to be rendered.
bool write_echo(const RayPlan& plan, const RaySource& source, Diagnostics& diagnostics) {
  Diagnostics unheard;
  mi::Reader reader = source.open(plan.render.scene, unheard);
  return mi::write_scene(mi::read_all(reader), plan.echo, diagnostics);
}

int run_ray(const std::vector<std::string>& words) {
  RayPlan plan = plan_of(read_ray_line(words));
  if (plan.help) return print_flags(), kExitDone;
  if (plan.version) {
    fmt::print("oriel " ORIEL_VERSION ", Apache License 2.0\n");
    return kExitDone;
  }
  const ThreadLimit limit(plan.render.threads);
  flush_denormals();
  plan.render.quiet = plan.level < kLevelAll - 1;
  Diagnostics diagnostics;
  DiagnosticPrinter printer(diagnostics, false,
                            plan.level > kLevelWarnings ? Severity::Note
                            : plan.level > kLevelErrors ? Severity::Warning
                                                        : Severity::Error);
  if (!plan.without_effect.empty())
    diagnostics.note("OR-CL-001", {},
                     fmt::format("no effect: {}", fmt::join(plan.without_effect, ", ")));
  const RaySource source = source_of(plan);
  if (!plan.echo.empty() && !write_echo(plan, source, diagnostics))
    return printer.print_new(), kExitFailed;
  mi::Reader reader = source.open(plan.render.scene, diagnostics);
  if (!plan.renders) {
    mi::read_all(reader);
    printer.print_new();
    return diagnostics.count(Severity::Error) > 0 ? kExitFailed : kExitDone;
  }
  RenderPlan render;
  render.roots = plan.roots;
  return render_frames(
      reader, plan.render, render, [&](scene::Scene& scene) { apply(plan, scene); }, diagnostics,
      printer);
}

}  // namespace

Command add_ray_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "ray", "Render with the options of mental ray's stand-alone program (oriel ray -help)");
  // Its flags have one dash and whole words.
  app->set_help_flag();
  app->prefix_command();
  return {app, [app] { return run_ray(app->remaining()); }};
}

}  // namespace oriel::app
