// SPDX-License-Identifier: Apache-2.0
#include "render/progressive.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <bit>

#include "base/parallel.h"
#include "render/allocation.h"

namespace oriel {
namespace {

/// Minimum brightness of pixels in noise estimates, as a share of the picture's brightness.
constexpr float kDarkestJudged = 0.01f;

constexpr double kSecondsBetweenReports = 0.2;

/// Smallest square of convergence_gain(): Sobol's points on smooth pixels, whose error falls with
/// the power 1.5 of their number (A. Owen, "Scrambled net variance for integrals of smooth
/// functions", Ann. Statist. 25, 1997) twice over.
constexpr double kFastest = 1.0 / 16;

/// A pixel is judged by the squares of 11 x 11 pixels, whose mean is known to an eighth.
constexpr int kJudgedRadius = 5;

/// The samples of all pixels grow by at most this factor in a pass that distributes them.
constexpr double kPassGrowth = 1.5;

/// Their least growth, so that few passes end the render: each looks at the noise, and the first
/// that finds it below the target by chance ends the render too early.
constexpr double kLeastPassGrowth = 1.0625;

/// The samples of a pixel grow by at most this factor in such a pass, whose allocation is based on
/// fewer samples than the pixel gets.
constexpr std::uint32_t kPixelGrowth = 2;

/// The most samples of a pixel, as a multiple of the mean over the picture, with SecondHalf.
constexpr std::uint32_t kMostOfDistributed = 4;

/// Least variance of a pixel for the distribution, relative to the mean: neighbours without noise
/// may have missed rare light.
constexpr double kLeastVariance = 1e-3;

}  // namespace

std::uint32_t RenderBudget::even_samples() const {
  if (distribution == Distribution::Even) return max_samples;
  if (distribution == Distribution::EveryPass) return kMinJudgedSamples;
  // Half of them, in whole blocks as in next_pass_target().
  return std::max(max_samples / 2 / kMinJudgedSamples * kMinJudgedSamples, kFewestDistributed / 2);
}

std::uint32_t RenderBudget::pixel_samples() const {
  return distribution == Distribution::SecondHalf ? kMostOfDistributed * max_samples : max_samples;
}

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
  // Sums of squares and of their squares; double: millions of terms.
  struct Sums {
    double squares = 0, fourths = 0;
    void add(float noise) {
      const double square = sqr(std::min(noise, kMaxPixelNoise));
      squares += square, fourths += square * square;
    }
    /// Squared standard error of the sum, relative to it.
    double uncertainty() const { return squares > 0 ? fourths / (squares * squares) : 0; }
  } last, before;
  for (const Film::Estimate& e : estimates) {
    last.add(relative_noise(e.doubling, e, picture));
    before.add(relative_noise(e.doubling_before, e, picture));
  }
  // Of independent samples the squares of changes halve with each doubling. By its standard error
  // the ratio may be less by chance.
  if (!(before.squares > 0)) return 1;
  const double chance = 1 + std::sqrt(last.uncertainty() + before.uncertainty());
  const double ratio = 2 * last.squares / before.squares;
  return static_cast<float>(std::sqrt(std::clamp(chance * ratio, kFastest, 1.0)));
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

Progressive::Progressive(Film& film, const RenderBudget& budget, const PicturePart& part)
    : film_(film),
      budget_(budget),
      is_whole_(part.is_whole()),
      tiles_(TileGrid(film.width(), film.height()).part(part)),
      pixels_(TileGrid(film.width(), film.height()).pixels(tiles_)) {
  budget_.max_samples = std::max(budget_.max_samples, 1u);
  state_.targets.resize(film.pixel_count());
  start_ = std::chrono::steady_clock::now();
}

double Progressive::elapsed() const {
  const std::chrono::duration<double> run = std::chrono::steady_clock::now() - start_;
  return state_.elapsed + run.count();
}

void Progressive::begin_at(std::chrono::steady_clock::time_point start) {
  start_ = std::chrono::steady_clock::now();
  const std::chrono::duration<double> run = start_ - start;
  state_.elapsed = elapsed_elsewhere_ + run.count();
}

bool Progressive::out_of_time() const {
  return budget_.seconds > 0 && state_.pass > 0 && elapsed_here() >= budget_.seconds;
}

bool Progressive::restore(State state) {
  if (state.targets.size() != film_.pixel_count() || state.pass < 0 || !(state.elapsed >= 0) ||
      !film_.is_valid(budget_.pixel_samples()))
    return false;
  for (std::size_t i = 0; i < state.targets.size(); ++i)
    if (state.targets[i] > budget_.pixel_samples() || film_.samples(i) > state.targets[i])
      return false;
  state_ = std::move(state);
  elapsed_elsewhere_ = state_.elapsed;
  return true;
}

bool Progressive::raise_targets(const std::vector<std::uint32_t>& targets) {
  if (targets.size() != film_.pixel_count()) return false;
  for (const std::uint32_t i : pixels_)
    if (targets[i] < film_.samples(i) || targets[i] > budget_.pixel_samples()) return false;
  for (const std::uint32_t i : pixels_) state_.targets[i] = targets[i];
  return true;
}

bool Progressive::pass_is_complete() const {
  return std::all_of(pixels_.begin(), pixels_.end(),
                     [&](std::uint32_t i) { return film_.samples(i) >= state_.targets[i]; });
}

bool Progressive::must_stop(const Callbacks& callbacks, const std::atomic<bool>* cancel) {
  if (cancel && *cancel) cancelled_ = true;
  if (out_of_time()) timed_out_ = true;
  if (!paused_ && callbacks.wants_pause && callbacks.wants_pause()) paused_ = true;
  return cancelled_ || timed_out_ || paused_;
}

/// The squared noise of one sample in the neighbourhood of each pixel, by one of the errors.
std::vector<float> Progressive::pooled_variance(const std::vector<Film::Estimate>& estimates,
                                                float Film::Estimate::*error, Pool pool) const {
  const float picture = picture_brightness(estimates);
  std::vector<float> variance(estimates.size());
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const float noise = relative_noise(estimates[i].*error, estimates[i], picture);
    variance[i] = sqr(std::min(noise, kMaxPixelNoise)) * static_cast<float>(film_.samples(i));
  }
  pool(variance, film_.width(), film_.height(), kJudgedRadius);
  return variance;
}

