// SPDX-License-Identifier: Apache-2.0
#include "convert_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "base/durable_file.h"
#include "command.h"
#include "light_meter.h"
#include "mi/reader.h"
#include "mi/writer.h"
#include "models/camera_view.h"
#include "models/daylight.h"
#include "models/gltf/write.h"
#include "models/import_apart.h"
#include "numbers.h"
#include "scene_dump.h"
#include "scene_file.h"
#include "scene_motion.h"
#include "shaders/registry.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

/// For the light of the model itself.
constexpr float kFNumber = 8;
/// A meter puts the mean at a tenth of the brightness that is white, and the curve of the exposure
/// (burn_highlights .3, crush_blacks .15) shows that at .066. With this factor the log mean is
/// shown at .18, middle grey.
constexpr float kMiddleGrey = 2.2f;
/// Share of a sunny day's exposure below which a camera of the file sees next to no daylight. A
/// guess: rooms have a thousandth of the light outside, cupboards none.
constexpr float kRoom = 1 / 20000.0f;
/// MB, for the import of a model of strangers; as for their pictures.
constexpr std::size_t kUntrustedMemory = 8192;

models::DaylightOptions daylight_options(const ConvertArguments& a) {
  models::DaylightOptions options;
  if (!a.size.empty()) {
    const PictureSize size = parse_size(a.size);
    options.width = size.width, options.height = size.height;
  }
  if (!a.sun.empty()) options.sun_azimuth = a.sun[0], options.sun_elevation = a.sun[1];
  return options;
}

bool is_glb(const fs::path& path) { return path.extension() == ".glb"; }
bool is_dump(const fs::path& path) { return path.extension() == ".json"; }

/// Inputs:  motion: gets the placements of all frames; may be null.
scene::Scene read_mi(const std::string& path, const TrustArguments& trust,
                     const std::vector<std::string>& include_paths, SceneMotion* motion,
                     Diagnostics& diagnostics) {
  SceneArguments arguments;
  arguments.path = path;
  arguments.include_paths = include_paths;
  arguments.trust = trust;
  mi::Reader reader(path, read_options(arguments, builtin_shaders()), diagnostics);
  if (!reader.opened()) throw UserError(fmt::format("cannot read '{}'", path));
  scene::Scene scene;
  while (reader.next_frame(scene))
    if (motion) motion->add_frame(scene);
  return scene;
}

/// A scene may contain hours of work: it is replaced only if a conversion wrote it.
void check_scene_target(const std::string& path, bool force) {
  std::error_code error;
  if (force || is_glb(path) || is_dump(path) || !fs::exists(path, error) ||
      fs::file_size(path, error) == 0)
    return;
  if (!mi::is_unedited_scene(path))
    throw UserError(
        fmt::format("'{}' exists and was written or edited by someone else; it is kept: choose "
                    "another name, or replace it with --force",
                    path));
}

/// One conversion, with what it says.
class Conversion {
 public:
  Conversion(const ConvertArguments& a, std::string to) : a_(a), to_(std::move(to)) {}

  void run() {
    const fs::path output(to_);
    const std::string folder = output.parent_path().empty() ? "." : output.parent_path().string();
    if (!fs::is_directory(folder))
      throw UserError(fmt::format("cannot write '{}': there is no folder '{}'", to_, folder));
    check_scene_target(to_, a_.force);
    if (is_mi(a_.model)) {
      scene_ = read_mi(a_.model, a_.trust, a_.include_paths, is_dump(to_) ? &motion_ : nullptr,
                       diagnostics_);
      write();
      return;
    }
    how_ = {(fs::path(folder) / (output.stem().string() + "_textures")).string(), folder,
            a_.up.empty() ? std::nullopt : std::optional(a_.up[0])};
    const models::DaylightOptions options = daylight_options(a_);
    if (!a_.size.empty())
      how_.aspect = static_cast<float>(options.width) / static_cast<float>(options.height);
    how_.emission_scale = a_.emission_scale;
    how_.seconds = a_.animation_time;
    how_.files = file_access(a_.trust);
    read(diagnostics_);
    const bool of_file = models::choose_camera(scene_, options, diagnostics_);
    printer_.print_new();
    if (!a_.size.empty()) models::set_picture_size(scene_, options.width, options.height);
    if (a_.daylight) models::add_daylight(scene_, options);
    if (!a_.sky.empty()) models::add_sky(scene_, a_.sky, a_.sky_rotation);
    write();
    if (is_glb(to_) || is_dump(to_)) return;  // these have no exposure
    if (!a_.daylight)
      expose();
    else if (of_file)
      expose_in_daylight(options);
  }

