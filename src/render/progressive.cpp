// SPDX-License-Identifier: Apache-2.0
#include "render/progressive.h"

#include <algorithm>
#include <bit>

#include "base/parallel.h"

namespace oriel {
namespace {

/// Tile size in pixels: small enough for two hundred tiles in a small picture, large enough for
/// coherent rays.
constexpr int kTile = 16;

/// Minimum brightness of pixels in noise estimates, as a share of the picture's brightness.
constexpr float kDarkestJudged = 0.01f;

constexpr double kSecondsBetweenReports = 0.2;

/// Smallest square of convergence_gain(): Sobol's points on smooth pixels, whose error falls with
/// the power 1.5 of their number (A. Owen, "Scrambled net variance for integrals of smooth
/// functions", Ann. Statist. 25, 1997) twice over.
constexpr double kFastest = 1.0 / 16;

/// A pixel is judged by the squares of 11 x 11 pixels, whose mean is known to an eighth.
constexpr int kJudgedRadius = 5;

int tiles_across(int pixels) { return (pixels + kTile - 1) / kTile; }

/// Means over windows of 2 kJudgedRadius + 1 values of a row or column, clipped at its ends.
void blur(const float* from, float* to, int count, std::size_t step) {
  for (int i = 0; i < count; ++i) {
    const int first = std::max(i - kJudgedRadius, 0), last = std::min(i + kJudgedRadius, count - 1);
    float sum = 0;
    for (int k = first; k <= last; ++k) sum += from[static_cast<std::size_t>(k) * step];
    to[static_cast<std::size_t>(i) * step] = sum / static_cast<float>(last - first + 1);
  }
}

}  // namespace

float relative_noise(float error, const Film::Estimate& estimate, float picture) {
  if (!(error > 0)) return 0;
  return error / std::sqrt(std::max({estimate.mean, kDarkestJudged * picture, 1e-20f}) *
                           std::max(picture, 1e-20f));
}

std::vector<Film::Estimate> film_estimates(const Film& film) {
  std::vector<Film::Estimate> estimates(film.pixel_count());
  const auto width = static_cast<std::size_t>(film.width());
  parallel_for(static_cast<std::size_t>(film.height()), [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i) estimates[i] = film.estimate(i);
  });
  return estimates;
}

float picture_brightness(const std::vector<Film::Estimate>& estimates) {
  double sum = 0;  // double: millions of terms
  for (const Film::Estimate& estimate : estimates) sum += std::sqrt(std::max(estimate.mean, 0.0f));
  const double mean = estimates.empty() ? 0 : sum / static_cast<double>(estimates.size());
  return static_cast<float>(mean * mean);
}

float convergence_gain(const std::vector<Film::Estimate>& estimates, float picture) {
  double last = 0, before = 0;
  for (const Film::Estimate& e : estimates) {
    const auto square = [&](float difference) {
      return double{sqr(std::min(relative_noise(difference, e, picture), kMaxPixelNoise))};
    };
    last += square(e.doubling);
    before += square(e.doubling_before);
  }
  // Of independent samples the squares of changes halve with each doubling.
  if (!(before > 0)) return 1;
  return static_cast<float>(std::sqrt(std::clamp(2 * last / before, kFastest, 1.0)));
}

float picture_noise(const std::vector<Film::Estimate>& estimates, float picture) {
  double sum = 0;  // double: millions of terms
  for (const Film::Estimate& estimate : estimates) {
    const float e = relative_noise(estimate.doubling, estimate, picture);
    if (!std::isfinite(e)) return std::numeric_limits<float>::infinity();
    sum += sqr(std::min(e, kMaxPixelNoise));
  }
  if (estimates.empty()) return 0;
  return convergence_gain(estimates, picture) *
         static_cast<float>(std::sqrt(sum / double(estimates.size())));
}

