// SPDX-License-Identifier: Apache-2.0
#include "frame_settings.h"

#include <fmt/format.h>

#include <algorithm>

#include "output/matte_layers.h"
#include "output/output_names.h"
#include "output/output_place.h"
#include "render/unit_luminance.h"
#include "render_frames.h"

namespace oriel::app {
namespace {

class SettingsOfFrame {
 public:
  explicit SettingsOfFrame(const FrameToRender& f)
      : a_(f.arguments),
        plan_(f.plan),
        scene_(f.scene),
        world_(f.world),
        files_(f.files),
        roots_(f.roots),
        diagnostics_(f.diagnostics) {}

  SessionSettings settings(bool& unit_is_known) {
    SessionSettings settings = plan_.session;
    settings.outputs = keeps_outputs();
    settings.lights = keeps_lights();
    settings.mattes = keeps_mattes();
    settings.irradiance = any_needs(LayerNeed::Irradiance);
    for (const PictureFile& file : files_) settings.surface_values |= surface_values(file);
    settings.unit_luminance = unit_of_pixels();
    settings.clamp = a_.clamp;
    settings.map_files = map_files();
    settings.diagnostics = &diagnostics_;
    if (plan_.part) {
      settings.part = *plan_.part;
      settings.save_without_caches = true;
      settings.map_files.read_only = true;
    }
    unit_is_known = unit_is_known_;
    return settings;
  }

 private:
  bool any_needs(LayerNeed need) const {
    return std::any_of(files_.begin(), files_.end(),
                       [&](const PictureFile& f) { return needs(f, need); });
  }

  /// cd/m2 of a pixel unit. Contradictions of the scene are reported only if a layer depends on it.
  float unit_of_pixels() {
    unit_is_known_ = true;
    if (a_.unit_luminance) return *a_.unit_luminance;
    NodeList exposures;
    for (const PictureFile& file : files_)
      exposures.insert(exposures.end(), file.shaders.begin(), file.shaders.end());
    Diagnostics unused;
    const UnitLuminance unit =
        unit_luminance(world_, exposures, has_photometric_layers(files_) ? diagnostics_ : unused);
    unit_is_known_ = !unit.by.empty();
    return unit.cd_m2;
  }

  /// Maps that the options name, below the scene's folder alone.
  MapFiles map_files() {
    const auto allowed = [&](const std::string& file) {
      const std::string path = allowed_path(file, roots_);
      if (path.empty())
        diagnostics_.warning("OR-RN-043", {},
                             fmt::format("the map \"{}\" is outside of the scene's folder; "
                                         "it is ignored",
                                         file),
                             "move the file into the folder of the scene");
      return path;
    };
    const scene::RenderOptions& o = world_.options;
    MapFiles files;
    if (!o.photonmap_file.empty()) files.photons = allowed(o.photonmap_file);
    for (const std::string& file : o.finalgather.files)
      if (std::string path = allowed(file); !path.empty()) files.gather.push_back(std::move(path));
    return files;
  }

  /// Whether a file asks for outputs of materials and a material has them.
  bool keeps_outputs() {
    if (!any_needs(LayerNeed::Outputs)) return false;
    const auto& materials = world_.materials;
    if (std::any_of(materials.begin(), materials.end(),
                    [](const Material& m) { return m.outputs; }))
      return true;
    // Buffers of that name are filled by users' shaders.
    if (std::any_of(world_.user_buffers.begin(), world_.user_buffers.end(),
                    [](const UserBuffer& b) { return output_of_frame_buffer(b.name) >= 0; }))
      return false;
    diagnostics_.warning("OR-RN-055", {},
                         "no material has outputs beside its result, so there are no such layers",
                         "switch on multiple_outputs of the materials");
    return false;
  }

  /// Whether a file can hold layers of lights, where there are some.
  bool keeps_lights() {
    if (!world_.light_layers.asked()) return false;
    if (std::any_of(files_.begin(), files_.end(), holds_light_layers)) return true;
    diagnostics_.warning("OR-RN-059", {},
                         "light groups are layers of EXR files, and none is written",
                         "name one with -o FILE.exr");
    return false;
  }

  /// Ranks of the Cryptomattes that user or scene ask for; 0 = none.
  int ranks_of_mattes() const {
    if (plan_.matte_ranks) return *plan_.matte_ranks;
    const int ranks = world_.options.matte_ranks;
    return ranks == scene::RenderOptions::kDefaultMatteRanks ? kMatteRanks
                                                             : std::min(ranks, kMaxMatteRanks);
  }

  std::optional<MatteNames> keeps_mattes() {
    int ranks = ranks_of_mattes();
    if (ranks > 0 && std::none_of(files_.begin(), files_.end(), holds_light_layers)) {
      diagnostics_.warning("OR-RN-062", {},
                           "Cryptomattes are layers of EXR files, and none is written",
                           "name one with -o FILE.exr");
      ranks = 0;
    }
    if (ranks == 0 && !any_needs(LayerNeed::Mattes)) return std::nullopt;
    return matte_names(scene_, world_, ranks);
  }

  const RenderArguments& a_;
  const RenderPlan& plan_;
  const scene::Scene& scene_;
  const World& world_;
  const std::vector<PictureFile>& files_;
  const OutputRoots& roots_;
  Diagnostics& diagnostics_;
  bool unit_is_known_ = false;
};

}  // namespace

bool has_photometric_layers(const std::vector<PictureFile>& files) {
  const LayerSet photometric(LayerGroup::Photometric);
  return std::any_of(files.begin(), files.end(),
                     [&](const PictureFile& f) { return f.layers.overlaps(photometric); });
}

SessionSettings frame_settings(const FrameToRender& frame, bool& unit_is_known) {
  return SettingsOfFrame(frame).settings(unit_is_known);
}

bool fits_budget(const FrameToRender& f, const scene::RenderCommand& command,
                 const SessionSettings& settings) {
  const std::uint64_t bytes = film_bytes(f.world, settings);
  if (bytes <= f.scene.budgets[Budget::Pixels]) return true;
  const scene::Camera* camera = find_camera(f.scene, command, f.plan.prepare.camera);
  f.diagnostics.error(
      "OR-RN-082", camera ? camera->where : command.where,
      fmt::format("a picture of {} x {} pixels is not rendered: {}", f.world.camera.width,
                  f.world.camera.height, f.scene.budgets.excess(Budget::Pixels, bytes)),
      "choose a lower resolution, --crop or fewer layers; " +
          SceneBudgets::hint(Budget::Pixels, bytes));
  return false;
}

}  // namespace oriel::app
