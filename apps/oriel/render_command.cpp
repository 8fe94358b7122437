// SPDX-License-Identifier: Apache-2.0
// oriel render: a scene to pictures, frame by frame.
#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <optional>

#include "base/parallel.h"
#include "command.h"
#include "interrupt.h"
#include "pictures.h"
#include "progress_line.h"
#include "render/camera_output.h"
#include "render/exposure_check.h"
#include "render/output.h"
#include "render/output_names.h"
#include "render/prepare.h"
#include "render/session.h"
#include "render/unit_luminance.h"
#include "scene_file.h"
#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/host.h"
#include "shaders/registry.h"
#include "sun_scene.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// A picture in progress is written at most so often, and takes at most a twentieth of the time.
constexpr double kSecondsBetweenWrites = 5;
constexpr double kWriteShare = 0.05;

struct RenderArguments {
  SceneArguments scene;
  std::vector<std::string> outputs;
  std::optional<std::uint32_t> samples;
  std::optional<float> noise;
  std::optional<double> time;
  std::string gi, size, crop, camera, layers, sun;
  std::vector<std::string> light_groups;
  std::optional<double> north;
  std::optional<float> unit_luminance;
  std::uint32_t seed = 0;
  int threads = 0;
  bool denoise = false, json = false, quiet = false;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::vector<int> parse_integers(const std::string& text, char separator) {
  std::vector<int> numbers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(separator, at), text.size());
    const std::string part = text.substr(at, end - at);
    if (part.empty() || part.size() > 6 || part.find_first_not_of("0123456789") != part.npos)
      return {};
    numbers.push_back(std::stoi(part));
    at = end + 1;
  }
  return numbers;
}

/// What the arguments mean, checked before anything is read.
struct RenderPlan {
  PrepareOptions prepare;
  SessionSettings session;
  std::optional<LayerSet> layers;
  std::optional<scene::IndirectMethod> gi;
  std::optional<sky::SolarPosition> sun;
};

std::optional<scene::IndirectMethod> parse_gi(const std::string& text) {
  using Method = scene::IndirectMethod;
  if (text.empty()) return std::nullopt;
  if (text == "scene") return Method::Scene;
  if (text == "path") return Method::Path;
  if (text == "fg") return Method::FinalGather;
  if (text == "photons") return Method::Photons;
  if (text == "fg+photons") return Method::FinalGatherPhotons;
  throw UsageError(fmt::format("--gi {}: path, fg, photons, fg+photons or scene", text));
}

LayerSet parse_layers(const std::string& text) {
  LayerSet layers = 0;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string name = text.substr(at, end - at);
    const LayerSet bit = layer_bit(name);
    if (name == "all")
      layers = kFilmLayers | kPhotometricLayers | kOutputLayers;
    else if (name == "outputs")
      layers |= kOutputLayers;
    else if (!bit && name != "beauty" && name != "alpha")
      throw UsageError(fmt::format("--layers {}: beauty, {}, outputs or all", name,
                                   fmt::join(layer_names(), ", ")));
    layers |= bit;
    at = end + 1;
  }
  return layers;
}

/// "key=lamp*,spot_??".
scene::LightGroup parse_light_group(const std::string& text) {
  const std::size_t equals = text.find('=');
  scene::LightGroup group{text.substr(0, equals), {}};
  if (equals != text.npos) group.patterns = scene::split_patterns(text.substr(equals + 1));
  const std::string complaint = scene::light_group_complaint(group);
  if (!complaint.empty())
    throw UsageError(
        fmt::format("--light-group {}: {}; write NAME=PATTERN,PATTERN,...", text, complaint));
  return group;
}

