// SPDX-License-Identifier: Apache-2.0
// oriel merge: the parts of pictures to the pictures.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "command.h"
#include "part_set.h"
#include "render_command.h"
#include "render_frames.h"
#include "render_plan.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<std::string> parts, outputs;
  std::string scene;
  SceneArguments trusted;  ///< only what it permits to the scene
  int threads = 0;
  bool json = false, quiet = false;
};

/// The arguments of the command that rendered the parts.
RenderArguments arguments_of_parts(const PartSet& parts) {
  CLI::App program;
  RenderArguments a;
  add_render_options(program, a);
  std::vector<std::string> words = parts.words();
  std::reverse(words.begin(), words.end());  // as CLI11 expects them
  try {
    program.parse(words);
  } catch (const CLI::ParseError&) {
    throw UserError("the command in the part files is damaged");
  }
  return a;
}

/// Pictures of the recorded command may only be written beside the parts: the command is content
/// of a file.
void require_beside(const std::vector<std::string>& outputs, const std::string& part) {
  std::error_code error;
  const auto folder = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path, error).parent_path(), error);
  };
  for (const std::string& output : outputs)
    if (folder(output) != folder(part))
      throw UserError(
          fmt::format("the parts were rendered for '{}', which is in another folder than they are; "
                      "name the picture with -o",
                      output));
}

int run_merge(const MergeArguments& m) {
  std::error_code error;
  const fs::path here = fs::current_path(error);
  const auto from_here = [&](const std::string& path) { return (here / path).string(); };
  std::vector<std::string> paths;
  for (const std::string& path : m.parts) paths.push_back(from_here(path));
  const PartSet parts(paths);
  for (const std::string& fault : parts.faults()) fmt::print(stderr, "oriel merge: {}\n", fault);
  if (!parts.faults().empty()) return kExitFailed;

  RenderArguments a = arguments_of_parts(parts);
  // Part files may come from elsewhere: what a scene may do is decided by this command alone.
  a.scene.trust = m.trusted.trust;
  a.scene.shader_path = m.trusted.shader_path;
  a.scene.trust_code = m.trusted.trust_code;
  if (!m.scene.empty())
    a.scene.path = from_here(m.scene);
  else if (fs::current_path(parts.folder(), error); error || !fs::exists(a.scene.path))
    throw UserError(fmt::format("the scene '{}' of the parts is not in '{}'; name it with --scene",
                                a.scene.path, parts.folder()));
  if (!m.outputs.empty()) {
    a.outputs.clear();
    for (const std::string& output : m.outputs) a.outputs.push_back(from_here(output));
  } else {
    require_beside(a.outputs, paths.front());
  }
  a.part.clear(), a.checkpoint.clear(), a.resume.clear(), a.maps.clear();
  a.skip_existing = false;
  a.threads = m.threads;
  a.json = m.json, a.quiet = m.quiet;
  RenderPlan plan = render_plan(a);
  plan.frames = FrameList(parts.frames());
  plan.merge = &parts;
  return render_scene(a, plan);
}

}  // namespace

Command add_merge_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("merge", "Merge the parts of render --part");
  auto m = std::make_shared<MergeArguments>();
  app->add_option("PARTS", m->parts, "Part files, all of a picture: NAME.part-*-of-N")
      ->required()
      ->type_name("FILE");
  app->add_option("-o,--output", m->outputs,
                  "Output file instead of those of the render; repeatable")
      ->allow_extra_args(false)
      ->type_name("FILE");
  app->add_option("--scene", m->scene,
                  "The scene, if it is no longer where the parts were rendered")
      ->type_name("SCENE");
  app->add_option("--shader-path", m->trusted.shader_path,
                  "Folders of native shader libraries, as of oriel render");
  app->add_flag("--trust-code", m->trusted.trust_code,
                "Compile and run C sources in the scene, as of oriel render");
  add_trust_options(*app, m->trusted.trust);
  app->add_option("--threads", m->threads, "Number of threads, 0 = all (default 0)")
      ->check(CLI::Range(0, 4096));
  app->add_flag("--json", m->json, "Print lines of JSON");
  app->add_flag("-q,--quiet", m->quiet, "Only warnings and errors");
  return {app, [m] { return run_merge(*m); }};
}

}  // namespace oriel::app
