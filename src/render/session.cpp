// SPDX-License-Identifier: Apache-2.0
#include "render/session.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

#include "base/byte_stream.h"
#include "base/checkpoint_file.h"
#include "color/luminance.h"
#include "render/eye_rays.h"
#include "render/indirect_plan.h"
#include "render/path_integrator.h"
#include "render/pixel_state.h"
#include "render/state_shaders.h"
#include "runtime/color_mapping.h"
#include "sampling/sampler.h"

namespace oriel {
namespace {

/// Intervals of progress reports and of preview pictures before the first pass.
constexpr double kSecondsBetweenPassReports = 0.2, kSecondsBetweenPreviews = 10;

/// Samples per pixel that are expected if a noise target or the time ends the render, and the
/// largest maximum that is taken for what the pixels will get.
constexpr std::uint32_t kUsualSamples = 64, kMostExpected = 1024;

/// The requested window, clipped to the picture; else that of the camera.
Window window_of(const World& world, const std::optional<Window>& asked) {
  const Camera& camera = world.camera;
  const Window whole{0, 0, camera.width, camera.height};
  Window w{camera.window[0], camera.window[1], camera.window[2], camera.window[3]};
  if (asked) w = *asked;
  w.x0 = std::clamp(w.x0, 0, whole.x1), w.x1 = std::clamp(w.x1, 0, whole.x1);
  w.y0 = std::clamp(w.y0, 0, whole.y1), w.y1 = std::clamp(w.y1, 0, whole.y1);
  return w.width() > 0 && w.height() > 0 ? w : whole;
}

/// Pictures of fewer pixels are previews, whose pixels get equal samples: parts need no rounds.
constexpr int kLeastDistributedPixels = 128 * 128;

RenderBudget budget_of(const World& world, const SessionSettings& settings) {
  RenderBudget budget = render_budget(world.options, settings.budget);
  const Window picture = window_of(world, std::nullopt);
  if (std::int64_t{picture.width()} * picture.height() < kLeastDistributedPixels)
    budget.distribution = Distribution::Even;
  return budget;
}

DisplayMap display_map(const World& world, const Window& window) {
  if (world.lens.empty()) return {};
  return [&world, window](int x, int y, const Rgb& color) {
    return map_color(world.lens, world, window.pixel_centre(x, y), color);
  };
}

std::unique_ptr<Integrator> integrator_of(const World& world, const SessionSettings& settings) {
  if (!settings.draft) return make_integrator(world);
  return std::make_unique<PathIntegrator>(
      world, PathSettings{.indirect = plan_indirect(world.options).indirect});
}

FilmRequest film_request(const World& world, const SessionSettings& settings) {
  FilmRequest request{.aovs = settings.outputs, .surface_values = settings.surface_values};
  if (settings.lights && world.light_layers.asked())
    request.light_layers = world.light_layers.count();
  for (const UserBuffer& buffer : world.user_buffers)
    request.user_buffers.push_back(buffer.interpolate ? PlaneRule::Mean : PlaneRule::FirstSample);
  return request;
}

}  // namespace

std::uint64_t film_bytes(const World& world, const SessionSettings& settings) {
  const Window window = window_of(world, settings.crop);
  const Film pixel(1, 1, FilterSampler(world.options.filter), display_map(world, window),
                   film_request(world, settings));
  return std::uint64_t{pixel.bytes()} * static_cast<std::uint64_t>(window.width()) *
         static_cast<std::uint64_t>(window.height());
}

RenderSession::RenderSession(const World& world, const SessionSettings& settings)
    : world_(world),
      seed_(settings.seed),
      irradiance_(settings.irradiance),
      picture_if_cancelled_(settings.picture_if_cancelled),
      unit_luminance_(settings.unit_luminance),
      clamp_(settings.clamp),
      window_(window_of(world, settings.crop)),
      maps_window_(settings.maps_for ? window_of(world, settings.maps_for) : window_),
      observer_(settings.observer),
      filter_(world.options.filter),
      budget_(budget_of(world, settings)),
      paths_of_pixel_(settings.draft ? PathSettings{}.paths_of_pixel
                                     : static_cast<float>(budget_.max_samples)),
      film_(window_.width(), window_.height(), filter_, display_map(world, window_),
            film_request(world, settings)),
      progressive_(film_, budget_, settings.part),
      map_files_(settings.map_files),
      diagnostics_(settings.diagnostics ? *settings.diagnostics : unheard_),
      integrator_(integrator_of(world, settings)),
      saves_caches_(!settings.save_without_caches),
      started_(settings.started) {
  if (settings.mattes) mattes_.emplace(film_.width(), film_.height(), filter_, *settings.mattes);
  // Lens shaders have their own rays, shaders may change samples, and filters have negative parts.
  constexpr std::uint32_t kFewestSamples = 4;
  looks_for_silhouettes_ = !settings.draft && budget_.max_samples >= kFewestSamples &&
                           world.lens_rays.empty() && world.state_shaders.empty() &&
                           !filter_.has_negative_lobes();
}

void RenderSession::clear_film() {
  film_.clear();
  if (mattes_) mattes_->clear();
}

FilmSample RenderSession::sample(int x, int y, std::uint32_t index, PathRecord& record,
                                 PartSamples& parts, RayCounts& counts) const {
  const int column = window_.x0 + x, row = window_.y1 - 1 - y;
  sampling::Sampler sampler(column, row, index, seed_);
  const Vec2 centre(static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f);
  const sampling::Sampler at_start = sampler;
  const FilterSampler::Offset offset = filter_.sample(sampler.next_2d());
  const Vec2 raster = centre + offset.pixels;

  using Moment = EyeSample::Moment;
  const auto call = [&](Moment at, PathResult& result) {
    call_state_shaders(world_, raster, at, result, record.user_buffers);
  };
  PathResult before;
  call(Moment::StateInit, before);
  call(Moment::SampleInit, before);
  if (observer_) observer_->begin_sample(offset.negative);
  SilhouetteSample silhouette;
  const bool has_places = silhouettes_.contain(x, y);
  if (has_places) {
    constexpr std::uint32_t kPlaceBranch = 5003;
    for (std::uint32_t i = 0; i < kSilhouettePlaces; ++i) {
      const Vec2 u = at_start.split(i, kSilhouettePlaces, kPlaceBranch).next_2d();
      silhouette.places[i] = centre + filter_.sample(u).pixels;
    }
    trace_at_silhouette(world_, *integrator_, silhouette, paths_of_pixel_, record, sampler, counts);
  } else {
    trace_eye_rays(world_, *integrator_, raster, paths_of_pixel_, record, sampler, counts);
  }
  const float brightest = max_component(record.radiance);
  const float kept = clamp_ > 0 && brightest > clamp_ ? clamp_ / brightest : 1;
  if (kept < 1) record.scale(kept);
  if (observer_) observer_->end_sample(record.radiance);
  call(Moment::SampleExit, record);
  call(Moment::StateExit, record);
  FilmSample s;
  s.beauty = record.radiance;
  s.alpha = record.alpha;
  s.depth = record.depth;
  s.normal = record.normal;
  s.albedo = record.albedo;
  s.irradiance = luminance(record.irradiance);
  s.record = &record;
  s.negative = offset.negative;
  const Vec2 reach = filter_.half_width() * 2.0f;
  const auto part_of = [&](const Vec2& from_centre) {
    return sub_pixel_of(from_centre / reach + Vec2(0.5f));
  };
  s.sub_pixel = part_of(offset.pixels);
  if (!has_places) return s;
  for (std::size_t i = 0; i < kSilhouettePlaces; ++i)
    parts[i] = {part_of(silhouette.places[i] - centre),
                kept * (i < silhouette.met ? silhouette.of_met : silhouette.of_rest)};
  s.parts = parts;
  return s;
}

template <class Draw>
void RenderSession::with_sampler(const Draw& draw) {
  if (std::exchange(looks_for_silhouettes_, false)) silhouettes_ = Silhouettes(world_, window_);
  const RecordRequest request{.aovs = film_.keeps_outputs(),
                              .irradiance = irradiance_,
                              .first_surfaces = mattes_.has_value(),
                              .surface_values = film_.surface_values(),
                              .light_layers = film_.light_layers()};
  struct PerThread {
    PerThread(const RecordRequest& request, std::size_t user_buffers, PathObserver* observer)
        : buffers(user_buffers, Rgba(0)), record(request, buffers, observer) {}
    RayCounts counts;
    std::vector<Rgba> buffers;
    PathRecord record;  // of the current sample
    PartSamples parts;
  };
  tbb::enumerable_thread_specific<PerThread> threads(request, film_.user_buffers(), observer_);
  const auto draw_one = [&](int x, int y, std::uint32_t index, FilmSample& s) {
    PerThread& mine = threads.local();
    mine.record.reset();
    std::fill(mine.buffers.begin(), mine.buffers.end(), Rgba(0));
    s = sample(x, y, index, mine.record, mine.parts, mine.counts);
    if (mattes_) mattes_->add(x, y, mine.record.first_surfaces, s.negative);
  };
  rays_of_threads_ = [&threads] {
    RayCounts sum;
    for (const PerThread& thread : threads) sum += thread.counts;
    return sum;
  };
  draw(draw_one, [&threads] { return std::exchange(threads.local().counts, {}); });
  rays_ += std::exchange(rays_of_threads_, nullptr)();
}

StopReason RenderSession::draw(Progressive& passes, const Progressive::Callbacks& callbacks,
                               const std::atomic<bool>* cancel) {
  StopReason reason{};
  with_sampler(
      [&](const auto& draw_one, const auto&) { reason = passes.run(draw_one, callbacks, cancel); });
  return reason;
}

void RenderSession::prepare_maps(const Progressive::Callbacks& callbacks,
                                 const std::atomic<bool>* cancel, WorkShare* share) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point start = Clock::now();
  const auto seconds = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  ProgressMonitor monitor{cancel, {}};
  double told = 0, shown = 0;
  const char* stage = nullptr;
  std::mutex mutex;
  if (callbacks.progress)
    monitor.progress = [&](const char* name, double share) {
      const std::lock_guard lock(mutex);
      if (name == stage && seconds() - told < kSecondsBetweenPassReports) return;
      stage = name;
      told = seconds();
      Progress p;
      p.stage = name;
      p.elapsed = told;
      p.done = share;
      p.remaining = share > 0 ? std::optional(told * (1 - share) / share) : std::nullopt;
      callbacks.progress(p);
    };
  const auto after_pass = [&] {
    if (!callbacks.pass || seconds() - shown < kSecondsBetweenPreviews || monitor.cancelled())
      return;
    Progressive once(film_, {.max_samples = 1});
    draw(once, {{}, callbacks.pass}, cancel);
    clear_film();
    shown = seconds();
  };
  IntegratorPreparation p = preparation(monitor, after_pass);
  p.share = share;
  integrator_->prepare(p);
}

