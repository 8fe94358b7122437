// SPDX-License-Identifier: Apache-2.0
#include "render/progressive.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <thread>

#include "base/parallel.h"
#include "render/budget.h"
#include "sampling/sampler.h"

namespace oriel {
namespace progressive_test {

constexpr int kWidth = 50, kHeight = 40;  // no multiple of a tile

FilterSampler box() { return FilterSampler(scene::PixelFilter{}); }

/// Grey 1, on the right half with noise of independent samples: 1 / sqrt(3 n) of n samples.
void noisy_half(int x, int y, std::uint32_t index, FilmSample& s) {
  sampling::Sampler sampler(x, y + kHeight * static_cast<int>(index), 0);
  const float noise = x < kWidth / 2 ? 0 : 2 * sampler.next_1d() - 1;
  s.beauty = Rgb(1 + noise);
  s.alpha = 1;
}

bool same_bytes(const Film& a, const Film& b) {
  return a.positive().size() == b.positive().size() &&
         std::memcmp(a.positive().data(), b.positive().data(),
                     a.positive().size() * sizeof(PixelMeans)) == 0;
}

Film rendered(int threads, const RenderBudget& budget) {
  const ThreadLimit limit(threads);
  Film film(kWidth, kHeight, box());
  Progressive(film, budget).run(noisy_half);
  return film;
}

TEST(Progressive, OneAndTwoThreadsGiveTheSameBytes) {
  const RenderBudget budget{.max_samples = 96, .noise = 0.08f};
  EXPECT_TRUE(same_bytes(rendered(1, budget), rendered(2, budget)));
}

TEST(Progressive, QuietPixelsStopAtSixteenSamples) {
  const Film film = rendered(0, {.max_samples = 256, .noise = 0.03f});
  EXPECT_EQ(film.samples(3, 3), kMinJudgedSamples);
  EXPECT_GT(film.samples(kWidth - 3, 3), 100u);
}

TEST(Progressive, PixelsAreJudgedByTheirNeighbourhood) {
  const Film film = rendered(0, {.max_samples = 64, .noise = 0.001f});
  EXPECT_EQ(film.samples(kWidth / 2 - 5, 10), 64u);
  EXPECT_EQ(film.samples(kWidth / 2 - 6, 10), kMinJudgedSamples);
}

TEST(Progressive, NeighboursInAllDirectionsGoOn) {
  Film film(kWidth, kHeight, box());
  Progressive(film, {.max_samples = 64, .noise = 1e-7f})
      .run([](int x, int y, std::uint32_t index, FilmSample& s) {
        sampling::Sampler sampler(x, y, index);
        s.beauty = Rgb(x == 20 && y == 30 ? sampler.next_1d() : 1.0f);
      });
  for (int y = 22; y <= 38; ++y)
    for (int x = 12; x <= 28; ++x) {
      const bool near = std::abs(x - 20) <= 5 && std::abs(y - 30) <= 5;
      EXPECT_EQ(film.samples(x, y), near ? 64u : kMinJudgedSamples) << x << ' ' << y;
    }
}

TEST(Progressive, EveryPixelReachesTheNoiseTarget) {
  const float target = 0.05f;
  Film film(kWidth, kHeight, box());
  Progressive run(film, {.max_samples = 4096, .noise = target, .every_pixel = true});
  EXPECT_EQ(run.run(noisy_half), StopReason::Noise);
  const float picture = picture_brightness(film_estimates(film));
  for (std::size_t i = 0; i < film.pixel_count(); ++i)
    EXPECT_LE(relative_noise(film.estimate(i).error, film.estimate(i), picture), target);
}

TEST(Progressive, PictureReachesTheNoiseTarget) {
  for (const float target : {.05f, .03f, .02f}) {
    Film film(kWidth, kHeight, box());
    Progressive run(film, {.max_samples = 1u << 16, .noise = target});
    EXPECT_EQ(run.run(noisy_half), StopReason::Noise);
    // The true picture is 1 everywhere.
    double sum = 0;
    for (std::size_t i = 0; i < film.pixel_count(); ++i)
      sum += sqr(double{film.estimate(i).mean} - 1);
    const double error = std::sqrt(sum / static_cast<double>(film.pixel_count()));
    EXPECT_LT(error, 1.25 * target);
    EXPECT_GT(error, .75 * target) << "no more samples than needed";
    EXPECT_LE(*run.progress().noise, target);
  }
}

/// Light that one sample in 50 finds; 16 samples of most pixels all miss it.
void rare_light(int x, int y, std::uint32_t index, FilmSample& s) {
  sampling::Sampler sampler(x, y + kHeight * static_cast<int>(index), 0);
  s.beauty = Rgb(.5f + (sampler.next_1d() < .02f ? 25.0f : 0));
}

TEST(Progressive, RareLightIsNoticedAndNotLost) {
  for (const float target : {.3f, .2f}) {
    Film film(kWidth, kHeight, box());
    Progressive run(film, {.max_samples = 1u << 16, .noise = target});
    EXPECT_EQ(run.run(rare_light), StopReason::Noise);
    double sum = 0, squares = 0;  // the true picture is 1 everywhere
    for (std::size_t i = 0; i < film.pixel_count(); ++i) {
      const double mean = film.estimate(i).mean;
      sum += mean;
      squares += std::min(sqr(mean - 1) / mean, 1.0);
    }
    const auto pixels = static_cast<double>(film.pixel_count());
    EXPECT_NEAR(std::sqrt(squares / pixels) / target, 1, .25) << target;
    // Four standard errors of 2000 pixels with that noise.
    EXPECT_NEAR(sum / pixels, 1, 4 * target / std::sqrt(pixels)) << target;
  }
}

/// Independent samples of mean 1.
struct NoisyPicture {
  const char* name;
  float target;
  float (*deviation)(int x);              ///< of one sample
  float (*sample)(int x, float uniform);  ///< the value of a number in 0..1
};

/// Noise .2 in the left half, 1 in the right half.
float two_deviations(int x) { return x < kWidth / 2 ? .2f : 1; }
/// Noise .02 at the left border to 1.5 at the right border.
float ramp(int x) { return .02f + 1.48f * static_cast<float>(x) / (kWidth - 1); }
/// One column of eleven is noisy.
float stripes(int x) { return x % 11 == 5 ? 1 : .02f; }
/// The deviation of a value 1 / p with probability p, which is else 0.
float spikes(int x) { return x < kWidth / 2 ? 7 : .1f; }

float uniform_noise(float deviation, float u) {
  return 1 + deviation * std::sqrt(3.0f) * (2 * u - 1);
}

const NoisyPicture kNoisyPictures[] = {
    {"two deviations", .05f, two_deviations,
     [](int x, float u) { return uniform_noise(two_deviations(x), u); }},
    {"two deviations, small target", .02f, two_deviations,
     [](int x, float u) { return uniform_noise(two_deviations(x), u); }},
    {"ramp", .05f, ramp, [](int x, float u) { return uniform_noise(ramp(x), u); }},
    {"stripes", .02f, stripes, [](int x, float u) { return uniform_noise(stripes(x), u); }},
    {"spikes", .1f, spikes,
     [](int x, float u) {
       return x < kWidth / 2 ? (u < .02f ? 50.0f : 0) : uniform_noise(spikes(x), u);
     }},
};

/// Renders a picture to its target.
void render_noisy(const NoisyPicture& picture, std::uint64_t seed, Film& film) {
  Progressive run(film, {.max_samples = 1u << 16, .noise = picture.target});
  EXPECT_EQ(run.run([&](int x, int y, std::uint32_t index, FilmSample& s) {
    sampling::Sampler sampler(x, y + film.height() * static_cast<int>(index), 0, seed);
    s.beauty = Rgb(picture.sample(x, sampler.next_1d()));
  }),
            StopReason::Noise);
}

TEST(Progressive, TheTrueErrorAtTheEndIsTheTarget) {
  for (const NoisyPicture& picture : kNoisyPictures) {
    Film film(kWidth, kHeight, box());
    render_noisy(picture, 1, film);
    double sum = 0;  // the true picture is 1 everywhere
    for (std::size_t i = 0; i < film.pixel_count(); ++i) sum += sqr(film.estimate(i).mean - 1);
    const double error = std::sqrt(sum / static_cast<double>(film.pixel_count()));
    EXPECT_NEAR(error / picture.target, 1, .25) << picture.name;
  }
}

TEST(Progressive, NoisyPixelsGetSamplesInProportionToTheirDeviation) {
  const NoisyPicture& picture = kNoisyPictures[0];
  Film film(kWidth, kHeight, box());
  render_noisy(picture, 1, film);
  // (mean deviation)^2 / target^2, while uniform sampling needs the mean of the squares.
  const double target2 = sqr(picture.target), best = .36 / target2, uniform = .52 / target2;
  EXPECT_GT(film.mean_samples(), .85 * best);
  EXPECT_LT(film.mean_samples(), .5 * (best + uniform));
  double error2 = 0, uniform2 = 0;
  for (std::size_t i = 0; i < film.pixel_count(); ++i) {
    error2 += sqr(film.estimate(i).mean - 1);
    uniform2 += sqr(two_deviations(static_cast<int>(i % kWidth))) / film.mean_samples();
  }
  EXPECT_LT(error2, .85 * uniform2) << "the error of uniform sampling with as many samples";
}

TEST(Progressive, AdaptiveMeansAreUnbiased) {
  for (const NoisyPicture& picture : kNoisyPictures) {
    double off = 0, variance = 0;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
      Film film(kWidth, 2 * kHeight, box());
      render_noisy(picture, seed, film);
      for (std::size_t i = 0; i < film.pixel_count(); ++i) {
        off += film.estimate(i).mean - 1;
        variance += sqr(picture.deviation(static_cast<int>(i % kWidth))) /
                    static_cast<double>(film.samples(i));
      }
    }
    // Four standard errors.
    EXPECT_LT(std::abs(off), 4 * std::sqrt(variance)) << picture.name << ' ' << off;
  }
}

TEST(Progressive, AFewPixelsWithoutEndDoNotKeepThePictureFromItsTarget) {
  Film film(kWidth, kHeight, box());
  Progressive run(film, {.max_samples = 1u << 12, .noise = .1f});
  const StopReason reason = run.run([](int x, int y, std::uint32_t index, FilmSample& s) {
    noisy_half(x, y, index, s);
    // One pixel of 2000 with a sample in 64 that is a million times too bright.
    if (x == 7 && y == 7 && index % 64 == 5) s.beauty = Rgb(1e6f);
  });
  EXPECT_EQ(reason, StopReason::Noise);
  EXPECT_LT(film.mean_samples(), 100);
}

TEST(Progressive, TheShareOfTheWorkGrowsToOne) {
  Film film(kWidth, kHeight, box());
  Progressive run(film, {.max_samples = 1u << 16, .noise = .02f});
  std::vector<Progress> passes;
  run.run(noisy_half, {{}, [&](const Progress& p) { passes.push_back(p); }});
  for (std::size_t i = 1; i < passes.size(); ++i) EXPECT_GE(passes[i].done, passes[i - 1].done);
  EXPECT_NEAR(passes.back().done, 1, .05);
  // From the second judged pass on the estimate of the whole is good: 1 / (6 target^2) samples.
  const double whole = film.mean_samples();
  for (std::size_t i = 6; i < passes.size(); ++i)
    EXPECT_NEAR(passes[i].mean_samples / passes[i].done, whole, .35 * whole) << i;
}

TEST(Progressive, WithoutTargetEveryPixelGetsTheRequestedSamples) {
  for (const std::uint32_t samples : {1u, 5u, 16u, 100u}) {
    const Film film = rendered(0, {.max_samples = samples});
    for (std::size_t i = 0; i < film.pixel_count(); ++i) EXPECT_EQ(film.samples(i), samples);
  }
}

void noisy_picture_of_two_deviations(int x, int y, std::uint32_t index, FilmSample& s) {
  sampling::Sampler sampler(x, y + kHeight * static_cast<int>(index), 0);
  s.beauty = Rgb(uniform_noise(two_deviations(x), sampler.next_1d()));
}

/// Samples of the pixels of the quiet half relative to those of the noisy half, without those whose
/// neighbourhood is in both.
double quiet_to_noisy(const Film& film) {
  double quiet = 0, noisy = 0;
  for (std::size_t i = 0; i < film.pixel_count(); ++i) {
    const auto x = static_cast<int>(i % kWidth);
    if (x < kWidth / 2 - 5) quiet += film.samples(i);
    if (x >= kWidth / 2 + 5) noisy += film.samples(i);
  }
  return quiet / noisy;
}

TEST(Progressive, DistributedSamplesGoWhereTheNoiseIs) {
  for (const std::uint32_t samples : {16u, 31u, 32u, 64u, 200u}) {
    const RenderBudget budget{.max_samples = samples, .distribution = Distribution::SecondHalf};
    Film film(kWidth, kHeight, box());
    Progressive run(film, budget);
    EXPECT_EQ(run.run(noisy_picture_of_two_deviations), StopReason::Samples);
    double error2 = 0;
    for (std::size_t i = 0; i < film.pixel_count(); ++i) {
      EXPECT_GE(film.samples(i), budget.even_samples());
      EXPECT_LE(film.samples(i), 4 * samples);
      error2 += sqr(film.estimate(i).mean - 1);
    }
    EXPECT_NEAR(film.mean_samples(), samples, .001 * samples);
    // Samples in proportion to the deviations, 1 : 5, would give a quiet pixel a third of the mean.
    // It already has more, its even samples, so the noisy half gets all others.
    EXPECT_NEAR(quiet_to_noisy(film),
                budget.even_samples() / (2.0 * samples - budget.even_samples()), .02);
    EXPECT_LT(error2 / static_cast<double>(film.pixel_count()), .8 * .52 / samples)
        << "of as many samples in every pixel: .52 / samples";
  }
}

// One sample in 500 finds light, which is nearly all noise by which samples are distributed.
TEST(Progressive, DistributedMeansAreUnbiased) {
  double off = 0, variance = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Film film(kWidth, kHeight, box());
    Progressive(film, {.max_samples = 32, .distribution = Distribution::SecondHalf})
        .run([seed](int x, int y, std::uint32_t index, FilmSample& s) {
          sampling::Sampler sampler(x, y + kHeight * static_cast<int>(index), 0, seed);
          s.beauty = Rgb(.5f + (sampler.next_1d() < .002f ? 250.0f : 0));
        });
    for (std::size_t i = 0; i < film.pixel_count(); ++i) {
      off += film.estimate(i).mean - 1;
      variance += sqr(250) * .002 * .998 / film.samples(i);
    }
  }
  EXPECT_LT(std::abs(off), 4 * std::sqrt(variance)) << "four standard errors";
}