RenderPlan plan_of(const RenderArguments& a) {
  RenderPlan plan;
  plan.gi = parse_gi(a.gi);
  plan.prepare.camera = a.camera;
  if (!a.size.empty()) {
    const std::vector<int> size = parse_integers(a.size, 'x');
    if (size.size() != 2 || size[0] < 1 || size[1] < 1 || size[0] > 65536 || size[1] > 65536)
      throw UsageError(fmt::format("--size {}: write WIDTHxHEIGHT in pixels", a.size));
    plan.prepare.width = size[0], plan.prepare.height = size[1];
  }
  if (!a.crop.empty()) {
    const std::vector<int> crop = parse_integers(a.crop, ',');
    if (crop.size() != 4 || crop[2] < crop[0] || crop[3] < crop[1])
      throw UsageError(fmt::format(
          "--crop {}: write XL,YL,XH,YH in pixels from the lower left, ends included", a.crop));
    plan.session.crop = Window{crop[0], crop[1], crop[2] + 1, crop[3] + 1};
  }
  for (const std::string& text : a.light_groups)
    scene::set_light_group(plan.prepare.light_groups, parse_light_group(text));
  if (plan.prepare.light_groups.size() > scene::kMostLightGroups)
    throw UsageError(fmt::format("--light-group: at most {} groups", scene::kMostLightGroups));
  if (!a.sun.empty()) plan.sun = read_sun("--sun", a.sun);
  if (a.north && !plan.sun) throw UsageError("--north: only with --sun");
  if (!a.layers.empty()) plan.layers = parse_layers(a.layers);
  if (a.unit_luminance && !(*a.unit_luminance > 0))
    throw UsageError("--unit-luminance: more than 0");
  if (a.samples && *a.samples == 0) throw UsageError("--samples: at least 1");
  if (a.noise && !(*a.noise > 0)) throw UsageError("--noise: more than 0");
  if (a.time && !(*a.time > 0)) throw UsageError("--time: more than 0 seconds");
  if (a.denoise && a.samples && *a.samples < 2)
    throw UsageError("--denoise: needs at least 2 samples to know the noise");
  plan.session.budget = {a.samples, a.noise, a.time};
  plan.session.seed = a.seed;
  for (const std::string& output : a.outputs) {
    const fs::path folder = fs::path(output).parent_path();
    if (!has_writable_suffix(output))
      throw UsageError(fmt::format(
          "-o {}: the suffix tells the file type: exr, hdr, png, jpg, tif, tga, bmp, ppm, ...",
          output));
    if (!folder.empty() && !fs::is_directory(folder))
      throw UserError(
          fmt::format("cannot write '{}': there is no folder '{}'", output, folder.string()));
  }
  return plan;
}

/// "out.exr", from the second frame on "out.0002.exr".
std::string frame_path(const std::string& path, int frame) {
  if (frame == 1) return path;
  const fs::path p(path);
  return (p.parent_path() /
          fmt::format("{}.{:04}{}", p.stem().string(), frame, p.extension().string()))
      .string();
}

class FrameRenderer {
 public:
  FrameRenderer(const RenderArguments& arguments, const RenderPlan& plan, scene::Scene& scene,
                Diagnostics& diagnostics, DiagnosticPrinter& printer)
      : a_(arguments),
        plan_(plan),
        scene_(scene),
        diagnostics_(diagnostics),
        printer_(printer),
        line_(ProgressLine::style_for(a_.json, a_.quiet)) {}

  /// False when there is nothing to render.
  bool render(const scene::RenderCommand& command, int frame) {
    session_.reset();  // it refers to the world before
    denoised_ = {};
    PrepareReport report;
    world_.reset();
    host_.emplace(scene_, builtin_shaders(), sdk::trusted_folders(a_.scene.shader_path),
                  diagnostics_, &interrupted());
    const std::string folder = fs::path(a_.scene.path).parent_path().string();
    sdk::set_output_roots({folder, {folder}});
    world_ = prepare(scene_, command, host_->registry(), plan_.prepare, diagnostics_, report);
    if (!world_) return false;
    if (plan_.gi) world_->options.indirect = *plan_.gi;
    choose_files(command, frame);
    check_exposures(*world_, files_, diagnostics_);
    printer_.print_new();

    SessionSettings settings = plan_.session;
    settings.outputs = keeps_outputs();
    settings.lights = keeps_lights();
    settings.irradiance = std::any_of(files_.begin(), files_.end(), needs_irradiance);
    settings.unit_luminance = unit_of_pixels();
    settings.map_files = map_files();
    settings.diagnostics = &diagnostics_;
    session_.emplace(*world_, settings);
    last_write_ = Clock::now();
    const StopReason reason = session_->run(
        {[this](const Progress& p) { line_.update(p); }, [this](const Progress& p) { on_pass(p); }},
        &interrupted());
    line_.clear();
    if (reason == StopReason::MapsOnly) return end_shaders(), finish(reason), true;
    if (session_->film().light_layers() > 0 && session_->has_unknown_light())
      diagnostics_.note("OR-RN-060", {},
                        "light from maps in files, of interpolated reflections and of shaders that "
                        "bring finished colours does not know its light group: it is layer "
                        "light.indirect");
    if (a_.denoise && !world_->preview) denoised_ = denoised_beauty(*session_);
    write_files();
    end_shaders();
    finish(reason);
    return true;
  }

