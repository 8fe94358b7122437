// SPDX-License-Identifier: Apache-2.0
// oriel convert: a model or a scene to .mi; oriel quick: a model to a picture.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/parallel.h"
#include "command.h"
#include "convert_model.h"
#include "suggest.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct QuickArguments : ConvertArguments {
  std::optional<int> samples;
  int threads = 0, cryptomatte = 0;
  bool denoise = true, json = false;
  std::string time, noise, layers, checkpoint, resume;  ///< as written, for oriel render

  /// The command that renders the scene.
  std::vector<std::string> render_words(const std::string& scene) const {
    constexpr int kSamples = 64;
    std::vector<std::string> words = {"render", scene, "-o", output};
    for (const auto& [option, text] : {std::pair("--time", &time),
                                       {"--noise", &noise},
                                       {"--layers", &layers},
                                       {"--checkpoint", &checkpoint},
                                       {"--resume", &resume}})
      if (!text->empty()) words.insert(words.end(), {option, *text});
    if (samples || (time.empty() && noise.empty()))
      words.insert(words.end(), {"--samples", std::to_string(samples.value_or(kSamples))});
    if (denoise && samples != 1) words.emplace_back("--denoise");
    if (threads > 0) words.insert(words.end(), {"--threads", std::to_string(threads)});
    if (cryptomatte > 0) words.push_back(fmt::format("--cryptomatte={}", cryptomatte));
    const std::vector<std::string> trusted = trust_words(trust_of_result(*this));
    words.insert(words.end(), trusted.begin(), trusted.end());
    if (json) words.emplace_back("--json");
    if (quiet) words.emplace_back("-q");
    return words;
  }
};

int run_convert(const ConvertArguments& a) {
  const std::string suffix = fs::path(a.output).extension().string();
  if (suffix != ".mi" && suffix != ".glb" && suffix != ".json")
    throw UsageError(
        fmt::format("{}: the name of the result ends in .mi, .glb or .json", a.output));
  if (fs::exists(a.output) && fs::equivalent(a.model, a.output))
    throw UsageError("the result would overwrite its input");
  return convert_model(a, a.output) ? kExitDone : kExitFailed;
}

int run_quick(QuickArguments a) {
  const ThreadLimit limit(a.threads);
  if (a.output.empty()) a.output = fs::path(a.model).stem().string() + ".png";
  if (is_mi(a.model)) throw UsageError("the input is a scene; use oriel render");
  const fs::path scene = fs::path(a.output).replace_extension(".mi");
  if (fs::exists(scene) && fs::equivalent(a.model, scene))
    throw UsageError("the scene would overwrite the model");
  a.daylight = a.sky.empty();
  const bool converted = convert_model(a, scene.string());
  // The very command that a user would type next.
  CLI::App program;
  const Command render = add_render_command(program);
  std::vector<std::string> words = a.render_words(scene.string());
  std::reverse(words.begin(), words.end());  // as CLI11 expects them
  program.parse(words);
  const int code = render.run();
  return converted ? code : kExitFailed;
}

void add_shared(CLI::App& command, ConvertArguments& a) {
  command.add_option("MODEL", a.model, "Model: glTF, GLB, OBJ, FBX, Collada, IFC, ...")
      ->required()
      ->check(CLI::ExistingFile);
  command
      .add_option("--up", a.up,
                  "Axis of the model that points up (default: from the format), or of the "
                  "scene that becomes glTF (default y)")
      ->check(one_of({"y", "z"}));
  command.add_option("--size", a.size,
                     "Size of the picture, WIDTHxHEIGHT in pixels (default: from the model's "
                     "camera, else 960x640)");
  command
      .add_option(
          "--sun", a.sun,
          "Direction of the sun: degrees clockwise from behind the model, degrees above the "
          "horizon")
      ->expected(2)
      ->delimiter(',');
  command.add_option("--sky", a.sky, "Latitude-longitude picture (.hdr, .exr) as environment")
      ->check(CLI::ExistingFile);
  command.add_option("--sky-rotation", a.sky_rotation,
                     "Rotation of --sky about the vertical in degrees (default 0)");
  command
      .add_option("-I,--include", a.include_paths,
                  "Search folder for include files of a scene; repeatable")
      ->allow_extra_args(false)
      ->type_name("DIR");
  command.add_flag("-q,--quiet", a.quiet, "Only warnings and errors");
  command.add_flag("--force", a.force,
                   "Replace a .mi file that was not written by quick or convert, or was edited");
  command
      .add_option("--emission-scale", a.emission_scale,
                  "Factor of the emission of materials (default 683 for files of Blender, else 1)")
      ->check(CLI::NonNegativeNumber);
  add_trust_options(command, a.trust);
  command.add_option("--animation-time", a.animation_time,
                     "Time of the first animation of a glTF file in seconds (default: none, the "
                     "file's own pose)");
}

}  // namespace

Command add_convert_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "convert", "Convert a model of another program to a .mi scene, or a scene to glTF or JSON");
  auto a = std::make_shared<ConvertArguments>();
  add_shared(*command, *a);
  command
      ->add_option("SCENE", a->output,
                   "File to write: NAME.mi, NAME.glb for glTF, or NAME.json with NAME.bin for "
                   "other programs")
      ->required();
  command->add_flag("--daylight", a->daylight, "Add sun, sky, ground and exposure");
  return {command, [a] { return run_convert(*a); }};
}

Command add_quick_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "quick", "Render a model in daylight; also writes its scene beside the picture (.mi)");
  auto a = std::make_shared<QuickArguments>();
  add_shared(*command, *a);
  command->add_option("-o,--output", a->output,
                      "Picture to write (default: name of the model with .png)");
  command
      ->add_option("--samples", a->samples,
                   "Samples per pixel (default 64, unless --time or --noise is given)")
      ->check(CLI::Range(1, 1 << 20));
  command->add_option("--time", a->time, "Time limit in seconds (default none)");
  command->add_option("--noise", a->noise, "Noise target, as in oriel render");
  command->add_option("--layers", a->layers, "Layers of EXR files, as in oriel render");
  command->add_option("--checkpoint", a->checkpoint, "Checkpoint file, as in oriel render")
      ->type_name("FILE[,every SECONDS]");
  command->add_option("--resume", a->resume, "Continue a checkpoint, as in oriel render")
      ->type_name("FILE");
  command->add_flag("--cryptomatte{6}", a->cryptomatte, "Cryptomatte layers of EXR files");
  command->add_flag("--json", a->json, "Print progress as lines of JSON");
  command->add_flag("--denoise,!--no-denoise", a->denoise, "Denoise the picture (default on)");
  command->add_option("--threads", a->threads, "Number of threads, 0 = all (default 0)")
      ->check(CLI::Range(0, 4096));
  return {command, [a] { return run_quick(*a); }};
}

}  // namespace oriel::app
