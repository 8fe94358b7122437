// SPDX-License-Identifier: Apache-2.0
// Passes over the film: which pixels need more samples, how many, and when the render ends.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <vector>

#include "render/film.h"
#include "render/tiles.h"

namespace oriel {

/// Minimum number of samples before the noise of a pixel is estimated.
inline constexpr std::uint32_t kMinJudgedSamples = 16;
/// Fewer samples are not distributed: half of them is too few to estimate the noise of pixels.
inline constexpr std::uint32_t kFewestDistributed = 16;

/// Where samples go without a noise target. Even: max_samples in every pixel. SecondHalf:
/// max_samples is the mean of all pixels, and the second half of them goes to the pixels where they
/// reduce the noise most. EveryPass: so do the samples of each pass, until the time is over.
enum class Distribution : std::uint8_t { Even, SecondHalf, EveryPass };

/// Stop criteria; the first that is met ends the render.
struct RenderBudget {
  std::uint32_t max_samples = 64;  ///< per pixel, see Distribution
  std::uint32_t min_samples = kMinJudgedSamples;
  float noise = 0;  ///< target of picture_noise(); 0 = none
  /// The noise target applies to every pixel instead of the picture.
  bool every_pixel = false;
  Distribution distribution = Distribution::Even;
  double seconds = 0;  ///< ends a render after its first pass; 0 = no limit
  bool operator==(const RenderBudget&) const = default;

  /// Samples that every pixel gets.
  std::uint32_t even_samples() const;
  /// The most that a pixel gets.
  std::uint32_t pixel_samples() const;
};

struct PixelDemand;

/// MapsOnly: there is no picture, since the options request caches of indirect light only. Part:
/// the further samples of a part depend on the pixels of the other parts.
enum class StopReason : std::uint8_t { Samples, Noise, Time, Cancelled, MapsOnly, Part };

/// Progress of a render.
struct Progress {
  const char* stage = nullptr;  ///< work before the picture, e.g. "photons"; null = the picture
  int pass = 0;                 ///< complete passes
  double mean_samples = 0;
  double active = 1;                ///< fraction of pixels that the running pass samples
  std::optional<float> noise;       ///< picture_noise(); nothing before the second sample
  double elapsed = 0;               ///< seconds
  std::optional<double> remaining;  ///< seconds, estimated
  double done = 0;                  ///< share of the work, 0 to 1; never decreases
};

/// Samples the pixels in passes until a stop criterion is met.
///
/// Model:   pass k takes every pixel to n_k samples: 1, 2, 4, 8, 16, 32, 48, 64, 96, 128, 192...
///          With a noise target, from min_samples on, a pass increases the samples of all pixels
///          together by at most half. It distributes them by allocate_samples(), so that the noise
///          of the picture decreases as fast as possible; each pixel at most doubles. The render
///          ends when the noise of the picture is below the target. With
///          RenderBudget::every_pixel, passes take the pixels whose noise is above the target
///          to the next n_k, and the render ends when no pixel is above it.
///          With Distribution::SecondHalf the last pass distributes half of the samples likewise,
///          by the noise of the pixels around each pixel; with EveryPass, each pass from 16 samples
///          on, which increases them by half.
///          All this is decided between passes from the film alone, so the picture is the same for
///          any number of threads.
///          A part of a picture draws the samples of its tiles. Passes that distribute samples
///          depend on the whole film: before them the part ends, see next_targets() and
///          raise_targets().
///          Noise of a pixel: error of its brightness over sqrt(L M), L its brightness and M the
///          picture's. Dark regions may thus be noisier than bright ones, which is less visible
///          there, and the noise does not depend on the unit of the scene. The error is the
///          change of the pixel when its number of samples was last doubled. Samples are
///          distributed by the geometric mean of this and of the standard error. A pixel is judged
///          by the mean square of its neighbourhood, to whose 121 pixels it contributes one:
///          judged by its own samples, pixels that lack a rare bright sample would stop early and
///          stay too dark.
/// Source:  H. Dammertz et al., "A Hierarchical Automatic Stopping Condition for Monte Carlo Global
///          Illumination", WSCG 2010 (error over the square root of brightness).
/// Checked: Progressive.* in progressive_test.cpp
class Progressive {
 public:
  /// The state of a render; with the film it is sufficient to continue later.
  struct State {
    std::int32_t pass = 0;
    std::vector<std::uint32_t> targets;  ///< samples that each pixel reaches in the running pass
    double elapsed = 0;                  ///< seconds, of all runs
  };
  /// `progress` is called a few times per second from any thread, never concurrently; `pass` after
  /// each pass, while the film does not change. `wants_pause` is called often, from any thread;
  /// after it returned true, all threads stop between two samples, and `paused` is called once.
  /// Then the pass continues.
  /// `spread` may be empty; else it calls the function for tiles, concurrently, in place of a loop
  /// on this machine, until all of them have their samples or `stops` returns true; other processes
  /// may render some of them.
  using TileLoop = std::function<void(const std::vector<int>& tiles,
                                      const std::function<void(int tile)>& render_tile,
                                      const std::function<bool()>& stops)>;
  struct Callbacks {
    std::function<void(const Progress&)> progress, pass;
    std::function<bool()> wants_pause;
    std::function<void()> paused;
    TileLoop spread;
  };