std::uint32_t next_pass_target(std::uint32_t samples) {
  if (samples == 0) return 1;
  if (samples < kMinJudgedSamples) return std::bit_floor(samples) * 2;
  // Steps of half the power of two below: at most 1.5 times the samples, in aligned blocks, for
  // which the sample sequences are most uniform.
  const std::uint32_t step = std::max(std::bit_floor(samples) / 2, kMinJudgedSamples);
  return (samples / step + 1) * step;
}

Progressive::Progressive(Film& film, const RenderBudget& budget)
    : Progressive(film, budget, State{}) {}

Progressive::Progressive(Film& film, const RenderBudget& budget, State state)
    : film_(film), budget_(budget), state_(std::move(state)) {
  budget_.max_samples = std::max(budget_.max_samples, 1u);
  if (state_.active.size() != film.pixel_count()) state_.active.assign(film.pixel_count(), 1);
  start_ = std::chrono::steady_clock::now();
}

double Progressive::elapsed() const {
  const std::chrono::duration<double> run = std::chrono::steady_clock::now() - start_;
  return state_.elapsed + run.count();
}

void Progressive::begin_at(std::chrono::steady_clock::time_point start) {
  const std::chrono::duration<double> run = std::chrono::steady_clock::now() - start;
  state_.elapsed = elapsed_elsewhere_ + run.count();
}

bool Progressive::out_of_time() const {
  return budget_.seconds > 0 && state_.pass > 0 && elapsed_here() >= budget_.seconds;
}

bool Progressive::restore(State state) {
  if (state.active.size() != film_.pixel_count() || state.pass < 0 ||
      state.target > budget_.max_samples || !(state.elapsed >= 0) ||
      !film_.is_valid(state.target) ||
      std::any_of(state.active.begin(), state.active.end(), [](auto a) { return a > 1; }))
    return false;
  state_ = std::move(state);
  elapsed_elsewhere_ = state_.elapsed;
  return true;
}

bool Progressive::pass_is_complete() const {
  for (std::size_t i = 0; i < state_.active.size(); ++i)
    if (state_.active[i] && film_.samples(i) < state_.target) return false;
  return true;
}

bool Progressive::must_stop(const Callbacks& callbacks, const std::atomic<bool>* cancel) {
  if (cancel && *cancel) cancelled_ = true;
  if (out_of_time()) timed_out_ = true;
  if (!paused_ && callbacks.wants_pause && callbacks.wants_pause()) paused_ = true;
  return cancelled_ || timed_out_ || paused_;
}

/// The noise by which each pixel is judged.
std::vector<float> Progressive::judged_noise(const std::vector<Film::Estimate>& estimates,
                                             float picture) const {
  const auto width = static_cast<std::size_t>(film_.width());
  const auto height = static_cast<std::size_t>(film_.height());
  std::vector<float> noise(estimates.size()), across(estimates.size());
  parallel_for(height, [&](std::size_t y) {
    for (std::size_t i = y * width; i < (y + 1) * width; ++i)
      noise[i] = sqr(
          std::min(relative_noise(estimates[i].doubling, estimates[i], picture), kMaxPixelNoise));
    blur(&noise[y * width], &across[y * width], film_.width(), 1);
  });
  parallel_for(width, [&](std::size_t x) { blur(&across[x], &noise[x], film_.height(), width); });
  const float gain = convergence_gain(estimates, picture);
  for (std::size_t i = 0; i < noise.size(); ++i) {
    noise[i] = gain * std::sqrt(noise[i]);
    if (budget_.every_pixel)
      noise[i] = std::max(noise[i], relative_noise(estimates[i].error, estimates[i], picture));
  }
  return noise;
}

double Progressive::needed_growth(const std::vector<float>& noise) const {
  // Squared noise falls with the number of samples. Pixels below the target stay as they are; the
  // others all need `growth` times their samples until the mean square is that of the target.
  const double target2 = sqr(double{budget_.noise});
  double open = 0, rest = 0;
  for (const float e : noise) (e > budget_.noise ? open : rest) += sqr(std::min(e, kMaxPixelNoise));
  const double allowed = target2 * static_cast<double>(noise.size()) - rest;
  return allowed > 0 ? std::max(open / allowed, 1.0) : 1;
}