IntegratorPreparation RenderSession::preparation(const ProgressMonitor& monitor,
                                                 std::function<void()> after_pass) {
  return {.window = maps_window_,
          .picture = window_of(world_, std::nullopt),
          .paths = expected_paths(),
          .noise = budget_.every_pixel ? 0 : budget_.noise,
          .seed = seed_,
          .files = map_files_,
          .diagnostics = diagnostics_,
          .monitor = monitor,
          .after_pass = std::move(after_pass),
          .counts = rays_of_maps_};
}

double RenderSession::expected_paths() const {
  const Window picture = window_of(world_, std::nullopt);
  const double pixels = double(picture.width()) * double(picture.height());
  // The time limit does not count: a render that continues may have another one.
  const bool fixed = !(budget_.noise > 0) && budget_.max_samples <= kMostExpected;
  return pixels * (fixed ? budget_.max_samples : std::min(budget_.max_samples, kUsualSamples));
}

RenderSession::Preparation RenderSession::take_preparation() {
  return {std::move(integrator_), maps_window_, window_of(world_, std::nullopt),
          expected_paths(),       seed_,        rays_of_maps_};
}

bool RenderSession::reuse(Preparation p) {
  if (!p.integrator || p.integrator->caches_only() || p.seed != seed_ ||
      p.paths != expected_paths() || p.picture != window_of(world_, std::nullopt) ||
      (p.integrator->has_caches() && p.window != maps_window_))
    return false;
  integrator_ = std::move(p.integrator);
  rays_of_maps_ = p.rays;
  prepared_ = state_is_whole_ = true;
  return true;
}