 private:
  /// After the files: output shaders belong to the frame.
  void end_shaders() {
    host_->end_frame();
    const std::string& shader = sdk::crashed_shader();
    if (!shader.empty())
      diagnostics_.error("OR-SDK-005", {}, fmt::format("shader \"{}\" crashed", shader),
                         "the picture so far is saved; run the program in a debugger to see where: "
                         "gdb --args oriel render ...");
  }

  void choose_files(const scene::RenderCommand& command, int frame) {
    files_.clear();
    const scene::Camera* camera = find_camera(scene_, command, plan_.prepare.camera);
    if (!a_.outputs.empty()) {
      NodeList shaders;
      if (camera)
        shaders = camera_output_shaders(*camera, scene_, host_->registry(), *world_, diagnostics_);
      for (const std::string& output : a_.outputs) {
        files_.push_back(picture_file(frame_path(output, frame)));
        files_.back().shaders = shaders;
      }
    } else if (camera) {
      const std::string folder = fs::path(a_.scene.path).parent_path().string();
      files_ = camera_outputs(*camera, {folder, {folder}}, scene_, host_->registry(), *world_,
                              diagnostics_);
    }
    if (files_.empty())
      files_.push_back(
          picture_file(frame_path(fs::path(a_.scene.path).stem().string() + ".exr", frame)));
    if (plan_.layers)
      for (PictureFile& file : files_) file.layers = *plan_.layers;
  }

  bool has_photometric_layers() const {
    return std::any_of(files_.begin(), files_.end(),
                       [](const PictureFile& f) { return (f.layers & kPhotometricLayers) != 0; });
  }

  /// cd/m2, asked for only where a layer is told in it.
  float unit_of_pixels() {
    if (!has_photometric_layers()) return 1;
    if (a_.unit_luminance) return *a_.unit_luminance;
    NodeList exposures;
    for (const PictureFile& file : files_)
      exposures.insert(exposures.end(), file.shaders.begin(), file.shaders.end());
    return unit_luminance(*world_, exposures, diagnostics_).cd_m2;
  }

  /// Maps that the options name, below the scene's folder alone.
  MapFiles map_files() {
    const std::string folder = fs::path(a_.scene.path).parent_path().string();
    const auto allowed = [&](const std::string& file) {
      const std::string path = allowed_path(file, {folder, {folder}});
      if (path.empty())
        diagnostics_.warning("OR-RN-043", {},
                             fmt::format("the map \"{}\" is left out: it lies outside of the "
                                         "scene's folder",
                                         file),
                             "move the scene or name a file below its folder");
      return path;
    };
    const scene::RenderOptions& o = world_->options;
    MapFiles files;
    if (!o.photonmap_file.empty()) files.photons = allowed(o.photonmap_file);
    for (const std::string& file : o.finalgather.files)
      if (std::string path = allowed(file); !path.empty()) files.gather.push_back(std::move(path));
    return files;
  }

  /// Whether a file asks for outputs of materials and a material has them.
  bool keeps_outputs() {
    if (std::none_of(files_.begin(), files_.end(), needs_outputs)) return false;
    const auto& materials = world_->materials;
    if (std::any_of(materials.begin(), materials.end(),
                    [](const Material& m) { return m.outputs; }))
      return true;
    // Buffers of that name are filled by users' shaders.
    if (std::any_of(world_->user_buffers.begin(), world_->user_buffers.end(),
                    [](const UserBuffer& b) { return output_of_frame_buffer(b.name) >= 0; }))
      return false;
    diagnostics_.warning("OR-RN-055", {},
                         "no material has outputs beside its result, so there are no such layers",
                         "switch on multiple_outputs of the materials");
    return false;
  }

  /// Whether a file can hold layers of lights, where there are some.
  bool keeps_lights() {
    if (!world_->light_layers.asked()) return false;
    if (std::any_of(files_.begin(), files_.end(), holds_light_layers)) return true;
    diagnostics_.warning("OR-RN-059", {},
                         "light groups are layers of EXR files, and none is written",
                         "name one with -o FILE.exr");
    return false;
  }