TEST(Progressive, TheTimeIsSpentWhereTheNoiseIs) {
  const RenderBudget budget{
      .max_samples = 1u << 20, .distribution = Distribution::EveryPass, .seconds = 3600};
  Film film(kWidth, kHeight, box());
  Progressive run(film, budget);
  std::atomic<bool> cancel{false};
  std::vector<double> means;
  run.run(noisy_picture_of_two_deviations,
          {{},
           [&](const Progress& p) {
             means.push_back(p.mean_samples);
             cancel = p.mean_samples >= 200;
           }},
          &cancel);
  // 1, 2, 4, 8, 16 samples, then half more in each pass.
  ASSERT_GT(means.size(), 6u);
  EXPECT_EQ(means[4], 16);
  for (std::size_t i = 5; i < means.size(); ++i)
    EXPECT_NEAR(means[i] / means[i - 1], 1.5, .05) << i;
  EXPECT_NEAR(quiet_to_noisy(film), .2, .03) << "in proportion to the deviations";
}

TEST(Progressive, PartsOfDistributedSamplesEndBeforeTheSecondHalf) {
  const RenderBudget budget{.max_samples = 64, .distribution = Distribution::SecondHalf};
  Film film(kWidth, kHeight, box());
  for (const int number : {1, 2}) {
    Progressive part(film, budget, {number, 2});
    EXPECT_EQ(part.run(noisy_half), StopReason::Part);
    for (const std::uint32_t i : part.pixels()) EXPECT_EQ(film.samples(i), 32u);
  }
  Progressive whole(film, budget);
  EXPECT_EQ(whole.judge(), std::nullopt);
  for (const int number : {1, 2}) {
    Progressive part(film, budget, {number, 2});
    ASSERT_TRUE(part.raise_targets(whole.next_targets()));
    EXPECT_EQ(part.run(noisy_half), StopReason::Part);
  }
  EXPECT_EQ(whole.judge(), StopReason::Samples);
  EXPECT_TRUE(same_bytes(film, rendered(0, budget)));
}