bool Progressive::choose_active(std::uint32_t& next) {
  const std::vector<Film::Estimate> estimates = film_estimates(film_);
  const float picture = picture_brightness(estimates);
  if (!budget_.every_pixel && picture_noise(estimates, picture) <= budget_.noise) return false;
  const std::vector<float> noise = judged_noise(estimates, picture);
  for (std::size_t i = 0; i < state_.active.size(); ++i)
    state_.active[i] = film_.samples(i) < budget_.min_samples || noise[i] > budget_.noise;
  if (!budget_.every_pixel) {
    // The last pass has only the blocks of samples that are still needed.
    const double needed = std::ceil(state_.target * needed_growth(noise) / kMinJudgedSamples);
    if (needed * kMinJudgedSamples < next)
      next = std::max(static_cast<std::uint32_t>(needed) * kMinJudgedSamples, state_.target + 1);
  }
  return std::any_of(state_.active.begin(), state_.active.end(), [](auto a) { return a != 0; });
}

std::optional<StopReason> Progressive::begin_pass() {
  if (state_.target >= budget_.max_samples) return StopReason::Samples;
  std::uint32_t next = next_pass_target(state_.target);
  if (budget_.noise > 0 && state_.target >= budget_.min_samples) {
    if (!choose_active(next)) return StopReason::Noise;
  }
  if (out_of_time()) return StopReason::Time;
  state_.target = std::min(next, budget_.max_samples);
  return std::nullopt;
}

/// The number of samples until the budget is used up or the noise target is met.
double Progressive::missing_samples(const std::vector<float>& noise) const {
  const auto noise2 = [&](std::size_t i) {
    return double{sqr(std::min(noise[i], kMaxPixelNoise))};
  };
  const double target2 = sqr(double{budget_.noise}), growth = needed_growth(noise);
  double missing = 0;
  for (std::size_t i = 0; i < noise.size(); ++i) {
    const double n = film_.samples(i), most = budget_.max_samples;
    double needed = most;
    if (target2 > 0) {
      needed = budget_.every_pixel ? n * noise2(i) / target2 : noise2(i) > target2 ? n * growth : n;
      needed = std::clamp(needed, std::min<double>(budget_.min_samples, most), most);
    }
    missing += std::max(needed - n, 0.0);
  }
  return missing;
}

void Progressive::estimate(double seconds_of_run, double samples_of_run) {
  const double before = progress().done;
  const std::vector<Film::Estimate> estimates = film_estimates(film_);
  const float picture = picture_brightness(estimates);
  const float noise = picture_noise(estimates, picture);
  const std::vector<float> judged = judged_noise(estimates, picture);
  const auto pixels = static_cast<double>(film_.pixel_count());
  const double missing = missing_samples(judged);
  double active = 0;
  for (std::size_t i = 0; i < film_.pixel_count(); ++i) {
    const bool below_min = film_.samples(i) < budget_.min_samples;
    const bool quiet = budget_.noise > 0 && !below_min && judged[i] <= budget_.noise;
    active += !quiet && film_.samples(i) < budget_.max_samples;
  }
  last_.pass = state_.pass;
  last_.mean_samples = film_.mean_samples();
  last_.active = pixels > 0 ? active / pixels : 0;
  last_.noise = std::isfinite(noise) ? std::optional(noise) : std::nullopt;
  last_.remaining.reset();
  samples_in_all_ = last_.mean_samples + (pixels > 0 ? missing / pixels : 0);
  if (samples_of_run > 0) last_.remaining = missing * seconds_of_run / samples_of_run;
  if (budget_.seconds > 0) {
    const double left = std::max(budget_.seconds - elapsed_here(), 0.0);
    last_.remaining = std::min(last_.remaining.value_or(left), left);
  }
  last_.done = std::max(before, done_share(last_.mean_samples));
}

