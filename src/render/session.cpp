// SPDX-License-Identifier: Apache-2.0
#include "render/session.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <chrono>
#include <mutex>

#include "sampling/sampler.h"
#include "transport/path.h"

namespace oriel {
namespace {

/// How often the work before the picture tells how far it is, and shows what it knows.
constexpr double kSecondsBetweenReports = 0.2, kSecondsBetweenPreviews = 10;

Window window_of(const World& world, const SessionSettings& settings) {
  const Camera& camera = world.camera;
  const Window whole{0, 0, camera.width, camera.height};
  Window w{camera.window[0], camera.window[1], camera.window[2], camera.window[3]};
  if (settings.crop) w = *settings.crop;
  w.x0 = std::clamp(w.x0, 0, whole.x1), w.x1 = std::clamp(w.x1, 0, whole.x1);
  w.y0 = std::clamp(w.y0, 0, whole.y1), w.y1 = std::clamp(w.y1, 0, whole.y1);
  return w.width() > 0 && w.height() > 0 ? w : whole;
}

DisplayMap display_map(const World& world, const Window& window) {
  if (world.lens.empty()) return {};
  return [&world, window](int x, int y, const Rgb& color) {
    return map_color(world.lens, world, window.pixel_centre(x, y), color);
  };
}

}  // namespace

Rgb map_color(const NodeList& shaders, const World& world, Vec2 raster, const Rgb& color) {
  ShadingPoint point;
  point.raster = raster;
  point.world = &world;
  const Camera::Ray ray = world.camera.ray(raster);
  point.ray_origin = ray.origin;
  point.ray_direction = ray.direction;
  const LensCall lens{ray.cos_to_film, world.camera.orthographic};
  Rgb mapped = color;
  for (const ShaderNode* node : shaders)
    mapped = node->with_params(
        point, [&](const Call& call) { return node->spec().lens(call, lens, mapped); });
  return mapped;
}

RenderSession::RenderSession(const World& world, const SessionSettings& settings)
    : world_(world),
      seed_(settings.seed),
      window_(window_of(world, settings)),
      filter_(world.options.filter),
      budget_(render_budget(world.options, settings.budget)),
      film_(window_.width(), window_.height(), filter_, display_map(world, window_),
            settings.outputs),
      progressive_(film_, budget_),
      map_files_(settings.map_files),
      diagnostics_(settings.diagnostics),
      passes_(world) {}

FilmSample RenderSession::sample(int x, int y, std::uint32_t index, RayCounts& counts,
                                 Outputs* outputs) const {
  const int column = window_.x0 + x, row = window_.y1 - 1 - y;
  sampling::Sampler sampler(column, row, index, seed_);
  const FilterSampler::Offset offset = filter_.sample(sampler.next_2d());
  const Vec2 raster(static_cast<float>(column) + 0.5f + offset.pixels.x,
                    static_cast<float>(row) + 0.5f + offset.pixels.y);

  PathSettings settings = passes_.path_settings();
  settings.paths_of_pixel = static_cast<float>(budget_.max_samples);
  settings.grid = grid_ && !grid_->empty() ? &*grid_ : nullptr;
  settings.outputs = outputs;
  const PathResult path =
      trace_path(world_, world_.camera.ray(raster), raster, settings, sampler, counts);
  FilmSample s;
  s.beauty = path.radiance;
  s.alpha = path.alpha;
  s.depth = path.depth;
  s.normal = path.normal;
  s.albedo = path.albedo;
  s.outputs = outputs;
  s.negative = offset.negative;
  s.sub_pixel = static_cast<std::uint8_t>((offset.pixels.x >= 0) + 2 * (offset.pixels.y >= 0));
  return s;
}

StopReason RenderSession::draw(Progressive& passes, const Progressive::Callbacks& callbacks,
                               const std::atomic<bool>* cancel) {
  struct PerThread {
    RayCounts counts;
    Outputs outputs;  // of the sample under way, until the film has it
  };
  tbb::enumerable_thread_specific<PerThread> threads;
  const auto draw_one = [&](int x, int y, std::uint32_t index, FilmSample& s) {
    PerThread& mine = threads.local();
    if (film_.keeps_outputs()) mine.outputs = {};
    s = sample(x, y, index, mine.counts, film_.keeps_outputs() ? &mine.outputs : nullptr);
  };
  const StopReason reason = passes.run(draw_one, callbacks, cancel);
  for (const PerThread& thread : threads) rays_ += thread.counts;
  return reason;
}

void RenderSession::prepare_maps(const Progressive::Callbacks& callbacks,
                                 const std::atomic<bool>* cancel) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(Clock::now() - start).count();
  };
  Watch watch{cancel, {}};
  double told = 0, shown = 0;
  std::mutex mutex;
  if (callbacks.progress)
    watch.progress = [&](const char* name, double share) {
      const std::lock_guard lock(mutex);
      if (seconds() - told < kSecondsBetweenReports) return;
      told = seconds();
      Progress p;
      p.stage = name;
      p.elapsed = told;
      p.remaining = share > 0 ? std::optional(told * (1 - share) / share) : std::nullopt;
      callbacks.progress(p);
    };
  const auto after_pass = [&] {
    if (!callbacks.pass || seconds() - shown < kSecondsBetweenPreviews || watch.cancelled()) return;
    Progressive once(film_, {.max_samples = 1});
    draw(once, {{}, callbacks.pass}, cancel);
    film_.clear();
    shown = seconds();
  };
  passes_.run(world_, window_, seed_, rays_, map_files_, diagnostics_, watch, after_pass);
}

StopReason RenderSession::run(const Progressive::Callbacks& callbacks,
                              const std::atomic<bool>* cancel) {
  const IndirectPlan& plan = passes_.plan();
  if (!grid_) {
    prepare_maps(callbacks, cancel);
    const scene::RenderOptions& o = world_.options;
    if ((plan.gather && o.finalgather.only) ||
        ((plan.global || plan.caustic) && o.photonmap_only))
      return StopReason::MapsOnly;
    grid_.emplace(world_, passes_.path_settings(), seed_, rays_);
    if (cancel && *cancel && plan.maps()) {
      Progressive once(film_, {.max_samples = 1});
      draw(once, {}, nullptr);
      return StopReason::Cancelled;
    }
  }
  return draw(progressive_, callbacks, cancel);
}

}  // namespace oriel
