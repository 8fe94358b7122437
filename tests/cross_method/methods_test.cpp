// SPDX-License-Identifier: Apache-2.0
// Path tracing, final gathering and photons agree.
#include "scenes.h"

namespace oriel::cross_method {
namespace methods_test {

/// Largest difference of the means of pictures.
constexpr double kTolerance = .02;
/// The same of paths that end at a cache.
constexpr double kCacheTolerance = .01;
/// Largest standard error of the reference.
constexpr double kReferenceError = .003;

struct Case {
  const char* name;
  SceneText (*scene)();
  std::uint32_t samples;  ///< of the reference, for a pixel of each of its pictures
  double indirect = 0;    ///< tolerance of the indirect part alone; 0 = not tested

  friend void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }
};

class Methods : public ::testing::TestWithParam<Case> {};

/// | scene | method | mean | its error | indirect | relative MSE | of it noise | seconds |
void print_row(const Case& c, const Method& method, const Measured& m, const Measured& paths) {
  if (!figures_wanted()) return;
  fmt::print("| {} | {} | {:.4f} | {:.4f} | {:.3f} | {:.2g} | {:.2g} | {:.2f} |\n", c.name,
             method.name, m.picture.mean / paths.picture.mean, m.picture.error / paths.picture.mean,
             m.indirect.mean / paths.indirect.mean, relative_mse(m.pixels, paths.pixels),
             m.noise_mse + (method.id == IndirectMethod::Path ? 0 : paths.noise_mse), m.seconds);
}

// Behind a portal gather rays from inside end at it; its light is direct, and that of photons where
// they stand for what comes after. Indirect light is a quarter of that picture.
// acceptance: H2, H3, H8, L1, Q1
TEST_P(Methods, GiveTheSameImage) {
  const Case& c = GetParam();
  Comparison comparison(c.scene());
  const Measured paths = comparison.render(kPath, c.samples, 4);
  EXPECT_LE(paths.picture.error, kReferenceError * paths.picture.mean) << "the reference is noisy";
  print_row(c, kPath, paths, paths);
  for (const Method& method : {kFinalGather, kBoth}) {
    const Measured m = comparison.render(method, 16, 2);
    EXPECT_NEAR(m.picture.mean / paths.picture.mean, 1, kTolerance)
        << method.name << ", standard error " << m.picture.error / paths.picture.mean;
    if (c.indirect > 0) {
      EXPECT_NEAR(m.indirect.mean / paths.indirect.mean, 1, c.indirect) << method.name;
    }
    print_row(c, method, m, paths);
  }
  const Measured cached = comparison.render(kPathCache, c.samples, 4);
  const double ratio = cached.picture.mean / paths.picture.mean;
  const double error = std::hypot(cached.picture.error, paths.picture.error) / paths.picture.mean;
  EXPECT_NEAR(ratio, 1, kCacheTolerance + 2 * error) << "path+cache, standard error " << error;
  print_row(c, kPathCache, cached, paths);
}

INSTANTIATE_TEST_SUITE_P(
    CrossMethod, Methods,
    ::testing::Values(Case{"closed_box", closed_box, 32}, Case{"sky_window", sky_window, 64},
                      Case{"sun_window", sun_window, 32}, Case{"glossy_corner", glossy_corner, 64},
                      Case{"glass_on_table", glass_on_table, 32}, Case{"curtain", curtain, 192},
                      Case{"glowing_sphere", glowing_sphere, 64}, Case{"two_rooms", two_rooms, 48},
                      Case{"sky_portal", sky_portal, 32, 2 * kTolerance},
                      Case{"furnished", furnished, 64},
                      Case{"furnished_on_land", furnished_on_land, 64}),
    [](const auto& i) { return std::string(i.param.name); });

}  // namespace methods_test
}  // namespace oriel::cross_method