StopReason RenderSession::show_preview() {
  clear_film();
  Progressive once(film_, {.max_samples = 1});
  return once.run([&](int x, int y, std::uint32_t, FilmSample& s) {
    const Vec2 at = window_.pixel_centre(x, y);
    const Rgba c = world_.preview->texel(Vec2(at.x / static_cast<float>(world_.camera.width),
                                              at.y / static_cast<float>(world_.camera.height)));
    s.beauty = rgb(c);
    s.alpha = c.a;
  });
}

StopReason RenderSession::run(const Progressive::Callbacks& callbacks,
                              const std::atomic<bool>* cancel) {
  if (world_.preview) return show_preview();
  if (!prepared_) {
    prepare_maps(callbacks, cancel);
    if (integrator_->caches_only()) return StopReason::MapsOnly;
    // A part has no picture to show, and its pixels can be saved without caches.
    if (!saves_caches_ && cancel && *cancel) return StopReason::Cancelled;
    prepared_ = true;
    // What paths learned is part of the state.
    const bool is_partial = integrator_->has_caches() || !integrator_->is_prepared();
    state_is_whole_ = !(cancel && *cancel && is_partial);
    if (!state_is_whole_ && !picture_if_cancelled_) return StopReason::Cancelled;
    if (!state_is_whole_) {
      Progressive once(film_, {.max_samples = 1});
      draw(once, {}, nullptr);
      return StopReason::Cancelled;
    }
    if (started_) progressive_.begin_at(*started_);
  }
  return draw(progressive_, callbacks, cancel);
}

