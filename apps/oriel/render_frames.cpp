// SPDX-License-Identifier: Apache-2.0
#include "render_frames.h"

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <new>
#include <stdexcept>

#include "base/input_files.h"
#include "base/parallel.h"
#include "checkpoint_labels.h"
#include "denoiser_option.h"
#include "done_line.h"
#include "frame_pictures.h"
#include "frame_settings.h"
#include "interrupt.h"
#include "maps_file.h"
#include "merge_picture.h"
#include "output/exposure_check.h"
#include "output/picture_metadata.h"
#include "parts.h"
#include "pictures.h"
#include "process_streams.h"
#include "progress_line.h"
#include "render/indirect_plan.h"
#include "render_attributes.h"
#include "scene_code.h"
#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/hang.h"
#include "sdk/host.h"
#include "sdk/missing_roles.h"
#include "shaders/registry.h"
#include "shared_picture.h"
#include "tile_server.h"

namespace oriel::app {
namespace {

/// Whether a file is made to be looked at: integers, not linear light.
bool is_for_display(const PictureFile& file) {
  return !file.float_pixels &&
         (file.samples == SampleFormat::U8 || file.samples == SampleFormat::U16);
}

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
/// A picture in progress is written at most so often, and takes at most a twentieth of the time.
constexpr double kSecondsBetweenWrites = 5, kWriteShare = 0.05;
constexpr double kMaxLimitSeconds = 1e9;  // the clock has 64 bits

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

OutputRoots roots_of(const SceneArguments& scene) {
  const std::string folder = fs::path(scene.path).parent_path().string();
  return {folder, {folder}};
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
        code_(arguments.scene, diagnostics),
        roots_(plan.roots.value_or(roots_of(arguments.scene))),
        line_(ProgressLine::style_for(a_.json, a_.quiet)),
        pictures_(roots_, a_.live, diagnostics) {
    if (!plan.part)
      checkpoints_.emplace(plan.checkpoint, a_.scene.path, option_labels(a_), diagnostics);
  }

  /// Every frame passes here before it is rendered or not. False: it is not wanted.
  bool begin(const scene::RenderCommand& command, int frame) {
    name_files(command, frame);
    if (!plan_.frames.holds(frame)) return false;
    if (!agreed(a_.skip_existing && frame_files_.all_exist())) return true;
    diagnostics_.note("OR-RN-063", command.where,
                      fmt::format("frame {} is left out: its files are there", frame));
    return false;
  }

  /// Both eyes of cameras that have two. False if the scene cannot be rendered. A frame whose files
  /// cannot be written is skipped.
  bool render(const scene::RenderCommand& command, int frame, bool is_last) {
    const scene::Camera* camera = find_camera(scene_, command, plan_.prepare.camera);
    const std::vector<Eye> eyes = camera ? eyes_of(*camera) : std::vector{Eye::Middle};
    name_files(command, frame);  // an edit may have changed them
    const bool writes = !plan_.part && a_.maps_only.empty() && leads();
    if (!agreed(!writes || pictures_.test(frame_files_.all(), command.where))) return true;
    for (const Eye eye : eyes)
      if (agreed(!interrupted() && (plan_.part || !checkpoints_->is_finished({frame, eye}))) &&
          !render(command, frame, eye, is_last && eye == eyes.back()))
        return false;
    return true;
  }

  int exit_code() const { return exit_code_; }
  /// Of an interrupted render. A part that was interrupted before its first pixel starts again.
  int exit_code_if_interrupted() const {
    const bool resumes = plan_.part || (checkpoints_->can_resume() && is_complete(diagnostics_));
    return resumes ? kExitResume : kExitFailed;
  }
  bool goes_on() const { return agreed(!interrupted()); }

  /// Unloads the shader libraries, whose last functions may still report errors.
  void close() {
    if (!plan_.part && leads() && !stays_ && !interrupted()) checkpoints_->remove();
    session_.reset();
    world_.reset();
    host_.reset();
  }

 private:
  void name_files(const scene::RenderCommand& command, int frame) {
    const scene::Camera* camera = find_camera(scene_, command, plan_.prepare.camera);
    frame_files_.begin(frame, a_.outputs, camera, roots_,
                       fs::path(a_.scene.path).stem().string() + ".exr");
  }

  bool render(const scene::RenderCommand& command, int frame, Eye eye, bool is_last) {
    session_.reset();  // it refers to the world before
    denoised_ = {};
    PrepareReport report;
    if (world_) cache_.keep(*world_);
    world_.reset();
    forget_frame_inputs();
    code_.compile(scene_);
    limit_time();
    host_.emplace(scene_, builtin_shaders(), code_.trusted_folders(), diagnostics_, &interrupted());
    sdk::set_output_roots(roots_);
    PrepareOptions options = plan_.prepare;
    options.cache = &cache_;
    options.eye = eye;
    options.release_geometry = is_last;
    world_ = prepare(scene_, command, host_->registry(), options, diagnostics_, report);
    if (!world_) return false;
    sdk::report_missing_roles(scene_, command, find_camera(scene_, command, plan_.prepare.camera),
                              world_->options.lens, world_->options.output, *host_, diagnostics_);
    if (plan_.gi) world_->options.indirect = *plan_.gi;
    if (!plan_.guiding) world_->options.guiding = false;
    choose_files(command, frame);
    for (PictureFile& file : files_) file.path = eye_path(file.path, eye);
    check_exposures(*world_, files_, diagnostics_);
    printer_.print_new();

    const FrameToRender request{a_, plan_, scene_, *world_, files_, roots_, diagnostics_};
    SessionSettings settings = frame_settings(request, unit_is_known_);
    settings.started = begun_;
    if (!fits_budget(request, command, settings)) return false;
    session_.emplace(*world_, settings);
    const RenderPlace place{frame, eye};
    if (!a_.maps_only.empty()) return compute_maps(place);
    if (!a_.maps.empty() && !world_->preview) read_maps(a_, place, *session_);
    if (plan_.part) return render_part(place);
    if (plan_.ranks) require_same_session(*plan_.ranks, a_, *session_);
    if (!leads()) return serve_leader();
    if (plan_.merge) {
      if (!merge_parts(place)) return true;
    } else {
      checkpoints_->begin(place, *session_);
    }
    last_write_ = Clock::now();
    const StopReason reason = plan_.ranks ? run_with_ranks(frame, eye) : run_session();
    sdk::set_stop_time({});  // of samples alone
    line_.clear();
    const bool unfinished =
        reason == StopReason::Cancelled || (reason == StopReason::Time && is_last);
    if (unfinished) write_checkpoint(true);
    if (reason == StopReason::MapsOnly) return end_shaders(), finish(reason), true;
    if (session_->film().light_layers() > 0 && session_->has_unknown_light())
      diagnostics_.note(
          "OR-RN-060", {},
          "the light group of light from map files, of interpolated reflections and of "
          "shaders that return finished colours is unknown; it is in the layer "
          "light_indirect");
    const std::size_t errors = diagnostics_.count(Severity::Error);
    write_pictures(reason);
    const bool lost = diagnostics_.count(Severity::Error) > errors;
    stays_ = unfinished || (lost && is_last);
    if (stays_ && !unfinished) write_checkpoint(true);
    if (!stays_ && !is_last) checkpoints_->end_picture(place);
    end_shaders();
    finish(reason);
    begun_ = Clock::now();
    return true;
  }

  /// Writes the maps of a picture that is not rendered.
  bool compute_maps(RenderPlace place) {
    if (!world_->preview) {
      const Progressive::Callbacks shown{
          .progress = [this](const Progress& p) { line_.update(p); }};
      const bool done = session_->prepare(shown, &interrupted());
      line_.clear();
      if (done) write_maps(a_, place, *session_);
      if (done && !a_.json && !a_.quiet)
        fmt::print(stderr, "{}: {} rays\n", maps_path(a_.maps_only, place),
                   session_->rays().rays());
      if (done && a_.json)
        print_done_line(*session_, StopReason::MapsOnly, {maps_path(a_.maps_only, place)});
    }
    sdk::set_stop_time({});
    end_shaders();
    return true;
  }

  /// Renders the part of a picture to its file.
  bool render_part(RenderPlace place) {
    if (world_->preview)
      throw UserError("the exposure shows its preview, which has no parts; render without --part");
    part_.emplace(a_, plan_.checkpoint, *plan_.part, place, files_.front().path, diagnostics_);
    part_->begin(*session_);
    const StopReason reason = part_->was_finished() ? StopReason::Samples : run_session();
    sdk::set_stop_time({});
    line_.clear();
    const bool finished = reason != StopReason::Cancelled;
    if (reason == StopReason::MapsOnly) return end_shaders(), finish(reason), true;
    if (!part_->was_finished() && session_->can_save() && !part_->end(*session_, finished))
      exit_code_ = kExitFailed;
    else if (!finished && exit_code_ == kExitDone)
      exit_code_ = kExitResume;
    end_shaders();
    printer_.print_new();
    if (a_.json)
      print_done_line(*session_, reason, {part_->path()});
    else if (!a_.quiet)
      fmt::print(stderr, "{}: part {}, {:.4g} samples{}\n", part_->path(), part_name(*plan_.part),
                 session_->progress().mean_samples,
                 finished ? "" : "; interrupted, the same command continues it");
    return true;
  }

  /// Reads the pixels of all parts. False: the picture needs another round of them.
  bool merge_parts(RenderPlace place) {
    const MergeResult merged = merge_picture(*plan_.merge, place, a_, *session_);
    if (merged.round.empty()) return true;
    exit_code_ = kExitResume;
    if (a_.json)
      print_json({{"event", "round"}, {"file", merged.round}, {"samples", merged.samples}});
    else if (!a_.quiet)
      fmt::print(stderr,
                 "{}: noisy pixels need another round, to {:.4g} samples on average; render all "
                 "parts again, then merge\n",
                 merged.round, merged.samples);
    end_shaders();
    return false;
  }

  bool leads() const { return !plan_.ranks || plan_.ranks->leads(); }
  /// A decision that depends on files: that of rank 0.
  bool agreed(bool decision) const {
    return plan_.ranks ? plan_.ranks->from_leader(decision) : decision;
  }
  /// Whether several ranks render the picture.
  bool is_shared() const {
    return plan_.ranks && !world_->preview && !session_->integrator().caches_only();
  }

  /// Renders tiles for rank 0, which writes the picture.
  bool serve_leader() {
    if (is_shared() && share_maps(*plan_.ranks, *session_, {}, nullptr))
      serve_tiles(*plan_.ranks, *session_);
    sdk::set_stop_time({});
    end_shaders();
    return true;
  }

  StopReason run_with_ranks(int frame, Eye eye) {
    const Progressive::Callbacks shown{.progress = [this](const Progress& p) { line_.update(p); }};
    if (!is_shared() || !share_maps(*plan_.ranks, *session_, shown, &interrupted()))
      return run_session();
    TileLeader leader(*plan_.ranks, *session_, 4 * frame + static_cast<int>(eye));
    spread_ = [&leader](const auto&... work) { leader.spread(work...); };
    const StopReason reason = run_session();
    spread_ = {};
    leader.end();
    return reason;
  }

  Checkpoints& checkpoints() { return part_ ? part_->file() : *checkpoints_; }

  StopReason run_session() {
    Progressive::Callbacks callbacks;
    callbacks.progress = [this](const Progress& p) { line_.update(p); };
    if (!plan_.part) callbacks.pass = [this](const Progress& p) { on_pass(p); };
    if (checkpoints().writes()) {
      callbacks.wants_pause = [this] { return checkpoints().is_due(); };
      callbacks.paused = [this] { write_checkpoint(false); };
    }
    callbacks.spread = spread_;
    return session_->run(callbacks, &interrupted());
  }

  void write_checkpoint(bool at_end) {
    if (!checkpoints().writes() || !session_->can_save()) return;
    const bool written = checkpoints().write(*session_, at_end);
    if (!written) {
      line_.clear();
      printer_.print_new();
    } else if (a_.json) {
      print_json({{"event", "checkpoint"},
                  {"file", part_ ? part_->path() : plan_.checkpoint.file},
                  {"samples", session_->film().mean_samples()},
                  {"seconds", checkpoints().write_seconds()}});
    } else if (at_end && !a_.quiet) {
      fmt::print(stderr, "the render can be continued: --resume {}\n", plan_.checkpoint.file);
    }
  }

  /// Ends shaders that hang beyond the time limit.
  void limit_time() const {
    sdk::StopTime limit;
    if (a_.time)
      limit = begun_ + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(std::min(*a_.time, kMaxLimitSeconds)));
    sdk::set_stop_time(limit);
  }