  void on_pass(const Progress& p) {
    line_.update(p);
    const double since = seconds_since(last_write_);
    if (since < kSecondsBetweenWrites || since * kWriteShare < write_seconds_) return;
    if (p.remaining && *p.remaining < kSecondsBetweenWrites) return;
    write_files();
  }

  void write_files() {
    const Clock::time_point start = Clock::now();
    const std::map<std::string, std::string> metadata = describe();
    for (const PictureFile& file : files_)
      write_picture(file, *session_, metadata, denoised_.empty() ? nullptr : &denoised_);
    last_write_ = Clock::now();
    write_seconds_ = seconds_since(start);
  }

  /// No times in here: the same command gives the same file.
  std::map<std::string, std::string> describe() const {
    const RenderBudget& b = session_->budget();
    const Progress p = session_->progress();
    const Window& w = session_->window();
    std::map<std::string, std::string> m = {
        {"software", "Oriel " ORIEL_VERSION},
        {"oriel.scene", fs::path(a_.scene.path).filename().string()},
        {"oriel.indirect", session_->indirect().plan().name()},
        {"oriel.seed", fmt::format("{}", a_.seed)},
        {"oriel.samples", fmt::format("{:.6g}", p.mean_samples)},
        {"oriel.maxSamples", fmt::format("{}", b.max_samples)},
        {"oriel.noiseTarget", fmt::format("{:.6g}", b.noise)},
        {"oriel.window", fmt::format("{} {} {} {}", w.x0, w.y0, w.x1 - 1, w.y1 - 1)}};
    const Camera& c = world_->camera;
    if (!c.orthographic)
      m[kFieldOfViewKey] =
          fmt::format("{:.9g}", 2 * std::atan(c.aperture / (2 * c.focal)) * 180 / kPi);
    if (has_photometric_layers())
      m[kUnitLuminanceKey] = fmt::format("{:.9g}", session_->unit_luminance());
    if (session_->film().light_layers() > 0)
      m["oriel.lightGroups"] = fmt::format("{}", fmt::join(world_->light_layers.names, " "));
    if (p.noise) m["oriel.noise"] = fmt::format("{:.6g}", *p.noise);
    if (!a_.scene.edits.empty())
      m["oriel.set"] = fmt::format("{}", fmt::join(a_.scene.edits, "; "));
    if (!a_.sun.empty())
      m["oriel.sun"] = fmt::format("{} north {:.6g}", a_.sun, a_.north.value_or(0));
    return m;
  }

  void finish(StopReason reason) {
    printer_.print_new();
    const Progress p = session_->progress();
    constexpr const char* kReasons[] = {"samples", "noise", "time", "interrupted", "maps only"};
    if (a_.json) {
      nlohmann::json line = {{"event", "done"},
                             {"stopped_by", kReasons[static_cast<int>(reason)]},
                             {"samples", p.mean_samples},
                             {"elapsed", p.elapsed},
                             {"rays", session_->rays().rays()},
                             {"files", nlohmann::json::array()}};
      if (p.noise) line["noise"] = *p.noise;
      if (reason != StopReason::MapsOnly)
        for (const PictureFile& file : files_) line["files"].push_back(file.path);
      return print_json(line);
    }
    if (a_.quiet) return;
    if (reason == StopReason::MapsOnly) {
      fmt::print(stderr, "maps of indirect light alone, as the options ask: no picture\n");
      return;
    }
    std::vector<std::string> names;
    for (const PictureFile& file : files_) names.push_back(file.path);
    fmt::print(stderr, "{}{}: {:.4g} samples{}, {}\n",
               reason == StopReason::Cancelled ? "interrupted, the picture so far: " : "",
               fmt::join(names, ", "), p.mean_samples,
               p.noise ? fmt::format(", noise {:.4f}", *p.noise) : "", duration_text(p.elapsed));
  }

  const RenderArguments& a_;
  const RenderPlan& plan_;
  scene::Scene& scene_;
  Diagnostics& diagnostics_;
  DiagnosticPrinter& printer_;
  ProgressLine line_;
  std::optional<sdk::Host> host_;  // outlives what was bound with its registry
  std::unique_ptr<World> world_;
  std::optional<RenderSession> session_;
  Image denoised_;  ///< empty until the render is done, or without --denoise
  std::vector<PictureFile> files_;
  Clock::time_point last_write_;
  double write_seconds_ = 0;
};

