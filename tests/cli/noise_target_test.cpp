// SPDX-License-Identifier: Apache-2.0
// oriel render --noise: the render ends where its true error is the target.
#include <cmath>
#include <ostream>
#include <vector>

#include "image/exr.h"
#include "support/program.h"

namespace oriel {
namespace noise_target_test {

/// A scene of scenes/, and a target that takes more than the minimum number of samples.
struct NoiseCase {
  const char* scene;
  const char* target;
};
void PrintTo(const NoiseCase& c, std::ostream* out) { *out << c.scene; }

class NoiseTarget : public ProgramTest, public ::testing::WithParamInterface<NoiseCase> {
 protected:
  /// Renders 48 x 32 pixels; returns the displayed picture.
  ExrFile rendered(const std::string& name, std::vector<std::string> options) const {
    const std::string scenes = std::string(ORIEL_SOURCE_DIR) + "/scenes";
    options.insert(options.begin(),
                   {"render", scenes + "/" + GetParam().scene, "-q", "-I", scenes, "--size",
                    "48x32", "--exr", "float", "--layers", "samples", "-o", name});
    const RunResult r = run(options);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return read_exr(file(name));
  }
};

double brightness(const Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return (double{p[0]} + p[1] + p[2]) / 3;
}

/// The documented noise of the picture (Progressive), with the difference from a second picture in
/// place of the estimated error.
double noise_of(const Image& image, const Image& other) {
  double roots = 0, squares = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) roots += std::sqrt(std::max(brightness(image, x, y), 0.));
  const auto pixels = static_cast<double>(image.pixel_count());
  const double picture = (roots / pixels) * (roots / pixels);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double b = brightness(image, x, y), error = b - brightness(other, x, y);
      squares += std::min(error * error / (std::max(b, .01 * picture) * picture), 1.);
    }
  return std::sqrt(squares / pixels);
}

// acceptance: M6
TEST_P(NoiseTarget, IsTheTrueErrorAtTheEnd) {
  const double target = std::stod(GetParam().target);
  const ExrFile first = rendered("a.exr", {"--noise", GetParam().target});
  const auto told = std::get<float>(first.metadata.at("oriel.noise"));
  const Image& samples = find_layer(first.layers, "samples")->image;
  double mean_samples = 0;
  for (int i = 0; i < 48 * 32; ++i) mean_samples += samples.at(i % 48, i / 48)[0] / (48 * 32);
  ASSERT_GT(mean_samples, 16) << "choose a smaller target";
  EXPECT_LE(told, target);
  // A picture of other random numbers that ended likewise has the same error, so their difference
  // has twice the variance.
  const ExrFile second = rendered("b.exr", {"--noise", GetParam().target, "--seed", "1"});
  const double error = noise_of(first.layers[0].image, second.layers[0].image) / std::sqrt(2.);
  RecordProperty("samples", std::to_string(mean_samples));
  RecordProperty("error", std::to_string(error / target));
  EXPECT_NEAR(error / target, 1, .25)
      << mean_samples << " samples, told " << told << ", error " << error;
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, NoiseTarget,
    ::testing::Values(NoiseCase{"guide/room.mi", ".1"}, NoiseCase{"interior/interior.mi", ".15"},
                      NoiseCase{"daylight.mi", ".03"}, NoiseCase{"round-corners.mi", ".03"},
                      NoiseCase{"profile-bulbs.mi", ".05"}, NoiseCase{"freeform.mi", ".01"},
                      NoiseCase{"manual/exposure/evening.mi", ".14"},
                      NoiseCase{"manual/material/translucency.mi", ".03"}));

}  // namespace noise_target_test
}  // namespace oriel