double Progressive::done_share(double mean_samples) const {
  double done = samples_in_all_ > 0 ? mean_samples / samples_in_all_ : 0;
  if (budget_.seconds > 0) done = std::max(done, elapsed_here() / budget_.seconds);
  return std::clamp(done, 0.0, 1.0);
}

Progress Progressive::progress() const {
  Progress p = last_;
  const std::uint64_t drawn = drawn_ - pass_start_samples_;
  if (film_.pixel_count())
    p.mean_samples += static_cast<double>(drawn) / static_cast<double>(film_.pixel_count());
  p.elapsed = elapsed();
  p.done = std::max(p.done, done_share(p.mean_samples));
  return p;
}

void Progressive::render_tile(int tile, const std::function<std::uint64_t(const Row&)>& render_row,
                              const Callbacks& callbacks, const std::atomic<bool>* cancel) {
  const int across = tiles_across(film_.width());
  const int x0 = tile % across * kTile, y0 = tile / across * kTile;
  const int x1 = std::min(x0 + kTile, film_.width()), y1 = std::min(y0 + kTile, film_.height());
  for (int y = y0; y < y1; ++y) {
    if (must_stop(callbacks, cancel)) return;
    drawn_ += render_row({x0, x1, y});
  }

  const std::unique_lock lock(report_mutex_, std::try_to_lock);
  if (!callbacks.progress || !lock.owns_lock()) return;
  if (elapsed() - last_report_ < kSecondsBetweenReports) return;
  last_report_ = elapsed();
  Progress p = progress();
  if (p.remaining) p.remaining = std::max(*p.remaining - (p.elapsed - last_.elapsed), 0.0);
  callbacks.progress(p);
}

/// Draws the samples of a pass, with pauses.
void Progressive::run_pass(const std::function<std::uint64_t(const Row&)>& render_row,
                           const Callbacks& callbacks, const std::atomic<bool>* cancel) {
  const auto tiles = static_cast<std::size_t>(tiles_across(film_.width())) *
                     static_cast<std::size_t>(tiles_across(film_.height()));
  bool complete = false;
  do {
    paused_ = false;
    parallel_for(tiles, [&](std::size_t tile) {
      render_tile(static_cast<int>(tile), render_row, callbacks, cancel);
    });
    const bool stopped = paused_ || cancelled_ || timed_out_;
    complete = !stopped || pass_is_complete();
    if (complete) ++state_.pass;
    if (paused_ && callbacks.paused) callbacks.paused();
  } while (!complete && !cancelled_ && !timed_out_);
}

StopReason Progressive::run_rows(const std::function<std::uint64_t(const Row&)>& render_row,
                                 const Callbacks& callbacks, const std::atomic<bool>* cancel) {
  start_ = std::chrono::steady_clock::now();
  const double elapsed_before = state_.elapsed;
  cancelled_ = timed_out_ = paused_ = false;
  drawn_ = pass_start_samples_ = 0;
  last_report_ = elapsed();
  estimate(0, 0);

  // An interrupted pass is completed first, with its active pixels and target.
  bool chosen = state_.target > 0 && !pass_is_complete();
  std::optional<StopReason> stop;
  while (!stop) {
    if (!chosen) stop = begin_pass();
    chosen = false;
    if (stop) break;
    run_pass(render_row, callbacks, cancel);
    if (cancelled_) stop = StopReason::Cancelled;
    if (timed_out_) stop = StopReason::Time;
    const double seconds = elapsed() - elapsed_before;
    estimate(seconds, static_cast<double>(drawn_));
    last_.elapsed = elapsed();
    pass_start_samples_ = drawn_;
    if (!stop && callbacks.pass) callbacks.pass(progress());
  }
  state_.elapsed = elapsed();
  start_ = std::chrono::steady_clock::now();
  return *stop;
}

}  // namespace oriel