/// Writes or reads the state of some pixels.
template <class Checkpoint>
void RenderSession::visit_pixels(Checkpoint& checkpoint, const std::vector<std::uint32_t>& pixels,
                                 std::vector<std::uint32_t>& targets) {
  PixelState<Checkpoint> state(checkpoint, pixels, film_.pixel_count());
  film_.visit_state(state);
  state.array(targets);
  if (!mattes_) return;
  if constexpr (Checkpoint::kReads)
    mattes_->restore(checkpoint, world_.materials, world_.instances.size(), pixels);
  else
    mattes_->save(checkpoint, world_.materials, pixels);
}

void RenderSession::save(CheckpointWriter& out) {
  out.value(static_cast<std::uint8_t>(saves_caches_));
  out.value(static_cast<std::uint8_t>(has_unknown_light()));
  if (saves_caches_) integrator_->save(out);
  std::vector<std::uint32_t> targets = progressive_.state().targets;
  visit_pixels(out, progressive_.pixels(), targets);
  out.value(progressive_.state().pass);
  out.value(progressive_.progress().elapsed);
  RayCounts rays = rays_;
  if (rays_of_threads_) rays += rays_of_threads_();
  visit_counts(out, rays_of_maps_);
  visit_counts(out, rays);
}

void RenderSession::restore(CheckpointReader& in) {
  std::uint8_t has_caches = 0, unknown_light = 0;
  in.value(has_caches);
  in.value(unknown_light);
  const ProgressMonitor monitor;
  if (has_caches != static_cast<std::uint8_t>(saves_caches_))
    throw CheckpointError("it belongs to another kind of render");
  if (saves_caches_) integrator_->restore(in, preparation(monitor, {}));
  Progressive::State state{.pass = 0, .targets = progressive_.state().targets};
  visit_pixels(in, progressive_.pixels(), state.targets);
  in.value(state.pass);
  in.value(state.elapsed);
  RayCounts of_maps;
  visit_counts(in, of_maps);
  visit_counts(in, rays_);
  in.end();
  if (!progressive_.restore(std::move(state))) throw CheckpointError("its pixels are invalid");
  if (saves_caches_) rays_of_maps_ = of_maps;
  if (saves_caches_ && started_) progressive_.begin_at(*started_);
  prepared_ |= saves_caches_;
  state_is_whole_ = true;
}

bool RenderSession::prepare(const Progressive::Callbacks& callbacks,
                            const std::atomic<bool>* cancel, WorkShare* share) {
  prepare_maps({callbacks.progress, {}, {}, {}}, cancel, share);
  prepared_ = state_is_whole_ = !(cancel && *cancel);
  if (prepared_ && started_) progressive_.begin_at(*started_);
  return prepared_;
}

void RenderSession::help_prepare(WorkShare& share, const std::atomic<bool>* cancel) {
  const ProgressMonitor monitor{cancel, {}};
  IntegratorPreparation p = preparation(monitor, [] {});
  p.share = &share;
  integrator_->help(p);
}

