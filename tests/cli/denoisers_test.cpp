// SPDX-License-Identifier: Apache-2.0
// oriel denoise: its choice of the denoiser, and light groups.
#include <cstdlib>
#include <random>

#include "image/exr.h"
#include "support/program.h"

namespace oriel {
namespace denoisers_test {

constexpr int kWidth = 40, kHeight = 30;

/// A row y of the picture has the mean level(y).
float level(int y) { return 3 + static_cast<float>(y); }

class Denoisers : public ProgramTest {
 protected:
  Denoisers() { setenv("ORIEL_OIDN_LIBRARY", "", 1); }
  ~Denoisers() override {
    unsetenv("ORIEL_OIDN_LIBRARY");
    unsetenv("FAKE_OIDN_ERROR");
  }

  /// Writes in.exr. Without a variance light that the denoiser loses is not given back.
  void write_input(float variance) const {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> noise(-1, 1);
    const auto layer = [](const char* name, std::vector<std::string> channels, float value) {
      const int n = static_cast<int>(channels.size());
      return Layer{name, std::move(channels), Image(kWidth, kHeight, n, value)};
    };
    const std::vector<std::string> rgb = {"R", "G", "B"};
    std::vector<Layer> layers = {
        layer("", rgb, 0),          layer("variance", rgb, variance),
        layer("albedo", rgb, .5f),  layer("normal", {"X", "Y", "Z"}, .577f),
        layer("light_sun", rgb, 0), layer("light_rest", rgb, 0)};
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; x += 2) {
        const float difference = noise(random);
        for (int i = 0; i < 2; ++i)
          for (int c = 0; c < 3; ++c) {
            const float value = level(y) + (i ? difference : -difference);
            layers[0].image.at(x + i, y)[c] = value;
            layers[4].image.at(x + i, y)[c] = .25f * value;
            layers[5].image.at(x + i, y)[c] = .75f * value;
          }
      }
    write_exr(file("in.exr"), layers, {});
  }
  RunResult denoise(std::vector<std::string> more = {}) const {
    more.insert(more.begin(), {"denoise", "in.exr", "-o", "out.exr"});
    return run(more);
  }
  std::string denoiser_of(const std::string& name) const {
    return std::get<std::string>(read_exr(file(name)).metadata.at("oriel.denoiser"));
  }
};

TEST_F(Denoisers, OpenImageDenoiseIsUsedIfItsLibraryIsThere) {
  write_input(0);
  const std::string libraries[] = {ORIEL_FAKE_OIDN_1, ORIEL_FAKE_OIDN_2};
  for (int version = 1; version <= 2; ++version) {
    setenv("ORIEL_OIDN_LIBRARY", libraries[version - 1].c_str(), 1);
    const RunResult r = denoise();
    ASSERT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_EQ(denoiser_of("out.exr"), "Open Image Denoise " + std::to_string(version) + ".4.3");
    const ExrFile out = read_exr(file("out.exr"));
    ASSERT_EQ(out.layers.size(), 3u);
    const Layer *sun = find_layer(out.layers, "light_sun"),
                *rest = find_layer(out.layers, "light_rest");
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        ASSERT_NEAR(out.layers[0].image.at(x, y)[1], level(y), 1e-4f) << x << ' ' << y;
        ASSERT_NEAR(sun->image.at(x, y)[1], .25f * level(y), 1e-4f);
        ASSERT_NEAR(rest->image.at(x, y)[1], .75f * level(y), 1e-4f);
      }
    EXPECT_EQ(denoise({"--denoiser", "oriel"}).exit_code, 0);
    EXPECT_EQ(denoiser_of("out.exr"), "Oriel");
  }
}

TEST_F(Denoisers, OpenImageDenoiseIsReplacedIfItFails) {
  write_input(0);
  setenv("ORIEL_OIDN_LIBRARY", ORIEL_FAKE_OIDN_2, 1);
  setenv("FAKE_OIDN_ERROR", "1", 1);
  RunResult r = denoise();
  EXPECT_EQ(r.exit_code, 0);
  EXPECT_NE(r.err.find("Open Image Denoise 2.4.3: out of memory; Oriel's own denoiser was used"),
            std::string::npos)
      << r.err;
  EXPECT_EQ(denoiser_of("out.exr"), "Oriel");
  r = denoise({"--denoiser", "oidn"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("out of memory"), std::string::npos) << r.err;
}

TEST_F(Denoisers, AMissingLibraryOfOpenImageDenoiseIsReported) {
  write_input(0);
  for (const char* library : {"", "no-such-library.so", "libz.so.1"}) {
    setenv("ORIEL_OIDN_LIBRARY", library, 1);
    const RunResult r = denoise({"--denoiser", "oidn"});
    EXPECT_EQ(r.exit_code, 1) << library;
    EXPECT_EQ(r.error_lines(), 1) << r.err;
    EXPECT_NE(r.err.find("Open Image Denoise was not found"), std::string::npos) << r.err;
    write("scene.mi", small_scene());
    const RunResult render = run(
        {"render", "scene.mi", "--samples", "8", "--denoise", "--denoiser", "oidn", "-o", "a.exr"});
    EXPECT_EQ(render.exit_code, 1) << "before anything is rendered";
    EXPECT_NE(render.err.find("Open Image Denoise was not found"), std::string::npos);
    EXPECT_EQ(denoise().exit_code, 0) << library;
    EXPECT_EQ(denoiser_of("out.exr"), "Oriel");
  }
}

TEST_F(Denoisers, LightGroupsSumToThePicture) {
  write_input(.3f);
  ASSERT_EQ(denoise().exit_code, 0);
  const RunResult r = run({"recombine", "out.exr", "--threshold", "1e-5"});
  EXPECT_EQ(r.exit_code, 0) << r.err << r.out;
  // Of light groups that are the same picture, each gets its share of the denoised one.
  const ExrFile out = read_exr(file("out.exr"));
  for (int x = 0; x < kWidth; ++x)
    EXPECT_NEAR(find_layer(out.layers, "light_sun")->image.at(x, 9)[0],
                .25f * out.layers[0].image.at(x, 9)[0], .01f);
}

TEST_F(Denoisers, RenderNamesTheDenoiser) {
  write("scene.mi", small_scene());
  setenv("ORIEL_OIDN_LIBRARY", ORIEL_FAKE_OIDN_2, 1);
  const RunResult r = run({"render", "scene.mi", "--samples", "8", "--denoise", "-o", "a.exr"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(denoiser_of("a.exr"), "Open Image Denoise 2.4.3");
}

}  // namespace denoisers_test
}  // namespace oriel