int run_render(const RenderArguments& a) {
  const RenderPlan plan = plan_of(a);
  const ThreadLimit limit(a.threads);
  flush_denormals();
  Diagnostics diagnostics;
  DiagnosticPrinter printer(diagnostics, a.json, !a.quiet);
  mi::Reader reader(a.scene.path, read_options(a.scene, builtin_shaders()), diagnostics);
  scene::Scene scene;
  if (!reader.opened()) {
    printer.print_new();
    return kExitFailed;
  }
  catch_interrupts();
  catch_crashes();
  FrameRenderer renderer(a, plan, scene, diagnostics, printer);
  int frames = 0;
  while (!interrupted() && reader.next_frame(scene)) {
    printer.print_new();
    for (const std::string& edit : a.scene.edits) apply_edit(scene, edit, builtin_shaders());
    if (plan.sun) turn_sun(scene, scene.renders.back().root, *plan.sun, a.north.value_or(0));
    const bool rendered = renderer.render(scene.renders.back(), ++frames);
    printer.print_new();
    if (!rendered) return kExitFailed;
  }
  printer.print_new();
  if (interrupted()) return kExitFailed;
  if (frames == 0)
    throw UserError(fmt::format("{}: the scene has no render statement, so there is nothing to do",
                                a.scene.path));
  return kExitDone;
}

}  // namespace

Command add_render_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand("render", "Renders a scene");
  auto a = std::make_shared<RenderArguments>();
  add_scene_arguments(*app, a->scene);
  app->add_option("-o,--output", a->outputs,
                  "File to write in place of the camera's outputs, type by suffix; repeat for more")
      ->allow_extra_args(false)
      ->type_name("FILE");
  app->add_option("--samples", a->samples, "Samples of every pixel");
  app->add_option("--noise", a->noise,
                  "Until the noise of every pixel is below this (0.02 is fine)");
  app->add_option("--time", a->time, "Seconds to render for");
  app->add_option("--gi", a->gi, "Indirect light: path, fg, photons, fg+photons or scene");
  app->add_option("--size", a->size, "Size of the picture")->type_name("WxH");
  app->add_option("--crop", a->crop, "Only this window: XL,YL,XH,YH from the lower left");
  app->add_option("--sun", a->sun,
                  "Turns sun and sky to where they stand, as 48.14,11.58,2026-06-21T12:00+02:00")
      ->type_name("LAT,LON,TIME");
  app->add_option("--north", a->north,
                  "For --sun: degrees of north clockwise from above, from +Y, or -Z with y up");
  app->add_option("--camera", a->camera, "Camera instance to use");
  app->add_option(
      "--layers", a->layers,
      "Layers of EXR files, comma between: beauty, depth, ..., illuminance (lux), luminance "
      "(cd/m2), outputs (of materials) or all");
  app->add_option("--light-group", a->light_groups,
                  "Lights of such names (* and ? stand for others, comma between; instances, "
                  "instgroups, glowing objects, or environment) become layer light.NAME of EXR "
                  "files: all their light, bounces included. The rest is light.rest, and the "
                  "layers sum to the beauty; light.indirect is there where maps from files, "
                  "interpolated reflections or users' shaders do not know. Repeat for more; the "
                  "first that matches "
                  "has the light. In scenes: option \"light group NAME\" \"PATTERN,...\"")
      ->allow_extra_args(false)
      ->type_name("NAME=PATTERN,...");
  app->add_option("--unit-luminance", a->unit_luminance,
                  "cd/m2 of one unit of a pixel; else as the scene's exposure or sky says, or 1");
  app->add_flag("--denoise", a->denoise,
                "Takes the noise out of finished pictures; EXR gets it as a layer of its own");
  app->add_option("--seed", a->seed, "Another pattern of noise");
  app->add_option("--threads", a->threads, "Threads to use, 0 = all")->check(CLI::Range(0, 4096));
  app->add_flag("--json", a->json, "Lines of JSON on stdout");
  app->add_flag("-q,--quiet", a->quiet, "Only warnings and errors");
  return {app, [a] { return run_render(*a); }};
}

}  // namespace oriel::app
