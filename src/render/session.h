// SPDX-License-Identifier: Apache-2.0
// One picture being rendered: camera samples through transport and lens shaders into the film.
#pragma once

#include <array>
#include <atomic>
#include <optional>

#include "render/budget.h"
#include "render/film.h"
#include "render/indirect_passes.h"
#include "render/progressive.h"
#include "render/window.h"
#include "runtime/world.h"
#include "transport/counts.h"
#include "transport/glossy_grid.h"

namespace oriel {

struct SessionSettings {
  BudgetRequest budget;
  std::uint32_t seed = 0;
  bool outputs = false;             ///< keep the outputs of materials
  std::optional<Window> crop = {};  ///< cut to the picture; replaces the camera's window
};

/// Whether diffuse surfaces light each other: the options ask for final gathering or global
/// illumination photons, or name a method.
bool asks_for_indirect(const scene::RenderOptions& options);

/// Sends a colour through shaders that map colours (exposures), as lens or output shaders.
///
/// Inputs:  raster: as Camera::ray takes it.
Rgb map_color(const NodeList& shaders, const World& world, Vec2 raster, const Rgb& color);

/// Renders one world.
///
/// Model:   sample i of a pixel is keyed by the pixel's place in the whole picture, the seed and i:
///          a crop shows the same pixels as the whole picture does.
/// Checked: tests/cli (threads, crop); the pieces by their own tests.
class RenderSession {
 public:
  /// `world` must outlive the session and stay as it is.
  RenderSession(const World& world, const SessionSettings& settings);

  /// Renders until the budget is used up or `cancel` becomes true. Called again it goes on.
  StopReason run(const Progressive::Callbacks& callbacks = {},
                 const std::atomic<bool>* cancel = nullptr);

  const World& world() const { return world_; }
  const Film& film() const { return film_; }
  const Window& window() const { return window_; }
  const RenderBudget& budget() const { return budget_; }
  Progress progress() const { return progressive_.progress(); }
  const RayCounts& rays() const { return rays_; }

 private:
  FilmSample sample(int x, int y, std::uint32_t index, RayCounts& counts, Outputs* outputs) const;

  const World& world_;
  std::uint32_t seed_;
  Window window_;
  FilterSampler filter_;
  RenderBudget budget_;
  Film film_;
  Progressive progressive_;
  std::optional<IndirectPasses> passes_;  ///< done when rendering begins, as the grid
  std::optional<GlossyGrid> grid_;
  RayCounts rays_;
  bool indirect_;
};

}  // namespace oriel