  /// After the files: output shaders belong to the frame.
  void end_shaders() { host_->end_frame(); }

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
      files_ = camera_outputs(*camera, roots_, scene_, host_->registry(), *world_, diagnostics_);
      for (PictureFile& file : files_) file.path = frame_files_.path_of(file.path);
    }
    if (files_.empty())
      files_.push_back(
          picture_file(frame_path(fs::path(a_.scene.path).stem().string() + ".exr", frame)));
    for (PictureFile& file : files_) {
      if (plan_.layers) file.layers = *plan_.layers;
      file.unmapped |= a_.linear;
      if (a_.bits > 0 && is_for_display(file))
        file.samples = a_.bits == 16 ? SampleFormat::U16 : SampleFormat::U8;
      if (plan_.precision) file.precision = *plan_.precision;
      if (plan_.compression) file.compression = *plan_.compression;
    }
  }

  void on_pass(const Progress& p) {
    line_.update(p);
    const double since = seconds_since(last_write_);
    if (since < kSecondsBetweenWrites || since * kWriteShare < write_seconds_) return;
    if (p.remaining && *p.remaining < kSecondsBetweenWrites) return;
    const Clock::time_point start = Clock::now();
    pictures_.write_pass(files_, writer());
    last_write_ = Clock::now();
    write_seconds_ = seconds_since(start);
  }

  void write_pictures(StopReason reason) {
    const UsefulWork work(plan_.ranks);
    const Progress p = session_->progress();
    const bool complete = p.pass > 0 || reason != StopReason::Cancelled;
    state_ = complete                              ? PictureState::Complete
             : session_->film().mean_samples() > 0 ? PictureState::FirstPass
                                                   : PictureState::Empty;
    if (a_.denoise && !world_->preview && complete) denoise_picture();
    pictures_.write_final(files_, state_, writer());
  }

  void denoise_picture() try {
    DenoisedPicture picture = denoised_beauty(*session_, denoiser_of(a_.denoiser));
    denoised_ = std::move(picture.color);
    denoiser_ = std::move(picture.denoiser);
    if (!picture.note.empty())
      diagnostics_.warning("OR-RN-072", {}, picture.note, "Oriel's own denoiser was used");
  } catch (const std::exception& e) {
    diagnostics_.error("OR-RN-069", {}, fmt::format("the pictures are not denoised: {}", e.what()));
  }

  /// Writes files of the film as it is now.
  FramePictures::Writer writer() {
    auto clean = std::make_shared<Image>();
    if (denoised_.empty() && !a_.keep_outliers &&
        std::any_of(files_.begin(), files_.end(), is_for_display))
      try {
        *clean = beauty_without_outliers(*session_);
      } catch (const std::bad_alloc&) {  // the pictures keep their outliers
      }
    return [this, clean](const PictureFile& file) {
      const Image* colors = !denoised_.empty()                        ? &denoised_
                            : is_for_display(file) && !clean->empty() ? clean.get()
                                                                      : nullptr;
      write_picture(file, *session_, describe(file), colors);
    };
  }

  /// Attributes of EXR files. Without --timestamps the same command gives the same bytes.
  std::map<std::string, ExrValue> describe(const PictureFile& file) const {
    std::map<std::string, ExrValue> m = picture_metadata(*world_, file.shaders);
    m.merge(render_attributes(a_, *session_));
    if (unit_is_known_) m["whiteLuminance"] = session_->unit_luminance();
    if (has_photometric_layers(files_)) m[kUnitLuminanceKey] = session_->unit_luminance();
    if (!denoised_.empty()) m["oriel.denoiser"] = denoiser_;
    return m;
  }

  void finish(StopReason reason) {
    printer_.print_new();
    if (a_.json)
      return print_done_line(
          *session_, reason,
          reason == StopReason::MapsOnly ? std::vector<std::string>() : pictures_.written());
    if (a_.quiet) return;
    if (reason == StopReason::MapsOnly) {
      fmt::print(stderr, "maps of indirect light alone, as the options ask: no picture\n");
      return;
    }
    if (state_ == PictureState::Empty) {
      fmt::print(stderr, "interrupted before the first sample: no picture is written\n");
      return;
    }
    print_summary(*session_, reason, pictures_.written());
  }

  const RenderArguments& a_;
  const RenderPlan& plan_;
  scene::Scene& scene_;
  Diagnostics& diagnostics_;
  DiagnosticPrinter& printer_;
  SceneCode code_;
  const OutputRoots roots_;
  ProgressLine line_;
  std::optional<sdk::Host> host_;  // outlives what was bound with its registry
  GeometryCache cache_;
  FrameFiles frame_files_;
  std::unique_ptr<World> world_;
  std::optional<RenderSession> session_;
  Image denoised_;        ///< empty until the render is done, or without --denoise
  std::string denoiser_;  ///< that made it
  std::vector<PictureFile> files_;
  FramePictures pictures_;
  std::optional<Checkpoints> checkpoints_;  ///< unless parts are rendered
  std::optional<PartRender> part_;
  Progressive::TileLoop spread_;  ///< while several ranks render the picture
  int exit_code_ = kExitDone;
  bool stays_ = false;  ///< the checkpoint, since its picture can go on
  PictureState state_ = PictureState::Empty;
  Clock::time_point begun_ = process_start();  ///< of the picture, for --time
  Clock::time_point last_write_;
  double write_seconds_ = 0;
  bool unit_is_known_ = false;  ///< cd/m2 of a pixel unit
};

}  // namespace

