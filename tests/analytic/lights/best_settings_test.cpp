// SPDX-License-Identifier: Apache-2.0
// The choice among several settings of paths, by pilot paths and by what is usual.
#include "render/best_settings.h"

#include "support/probe.h"

namespace oriel::testing {
namespace best_settings_test {

/// A lamp of 1 x 1 over a floor: samples of the lamp are far less noisy than rays that find it.
class LampOverFloor {
 public:
  LampOverFloor() : probe_(scene()) {}

  /// The estimator that is chosen. Inputs:  paths: of the picture; usual: usual gain of light
  /// samples over rays.
  Estimator chosen(double paths, float usual) {
    IntegratorPreparation p{.window = kPicture,
                            .picture = kPicture,
                            .paths = paths,
                            .files = files_,
                            .diagnostics = diagnostics_,
                            .monitor = monitor_,
                            .after_pass = {},
                            .counts = counts_};
    PathSettings rays, samples;
    rays.estimator = Estimator::BsdfOnly;
    samples.estimator = Estimator::LightOnly;
    BestSettings best(probe_.world(), p, rays);
    const BestSettings::Candidate candidates[] = {{samples, usual}};
    best.choose(candidates);
    return best.settings().estimator;
  }

 private:
  static constexpr Window kPicture{0, 0, 32, 32};
  static SceneText scene() {
    SceneText scene;
    scene.lambert("white", .5f).plate("white");
    scene.light("lamp",
                "\"physical_light\" ( \"color\" 9 9 9 ) origin 0 0 1 direction 0 0 -1 "
                "rectangle 1 0 0 0 1 0 3 3");
    return scene.camera("focal 1 aperture 1 aspect 1 resolution 32 32",
                        "transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 -4 1");
  }

  Probe probe_;
  MapFiles files_;
  Diagnostics diagnostics_;
  ProgressMonitor monitor_;
  RayCounts counts_;
};

/// Paths of pictures with 256 and with 4096 pixels of pilot paths.
constexpr double kFew = 1, kMany = 1e9;
constexpr float kHardlyUsual = 1e-6f;

TEST(BestSettings, TakeWhatGains) {
  LampOverFloor lamp;
  EXPECT_EQ(lamp.chosen(kFew, 1), Estimator::LightOnly);
  EXPECT_EQ(lamp.chosen(kMany, 1), Estimator::LightOnly);
}

TEST(BestSettings, WithFewPilotPathsWhatIsUsualCountsAsMuch) {
  // With equal shares, a usual gain of 1e-6 outweighs any measured gain below 1e6.
  LampOverFloor lamp;
  EXPECT_EQ(lamp.chosen(kFew, kHardlyUsual), Estimator::BsdfOnly);
}

TEST(BestSettings, ManyPilotPathsOutweighWhatIsUsual) {
  // With a share of 16/17, a measured gain of 3 outweighs it.
  LampOverFloor lamp;
  EXPECT_EQ(lamp.chosen(kMany, kHardlyUsual), Estimator::LightOnly);
}

}  // namespace best_settings_test
}  // namespace oriel::testing
