// SPDX-License-Identifier: Apache-2.0
// oriel convert: a model or a scene to .mi; oriel quick: a model to a picture.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "command.h"
#include "light_meter.h"
#include "mi/reader.h"
#include "mi/writer.h"
#include "models/daylight.h"
#include "models/import.h"
#include "numbers.h"
#include "scene_file.h"
#include "shaders/registry.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

struct ConvertArguments {
  std::string model, output, size, up;
  std::vector<float> sun;
  bool daylight = false;
  // oriel quick
  int samples = 64;
  bool denoise = true;
};

models::DaylightOptions daylight_options(const ConvertArguments& a) {
  models::DaylightOptions options;
  if (!a.size.empty()) {
    const PictureSize size = parse_size(a.size);
    options.width = size.width, options.height = size.height;
  }
  if (!a.sun.empty()) options.sun_azimuth = a.sun[0], options.sun_elevation = a.sun[1];
  return options;
}

bool is_mi(const fs::path& path) {
  return path.extension() == ".mi" ||
         (path.extension() == ".gz" && path.stem().extension() == ".mi");
}

/// For the light of the model itself.
constexpr float kFNumber = 8;

scene::Scene read_mi(const std::string& path, Diagnostics& diagnostics) {
  SceneArguments arguments;
  arguments.path = path;
  mi::Reader reader(path, read_options(arguments, builtin_shaders()), diagnostics);
  if (!reader.opened()) throw UserError(fmt::format("cannot read '{}'", path));
  return mi::read_all(reader);
}

/// Reads the model, adds what a picture needs and writes the scene.
void convert(const ConvertArguments& a, const std::string& to) {
  Diagnostics diagnostics;
  DiagnosticPrinter printer(diagnostics, false, true);
  const fs::path output(to);
  const std::string folder = output.parent_path().empty() ? "." : output.parent_path().string();
  if (!fs::is_directory(folder))
    throw UserError(fmt::format("cannot write '{}': there is no folder '{}'", to, folder));
  scene::Scene scene;
  if (is_mi(a.model)) {
    scene = read_mi(a.model, diagnostics);
  } else {
    const std::string textures =
        (fs::path(folder) / (output.stem().string() + "_textures")).string();
    auto imported = models::import_model(
        a.model, {textures, folder, a.up.empty() ? std::nullopt : std::optional(a.up[0])},
        diagnostics);
    printer.print_new();
    if (!imported) throw UserError(fmt::format("'{}' could not be read", a.model));
    scene = std::move(*imported);
    const models::DaylightOptions options = daylight_options(a);
    if (scene.renders.empty())
      models::add_camera(scene, options);
    else if (!a.size.empty())
      models::set_picture_size(scene, options.width, options.height);
    if (a.daylight) models::add_daylight(scene, options);
  }
  const auto write = [&] {
    const bool written = mi::write_scene(scene, to, diagnostics);
    printer.print_new();
    if (!written) throw UserError(fmt::format("cannot write '{}'", to));
  };
  write();
  if (is_mi(a.model) || a.daylight) return;
  // As it will be read: pictures are found from where the scene is.
  scene::Scene read = read_mi(to, diagnostics);
  if (const float shutter = metered_shutter(read, kFNumber); shutter > 0) {
    models::add_exposure(scene, kFNumber, shutter);
    write();
  } else {
    diagnostics.note("OR-MD-007", {}, "no light of the model reaches what its camera sees",
                     "--daylight adds sun and sky");
    printer.print_new();
  }
}

int run_convert(const ConvertArguments& a) {
  if (fs::path(a.output).extension() != ".mi")
    throw UsageError(fmt::format("{}: the result is a scene; its name ends in .mi", a.output));
  if (fs::exists(a.output) && fs::equivalent(a.model, a.output))
    throw UsageError("the result would overwrite what it is made of");
  convert(a, a.output);
  return kExitDone;
}

int run_quick(ConvertArguments a) {
  if (a.output.empty()) a.output = fs::path(a.model).stem().string() + ".png";
  if (is_mi(a.model)) throw UsageError("for scenes there is oriel render");
  const fs::path scene = fs::path(a.output).replace_extension(".mi");
  if (fs::exists(scene) && fs::equivalent(a.model, scene))
    throw UsageError("the scene would overwrite the model");
  a.daylight = true;
  convert(a, scene.string());
  // The very command that a user would type next.
  CLI::App program;
  const Command render = add_render_command(program);
  std::vector<std::string> words = {"render", scene.string(), "-o",
                                    a.output, "--samples",    std::to_string(a.samples)};
  if (a.denoise && a.samples > 1) words.emplace_back("--denoise");
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
  auto a = std::make_shared<ConvertArguments>();
  add_shared(*command, *a);
  command->add_option("-o,--output", a->output, "picture to write; MODEL's name with .png");
  command->add_option("--samples", a->samples, "per pixel")
      ->capture_default_str()
      ->check(CLI::Range(1, 1 << 20));
  command->add_flag("--denoise,!--no-denoise", a->denoise, "take the rest of the noise out")
      ->capture_default_str();
  return {command, [a] { return run_quick(*a); }};
}

}  // namespace oriel::app