  Progressive(Film& film, const RenderBudget& budget, const PicturePart& part = {});

  /// Calls sample(x, y, index, FilmSample&) for each sample, concurrently.
  /// Inputs:  cancel: ends the render soon after it becomes true; may be null.
  template <class Sample>
  StopReason run(const Sample& sample, const Callbacks& callbacks = {},
                 const std::atomic<bool>* cancel = nullptr);

  /// Draws the samples of tiles up to given targets: the work of another process. Each thread calls
  /// next() until there is no tile, and drawn() after a tile.
  template <class Sample>
  void draw_tiles(const Sample& sample, const std::function<std::optional<int>()>& next,
                  const std::function<void(int)>& drawn, const std::atomic<bool>* cancel = nullptr);
  /// Sets targets of pixels without tests, before draw_tiles().
  std::vector<std::uint32_t>& targets() { return state_.targets; }
  /// Counts samples that another process drew.
  void count_drawn(std::uint64_t samples) { drawn_ += samples; }

  /// Counts the time from then on; before the first run.
  void begin_at(std::chrono::steady_clock::time_point start);
  /// Continues another render with the same budget; before the first run and begin_at(). The film
  /// is that of the state.
  /// Returns: false if the state fits neither film nor budget; it is then unchanged.
  bool restore(State state);

  /// Decides on the film as it is, without drawing samples, whether the render is done.
  /// Returns: why it is; nothing if next_targets() has more samples.
  std::optional<StopReason> judge();
  /// The samples that each pixel reaches in the pass after judge().
  const std::vector<std::uint32_t>& next_targets() const { return next_.targets; }
  /// Sets the targets of the running pass, which only increase; those of other parts are ignored.
  /// Returns: false if they do not fit film and budget; nothing is changed then.
  bool raise_targets(const std::vector<std::uint32_t>& targets);

  const State& state() const { return state_; }
  Progress progress() const;
  /// The pixels of the part, tile by tile.
  const std::vector<std::uint32_t>& pixels() const { return pixels_; }

 private:
  struct Row {
    int x0, x1, y;
  };
  /// Samples between tests whether a row has to stop: at most a few milliseconds.
  static constexpr std::uint64_t kSamplesBetweenTests = 64;
  template <class Sample>
  std::function<std::uint64_t(const Row&)> row_renderer(const Sample& sample,
                                                        const Callbacks& callbacks,
                                                        const std::atomic<bool>* cancel);
  void loop_over(const std::function<std::optional<int>()>& next,
                 const std::function<std::uint64_t(const Row&)>& render_row,
                 const std::function<void(int)>& drawn, const std::atomic<bool>* cancel);
  StopReason run_rows(const std::function<std::uint64_t(const Row&)>& render_row,
                      const Callbacks& callbacks, const std::atomic<bool>* cancel);
  void run_pass(const std::function<std::uint64_t(const Row&)>& render_row,
                const Callbacks& callbacks, const std::atomic<bool>* cancel);
  /// The pass that follows the present film.
  struct Plan {
    std::optional<StopReason> stop;      ///< instead of a pass
    std::vector<std::uint32_t> targets;  ///< as in State
    double missing = 0;                  ///< estimated samples of all pixels until the end
  };
  Plan plan(const std::vector<Film::Estimate>& estimates, float noise) const;
  bool plan_grows() const;
  std::optional<StopReason> plan_stops() const;
  void plan_for_picture(Plan& plan, const std::vector<Film::Estimate>& estimates,
                        float noise) const;
  void plan_for_pixels(Plan& plan, const std::vector<Film::Estimate>& estimates) const;
  void plan_distribution(Plan& plan, const std::vector<Film::Estimate>& estimates) const;
  /// blur_square() or average_neighbours().
  using Pool = void (*)(std::vector<float>& values, int width, int height, int radius);
  std::vector<PixelDemand> demands(const std::vector<Film::Estimate>& estimates, Pool pool) const;
  std::optional<StopReason> begin_pass();
  void render_tile(int tile, const std::function<std::uint64_t(const Row&)>& render_row,
                   const Callbacks& callbacks, const std::atomic<bool>* cancel);
  void estimate(double seconds_of_run, double samples_of_run);
  std::vector<float> pooled_variance(const std::vector<Film::Estimate>& estimates,
                                     float Film::Estimate::*error, Pool pool) const;
  double mean_samples() const;
  double done_share(double mean_samples) const;
  bool pass_is_complete() const;
  std::vector<int> incomplete_tiles() const;
  double elapsed() const;
  /// Without the time of earlier runs, from whose checkpoint this one continues.
  double elapsed_here() const { return elapsed() - elapsed_elsewhere_; }
  bool out_of_time() const;
  bool must_stop(const Callbacks& callbacks, const std::atomic<bool>* cancel);

