// SPDX-License-Identifier: Apache-2.0
#include "interactive/render_loop.h"

#include <algorithm>
#include <utility>

#include "interactive/map_files.h"
#include "interactive/tile_order.h"
#include "output/camera_output.h"

namespace oriel::interactive {
namespace {

/// A reduced picture after a change should take at most this time: with the preparation it then
/// follows the pointer.
constexpr double kFirstPictureSeconds = 0.06;
constexpr int kLargestDivider = 32;
constexpr int kDragDivider = 4;  ///< of the finest picture while a pointer drags

/// Seconds between copies of the film, by seconds since the change: more often costs time without
/// showing more.
double copy_interval(double since) {
  if (since < 1) return 0.1;
  if (since < 2) return 0.25;
  if (since < 4) return 0.5;
  return since < 8 ? 1 : 2;
}

/// Seconds after a change until which a draft of full size gets samples. Learning takes seconds and
/// starts the picture again, so that it pays later than this; see bench/README.md.
constexpr double kDraftSeconds = 5;

/// Copies take at most this share of the time.
constexpr double kCopyShare = 0.1;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The denoised layer is made from the others when the film is copied.
std::vector<std::string> stored_layers(const ViewSettings& view) {
  std::vector<std::string> layers = view.layers;
  std::erase(layers, kDenoisedLayer);
  return layers;
}

/// Effects of a change of the view.
EditEffects effects_between(const ViewSettings& a, const ViewSettings& b) {
  EditEffects effects;
  if (a.region != b.region || stored_layers(a) != stored_layers(b) ||
      a.budget.samples != b.budget.samples || a.budget.noise != b.budget.noise ||
      a.budget.seconds != b.budget.seconds)
    effects.bits |= kEffectFilm;
  if (a.look != b.look || a.size != b.size || a.scale != b.scale) effects.bits |= kEffectCamera;
  if (a.camera != b.camera || a.light_groups != b.light_groups || a.group_lights != b.group_lights)
    effects.bits |= kEffectWorld;
  return effects;
}

}  // namespace

RenderLoop::RenderLoop(SceneSource source, const LoopSettings& settings, Show show, Notify changed)
    : scene_(std::move(source), diagnostics_),
      settings_(settings),
      show_(std::move(show)),
      changed_(std::move(changed)) {}

bool RenderLoop::read() {
  set_state(LoopState::Loading);
  session_.reset();
  prepared_ = false;
  if (!scene_.read()) {
    set_state(LoopState::Failed);
    return false;
  }
  change({kEffectWorld, {}});
  return true;
}

void RenderLoop::change(const EditEffects& effects) {
  if (effects.bits == kEffectNone) return;
  if (pending_.bits == kEffectNone) changed_at_ = Clock::now();
  pending_ |= effects;
  if ((effects.bits & ~unsigned{kEffectFilm}) != 0)
    preparation_ = {};
  else if (session_ && session_->can_save())
    preparation_ = session_->take_preparation();
  session_.reset();
  finished_ = false;
}

void RenderLoop::set_edits(const std::vector<std::string>& edits) {
  if (prepared_ && edits == scene_.edited().edits()) return;
  session_.reset();  // its world refers to elements that change
  preparation_ = {};
  finished_ = false;
  EditEffects effects = scene_.edited().set(edits);
  if (effects.bits == kEffectNone) effects.bits = kEffectFilm;
  change(effects);
}

void RenderLoop::set_view(const ViewSettings& view) {
  const EditEffects effects = effects_between(view_, view);
  // A finished picture is copied again.
  if ((view_.dragging && !view.dragging) || view_.layers != view.layers) finished_ = false;
  view_ = view;
  view_.scale = std::clamp(view_.scale, 1, 8);
  change(effects);
}

std::array<int, 2> RenderLoop::full_size() const {
  if (view_.size) return *view_.size;
  const scene::Camera* camera = find_camera(scene_.scene(), scene_.command(), view_.camera);
  const Camera defaults;
  return camera ? camera->resolution.value_or(std::array{defaults.width, defaults.height})
                : std::array{defaults.width, defaults.height};
}

std::array<int, 2> RenderLoop::scaled_size() const {
  const auto [width, height] = full_size();
  return reduced_size(width, height, view_.scale);
}

std::array<int, 2> RenderLoop::requested_size() const {
  if (!view_.size && view_.scale == 1) return {0, 0};
  return scaled_size();
}

std::array<int, 2> RenderLoop::scaled_pixel(int x, int y) const {
  const auto [width, height] = scaled_size();
  return {std::clamp(x / view_.scale, 0, width - 1), std::clamp(y / view_.scale, 0, height - 1)};
}

LoopStatus RenderLoop::status() const {
  const std::scoped_lock lock(mutex_);
  return status_;
}

void RenderLoop::set_pointer(const std::optional<std::array<int, 2>>& pixel) {
  const std::scoped_lock lock(mutex_);
  pointer_ = pixel;
}

void RenderLoop::render_tiles(const std::vector<int>& tiles,
                              const std::function<void(int)>& render_tile) {
  std::optional<std::array<int, 2>> pointer;
  {
    const std::scoped_lock lock(mutex_);
    pointer = pointer_;
  }
  if (!pointer) return for_each_tile(tiles, render_tile);
  const auto [x, y] = scaled_pixel((*pointer)[0], (*pointer)[1]);
  const Window& window = session_->window();
  const Vec2 pixel(static_cast<float>(x - window.x0),
                   static_cast<float>(session_->world().camera.height - 1 - y - window.y0));
  const TileGrid grid(session_->film().width(), session_->film().height());
  for_each_tile(tiles_near(pixel, grid, tiles), render_tile);
}

std::uint32_t RenderLoop::next_epoch() const {
  return status().epoch + (pending_.bits != kEffectNone || !prepared_ ? 1 : 0);
}

void RenderLoop::set_state(LoopState state) {
  {
    const std::scoped_lock lock(mutex_);
    status_.state = state;
  }
  if (changed_) changed_();
}

void RenderLoop::set_progress(const Progress& progress, int divider) {
  {
    const std::scoped_lock lock(mutex_);
    status_.progress = progress;
    status_.divider = divider;
  }
  if (changed_) changed_();
}

void RenderLoop::count_messages() {
  const std::scoped_lock lock(mutex_);
  status_.messages = diagnostics_.all().size();
}

int RenderLoop::start_divider() const {
  const auto [width, height] = scaled_size();
  int divider = settings_.first_divider;
  const int side = std::max(width, height);
  while (divider > 1 && side / divider < settings_.least_long_side) divider /= 2;
  const double all_seconds = reduced_pixel_seconds_ * static_cast<double>(width) * height;
  while (divider > 1 && divider < kLargestDivider &&
         all_seconds > kFirstPictureSeconds * divider * divider &&
         2 * side / (2 * divider) >= settings_.least_long_side)
    divider *= 2;
  return divider;
}

bool RenderLoop::prepare() {
  if (!scene_.is_read()) return false;
  if (prepared_ && pending_.bits == kEffectNone) return scene_.world() != nullptr;
  session_.reset();
  {
    const std::scoped_lock lock(mutex_);
    ++status_.epoch;
    status_.progress = {};
  }
  set_state(LoopState::Preparing);
  const auto [width, height] = requested_size();
  prepared_ = scene_.update(pending_, view_, width, height);
  count_messages();
  pending_ = {};
  first_picture_ = true;
  last_copy_ = 0;
  next_divider_ = start_divider();
  draft_samples_ = 0;
  if (!prepared_) set_state(LoopState::Failed);
  return prepared_;
}

bool RenderLoop::prepare_completely() {
  if (!prepare()) return false;
  scene_.complete();
  return true;
}

SessionSettings RenderLoop::session_settings(int divider) const {
  SessionSettings settings;
  settings.seed = settings_.seed;
  settings.clamp = settings_.clamp;
  settings.budget = view_.budget;
  settings.unit_luminance = scene_.unit().cd_m2;
  const Camera& camera = scene_.world()->camera;
  if (view_.region || divider > 1)
    settings.crop =
        reduced_window(view_.region, divider * view_.scale, camera.width, camera.height);
  request_layers(view_.layers, settings);
  return settings;
}

bool RenderLoop::run(const std::atomic<bool>& cancel) {
  if (finished_) return true;
  if (!prepare()) {
    finished_ = true;
    return true;
  }
  set_state(LoopState::Rendering);
  const int least = view_.dragging ? std::min(kDragDivider, start_divider()) : 2;
  while (next_divider_ >= least && next_divider_ > 1) {
    if (cancel || !run_preview(cancel)) return false;
    next_divider_ /= 2;
  }
  if (view_.dragging && start_divider() > 1) {
    finished_ = true;
    return true;
  }
  if (cancel) return false;
  make_session();
  if (cancel || (draft_samples_ == 0 && session_->prepares_long() && !run_draft(cancel)))
    return false;
  if (!run_final(cancel)) return false;
  finished_ = true;
  set_state(LoopState::Converged);
  return true;
}

bool RenderLoop::run_preview(const std::atomic<bool>& cancel) {
  const auto [width, height] = scaled_size();
  const auto [w, h] = reduced_size(width, height, next_divider_);
  scene_.resize_camera(view_, w, h);
  // Photons of caustics take longer than such a picture.
  World& world = *scene_.world();
  const auto chosen = world.options.choose_paths_alone();
  SessionSettings settings = session_settings(next_divider_);
  settings.budget = {.samples = 1};
  settings.draft = true;
  bool done = false;
  {
    RenderSession session(world, settings);
    set_progress({}, next_divider_);
    const Clock::time_point start = Clock::now();
    done = session.run({}, &cancel) != StopReason::Cancelled;
    if (done) {
      reduced_pixel_seconds_ =
          seconds_since(start) / static_cast<double>(session.film().pixel_count());
      copy_picture(session, next_divider_, true);
    }
  }
  world.options.choose(chosen);
  const auto full = requested_size();
  scene_.resize_camera(view_, full[0], full[1]);
  return done;
}

void RenderLoop::end_caches() {
  if (computes_caches_.exchange(false) && caches_end_) caches_end_();
}

/// Path traced without what the full-size session computes beforehand.
bool RenderLoop::run_draft(const std::atomic<bool>& cancel) {
  World& world = *scene_.world();
  const auto chosen = world.options.choose_paths_alone();
  SessionSettings settings = session_settings(1);
  settings.budget.seconds = std::max(1e-3, kDraftSeconds - seconds_since(changed_at_));
  settings.draft = true;
  {
    RenderSession session(world, settings);
    Progressive::Callbacks callbacks;
    callbacks.pass = [&](const Progress&) { copy_picture(session, 1, true); };
    callbacks.wants_pause = [&] { return session.progress().pass > 0 && is_copy_due(); };
    callbacks.paused = [&] { copy_picture(session, 1, true); };
    callbacks.spread = [this](const std::vector<int>& tiles, const auto& render_tile, const auto&) {
      render_tiles(tiles, render_tile);
    };
    set_progress({}, 1);
    if (session.run(callbacks, &cancel) != StopReason::Cancelled) {
      copy_picture(session, 1, true);
      draft_samples_ = session.film().mean_samples();
    }
  }
  world.options.choose(chosen);
  return draft_samples_ > 0;
}

void RenderLoop::make_session() {
  if (session_) return;
  scene_.complete();
  SessionSettings settings = session_settings(1);
  settings.map_files = allowed_map_files(*scene_.world(), scene_.source().path, diagnostics_);
  settings.diagnostics = &diagnostics_;
  settings.picture_if_cancelled = false;
  session_.emplace(*scene_.world(), settings);
  session_->reuse(std::exchange(preparation_, {}));
}

bool RenderLoop::run_final(const std::atomic<bool>& cancel) {
  // A picture with fewer samples than the draft has would look worse. Asked between passes only: it
  // reads the whole film.
  bool is_better = session_->film().mean_samples() >= draft_samples_;
  Progressive::Callbacks callbacks;
  callbacks.progress = [this](const Progress& p) { set_progress(p, 1); };
  callbacks.pass = [&](const Progress& p) {
    count_messages();
    set_progress(p, 1);
    is_better = session_->film().mean_samples() >= draft_samples_;
    if (is_better && (first_picture_ || p.pass <= 1 || is_copy_due()))
      copy_picture(*session_, 1, false);
  };
  callbacks.wants_pause = [&] {
    return is_better && session_->progress().pass > 0 && is_copy_due();
  };
  callbacks.paused = [this] { copy_picture(*session_, 1, false); };
  callbacks.spread = [this](const std::vector<int>& tiles, const auto& render_tile, const auto&) {
    end_caches();
    render_tiles(tiles, render_tile);
  };
  computes_caches_ = !session_->can_save();
  const StopReason reason = session_->run(callbacks, &cancel);
  end_caches();
  count_messages();
  set_progress(session_->progress(), 1);
  if (reason == StopReason::Cancelled) {
    // Incomplete caches would stay.
    if (!session_->can_save()) session_.reset();
    return false;
  }
  if (reason != StopReason::MapsOnly) copy_picture(*session_, 1, false, true);
  return true;
}

bool RenderLoop::is_copy_due() const {
  const double since = seconds_since(changed_at_);
  return since - last_copy_ >= std::max(copy_interval(since), copy_seconds_ / kCopyShare);
}

bool RenderLoop::denoises(const RenderSession& session, bool preview, bool final) const {
  // Edits wait for the denoiser, so running pictures are denoised only if that is quick.
  constexpr double kQuick = 0.3;
  constexpr double kLeastSamples = 4;
  const auto& names = view_.layers;
  return std::find(names.begin(), names.end(), kDenoisedLayer) != names.end() && !preview &&
         session.film().mean_samples() >= kLeastSamples && (final || denoise_seconds_ < kQuick);
}

void RenderLoop::copy_picture(const RenderSession& session, int divider, bool preview, bool final) {
  const Clock::time_point start = Clock::now();
  auto picture = std::make_shared<Picture>();
  const Camera& camera = session.world().camera;
  const Window& window = session.window();
  picture->divider = divider * view_.scale;
  picture->preview = preview;
  picture->first = first_picture_;
  picture->width = camera.width, picture->height = camera.height;
  picture->x = window.x0, picture->y = camera.height - window.y1;
  picture->w = window.width(), picture->h = window.height();
  picture->samples = static_cast<std::uint32_t>(session.film().mean_samples());
  picture->number = ++pictures_;
  const bool denoise = denoises(session, preview, final);
  picture->layers = copy_layers(session, view_.layers, denoise);
  {
    const std::scoped_lock lock(mutex_);
    picture->epoch = status_.epoch;
    if (first_picture_) status_.latency = seconds_since(changed_at_);
  }
  first_picture_ = false;
  last_copy_ = seconds_since(changed_at_);
  copy_seconds_ = seconds_since(start);
  if (denoise) denoise_seconds_ = copy_seconds_;
  if (show_) show_(std::move(picture));
}

}  // namespace oriel::interactive
