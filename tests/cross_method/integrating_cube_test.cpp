// SPDX-License-Identifier: Apache-2.0
// Final gathering in a closed grey cube, whose mean indirect illuminance is known exactly.
#include "comparison.h"

namespace oriel::cross_method {
namespace integrating_cube_test {

// By flux conservation: a lamp of flux F in a closed room of area S and albedo r brings
// F r / (S (1 - r)) of indirect light to the walls in the mean. The camera in the middle sees just
// one wall, all parts of it alike, and the six are equal.
// acceptance: H2, H3
TEST(IntegratingCube, HasItsMeanIndirectIlluminanceByEveryMethod) {
  const struct {
    float albedo;
    double indirect;
  } kCases[] = {{.2f, 26.0417}, {.5f, 104.1667}, {.8f, 416.667}, {.9f, 937.5}};
  for (const auto& c : kCases) {
    SceneText scene(
        "trace depth 8 8 12 shadow segments finalgather on finalgather accuracy 400 "
        "finalgather trace depth 4 4 400 800 finalgather presample density 4 "
        "globillum on photon trace depth 400 400 800");
    scene.lambert("grey", c.albedo).box("grey", Vec3(-2), Vec3(2), true);
    // 10000 lm: a physical light sends pi times its colour.
    scene.light("lamp", fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} ) origin 0 0 0",
                                    10000 / kPi));
    scene.camera("focal 1 aperture 2 aspect 1 resolution 24 24");
    Comparison comparison(scene);
    for (const Method& method : {kFinalGather, kBoth}) {
      const Measured m = comparison.render(method, 4, 2);
      const double lux = m.indirect.mean * kPi / c.albedo,
                   error = m.indirect.error * kPi / c.albedo;
      EXPECT_NEAR(lux, c.indirect, .02 * c.indirect) << method.name << ", albedo " << c.albedo;
      if (figures_wanted())
        fmt::print("| cube, albedo {} | {} | {:.5g} | {:.5g} | {:.2g} | {:.4f} |\n", c.albedo,
                   method.name, c.indirect, lux, error, lux / c.indirect);
    }
  }
}

}  // namespace integrating_cube_test
}  // namespace oriel::cross_method