  Film& film_;
  RenderBudget budget_;
  bool is_whole_;
  std::vector<int> tiles_;             ///< of the part
  std::vector<std::uint32_t> pixels_;  ///< of the tiles
  State state_;
  Progress last_;              ///< as of the last complete pass
  Plan next_;                  ///< the same
  double samples_in_all_ = 0;  ///< estimated mean number of samples at the end
  std::uint64_t pass_start_samples_ = 0;
  std::atomic<std::uint64_t> drawn_{0};  ///< in this run
  std::atomic<bool> timed_out_{false}, cancelled_{false}, paused_{false};
  double elapsed_elsewhere_ = 0;
  std::chrono::steady_clock::time_point start_;
  std::mutex report_mutex_;
  double last_report_ = 0;
};

/// Error of a pixel, relative to the brightness of pixel and picture, see Progressive.
float relative_noise(float error, const Film::Estimate& estimate, float picture_brightness);

/// The largest noise that a pixel contributes to the noise of the picture: a pixel that is wrong as
/// a whole is not seen to get worse, and a few outliers must not decide when a render ends.
inline constexpr float kMaxPixelNoise = 1;

/// The error of all samples relative to the change at the last doubling of their number, as
/// extrapolated from the last two changes: 1 of independent samples; less if evenly spread samples
/// make the error fall faster than with the root of their number, beyond one standard error of the
/// squares.
float convergence_gain(const std::vector<Film::Estimate>& estimates, float picture_brightness);

/// Noise of the picture: root of the mean over pixels of the squared relative_noise() of their
/// changes, each at most kMaxPixelNoise, times convergence_gain(). Infinite before the second
/// sample.
float picture_noise(const std::vector<Film::Estimate>& estimates, float picture_brightness);

/// Estimates of all pixels.
std::vector<Film::Estimate> film_estimates(const Film& film);

/// Brightness of the picture for noise estimates: the square of the mean root of the pixels'
/// brightness, which a few visible lights hardly change.
float picture_brightness(const std::vector<Film::Estimate>& estimates);

/// The target of the pass after the one with the target `samples`.
std::uint32_t next_pass_target(std::uint32_t samples);

template <class Sample>
std::function<std::uint64_t(const Progressive::Row&)> Progressive::row_renderer(
    const Sample& sample, const Callbacks& callbacks, const std::atomic<bool>* cancel) {
  return [this, &sample, &callbacks, cancel](const Row& row) {
    std::uint64_t drawn = 0;
    for (int x = row.x0; x < row.x1; ++x) {
      const auto pixel = static_cast<std::size_t>(row.y) * static_cast<std::size_t>(film_.width()) +
                         static_cast<std::size_t>(x);
      for (std::uint32_t i = film_.samples(pixel); i < state_.targets[pixel]; ++i) {
        FilmSample s;
        sample(x, row.y, i, s);
        film_.add(x, row.y, s);
        if (++drawn % kSamplesBetweenTests == 0 && must_stop(callbacks, cancel)) return drawn;
      }
    }
    return drawn;
  };
}

template <class Sample>
StopReason Progressive::run(const Sample& sample, const Callbacks& callbacks,
                            const std::atomic<bool>* cancel) {
  return run_rows(row_renderer(sample, callbacks, cancel), callbacks, cancel);
}

template <class Sample>
void Progressive::draw_tiles(const Sample& sample, const std::function<std::optional<int>()>& next,
                             const std::function<void(int)>& drawn,
                             const std::atomic<bool>* cancel) {
  const Callbacks none;
  loop_over(next, row_renderer(sample, none, cancel), drawn, cancel);
}

}  // namespace oriel