/// Two independent estimates: the changes measure the gain of evenly spread samples, the standard
/// errors are more certain. By the changes alone, pixels whose change is small by chance would
/// keep it until they double, and the noise of the picture would be estimated too small.
std::vector<PixelDemand> Progressive::demands(const std::vector<Film::Estimate>& estimates,
                                              Pool pool) const {
  const std::vector<float> changes = pooled_variance(estimates, &Film::Estimate::doubling, pool);
  const std::vector<float> spread = pooled_variance(estimates, &Film::Estimate::error, pool);
  std::vector<PixelDemand> pixels(changes.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = {film_.samples(i), std::sqrt(changes[i] * spread[i])};
  return pixels;
}

/// The next pass of a picture whose noise has a target.
void Progressive::plan_for_picture(Plan& plan, const std::vector<Film::Estimate>& estimates,
                                   float noise) const {
  if (noise <= budget_.noise) {
    plan.stop = StopReason::Noise;
    return;
  }
  const std::vector<PixelDemand> pixels = demands(estimates, blur_square);
  double present = 0, drawn = 0;  // double: millions of terms
  for (const PixelDemand& pixel : pixels) {
    present += double{pixel.variance} / pixel.samples;
    drawn += pixel.samples;
  }
  // The demands are relative; noise and target give their scale.
  const double target2 = present * sqr(budget_.noise / noise) / static_cast<double>(pixels.size());
  AllocationLimits limits{.squared_noise = target2,
                          .least_growth = kLeastPassGrowth,
                          .growth = kPassGrowth,
                          .pixel_growth = kPixelGrowth,
                          .max_samples = budget_.max_samples};
  plan.targets = allocate_samples(pixels, limits);
  limits.least_growth = 1;
  limits.growth = limits.pixel_growth = budget_.max_samples;
  for (const std::uint32_t samples : allocate_samples(pixels, limits)) plan.missing += samples;
  plan.missing -= drawn;
}

/// The next pass of a picture whose pixels all have a noise target.
void Progressive::plan_for_pixels(Plan& plan, const std::vector<Film::Estimate>& estimates) const {
  const float picture = picture_brightness(estimates), target2 = sqr(budget_.noise);
  const float gain2 = sqr(convergence_gain(estimates, picture));
  const std::vector<float> variance =
      pooled_variance(estimates, &Film::Estimate::doubling, blur_square);
  plan.stop = StopReason::Noise;
  for (std::size_t i = 0; i < variance.size(); ++i) {
    const std::uint32_t n = film_.samples(i);
    const float own = relative_noise(estimates[i].error, estimates[i], picture);
    const float noise2 =
        std::max(gain2 * variance[i] / static_cast<float>(n), sqr(std::min(own, kMaxPixelNoise)));
    if (noise2 <= target2) continue;
    plan.stop.reset();
    plan.targets[i] = std::max(n, std::min(next_pass_target(n), budget_.max_samples));
    const double most = budget_.max_samples, needed = double{noise2} / target2 * n;
    plan.missing += std::max(std::min(needed, most) - n, 0.0);
  }
}

/// The next pass of a picture without a noise target. The samples of a pixel do not depend on its
/// own noise: pixels that lack a rare bright sample would stay too dark.
void Progressive::plan_distribution(Plan& plan,
                                    const std::vector<Film::Estimate>& estimates) const {
  std::vector<PixelDemand> pixels = demands(estimates, average_neighbours);
  double sum = 0, drawn = 0;  // double: millions of terms
  for (const PixelDemand& pixel : pixels) sum += pixel.variance, drawn += pixel.samples;
  const auto count = static_cast<double>(pixels.size());
  const float least =
      std::max(static_cast<float>(kLeastVariance * sum / count), std::numeric_limits<float>::min());
  for (PixelDemand& pixel : pixels) pixel.variance = std::max(pixel.variance, least);
  const double all = budget_.max_samples * count;
  const bool last = budget_.distribution == Distribution::SecondHalf;
  plan.targets =
      allocate_samples(pixels, {.growth = last ? all / drawn : kPassGrowth,
                                .pixel_growth = last ? budget_.pixel_samples() : kPixelGrowth,
                                .max_samples = budget_.pixel_samples(),
                                .block = std::min(kMinJudgedSamples, budget_.even_samples())});
  plan.missing = all - drawn;
}

Progressive::Plan Progressive::plan(const std::vector<Film::Estimate>& estimates,
                                    float noise) const {
  Plan plan;
  plan.targets.resize(film_.pixel_count());
  const std::uint32_t even = budget_.even_samples();
  std::uint32_t lowest = pixels_.empty() ? 0 : even, highest = 0;
  for (const std::uint32_t i : pixels_) {
    plan.targets[i] = film_.samples(i);
    lowest = std::min(lowest, plan.targets[i]);
    highest = std::max(highest, plan.targets[i]);
  }
  if (lowest >= even) {
    const bool is_distributed =
        budget_.distribution == Distribution::SecondHalf && is_whole_ && highest > even;
    if (budget_.distribution == Distribution::Even || is_distributed)
      plan.stop = StopReason::Samples;
    else if (is_whole_)
      plan_distribution(plan, estimates);
    else
      plan.stop = StopReason::Part;
    return plan;
  }
  const bool judged = budget_.noise > 0 && lowest >= kMinSplitSamples;
  if (!judged || !is_whole_) {
    for (const std::uint32_t i : pixels_) plan.missing += budget_.max_samples - plan.targets[i];
  } else if (budget_.every_pixel) {
    plan_for_pixels(plan, estimates);
  } else {
    plan_for_picture(plan, estimates, noise);
  }
  if (judged && lowest >= budget_.min_samples) {
    if (!is_whole_) plan.stop = StopReason::Part;
    return plan;
  }
  plan.stop.reset();
  const std::uint32_t next = std::min(next_pass_target(lowest), even);
  for (const std::uint32_t i : pixels_) plan.targets[i] = std::max(film_.samples(i), next);
  return plan;
}

/// Whether the next pass has samples.
bool Progressive::plan_grows() const {
  return std::any_of(pixels_.begin(), pixels_.end(),
                     [&](std::uint32_t i) { return next_.targets[i] > film_.samples(i); });
}

/// Why the plan of the next pass ends the render.
std::optional<StopReason> Progressive::plan_stops() const {
  if (next_.stop) return next_.stop;
  // Without a pass all pixels that have noise have the most samples.
  if (!plan_grows()) return StopReason::Samples;
  return std::nullopt;
}

std::optional<StopReason> Progressive::judge() {
  estimate(0, 0);
  return plan_stops();
}

std::optional<StopReason> Progressive::begin_pass() {
  if (const std::optional<StopReason> stop = plan_stops()) return stop;
  if (out_of_time()) return StopReason::Time;
  state_.targets = next_.targets;
  return std::nullopt;
}

void Progressive::estimate(double seconds_of_run, double samples_of_run) {
  const double before = progress().done;
  std::vector<Film::Estimate> estimates;
  if (is_whole_) {
    estimates = film_estimates(film_);
  } else {
    estimates.resize(pixels_.size());
    parallel_for(pixels_.size(), [&](std::size_t i) { estimates[i] = film_.estimate(pixels_[i]); });
  }
  const float picture = picture_brightness(estimates);
  const float noise = picture_noise(estimates, picture);
  const auto pixels = static_cast<double>(pixels_.size());
  next_ = plan(estimates, noise);
  const double missing = next_.missing;
  double active = 0;
  for (const std::uint32_t i : pixels_)
    active += !next_.stop && next_.targets[i] > film_.samples(i);
  last_.pass = state_.pass;
  last_.mean_samples = mean_samples();
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

double Progressive::mean_samples() const {
  if (is_whole_) return film_.mean_samples();
  double sum = 0;
  for (const std::uint32_t i : pixels_) sum += film_.samples(i);
  return pixels_.empty() ? 0 : sum / static_cast<double>(pixels_.size());
}

double Progressive::done_share(double mean_samples) const {
  double done = samples_in_all_ > 0 ? mean_samples / samples_in_all_ : 0;
  if (budget_.seconds > 0) done = std::max(done, elapsed_here() / budget_.seconds);
  return std::clamp(done, 0.0, 1.0);
}

Progress Progressive::progress() const {
  Progress p = last_;
  const std::uint64_t drawn = drawn_ - pass_start_samples_;
  if (!pixels_.empty())
    p.mean_samples += static_cast<double>(drawn) / static_cast<double>(pixels_.size());
  p.elapsed = elapsed();
  p.done = std::max(p.done, done_share(p.mean_samples));
  return p;
}

void Progressive::render_tile(int tile, const std::function<std::uint64_t(const Row&)>& render_row,
                              const Callbacks& callbacks, const std::atomic<bool>* cancel) {
  const TileBounds b = TileGrid(film_.width(), film_.height()).bounds(tile);
  for (int y = b.y0; y < b.y1; ++y) {
    if (must_stop(callbacks, cancel)) return;
    drawn_ += render_row({b.x0, b.x1, y});
  }

  const std::unique_lock lock(report_mutex_, std::try_to_lock);
  if (!callbacks.progress || !lock.owns_lock()) return;
  if (elapsed() - last_report_ < kSecondsBetweenReports) return;
  last_report_ = elapsed();
  Progress p = progress();
  if (p.remaining) p.remaining = std::max(*p.remaining - (p.elapsed - last_.elapsed), 0.0);
  callbacks.progress(p);
}

void Progressive::loop_over(const std::function<std::optional<int>()>& next,
                            const std::function<std::uint64_t(const Row&)>& render_row,
                            const std::function<void(int)>& drawn,
                            const std::atomic<bool>* cancel) {
  const TileGrid grid(film_.width(), film_.height());
  cancelled_ = timed_out_ = paused_ = false;
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  parallel_for(threads, [&](std::size_t) {
    while (const std::optional<int> tile = next()) {
      const TileBounds b = grid.bounds(*tile);
      for (int y = b.y0; y < b.y1 && !(cancel && *cancel); ++y)
        drawn_ += render_row({b.x0, b.x1, y});
      drawn(*tile);
    }
  });
}

/// The tiles that the running pass still has to render, those with most samples first.
std::vector<int> Progressive::incomplete_tiles() const {
  const TileGrid grid(film_.width(), film_.height());
  std::vector<std::pair<std::uint64_t, int>> missing;
  for (const int tile : tiles_) {
    std::uint64_t samples = 0;
    for (const std::uint32_t i : grid.pixels({tile}))
      samples += state_.targets[i] - std::min(film_.samples(i), state_.targets[i]);
    if (samples > 0) missing.emplace_back(samples, tile);
  }
  std::stable_sort(missing.begin(), missing.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<int> tiles;
  tiles.reserve(missing.size());
  for (const auto& [samples, tile] : missing) tiles.push_back(tile);
  return tiles;
}

/// Draws the samples of a pass, with pauses.
void Progressive::run_pass(const std::function<std::uint64_t(const Row&)>& render_row,
                           const Callbacks& callbacks, const std::atomic<bool>* cancel) {
  bool complete = false;
  do {
    paused_ = false;
    const auto render = [&](int tile) { render_tile(tile, render_row, callbacks, cancel); };
    if (callbacks.spread)
      callbacks.spread(incomplete_tiles(), render, [&] { return must_stop(callbacks, cancel); });
    else
      parallel_for(tiles_.size(), [&](std::size_t i) { render(tiles_[i]); });
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

  // An interrupted pass is completed first, with the sample numbers that it was to reach.
  bool chosen = !pass_is_complete();
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
