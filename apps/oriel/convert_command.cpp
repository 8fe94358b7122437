// SPDX-License-Identifier: Apache-2.0
// oriel convert: a model or a scene to .mi; oriel quick: a model to a picture.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/parallel.h"
#include "command.h"
#include "convert_model.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct QuickArguments : ConvertArguments {
  std::optional<int> samples;
  int threads = 0, cryptomatte = 0;
  bool denoise = true, json = false;
  std::string time, noise, layers;  ///< as written, for oriel render

  /// The command that renders the scene.
  std::vector<std::string> render_words(const std::string& scene) const {
    constexpr int kSamples = 64;
    std::vector<std::string> words = {"render", scene, "-o", output};
    for (const auto& [option, text] :
         {std::pair("--time", &time), {"--noise", &noise}, {"--layers", &layers}})
      if (!text->empty()) words.insert(words.end(), {option, *text});
    if (samples || (time.empty() && noise.empty()))
      words.insert(words.end(), {"--samples", std::to_string(samples.value_or(kSamples))});
    if (denoise && samples != 1) words.emplace_back("--denoise");
    if (threads > 0) words.insert(words.end(), {"--threads", std::to_string(threads)});
    if (cryptomatte > 0) words.push_back(fmt::format("--cryptomatte={}", cryptomatte));
    if (json) words.emplace_back("--json");
    if (quiet) words.emplace_back("-q");
    return words;
  }
};

int run_convert(const ConvertArguments& a) {
  const std::string suffix = fs::path(a.output).extension().string();
  if (suffix != ".mi" && suffix != ".glb")
    throw UsageError(fmt::format("{}: the name of the result ends in .mi or .glb", a.output));
  if (fs::exists(a.output) && fs::equivalent(a.model, a.output))
    throw UsageError("the result would overwrite its input");
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
  a.daylight = a.sky.empty();
  convert_model(a, scene.string());
  // The very command that a user would type next.
  CLI::App program;
  const Command render = add_render_command(program);
  std::vector<std::string> words = a.render_words(scene.string());
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
  command.add_option("--sky", a.sky, "latitude-longitude picture (.hdr, .exr) as environment")
      ->check(CLI::ExistingFile);
  command.add_option("--sky-rotation", a.sky_rotation,
                     "rotation of --sky about the vertical in degrees (0)");
  command.add_flag("-q,--quiet", a.quiet, "only warnings and errors");
  command
      .add_option("--emission-scale", a.emission_scale,
                  "factor of the emission of materials (683 for Blender's files, else 1)")
      ->check(CLI::NonNegativeNumber);
}

}  // namespace

Command add_convert_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "convert", "convert a model of another program to a .mi scene, or a scene to glTF");
  auto a = std::make_shared<ConvertArguments>();
  add_shared(*command, *a);
  command->add_option("SCENE", a->output, "file to write: NAME.mi, or NAME.glb for glTF")
      ->required();
  command->add_flag("--daylight", a->daylight, "add sun, sky, ground and exposure");
  return {command, [a] { return run_convert(*a); }};
}

Command add_quick_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "quick", "a picture of a model in daylight; its scene is kept beside it as .mi");
  auto a = std::make_shared<QuickArguments>();
  add_shared(*command, *a);
  command->add_option("-o,--output", a->output, "picture to write; MODEL's name with .png");
  command->add_option("--samples", a->samples, "samples per pixel (64, unless --time or --noise)")
      ->check(CLI::Range(1, 1 << 20));
  command->add_option("--time", a->time, "time limit in seconds");
  command->add_option("--noise", a->noise, "noise target, as of oriel render");
  command->add_option("--layers", a->layers, "layers of EXR files, as of oriel render");
  command->add_flag("--cryptomatte{6}", a->cryptomatte, "Cryptomatte layers of EXR files");
  command->add_flag("--json", a->json, "progress as lines of JSON on stdout");
  command->add_flag("--denoise,!--no-denoise", a->denoise, "take the rest of the noise out")
      ->capture_default_str();
  command->add_option("--threads", a->threads, "Threads to use, 0 = all")
      ->check(CLI::Range(0, 4096));
  return {command, [a] { return run_quick(*a); }};
}

}  // namespace oriel::app