  bool is_complete() const { return !diagnostics_.has("OR-MD-023"); }

 private:
  void read(Diagnostics& diagnostics) {
    models::ImportProcess process;
    if (a_.trust.untrusted) process.memory_mb = kUntrustedMemory, process.seconds = 600;
    std::optional<scene::Scene> read =
        models::import_model_apart(a_.model, how_, process, diagnostics);
    printer_.print_new();
    if (!read) throw UserError(fmt::format("'{}' could not be read", a_.model));
    scene_ = std::move(*read);
  }

  void write() {
    if (is_dump(to_)) {
      const fs::path arrays = fs::path(to_).replace_extension(".bin");
      const SceneDump dump = dump_scene(scene_, arrays.filename().string(), motion_, diagnostics_);
      write_durably(arrays.string(), dump.binary);
      write_durably(to_, dump.json);
      printer_.print_new();
      return;
    }
    const bool glb = is_glb(to_);
    if (glb) write_durably(to_, models::gltf::write_glb(scene_, diagnostics_, a_.up == "z"));
    const bool written = glb || mi::write_scene(scene_, to_, diagnostics_);
    printer_.print_new();
    if (!written) throw UserError(fmt::format("cannot write '{}'", to_));
  }

  /// As it will be read: pictures are found from where the scene is.
  float metered(float f_number) {
    scene::Scene written = read_mi(to_, trust_of_result(a_), {}, nullptr, diagnostics_);
    return metered_shutter(written, f_number) / kMiddleGrey;
  }

  void expose() {
    if (const float shutter = metered(kFNumber); shutter > 0) {
      models::add_exposure(scene_, kFNumber, shutter);
      write();
    } else {
      diagnostics_.note(
          "OR-MD-007", {},
          "the lights of the model do not illuminate the view of its camera; no exposure is set",
          "--daylight adds sun and sky");
      printer_.print_new();
    }
  }

  void expose_in_daylight(const models::DaylightOptions& options) {
    const float shutter = metered(models::kSunnyFNumber);
    if (shutter > models::kSunnyShutter * kRoom) {
      models::add_exposure(scene_, models::kSunnyFNumber, shutter);
    } else {
      diagnostics_.warning(
          "OR-MD-013", {},
          "the view of the file's camera receives almost no daylight; the model is "
          "rendered from its front",
          "the scene still contains the file's camera");
      Diagnostics heard_already;
      read(heard_already);
      models::add_camera(scene_, options);
      models::add_daylight(scene_, options);
    }
    write();
  }

  const ConvertArguments& a_;
  const std::string to_;
  models::ImportOptions how_;
  Diagnostics diagnostics_;
  DiagnosticPrinter printer_{diagnostics_, false, !a_.quiet};
  scene::Scene scene_;
  SceneMotion motion_;
};

}  // namespace

TrustArguments trust_of_result(const ConvertArguments& a) {
  TrustArguments trust = a.trust;
  const std::string folder = fs::path(a.model).parent_path().string();
  trust.allowed.push_back(folder.empty() ? "." : folder);
  if (!a.sky.empty()) trust.allowed.push_back(a.sky);
  return trust;
}

bool is_mi(const fs::path& path) {
  return path.extension() == ".mi" ||
         (path.extension() == ".gz" && path.stem().extension() == ".mi");
}

bool is_model(const fs::path& path) {
  static constexpr std::array kSuffixes = {".glb",  ".gltf", ".obj", ".fbx", ".dae",
                                           ".ifc",  ".3ds",  ".ply", ".stl", ".usd",
                                           ".usda", ".usdc", ".usdz"};
  const std::string suffix = models::lower_suffix(path.string());
  return std::find(kSuffixes.begin(), kSuffixes.end(), suffix) != kSuffixes.end();
}

bool convert_model(const ConvertArguments& a, const std::string& to) {
  Conversion conversion(a, to);
  conversion.run();
  return conversion.is_complete();
}

}  // namespace oriel::app
