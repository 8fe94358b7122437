// SPDX-License-Identifier: Apache-2.0
// Portals reduce the noise in a room that the sky lights through a window.
#include "base/parallel.h"
#include "color/luminance.h"
#include "support/portal_scenes.h"

namespace oriel::testing {
namespace portal_noise_test {

constexpr int kWidth = 24, kHeight = 18;
constexpr std::size_t kPixels = std::size_t{kWidth} * kHeight;

/// A picture of the room from its window under construction, a sample of every pixel at a time.
class Picture {
 public:
  Picture(const World& world, std::uint32_t seed) : world_(world), seed_(seed), sum_(kPixels, 0) {}

  void add_sample() {
    std::vector<RayCounts> counts(kHeight);
    parallel_for(kHeight, [&](std::size_t line) {
      for (int x = 0; x < kWidth; ++x) {
        const int y = static_cast<int>(line);
        sampling::Sampler sampler(x, y, samples_, seed_);
        const Vec2 raster = Vec2(static_cast<float>(x), static_cast<float>(y)) + sampler.next_2d();
        const Rgb c =
            trace_path(world_, world_.camera.ray(raster), raster, {}, sampler, counts[line])
                .radiance;
        sum_[line * kWidth + static_cast<std::size_t>(x)] += double(luminance(c));
      }
    });
    for (const RayCounts& c : counts) rays_ += c.rays();
    ++samples_;
  }
  double at(std::size_t i) const { return sum_[i] / samples_; }
  std::uint64_t rays() const { return rays_; }

  /// Mean over pixels of the squared difference by the squared value of `exact`.
  double relative_error(const Picture& exact) const {
    double sum = 0;
    for (std::size_t i = 0; i < kPixels; ++i) {
      const double share = (at(i) - exact.at(i)) / exact.at(i);
      sum += share * share;
    }
    return sum / double(kPixels);
  }

 private:
  const World& world_;
  std::uint32_t seed_, samples_ = 0;
  std::uint64_t rays_ = 0;
  std::vector<double> sum_;  // double: hundreds of samples
};

/// n x n portals; none for 0.
Probe furnished(int n) {
  SceneText scene = room(kSky, .6f);
  scene.camera(fmt::format("focal 1 aperture 1.6 aspect 1.33333 resolution {} {}", kWidth, kHeight),
               "0 0 -1 0  -1 0 0 0  0 1 0 0  0 -1.5 .1 1");
  scene.box("wall", Vec3(2, .5f, 0), Vec3(3, 1.5f, .8f));
  if (n > 0) add_window(scene, n, "\"cutoff_threshold\" 0");
  return probe_of(scene);
}

// Rays stand for time, which a test cannot count on; portal_bench measures time. Everything is
// drawn from fixed seeds, so nothing here depends on chance.
// acceptance: L9
TEST(Portal, MakesNoiseFiveTimesLowerWithNoMoreRays) {
  constexpr int kSamples = 48, kReferenceSamples = 512;
  constexpr double kGain = 5;
  Probe open = furnished(0);
  open.without_openings();
  const Probe one = furnished(1);
  Picture exact(one.world(), 1);
  for (int s = 0; s < kReferenceSamples; ++s) exact.add_sample();
  Picture without(open.world(), 2);
  for (int s = 0; s < kSamples; ++s) without.add_sample();
  const double noise = without.relative_error(exact);
  for (const int n : {1, 4}) {
    const Probe probe = furnished(n);
    Picture with(probe.world(), 3);
    std::uint64_t last = 0;  // rays of one more sample
    while (with.rays() + last <= without.rays()) {
      const std::uint64_t before = with.rays();
      with.add_sample();
      last = with.rays() - before;
    }
    ASSERT_LE(with.rays(), without.rays());
    ASSERT_GT(with.rays(), without.rays() * 9 / 10);
    const double gain = noise / with.relative_error(exact);
    EXPECT_GE(gain, kGain) << n * n << " portals";
    figure(fmt::format("noise without portals by that of {}", n * n), kGain, gain, 0);
  }
}

}  // namespace portal_noise_test
}  // namespace oriel::testing