TEST(Progressive, GoingOnFromAStateGivesTheSameBytes) {
  for (const RenderBudget& budget :
       {RenderBudget{.max_samples = 192, .noise = 0.05f},
        RenderBudget{.max_samples = 192, .distribution = Distribution::SecondHalf}})
    for (const int passes : {3, 6, 7}) {
      Film film(kWidth, kHeight, box());
      std::atomic<bool> cancel{false};
      Progressive first(film, budget);
      const auto stop = [&](const Progress& p) { cancel = p.pass == passes; };
      EXPECT_EQ(first.run(noisy_half, {{}, stop}, &cancel), StopReason::Cancelled);
      Progressive second(film, budget);
      ASSERT_TRUE(second.restore(first.state()));
      second.run(noisy_half);
      EXPECT_TRUE(same_bytes(film, rendered(0, budget))) << passes;
    }
}

TEST(Progressive, GoingOnFromAnInterruptedPassGivesTheSameBytes) {
  const RenderBudget target{.max_samples = 192, .noise = 0.05f};
  const RenderBudget distributed{.max_samples = 192, .distribution = Distribution::SecondHalf};
  for (const auto& [budget, stop_after] :
       {std::pair(target, 1000), std::pair(target, 40'000), std::pair(target, 60'000),
        std::pair(distributed, 60'000), std::pair(distributed, 250'000)}) {
    Film film(kWidth, kHeight, box());
    std::atomic<bool> cancel{false};
    std::atomic<int> left{stop_after};
    Progressive first(film, budget);
    const StopReason reason = first.run(
        [&](int x, int y, std::uint32_t index, FilmSample& s) {
          if (--left == 0) cancel = true;
          noisy_half(x, y, index, s);
        },
        {}, &cancel);
    EXPECT_EQ(reason, StopReason::Cancelled);
    Progressive second(film, budget);
    ASSERT_TRUE(second.restore(first.state()));
    second.run(noisy_half);
    EXPECT_TRUE(same_bytes(film, rendered(0, budget))) << stop_after;
  }
}