void RenderSession::save_maps(CheckpointWriter& out) {
  integrator_->save(out);
  visit_counts(out, rays_of_maps_);
}

void RenderSession::read_maps(CheckpointReader& in) {
  const ProgressMonitor monitor;
  integrator_->restore(in, preparation(monitor, {}));
  visit_counts(in, rays_of_maps_);
  in.end();
  prepared_ = state_is_whole_ = true;
  if (started_) progressive_.begin_at(*started_);
}

void RenderSession::pack_tiles(ByteWriter& out, const std::vector<int>& tiles) {
  const std::vector<std::uint32_t> pixels = TileGrid(film_.width(), film_.height()).pixels(tiles);
  out.reserve(pixels.size() * (film_.bytes() / film_.pixel_count() + sizeof(std::uint32_t)));
  visit_pixels(out, pixels, progressive_.targets());
}

void RenderSession::unpack_tiles(ByteReader& in, const std::vector<int>& tiles) {
  visit_pixels(in, TileGrid(film_.width(), film_.height()).pixels(tiles), progressive_.targets());
}

void RenderSession::pack_targets(ByteWriter& out, const std::vector<int>& tiles) {
  PixelState<ByteWriter>(out, TileGrid(film_.width(), film_.height()).pixels(tiles),
                         film_.pixel_count())
      .array(progressive_.targets());
}

void RenderSession::unpack_targets(ByteReader& in, const std::vector<int>& tiles) {
  PixelState<ByteReader>(in, TileGrid(film_.width(), film_.height()).pixels(tiles),
                         film_.pixel_count())
      .array(progressive_.targets());
}

void RenderSession::draw_tiles(const std::function<std::optional<int>()>& next,
                               const std::function<void(int, const RayCounts&)>& drawn,
                               const std::atomic<bool>* cancel) {
  with_sampler([&](const auto& draw_one, const auto& take_counts) {
    progressive_.draw_tiles(
        draw_one, next, [&](int tile) { drawn(tile, take_counts()); }, cancel);
  });
}

void RenderSession::add_tiles(ByteReader& in, const std::vector<int>& tiles,
                              const RayCounts& rays) {
  const std::vector<std::uint32_t> pixels = TileGrid(film_.width(), film_.height()).pixels(tiles);
  const auto samples = [&] {
    std::uint64_t sum = 0;
    for (const std::uint32_t i : pixels) sum += film_.samples(i);
    return sum;
  };
  const std::uint64_t before = samples();
  unpack_tiles(in, tiles);
  progressive_.count_drawn(samples() - before);
  rays_ += rays;
}

void RenderSession::add_part(CheckpointReader& in, const PicturePart& part) {
  std::uint8_t has_caches = 0, unknown_light = 0;
  in.value(has_caches);
  in.value(unknown_light);
  if (has_caches != 0) throw CheckpointError("it is not a part of a picture");
  merged_.targets.resize(film_.pixel_count());
  const TileGrid grid(film_.width(), film_.height());
  visit_pixels(in, grid.pixels(grid.part(part)), merged_.targets);
  std::int32_t pass = 0;
  double seconds = 0;
  RayCounts rays;
  in.value(pass);
  in.value(seconds);
  visit_counts(in, rays_of_maps_);
  visit_counts(in, rays);
  in.end();
  rays_ += rays;
  parts_have_unknown_light_ |= unknown_light != 0;
  merged_.pass = std::max(merged_.pass, pass);
  merged_.elapsed = std::max(merged_.elapsed, seconds);
}

std::optional<StopReason> RenderSession::judge_parts() {
  merged_.targets.resize(film_.pixel_count());
  for (std::size_t i = 0; i < merged_.targets.size(); ++i)
    if (film_.samples(i) != merged_.targets[i]) throw CheckpointError("the parts are not finished");
  if (!progressive_.restore(std::move(merged_)))
    throw CheckpointError("the pixels of the parts are invalid");
  prepared_ = state_is_whole_ = true;
  return progressive_.judge();
}

void RenderSession::raise_targets(const std::vector<std::uint32_t>& targets) {
  if (!progressive_.raise_targets(targets))
    throw CheckpointError("its numbers of samples are invalid");
}

}  // namespace oriel
