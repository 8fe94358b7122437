// SPDX-License-Identifier: Apache-2.0
// oriel convert: a model or a scene to .mi; oriel quick: a model to a picture.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/parallel.h"
#include "command.h"
#include "convert_model.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct QuickArguments : ConvertArguments {
  int samples = 64, threads = 0;
  bool denoise = true;
};

int run_convert(const ConvertArguments& a) {
  if (fs::path(a.output).extension() != ".mi")
    throw UsageError(fmt::format("{}: the result is a scene; its name ends in .mi", a.output));
  if (fs::exists(a.output) && fs::equivalent(a.model, a.output))
    throw UsageError("the result would overwrite what it is made of");
  convert_model(a, a.output);
  return kExitDone;
}

int run_quick(QuickArguments a) {
  const ThreadLimit limit(a.threads);
  if (a.output.empty()) a.output = fs::path(a.model).stem().string() + ".png";
  if (is_mi(a.model)) throw UsageError("for scenes there is oriel render");
  const fs::path scene = fs::path(a.output).replace_extension(".mi");
  if (fs::exists(scene) && fs::equivalent(a.model, scene))
    throw UsageError("the scene would overwrite the model");
  a.daylight = true;
  convert_model(a, scene.string());
  // The very command that a user would type next.
  CLI::App program;
  const Command render = add_render_command(program);
  std::vector<std::string> words = {"render", scene.string(), "-o",
                                    a.output, "--samples",    std::to_string(a.samples)};
  if (a.denoise && a.samples > 1) words.emplace_back("--denoise");
  if (a.threads > 0) words.insert(words.end(), {"--threads", std::to_string(a.threads)});
  std::reverse(words.begin(), words.end());  // as CLI11 takes them
  program.parse(words);
  return render.run();
}

void add_shared(CLI::App& command, ConvertArguments& a) {
  command.add_option("MODEL", a.model, "glTF, GLB, OBJ, FBX, Collada, IFC, ... ")
      ->required()
      ->check(CLI::ExistingFile);
  command.add_option("--up", a.up, "axis of the model that points up; else as its format has it")
      ->check(CLI::IsMember({"y", "z"}));
  command.add_option("--size", a.size,
                     "picture, WIDTHxHEIGHT pixels; else that of the model's camera, or 960x640");
  command
      .add_option("--sun", a.sun,
                  "where the sun stands: degrees clockwise from behind the model, degrees above "
                  "the horizon")
      ->expected(2)
      ->delimiter(',');
  command
      .add_option("--emission-scale", a.emission_scale,
                  "factor of the emission of materials (683 for Blender's files, else 1)")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace

Command add_convert_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("convert", "write a model of another program as a .mi scene");
  auto a = std::make_shared<ConvertArguments>();
  add_shared(*command, *a);
  command->add_option("SCENE", a->output, "the scene to write, NAME.mi")->required();
  command->add_flag("--daylight", a->daylight, "add sun, sky, ground and exposure");
  return {command, [a] { return run_convert(*a); }};
}

Command add_quick_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "quick", "a picture of a model in daylight; its scene is kept beside it as .mi");
  auto a = std::make_shared<QuickArguments>();
  add_shared(*command, *a);
  command->add_option("-o,--output", a->output, "picture to write; MODEL's name with .png");
  command->add_option("--samples", a->samples, "per pixel")
      ->capture_default_str()
      ->check(CLI::Range(1, 1 << 20));
  command->add_flag("--denoise,!--no-denoise", a->denoise, "take the rest of the noise out")
      ->capture_default_str();
  command->add_option("--threads", a->threads, "Threads to use, 0 = all")
      ->check(CLI::Range(0, 4096));
  return {command, [a] { return run_quick(*a); }};
}

}  // namespace oriel::app