TEST(Progressive, TimeLimitEndsTheRenderButNotBeforeTheFirstPass) {
  Film film(kWidth, kHeight, box());
  Progressive run(film, {.max_samples = 1u << 20, .seconds = 0.05});
  const auto slow = [](int x, int y, std::uint32_t index, FilmSample& s) {
    if (x == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    noisy_half(x, y, index, s);
  };
  EXPECT_EQ(run.run(slow), StopReason::Time);
  for (std::size_t i = 0; i < film.pixel_count(); ++i) EXPECT_GE(film.samples(i), 1u);
  EXPECT_LT(run.progress().elapsed, 5);
}

TEST(Progressive, ReportsEveryPassAndTheNoise) {
  Film film(kWidth, kHeight, box());
  Progressive run(film, {.max_samples = 64});
  std::vector<Progress> passes;
  run.run(noisy_half, {{}, [&](const Progress& p) { passes.push_back(p); }});
  ASSERT_EQ(passes.size(), 8u);  // 1 2 4 8 16 32 48 64
  EXPECT_FALSE(passes[0].noise);
  ASSERT_TRUE(passes[7].noise);
  EXPECT_DOUBLE_EQ(passes[7].mean_samples, 64);
  EXPECT_EQ(passes[7].active, 0);
  // Half of the pixels have none, the others uniform noise: 1 / sqrt(3) / sqrt(64).
  EXPECT_NEAR(*passes[7].noise, std::sqrt(0.5 / 3) / 8, 2e-3);
}

TEST(Progressive, CancellingEndsThePassAtTheNextRow) {
  const ThreadLimit limit(1);
  Film film(kWidth, kHeight, box());
  std::atomic<bool> cancel{false};
  int drawn = 0;
  Progressive run(film, {.max_samples = 4});
  const StopReason reason = run.run(
      [&](int x, int y, std::uint32_t index, FilmSample& s) {
        cancel = true;
        ++drawn;
        noisy_half(x, y, index, s);
      },
      {}, &cancel);
  EXPECT_EQ(reason, StopReason::Cancelled);
  EXPECT_LE(drawn, kWidth) << "the row that was begun";
}

TEST(Progressive, MeanSamplesGrowWithinAPass) {
  const ThreadLimit limit(1);
  Film film(kWidth, kHeight, box());
  Progressive run(film, {.max_samples = 4});
  std::vector<double> means;
  run.run([&](int x, int y, std::uint32_t index, FilmSample& s) {
    means.push_back(run.progress().mean_samples);
    noisy_half(x, y, index, s);
  });
  ASSERT_EQ(means.size(), 4 * film.pixel_count());
  // Samples are counted when their row of a tile, which is no wider than the picture, is done.
  for (std::size_t i = 0; i < means.size(); ++i) {
    const double before = static_cast<double>(i) / static_cast<double>(film.pixel_count());
    EXPECT_LE(means[i], before + 1e-9);
    EXPECT_GE(means[i], before - 1.0 / kHeight);
  }
}

TEST(Progressive, NoiseDoesNotDependOnTheUnitOfTheScene) {
  EXPECT_FLOAT_EQ(relative_noise(.1f, {.mean = .5f}, .7f), relative_noise(100, {.mean = 500}, 700));
}

TEST(Progressive, PassesGrowByAlignedBlocks) {
  std::vector<std::uint32_t> targets;
  for (std::uint32_t n = 0; n < 300;) targets.push_back(n = next_pass_target(n));
  EXPECT_EQ(targets,
            (std::vector<std::uint32_t>{1, 2, 4, 8, 16, 32, 48, 64, 96, 128, 192, 256, 384}));
}

TEST(Budget, FollowsSamplesAndContrast) {
  scene::RenderOptions options;  // samples -2 0, contrast .1
  const RenderBudget positive = render_budget(options, {});
  EXPECT_EQ(positive.max_samples, kMinSceneSamples);
  EXPECT_EQ(positive.min_samples, kMinJudgedSamples);
  EXPECT_NEAR(positive.noise, 0.1 / (1.96 * std::sqrt(2.0)), 1e-4);
  options.samples_min = 3;
  options.samples_max = 4;
  options.contrast = Rgba(0.02f, 0.01f, 0.03f, 0.1f);
  const RenderBudget fine = render_budget(options, {});
  EXPECT_EQ(fine.max_samples, 256 * kPathSamplesPerSceneSample);
  EXPECT_EQ(fine.min_samples, 64u);
  EXPECT_NEAR(fine.noise, 0.01 / (1.96 * std::sqrt(2.0)), 1e-5);
}

TEST(Budget, OptionsOverrideTheScene) {
  const scene::RenderOptions options;
  EXPECT_EQ(render_budget(options, {.samples = 7}), (RenderBudget{.max_samples = 7}));
  EXPECT_EQ(render_budget(options, {.samples = 32}), (RenderBudget{.max_samples = 32}));
  EXPECT_EQ(render_budget(options, {.noise = 0.01f}),
            (RenderBudget{.max_samples = kMaxSamplesForNoise, .noise = 0.01f}));
  EXPECT_EQ(render_budget(options, {.seconds = 3}),
            (RenderBudget{.max_samples = kMaxSamples, .seconds = 3}));
}

TEST(Budget, DistributesSamplesFrom16OnWithoutANoiseTarget) {
  const scene::RenderOptions options;
  const auto distribution = [&](BudgetRequest request) {
    request.distributes = true;
    return render_budget(options, request).distribution;
  };
  EXPECT_EQ(distribution({.samples = 16}), Distribution::SecondHalf);
  EXPECT_EQ(distribution({.samples = 64, .seconds = 10}), Distribution::SecondHalf);
  EXPECT_EQ(distribution({.seconds = 10}), Distribution::EveryPass);
  EXPECT_EQ(distribution({.samples = 15}), Distribution::Even);
  EXPECT_EQ(distribution({.samples = 64, .noise = .01f}), Distribution::Even);
  EXPECT_EQ(distribution({.noise = .01f, .seconds = 10}), Distribution::Even);
  EXPECT_EQ(distribution({}), Distribution::Even) << "the scene's own target";
  EXPECT_EQ(render_budget(options, {.samples = 16}).distribution, Distribution::Even);
}

}  // namespace progressive_test
}  // namespace oriel
