// SPDX-License-Identifier: Apache-2.0
// One picture being rendered: camera samples through transport and lens shaders into the film.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <optional>

#include "render/budget.h"
#include "render/film.h"
#include "render/integrator.h"
#include "render/mattes.h"
#include "render/progressive.h"
#include "runtime/window.h"
#include "runtime/world.h"
#include "transport/counts.h"
#include "transport/path/path_observer.h"

namespace oriel {

struct SessionSettings {
  BudgetRequest budget;
  std::uint32_t seed = 0;
  bool outputs = false;                 ///< keep the outputs of materials
  bool irradiance = false;              ///< and that of the first surfaces: a second path for each
  SurfaceValues surface_values = {};    ///< stored of the first surfaces
  bool lights = true;                   ///< keep the layers of lights that the world has
  float clamp = 0;                      ///< maximum of a sample's channels, pixel units; 0 = none
  float unit_luminance = 1;             ///< cd/m2 of one unit of a pixel, see unit_luminance.h
  std::optional<Window> crop = {};      ///< cut to the picture; replaces the camera's window
  std::optional<Window> maps_for = {};  ///< what gather points are placed for; unset: the window
  /// Optional observer of the paths of the picture; may be null. Called for one pixel after the
  /// other from any thread, so the window should be one pixel. Outlives the session.
  PathObserver* observer = nullptr;
  std::optional<MatteNames> mattes = {};  ///< keep what each pixel sees first
  MapFiles map_files = {};
  Diagnostics* diagnostics = nullptr;  ///< of map files; outlives the session; may be null
};

/// Renders one world.
///
/// Model:   sample i of a pixel is keyed by the pixel's place in the whole picture, the seed and i:
///          a crop shows the same pixels as the whole picture does.
/// Checked: tests/cli (threads, crop); the pieces by their own tests.
class RenderSession {
 public:
  /// `world` must outlive the session and stay as it is.
  RenderSession(const World& world, const SessionSettings& settings);

  /// Makes maps as the options ask, then renders until the budget is used up or `cancel` becomes
  /// true. Called again it goes on. While gather points are placed a picture of one sample with
  /// what is known so far is shown from time to time (callbacks.pass); cancelled before the
  /// picture began, it leaves such a one. No picture where the options ask for maps only. Where an
  /// exposure has a preview, that is the picture and nothing is rendered.
  StopReason run(const Progressive::Callbacks& callbacks = {},
                 const std::atomic<bool>* cancel = nullptr);

  const World& world() const { return world_; }
  const Film& film() const { return film_; }
  const Window& window() const { return window_; }
  /// What pixels see first, as the film counts pixels; null where it is not kept.
  const Mattes* mattes() const { return mattes_ ? &*mattes_ : nullptr; }
  const Integrator& integrator() const { return *integrator_; }
  const RenderBudget& budget() const { return budget_; }
  Progress progress() const { return progressive_.progress(); }
  const RayCounts& rays() const { return rays_; }
  bool keeps_irradiance() const { return irradiance_; }
  float unit_luminance() const { return unit_luminance_; }
  /// Whether some light of the picture may not know its layer: it comes from maps in files, from
  /// grids of interpolated reflections or from shaders that bring finished colours.
  bool has_unknown_light() const {
    return integrator_->has_unknown_light() || world_.light_layers.some_unknown;
  }

 private:
  FilmSample sample(int x, int y, std::uint32_t index, PathRecord& record, RayCounts& counts) const;
  void prepare_maps(const Progressive::Callbacks& callbacks, const std::atomic<bool>* cancel);
  StopReason show_preview();
  void clear_film();
  StopReason draw(Progressive& passes, const Progressive::Callbacks& callbacks,
                  const std::atomic<bool>* cancel);

  const World& world_;
  std::uint32_t seed_;
  bool irradiance_;
  float unit_luminance_;
  float clamp_;
  Window window_, maps_window_;
  PathObserver* observer_;
  FilterSampler filter_;
  RenderBudget budget_;
  Film film_;
  std::optional<Mattes> mattes_;
  Progressive progressive_;
  MapFiles map_files_;
  Diagnostics unheard_;  ///< where nobody listens
  Diagnostics& diagnostics_;
  std::unique_ptr<Integrator> integrator_;
  bool prepared_ = false;  ///< the integrator has its caches
  RayCounts rays_;
};

}  // namespace oriel
