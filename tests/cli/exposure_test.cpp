// SPDX-License-Identifier: Apache-2.0
// Exposure workflow of the manual, and diagnostics of invalid exposures.
#include <nlohmann/json.hpp>

#include "image/exr.h"
#include "image/files.h"
#include "support/program.h"
#include "tone/exposure.h"

namespace oriel {
namespace exposure_test {

class ExposureProgram : public ProgramTest {
 protected:
  /// The last line of the output of `oriel render --json`.
  static nlohmann::json last_line(const RunResult& r) {
    const std::string text = r.out.substr(0, r.out.find_last_not_of('\n') + 1);
    return nlohmann::json::parse(text.substr(text.rfind('\n') + 1));
  }
};

// acceptance: X2
TEST_F(ExposureProgram, PreviewIsThePictureRenderedBeforeMappedAnew) {
  write("plain.mi", small_scene());
  // With all layers: the beauty is read.
  ASSERT_EQ(run({"render", "plain.mi", "-o", "preview.exr", "--samples", "8", "--exr", "float"})
                .exit_code,
            0);
  write("tuned.mi", "color texture \"pv\" \"preview.exr\"\n" +
                        small_scene("finalgather on",
                                    "lens \"mia_exposure_simple\" ( \"gain\" 3, \"gamma\" 1.8, "
                                    "\"preview\" \"pv\", \"use_preview\" on )"));
  const RunResult r = run({"render", "tuned.mi", "-o", "tuned.exr", "--json", "--exr", "float"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.error_lines(), 0) << r.err;
  EXPECT_EQ(last_line(r)["rays"], 0);
  EXPECT_LT(last_line(r)["elapsed"], 2);
  const ExrFile tuned = read_exr(file("tuned.exr")), before = read_exr(file("preview.exr"));
  const Layer* linear = find_layer(tuned.layers, "linear");
  ASSERT_NE(linear, nullptr);
  const lens::SimpleExposure exposure({.gain = 3, .gamma = 1.8f});
  const Image& beauty = before.layers[0].image;
  for (int y = 0; y < beauty.height; ++y)
    for (int x = 0; x < beauty.width; ++x) {
      const float* p = beauty.at(x, y);
      const Rgb exact = exposure(Rgb(p[0], p[1], p[2]));
      for (int k = 0; k < 3; ++k) {
        ASSERT_EQ(linear->image.at(x, y)[k], p[k]) << x << " " << y;
        ASSERT_NEAR(tuned.layers[0].image.at(x, y)[k], exact[k], 1e-6f) << x << " " << y;
      }
    }
  // Denoising has no noise estimate and reports nothing.
  EXPECT_EQ(run({"render", "tuned.mi", "-o", "tuned.png", "--denoise", "-q"}).exit_code, 0);
}

/// Gain 2 without compression, gamma 1: twice the light.
const std::string kTwice =
    " \"mia_exposure_simple\" ( \"gain\" 2, \"compression\" 0, \"gamma\" 1 ) ";

TEST_F(ExposureProgram, FloatFilesContainTheRequestedValues) {
  const std::string files =
      "output \"rgba_fp\" \"tif\" \"a.tif\" output \"rgba_fp\" \"exr\" \"a.exr\"";
  write("plain.mi", small_scene("", files));
  ASSERT_EQ(run({"render", "plain.mi", "--samples", "4", "-q"}).exit_code, 0);
  const Image light = read_image(file("a.exr"));
  for (const char* role : {"lens", "output"}) {
    write("mapped.mi", small_scene("", role + kTwice + files));
    const RunResult r = run({"render", "mapped.mi", "--samples", "4"});
    ASSERT_EQ(r.exit_code, 0);
    EXPECT_NE(r.err.find("OR-RN-066"), std::string::npos) << r.err;
    const auto is_light_times = [&](const char* name, float factor) {
      const Image image = read_image(file(name));
      ASSERT_EQ(image.pixels.size(), light.pixels.size());
      for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const float wanted = (i % 4 < 3 ? factor : 1) * light.pixels[i];
        ASSERT_NEAR(image.pixels[i], wanted, 1e-5f * wanted) << role;
      }
    };
    is_light_times("a.tif", 2);
    is_light_times("a.exr", 2);
    const ExrFile written = read_exr(file("a.exr"));
    ASSERT_NE(find_layer(written.layers, "linear"), nullptr);
    EXPECT_EQ(find_layer(written.layers, "linear")->image.pixels, light.pixels);
    // So does a file of another name, and its linear layer is what the tools read.
    ASSERT_EQ(run({"render", "mapped.mi", "-o", "b.exr", "--samples", "4", "-q", "--exr", "float"})
                  .exit_code,
              0);
    is_light_times("b.exr", 2);
    ASSERT_EQ(run({"tonemap", "b.exr", "-o", "c.exr", "--simple", "--gain", "1", "--compression",
                   "0", "--gamma", "1"})
                  .exit_code,
              0);
    is_light_times("c.exr", 1);
    ASSERT_EQ(run({"render", "mapped.mi", "--linear", "--samples", "4"}).exit_code, 0);
    is_light_times("a.tif", 1);
    is_light_times("a.exr", 1);
  }
}

TEST_F(ExposureProgram, DoubleGammaOfOutputShadersIsReported) {
  for (const char* role : {"lens", "output"}) {
    write("scene.mi",
          small_scene("gamma 2.2", std::string(role) + " \"mia_exposure_simple\" ( \"gain\" 1 )"));
    const RunResult r = run({"render", "scene.mi", "-o", "a.png", "--samples", "1", "-q"});
    EXPECT_EQ(r.exit_code, 0);
    EXPECT_NE(r.err.find("OR-RN-041"), std::string::npos) << role << r.err;
  }
}

}  // namespace exposure_test
}  // namespace oriel