int render_frames(mi::Reader& reader, const RenderArguments& arguments, const RenderPlan& plan,
                  const std::function<void(scene::Scene&)>& edit, Diagnostics& diagnostics,
                  DiagnosticPrinter& printer) {
  scene::Scene scene;
  catch_interrupts();
  if (plan.part || arguments.stop_at_usr1) end_at_checkpoint_signal();
  FrameRenderer renderer(arguments, plan, scene, diagnostics, printer);
  int frames = 0, rendered = 0;
  while (renderer.goes_on() && plan.frames.goes_on_from(frames + 1) && reader.next_frame(scene)) {
    printer.print_new();
    if (!renderer.begin(scene.renders.back(), ++frames)) continue;
    edit(scene);
    const bool is_last = !plan.frames.goes_on_from(frames + 1) || reader.at_end();
    const bool done = renderer.render(scene.renders.back(), frames, is_last);
    printer.print_new();
    if (!done) return kExitFailed;
    ++rendered;
  }
  renderer.close();
  printer.print_new();
  if (renderer.exit_code() != kExitDone) return renderer.exit_code();
  if (interrupted()) return renderer.exit_code_if_interrupted();
  if (frames == 0)
    throw UserError(fmt::format("{}: the scene has no render statement, so there is nothing to do",
                                arguments.scene.path));
  if (rendered == 0 && !arguments.skip_existing)
    throw UserError(fmt::format("--frames {}: {} has {} render statements", arguments.frames,
                                arguments.scene.path, frames));
  return is_complete(diagnostics) ? kExitDone : kExitFailed;
}

}  // namespace oriel::app
