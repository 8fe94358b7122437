// SPDX-License-Identifier: Apache-2.0
// A render in progress: camera samples, traced by an integrator, stored in a film.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>

#include "render/budget.h"
#include "render/film.h"
#include "render/integrator.h"
#include "render/mattes.h"
#include "render/progressive.h"
#include "render/silhouettes.h"
#include "runtime/window.h"
#include "runtime/world.h"
#include "transport/counts.h"
#include "transport/path/path_observer.h"

namespace oriel {

class ByteReader;
class ByteWriter;
class CheckpointReader;
class CheckpointWriter;

struct SessionSettings {
  BudgetRequest budget;
  std::uint32_t seed = 0;
  bool outputs = false;  ///< store the outputs of materials
  bool irradiance =
      false;  ///< store the irradiance of first surfaces; costs a second path per sample
  SurfaceValues surface_values = {};  ///< stored values of first surfaces
  bool lights = true;                 ///< store the light layers of the world
  /// A quick picture: paths without caches and without what is learned before the picture, one ray
  /// for each lobe whatever the sample counts of materials.
  bool draft = false;
  /// Whether run() draws a picture if it is cancelled while the integrator is prepared. False: the
  /// session can then not be continued, see can_save().
  bool picture_if_cancelled = true;
  float clamp = 0;                  ///< maximum of a sample's channels, pixel units; 0 = none
  float unit_luminance = 1;         ///< cd/m2 of one unit of a pixel, see unit_luminance.h
  std::optional<Window> crop = {};  ///< window, clipped to the picture; default: that of the camera
  std::optional<Window> maps_for = {};  ///< window for gather points; default: the window
  /// Optional observer of paths; may be null. Called from any thread, so the window should be one
  /// pixel. Must outlive the session.
  PathObserver* observer = nullptr;
  std::optional<MatteNames> mattes = {};  ///< store the first surfaces of each pixel
  PicturePart part = {};                  ///< only its pixels get samples
  /// The caches of indirect light are not part of save(): restore() leaves them to run(). For
  /// parts, of which each would contain the same caches.
  bool save_without_caches = false;
  MapFiles map_files = {};
  Diagnostics* diagnostics = nullptr;  ///< for map files; must outlive the session; may be null
  /// When the time limit and Progress::elapsed start; default: with the first pass.
  std::optional<std::chrono::steady_clock::time_point> started = {};
};

/// Memory of the film of a session in bytes.
std::uint64_t film_bytes(const World& world, const SessionSettings& settings);

/// Renders one world.
///
/// Model:   sample i of a pixel depends on the position of the pixel in the whole picture, the seed
///          and i, so a crop has the same pixels as the whole picture, unless their numbers of
///          samples depend on the noise of the others.
/// Checked: tests/cli (threads, crop); the pieces by their own tests.
class RenderSession {
 public:
  /// `world` must outlive the session and must not change.
  RenderSession(const World& world, const SessionSettings& settings);

  /// Prepares the integrator, then renders until the budget is used up or `cancel` becomes true.
  /// Another call continues. While gather points are computed, callbacks.pass occasionally gets a
  /// picture of one sample with the light so far; if cancelled before the first sample, the film
  /// contains such a picture. There is no picture if the options request caches only. If an
  /// exposure has a preview, the preview is the picture and nothing is rendered.
  StopReason run(const Progressive::Callbacks& callbacks = {},
                 const std::atomic<bool>* cancel = nullptr);

  /// Whether save() is possible: all caches exist, and the picture is not a preview. Within run()
  /// only from callbacks.paused.
  bool can_save() const { return state_is_whole_; }
  /// Writes caches, film, mattes and progress of the part.
  void save(CheckpointWriter& out);
  /// Reads them before the first run, which then continues where the other render was. World and
  /// settings must be the same, except for the time limit.
  /// Errors:  CheckpointError; the session can then not be used any more.
  /// Checked: Resume.* in tests/faults, SessionState.*
  void restore(CheckpointReader& in);

  /// Whether run() may compute for long before the picture starts.
  bool prepares_long() const { return !prepared_ && integrator_->prepares_long(expected_paths()); }
  /// What a session has computed before its picture.
  struct Preparation {
    std::unique_ptr<Integrator> integrator;  ///< null: nothing
    Window window, picture;
    double paths = 0;
    std::uint32_t seed = 0;
    RayCounts rays;
  };
  /// Takes it out of a session with can_save(), which cannot be used any more.
  Preparation take_preparation();
  /// Takes that of another session of the same world, before the first run. Returns false, and
  /// computes its own, if it would have computed something else.
  /// Checked: LightCachesTest.ChangesOfTheFilmAloneKeepCaches
  bool reuse(Preparation preparation);

  /// Computes what run() needs before the picture: the caches of indirect light and what paths
  /// learn. Returns false if cancelled. `share`: processes that call help_prepare() meanwhile.
  bool prepare(const Progressive::Callbacks& callbacks = {},
               const std::atomic<bool>* cancel = nullptr, WorkShare* share = nullptr);
  /// Computes a share of prepare() of the leading process; read_maps() has to follow.
  void help_prepare(WorkShare& share, const std::atomic<bool>* cancel);
  /// Writes the result of prepare(); read_maps() of a session with the same world and settings
  /// reads it before run().
  /// Errors:  CheckpointError; the session can then not be used any more.
  void save_maps(CheckpointWriter& out);
  void read_maps(CheckpointReader& in);

