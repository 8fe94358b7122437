// SPDX-License-Identifier: Apache-2.0
// oriel check, shaders, tonemap and diff.
#include <cmath>
#include <nlohmann/json.hpp>

#include "image/exr.h"
#include "image/files.h"
#include "support/program.h"

namespace oriel {
namespace tools_test {

class CheckProgram : public ProgramTest {};
class ShadersProgram : public ProgramTest {};
class DenoiseProgram : public ProgramTest {};

class TonemapProgram : public ProgramTest {
 protected:
  /// Greys of a linear EXR picture after `oriel tonemap` with these arguments, as EXR again.
  std::vector<float> mapped(const std::vector<float>& greys, std::vector<std::string> arguments) {
    Image image(static_cast<int>(greys.size()), 1, 3);
    for (std::size_t i = 0; i < greys.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = greys[i];
    write_image(file("in.exr"), image, {.format = SampleFormat::Float});
    arguments.insert(arguments.begin(), {"tonemap", "in.exr", "-o", "out.exr"});
    const RunResult r = run(arguments);
    EXPECT_EQ(r.exit_code, 0) << r.err;
    const Image out = read_image(file("out.exr"));
    std::vector<float> values;
    for (std::size_t i = 0; i < out.pixel_count(); ++i)
      values.push_back(out.pixels[i * static_cast<std::size_t>(out.channels)]);
    return values;
  }
};

class DiffProgram : public ProgramTest {
 protected:
  void write_grey(const std::string& name, float value) const {
    write_image(file(name), Image(16, 16, 3, value), {.format = SampleFormat::Float});
  }
};

TEST_F(CheckProgram, ReportsUsedAndMissingParts) {
  write("scene.mi",
        small_scene("\"no such option\" 1 finalgather on") + "gui \"panel\" { } end gui\n");
  const RunResult r = run({"check", "scene.mi", "--json"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const auto json = nlohmann::json::parse(r.out);
  EXPECT_EQ(json["shaders"]["mia_material_x"], 1);
  EXPECT_EQ(json["geometry"]["triangles"], 4);
  EXPECT_EQ(json["geometry"]["lights"], 1);
  EXPECT_EQ(json["options"]["unknown_strings"][0], "no such option");
  EXPECT_EQ(json["picture"]["width"], 48);
  EXPECT_TRUE(json["renders"]);
}

TEST_F(CheckProgram, TextSaysTheSame) {
  write("scene.mi", small_scene("\"no such option\" 1"));
  const RunResult r = run({"check", "scene.mi"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.out.find("mia_material_x"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("no such option"), std::string::npos) << r.out;
  EXPECT_NE(r.out.find("4 triangles"), std::string::npos) << r.out;
}

TEST_F(CheckProgram, MissingSceneIsOneLine) {
  const RunResult r = run({"check", "missing.mi"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_EQ(r.error_lines(), 1) << r.err;
}

TEST_F(ShadersProgram, ListsPagesAndDeclarations) {
  const RunResult list = run({"shaders"});
  EXPECT_EQ(list.exit_code, 0);
  EXPECT_NE(list.out.find("mia_physicalsky"), std::string::npos);
  const RunResult page = run({"shaders", "mia_exposure_photographic"});
  EXPECT_EQ(page.exit_code, 0);
  EXPECT_NE(page.out.find("burn_highlights"), std::string::npos);
  const RunResult declarations = run({"shaders", "--mi", "architectural"});
  EXPECT_EQ(declarations.exit_code, 0);
  EXPECT_NE(declarations.out.find("declare shader"), std::string::npos);
}

TEST_F(ShadersProgram, NearestNameIsOffered) {
  const RunResult r = run({"shaders", "mia_materal_x"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("did you mean \"mia_material_x\"?"), std::string::npos) << r.err;
}

// acceptance: X1
TEST_F(TonemapProgram, SimpleExposureFollowsTheManualsOrder) {
  // (in + pedestal) gain, above the knee 1 / (1 + compression) of the slope, then gamma.
  const auto out = mapped({0.1f, 0.65f}, {"--simple", "--pedestal", "0.1", "--gain", "2", "--knee",
                                          "0.5", "--compression", "2", "--gamma", "1"});
  ASSERT_EQ(out.size(), 2u);
  EXPECT_NEAR(out[0], 0.4, 1e-6);
  EXPECT_NEAR(out[1], 0.5 + (1.5 - 0.5) / 3, 1e-6);
}

// acceptance: X3
TEST_F(TonemapProgram, FilmShutterAndApertureAreReciprocal) {
  const std::vector<float> greys = {100, 1000, 10000};
  const auto a = mapped(greys, {"--iso", "100", "--shutter", "100", "--f-number", "16"});
  const auto b = mapped(greys, {"--iso", "200", "--shutter", "200", "--f-number", "16"});
  const auto c = mapped(greys, {"--iso", "100", "--shutter", "400", "--f-number", "8"});
  for (std::size_t i = 0; i < greys.size(); ++i) {
    EXPECT_NEAR(b[i], a[i], 1e-5f);
    EXPECT_NEAR(c[i], a[i], 1e-5f);
  }
  // Sunny 16: a white card under 96.5 klx just saturates.
  const auto sunny = mapped({30720}, {"--burn", "1", "--crush", "0", "--gamma", "1"});
  EXPECT_NEAR(sunny[0], 1, 1e-5);
}

// acceptance: X7
TEST_F(TonemapProgram, Burn1Crush0IsLinearAndBurn0NeverExceedsWhite) {
  const std::vector<float> greys = {0.1f, 0.5f, 2, 1e6f};
  const auto linear =
      mapped(greys, {"--iso", "0", "--cm2", "0.5", "--burn", "1", "--crush", "0", "--gamma", "1"});
  for (std::size_t i = 0; i < greys.size(); ++i)
    EXPECT_NEAR(linear[i], greys[i] / 2, 1e-5 * greys[i]);
  const auto soft =
      mapped(greys, {"--iso", "0", "--cm2", "1", "--burn", "0", "--crush", "0", "--gamma", "1"});
  for (const float v : soft) EXPECT_LE(v, 1);
  EXPECT_GT(soft[3], 0.999f);
}

// acceptance: X6
TEST_F(TonemapProgram, VignettingDependsOnTheFieldOfView) {
  // 90 degrees over 4 pixels: their middles lie 1.5 and .5 pixels off, 2 pixels away.
  const std::vector<std::string> linear = {"--iso",   "0", "--burn",       "1",
                                           "--crush", "0", "--vignetting", "3"};
  std::vector<std::string> given = linear;
  given.insert(given.end(), {"--gamma", "1", "--fov", "90"});
  const auto v = mapped({1, 1, 1, 1}, given);
  EXPECT_NEAR(v[0], std::pow(1 / std::sqrt(1 + .75 * .75), 3), 1e-6);
  EXPECT_NEAR(v[2], std::pow(1 / std::sqrt(1 + .25 * .25), 3), 1e-6);
  std::vector<std::string> unknown = {"tonemap", "in.exr", "-o", "a.exr"};
  unknown.insert(unknown.end(), linear.begin(), linear.end());
  const RunResult r = run(unknown);
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("--fov"), std::string::npos) << r.err;
}

// acceptance: X2, X6
TEST_F(TonemapProgram, MapsAsTheLensShaderOfTheRender) {
  // The rendered file contains its field of view; linear settings scale pixels.
  write("scene.mi",
        small_scene("",
                    "lens \"mia_exposure_photographic\" ( \"film_iso\" 0, \"cm2_factor\" .5, "
                    "\"vignetting\" 4, \"burn_highlights\" 1, \"crush_blacks\" 0, "
                    "\"saturation\" .7, \"gamma\" 1 )"));
  ASSERT_EQ(
      run({"render", "scene.mi", "-o", "a.exr", "--samples", "8", "--exr", "float"}).exit_code, 0);
  ASSERT_EQ(run({"tonemap", "a.exr", "-o", "b.exr", "--iso", "0", "--cm2", ".5", "--vignetting",
                 "4", "--burn", "1", "--crush", "0", "--saturation", ".7", "--gamma", "1"})
                .exit_code,
            0);
  const ExrFile rendered = read_exr(file("a.exr"));
  ASSERT_NE(find_layer(rendered.layers, "linear"), nullptr);
  const Image &display = rendered.layers[0].image, mapped = read_image(file("b.exr"));
  for (int y = 0; y < mapped.height; ++y)
    for (int x = 0; x < mapped.width; ++x)
      for (int k = 0; k < 3; ++k)
        ASSERT_NEAR(mapped.at(x, y)[k], display.at(x, y)[k], 2e-6f) << x << " " << y;
  // The file contains these parameters.
  ASSERT_EQ(run({"tonemap", "a.exr", "-o", "d.exr"}).exit_code, 0);
  EXPECT_EQ(read_image(file("d.exr")).pixels, mapped.pixels);
  ASSERT_EQ(
      run({"tonemap", "a.exr", "-o",           "c.exr", "--layer",      "albedo", "--iso",  "0",
           "--cm2",   "1",     "--vignetting", "0",     "--saturation", "1",      "--burn", "1",
           "--crush", "0",     "--gamma",      "1"})
          .exit_code,
      0);
  const Layer* albedo = find_layer(rendered.layers, "albedo");
  EXPECT_NEAR(read_image(file("c.exr")).at(20, 20)[1], albedo->image.at(20, 20)[1], 1e-6f);
  EXPECT_EQ(run({"tonemap", "a.exr", "-o", "c.exr", "--layer", "nothing"}).exit_code, 1);
}

TEST_F(TonemapProgram, ViewsStandInForTheCurves) {
  // Exposed by the camera first: 30720 cd/m2 saturate.
  const auto agx = mapped({0, .18f * 30720, 1e9f}, {"--view", "agx"});
  EXPECT_NEAR(agx[0], 0, 1e-6);
  EXPECT_NEAR(agx[1], .5, 1e-4);
  EXPECT_NEAR(agx[2], 1, 1e-4);
  // PBR Neutral takes .04 of .4; then the sRGB curve.
  const auto neutral = mapped({.4f * 30720}, {"--view", "neutral"});
  EXPECT_NEAR(neutral[0], 1.055 * std::pow(.36, 1 / 2.4) - .055, 1e-5);
  for (const char* option : {"--burn", "--crush", "--saturation", "--gamma"})
    EXPECT_EQ(run({"tonemap", "in.exr", "-o", "a.png", "--view", "agx", option, "1"}).exit_code, 2)
        << option;
  EXPECT_EQ(run({"tonemap", "in.exr", "-o", "a.png", "--view", "aces"}).exit_code, 2);
}

// acceptance: X1
TEST_F(TonemapProgram, KneesOfBothForms) {
  const auto ratio = mapped({1}, {"--simple", "--gamma", "1"});
  const auto smooth = mapped({1}, {"--simple", "--gamma", "1", "--knee-curve", "asymptotic"});
  EXPECT_NEAR(ratio[0], 2 / 3., 1e-6);
  EXPECT_NEAR(smooth[0], .75, 1e-6);
}

TEST_F(TonemapProgram, WrongOptionsAreUsageErrors) {
  EXPECT_EQ(run({"tonemap", "in.exr"}).exit_code, 2);
  EXPECT_EQ(run({"tonemap", "in.exr", "-o", "a.png", "--gain", "2"}).exit_code, 2);
  const RunResult r = run({"tonemap", "in.exr", "-o", "a.png"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_EQ(r.error_lines(), 1) << r.err;
}

TEST_F(DenoiseProgram, ImagesWithoutNoiseLayersAreAUserError) {
  write_image(file("in.exr"), Image(8, 8, 3, 1), {.format = SampleFormat::Float});
  const RunResult r = run({"denoise", "in.exr", "-o", "out.exr"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_EQ(r.error_lines(), 1) << r.err;
  EXPECT_NE(r.err.find("variance"), std::string::npos) << r.err;
  EXPECT_EQ(run({"denoise", "missing.exr", "-o", "out.exr"}).exit_code, 1);
  EXPECT_EQ(run({"denoise", "in.exr", "-o", "out.png"}).exit_code, 2);
}

TEST_F(DiffProgram, ThresholdsDecideTheExitCode) {
  write_grey("a.exr", 0.5f);
  write_grey("b.exr", 0.6f);
  EXPECT_EQ(run({"diff", "a.exr", "a.exr", "--threshold", "rmse=0"}).exit_code, 0);
  EXPECT_EQ(run({"diff", "a.exr", "b.exr"}).exit_code, 0);
  EXPECT_EQ(run({"diff", "a.exr", "b.exr", "--threshold", "rmse=0.11"}).exit_code, 0);
  EXPECT_EQ(run({"diff", "a.exr", "b.exr", "--threshold", "rmse=0.09"}).exit_code, 1);
  EXPECT_EQ(run({"diff", "a.exr", "b.exr", "--threshold", "rmse=0.11", "--threshold", "max=0.01"})
                .exit_code,
            1);
  EXPECT_EQ(run({"diff", "a.exr", "b.exr", "--threshold", "beauty=1"}).exit_code, 2);
  EXPECT_EQ(run({"diff", "a.exr", "missing.exr"}).exit_code, 1);
}

TEST_F(DiffProgram, JsonHasEveryMetric) {
  write_grey("a.exr", 0.5f);
  write_grey("b.exr", 0.6f);
  const auto json = nlohmann::json::parse(run({"diff", "a.exr", "b.exr", "--json"}).out);
  EXPECT_NEAR(json["rmse"].get<double>(), 0.1, 1e-6);
  EXPECT_NEAR(json["relmse"].get<double>(), 0.01 / (0.36 + 0.01), 1e-5);
  EXPECT_NEAR(json["max"].get<double>(), 0.1, 1e-6);
  EXPECT_GT(json["flip"].get<double>(), 0);
}

TEST_F(DiffProgram, FlipMapHasTheErrorOfEachPixel) {
  Image image(32, 32, 3, .5f);
  write_image(file("a.exr"), image, {.format = SampleFormat::Float});
  for (int k = 0; k < 3; ++k) image.at(8, 20)[k] = 1;
  write_image(file("b.exr"), image, {.format = SampleFormat::Float});
  const RunResult r = run({"diff", "a.exr", "b.exr", "--flip", "map.exr", "--json"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const Image map = read_image(file("map.exr"));
  ASSERT_EQ(map.pixel_count(), image.pixel_count());
  double sum = 0;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      sum += double{map.at(x, y)[0]};
      EXPECT_LE(map.at(x, y)[0], map.at(8, 20)[0]) << x << ' ' << y;
    }
  EXPECT_GT(map.at(8, 20)[0], .1f);
  EXPECT_EQ(map.at(31, 0)[0], 0);
  EXPECT_NEAR(sum / 1024, nlohmann::json::parse(r.out)["flip"].get<double>(), 1e-6);
  EXPECT_EQ(run({"diff", "a.exr", "b.exr", "--flip", "nowhere/map.png"}).exit_code, 1);
}

TEST_F(DiffProgram, NanAlwaysFails) {
  write_grey("a.exr", 0.5f);
  write_grey("b.exr", std::nanf(""));
  EXPECT_EQ(run({"diff", "b.exr", "a.exr", "--threshold", "rmse=1"}).exit_code, 1);
}

}  // namespace tools_test
}  // namespace oriel
