// SPDX-License-Identifier: Apache-2.0
// Exposure shaders in renders: previews without rendering, lens and output copies, side channels.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "image/files.h"
#include "output/camera_output.h"
#include "prepare/testing/prepared_scene.h"
#include "support/expect_near.h"
#include "support/files.h"
#include "tone/exposure.h"

namespace oriel {
namespace exposure_test {

using testing::expect_near_relative;
using testing::PreparedScene;

constexpr int kWidth = 16, kHeight = 12;

/// A lit square that fills the image; `gather` enables indirect light maps.
std::string scene_with(const std::string& camera, const std::string& before = {},
                       bool gather = false) {
  return testing::scene_text(
      before +
          " material \"m\" \"mib_illum_lambert\" ( \"diffuse\" .9 .6 .3, \"mode\" 4 ) end material "
          "light \"l\" \"mib_light_point\" ( \"color\" 3 3 3 ) origin 1 1 -3 end light "
          "instance \"l_i\" \"l\" end instance ",
      "\"l_i\"", camera, gather ? "finalgather on globillum on" : "");
}

struct Rendered {
  PreparedScene scene;
  NodeList output_shaders;
  std::unique_ptr<RenderSession> session;
  explicit Rendered(const std::string& text, std::uint32_t samples = 16) : scene(text) {
    const scene::Camera* camera = find_camera(scene.scene, scene.scene.renders.back());
    output_shaders = camera_output_shaders(*camera, scene.scene, builtin_shaders(), *scene.world,
                                           scene.diagnostics);
    SessionSettings settings;
    settings.budget.samples = samples;
    session = std::make_unique<RenderSession>(*scene.world, settings);
    session->run();
  }
  Rgb film(int x, int y) const { return rgb(session->film().pixel(x, y).beauty); }
  /// After lens and output shaders.
  Image picture() const { return shown_image(*session, output_shaders); }
};

Rgb pixel(const Image& image, int x, int y) {
  const float* p = image.at(x, y);
  return Rgb(p[0], p[1], p[2]);
}

template <class F>
void each_pixel(const F& f) {
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) f(x, y);
}

const std::string kCurved = "\"mia_exposure_simple\" ( \"gain\" 2, \"knee\" .3, \"gamma\" 2.2";
const std::string kLinear = "\"mia_exposure_simple\" ( \"gain\" 2, \"compression\" 0, \"gamma\" 1";

/// The film of a render, written as the manual's walk-through has it.
std::string save_film(const Rendered& r, const TestFolder& folder) {
  Image image(kWidth, kHeight, 3);
  each_pixel([&](int x, int y) {
    for (int k = 0; k < 3; ++k) image.at(x, y)[k] = r.film(x, y)[k];
  });
  write_image(folder.file("preview.exr"), image, {.format = SampleFormat::Float});
  return "color texture \"pv\" \"" + folder.file("preview.exr") + "\"";
}

// acceptance: X2
TEST(Preview, IsMappedWithoutRendering) {
  const TestFolder folder;
  const Rendered plain(scene_with(""));
  const std::string texture = save_film(plain, folder);
  const lens::SimpleExposure exposure({.gain = 2, .knee = .3f});
  for (const char* role : {"lens ", "output "}) {
    // Maps that the scene enables are not computed either.
    const Rendered r(
        scene_with(role + kCurved + ", \"preview\" \"pv\", \"use_preview\" on )", texture, true));
    EXPECT_EQ(r.scene.messages(), "");
    EXPECT_EQ(r.session->rays().rays(), 0u);
    const Image shown = r.picture();
    each_pixel([&](int x, int y) {
      expect_near_relative(r.film(x, y), plain.film(x, y), 0);
      expect_near_relative(pixel(shown, x, y), exposure(plain.film(x, y)));
    });
  }
}

// acceptance: X2
TEST(Preview, EqualsARender) {
  const TestFolder folder;
  const std::string photographic =
      "lens \"mia_exposure_photographic\" ( \"film_iso\" 0, \"cm2_factor\" 2, \"vignetting\" 3, "
      "\"burn_highlights\" {}, \"crush_blacks\" {}, \"gamma\" {}{} )";
  const Rendered plain(scene_with(""), 256);
  const std::string texture = save_film(plain, folder);
  struct Row {
    const char *burn, *crush, *gamma;
    float tolerance;
  };
  // Linear settings map means and parts alike; curved ones differ by the spread within a pixel.
  for (const Row& row : {Row{"1", "0", "1", 1e-5f}, Row{".25", ".2", "2.2", 2e-3f}}) {
    const auto lens = [&](const char* preview) {
      return fmt::format(fmt::runtime(photographic), row.burn, row.crush, row.gamma, preview);
    };
    const Image a = Rendered(scene_with(lens("")), 256).picture();
    const Image b =
        Rendered(scene_with(lens(", \"preview\" \"pv\", \"use_preview\" on"), texture)).picture();
    each_pixel(
        [&](int x, int y) { expect_near_relative(pixel(b, x, y), pixel(a, x, y), row.tolerance); });
  }
}

// acceptance: X2
TEST(Preview, OtherSizesAreStretchedAndOffDisablesIt) {
  const std::string texture = "color texture \"pv\" [2 1 3] 'ff0000' '0000ff'";
  const Rendered r(
      scene_with("lens " + kLinear + ", \"preview\" \"pv\", \"use_preview\" on )", texture));
  each_pixel([&](int x, int y) {
    expect_near_relative(r.film(x, y), x < kWidth / 2 ? Rgb(1, 0, 0) : Rgb(0, 0, 1), 0);
  });
  const Rendered off(scene_with("lens " + kLinear + ", \"preview\" \"pv\" )", texture));
  EXPECT_GT(off.session->rays().eye, 0u);
}

TEST(Preview, UnreadablePreviewIsReportedAndTheSceneRendered) {
  const Rendered r(scene_with("lens " + kLinear + ", \"preview\" \"pv\", \"use_preview\" on )",
                              "color texture \"pv\" \"/nowhere/at/all.exr\""));
  EXPECT_TRUE(r.scene.diagnostics.has("OR-RT-020"));
  EXPECT_GT(r.session->rays().eye, 0u);
}

// A finished picture behind the scene, in light and back: with every step of the exposure at work,
// and from pixel to pixel another vignetting.
TEST(ReverseExposure, BackgroundPlateIsUnchanged) {
  const std::string camera =
      "\"cm2_factor\" 2, \"whitepoint\" 1 .9 .7, \"f_number\" 4, \"vignetting\" 3, "
      "\"burn_highlights\" .2, \"crush_blacks\" .3, \"saturation\" 1.2";
  const auto plate = [&](const std::string& reverse) {
    return Rendered(
        "options \"opt\" object space end options camera \"cam\" focal 1 aperture 1 "
        "aspect 1.333333 resolution 16 12 lens \"mia_exposure_photographic\" ( " +
        camera + " ) environment \"mia_exposure_photographic_rev\" ( " + reverse +
        ", \"input\" .2 .5 .8 ) end camera instance \"cam_i\" \"cam\" end instance "
        "instgroup \"root\" \"cam_i\" end instgroup render \"root\" \"cam_i\" "
        "\"opt\"\n");
  };
  const Rendered r = plate(camera);
  EXPECT_EQ(r.scene.messages(), "");
  EXPECT_EQ(r.scene.report.binding.approximated.count("mia_exposure_photographic_rev.input"), 1u);
  const Image shown = r.picture();
  // Quarters of a pixel are mapped by their means, and vignetting changes within them.
  each_pixel(
      [&](int x, int y) { expect_near_relative(pixel(shown, x, y), Rgb(.2f, .5f, .8f), 1e-3f); });
  // The light behind it is brighter where the film is dimmer.
  EXPECT_GT(r.film(0, 0).y, 1.2f * r.film(kWidth / 2, kHeight / 2).y);
  // Another camera shows it otherwise.
  const Image other = plate("\"f_number\" 4").picture();
  EXPECT_GT(std::abs(pixel(other, 8, 6).y - .5f), .02f);
}

// acceptance: X8
TEST(SideChannel, LensAndOutputShadersAgreeWhereTheMappingIsLinear) {
  const Image lens = Rendered(scene_with("lens " + kLinear + " )")).picture();
  const Image output = Rendered(scene_with("output " + kLinear + " )")).picture();
  each_pixel(
      [&](int x, int y) { expect_near_relative(pixel(output, x, y), pixel(lens, x, y), 1e-5f); });
}

const std::string kPhotographic =
    "\"mia_exposure_photographic\" ( \"film_iso\" 0, \"cm2_factor\" {}, \"vignetting\" 0, "
    "\"side_channel_mode\" {}, \"side_channel\" \"{}\" )";

std::string photographic(double factor, int mode, const char* channel = "raw") {
  return fmt::format(fmt::runtime(kPhotographic), factor, mode, channel);
}

// acceptance: X8
TEST(SideChannel, Mode1RemapsTheLensShaderInput) {
  // The lens' copy maps wildly otherwise: nothing of that is left.
  const Rendered r(scene_with("lens " + photographic(9, 1) + " output " + photographic(.5, 1)));
  EXPECT_EQ(r.scene.messages(), "");
  const lens::PhotographicExposure exposure({.cm2_factor = .5f, .film_iso = 0, .vignetting = 0});
  const lens::PhotographicExposure of_lens({.cm2_factor = 9, .film_iso = 0, .vignetting = 0});
  const Image shown = r.picture();
  each_pixel([&](int x, int y) {
    expect_near_relative(pixel(shown, x, y), exposure(r.film(x, y)));
    // While it renders, the lens shader's picture is seen.
    expect_near_relative(r.session->film().shown(x, y), of_lens(r.film(x, y)), 1e-2f);
  });
}

// acceptance: X8
TEST(SideChannel, Mode2RestoresTheLensShaderInput) {
  const Rendered r(scene_with("lens " + photographic(9, 2) + " output " + photographic(9, 2) +
                              " output " + kLinear + " )"));
  const Image shown = r.picture();
  each_pixel([&](int x, int y) { expect_near_relative(pixel(shown, x, y), r.film(x, y) * 2.0f); });
}

// acceptance: X8
TEST(SideChannel, Mode0MapsThePicture) {
  const Rendered r(scene_with("lens " + kLinear + " ) output " + photographic(.5, 0)));
  const lens::PhotographicExposure exposure({.cm2_factor = .5f, .film_iso = 0, .vignetting = 0});
  const Image shown = r.picture();
  each_pixel([&](int x, int y) {
    expect_near_relative(pixel(shown, x, y), exposure(r.film(x, y) * 2.0f), 1e-5f);
  });
}

// acceptance: X8
TEST(SideChannel, UnfilledChannelIsReportedAndTheImageMapped) {
  const Rendered r(
      scene_with("lens " + photographic(1, 1, "other") + " output " + photographic(.5, 1)));
  EXPECT_NE(r.scene.only("OR-RN-056"), nullptr) << r.scene.messages();
  const lens::PhotographicExposure exposure({.cm2_factor = .5f, .film_iso = 0, .vignetting = 0});
  const Image shown = r.picture();
  expect_near_relative(pixel(shown, 5, 5), exposure(r.session->film().shown(5, 5)));
}

// acceptance: X8
TEST(SideChannel, IsAFrameBufferThatCanBeWritten) {
  const TestFolder folder;
  const Rendered r(scene_with("lens " + photographic(9, 1) +
                              " framebuffer \"raw\" datatype \"rgba_fp\" filename \"raw.tif\" "
                              "filetype \"tif\" user on"));
  const scene::Camera* camera = find_camera(r.scene.scene, r.scene.scene.renders.back());
  Diagnostics diagnostics;
  const auto files = camera_outputs(*camera, {folder.file(""), {folder.file("")}}, r.scene.scene,
                                    builtin_shaders(), *r.scene.world, diagnostics);
  ASSERT_EQ(files.size(), 1u);
  EXPECT_TRUE(diagnostics.all().empty());
  write_picture(files[0], *r.session, {});
  const Image raw = read_image(files[0].path);
  each_pixel([&](int x, int y) { expect_near_relative(pixel(raw, x, y), r.film(x, y)); });
}

TEST(LensList, TheLastShaderMapsFirst) {
  // Each shader calls the next one for the colour of the ray: (c + .1) * 3, not c * 3 + .1.
  const Rendered r(
      scene_with("lens \"mia_exposure_simple\" ( \"gain\" 3, \"compression\" 0, \"gamma\" 1 ) "
                 "\"mia_exposure_simple\" ( \"pedestal\" .1, \"compression\" 0, \"gamma\" 1 )"));
  expect_near_relative(r.session->film().shown(8, 6), (r.film(8, 6) + Rgb(.1f)) * 3.0f, 1e-5f);
}

}  // namespace exposure_test
}  // namespace oriel