  /// Writes the pixels of tiles and the samples that they have to reach, for a session of another
  /// process with the same world and settings; or reads them.
  /// Errors:  std::runtime_error.
  void pack_tiles(ByteWriter& out, const std::vector<int>& tiles);
  void unpack_tiles(ByteReader& in, const std::vector<int>& tiles);
  /// The same of the samples that the pixels have to reach, for a session that has the pixels.
  void pack_targets(ByteWriter& out, const std::vector<int>& tiles);
  void unpack_targets(ByteReader& in, const std::vector<int>& tiles);
  /// Draws the missing samples of tiles, after prepare() or read_maps(). Each thread calls next()
  /// until there is no tile, and after each tile drawn() with the rays, which rays() does not
  /// count. Tiles lack samples if cancelled.
  void draw_tiles(const std::function<std::optional<int>()>& next,
                  const std::function<void(int tile, const RayCounts& rays)>& drawn,
                  const std::atomic<bool>* cancel = nullptr);
  /// Reads tiles that draw_tiles() of another process completed. The running pass is not paused.
  void add_tiles(ByteReader& in, const std::vector<int>& tiles, const RayCounts& rays);

  /// Adds the pixels of a part that another session saved without caches. World and settings must
  /// be the same, except that this session has the whole picture.
  /// Errors:  CheckpointError; the session can then not be used any more.
  void add_part(CheckpointReader& in, const PicturePart& part);
  /// After all parts were added: decides whether the picture is done; run() then ends at once.
  /// Returns: why it is done; nothing if next_targets() has more samples.
  /// Errors:  CheckpointError if the parts do not fit each other.
  std::optional<StopReason> judge_parts();
  /// The samples that each pixel gets in the next pass, after judge_parts().
  const std::vector<std::uint32_t>& next_targets() const { return progressive_.next_targets(); }
  /// Sets the samples that each pixel gets in the running pass of a part, before run().
  /// Errors:  CheckpointError if they do not fit the part.
  void raise_targets(const std::vector<std::uint32_t>& targets);

  const World& world() const { return world_; }
  const Film& film() const { return film_; }
  const Window& window() const { return window_; }
  /// The first surfaces of pixels, indexed like the film; null if not stored.
  const Mattes* mattes() const { return mattes_ ? &*mattes_ : nullptr; }
  const Integrator& integrator() const { return *integrator_; }
  const RenderBudget& budget() const { return budget_; }
  Progress progress() const { return progressive_.progress(); }
  /// Rays of those that were traced before the picture, for caches and to learn.
  std::uint64_t rays_before() const { return rays_of_maps_.rays(); }
  /// Memory of what paths learned before the picture.
  std::size_t learned_bytes() const { return integrator_->learned_bytes(); }
  RayCounts rays() const {
    RayCounts sum = rays_of_maps_;
    return sum += rays_;
  }
  bool keeps_irradiance() const { return irradiance_; }
  float unit_luminance() const { return unit_luminance_; }
  /// Whether some light may belong to no light layer: light from map files, from grids of
  /// interpolated reflections, or from shaders that return finished colours.
  bool has_unknown_light() const {
    return parts_have_unknown_light_ || integrator_->has_unknown_light() ||
           world_.light_layers.some_unknown;
  }

 private:
  using PartSamples = std::array<PartSample, kSilhouettePlaces>;
  /// Inputs:  record: empty; parts: memory for those of the sample.
  FilmSample sample(int x, int y, std::uint32_t index, PathRecord& record, PartSamples& parts,
                    RayCounts& counts) const;
  IntegratorPreparation preparation(const ProgressMonitor& monitor,
                                    std::function<void()> after_pass);
  /// Of the picture without a crop.
  double expected_paths() const;
  void prepare_maps(const Progressive::Callbacks& callbacks, const std::atomic<bool>* cancel,
                    WorkShare* share = nullptr);
  StopReason show_preview();
  void clear_film();
  template <class Checkpoint>
  void visit_pixels(Checkpoint& checkpoint, const std::vector<std::uint32_t>& pixels,
                    std::vector<std::uint32_t>& targets);
  /// Calls draw(sample, take_counts) with a function that draws one sample and counts its rays, and
  /// one that returns the counts of the calling thread and forgets them.
  template <class Draw>
  void with_sampler(const Draw& draw);
  StopReason draw(Progressive& passes, const Progressive::Callbacks& callbacks,
                  const std::atomic<bool>* cancel);

  const World& world_;
  std::uint32_t seed_;
  bool irradiance_;
  bool picture_if_cancelled_;
  float unit_luminance_;
  float clamp_;
  Window window_, maps_window_;
  PathObserver* observer_;
  FilterSampler filter_;
  RenderBudget budget_;
  float paths_of_pixel_;  ///< see PathSettings
  Film film_;
  std::optional<Mattes> mattes_;
  Progressive progressive_;
  MapFiles map_files_;
  Diagnostics unheard_;  ///< used if SessionSettings::diagnostics is null
  Diagnostics& diagnostics_;
  std::unique_ptr<Integrator> integrator_;
  bool saves_caches_;
  bool parts_have_unknown_light_ = false;
  Progressive::State merged_;  ///< of the parts so far
  Silhouettes silhouettes_;
  bool looks_for_silhouettes_ = false;  ///< before the first sample
  bool prepared_ = false;               ///< the integrator has its caches
  bool state_is_whole_ = false;         ///< see can_save()
  std::optional<std::chrono::steady_clock::time_point> started_;
  RayCounts rays_, rays_of_maps_;
  std::function<RayCounts()> rays_of_threads_;  ///< not yet in rays_; empty outside of draw()
};

}  // namespace oriel
