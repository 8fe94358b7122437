// SPDX-License-Identifier: Apache-2.0
#include "output/output.h"

#include <gtest/gtest.h>

#include "image/exr.h"
#include "output/camera_output.h"
#include "prepare/testing/prepared_scene.h"
#include "support/files.h"

namespace oriel {
namespace output_test {

using testing::PreparedScene;

constexpr const char* kSurface =
    "material \"m\" \"mib_illum_lambert\" ( \"ambience\" 1 1 1, \"ambient\" .2 .4 .6, "
    "\"diffuse\" .5 .5 .5, \"mode\" 4 ) end material "
    "light \"l\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 2 1 0 end light "
    "instance \"l_inst\" \"l\" end instance ";

/// A lit square, rendered with few samples; `camera` and `options` are further statements.
struct Rendered {
  PreparedScene prepared;
  std::optional<RenderSession> session;

  explicit Rendered(std::string_view camera = {}, std::string_view options = {},
                    std::optional<Window> crop = {})
      : prepared(testing::scene_text(kSurface, "\"l_inst\"", camera, options)) {
    SessionSettings settings;
    settings.budget.samples = 4;
    settings.crop = crop;
    session.emplace(*prepared.world, settings);
    session->run();
  }
};

/// picture_file() with EXR in 32 bits.
PictureFile float_file(const std::string& path) {
  PictureFile file = picture_file(path);
  file.precision = ExrPrecision::Float;
  return file;
}

constexpr const char* kExposure =
    "lens \"mia_exposure_simple\" ( \"gain\" 2, \"compression\" 0, \"gamma\" 2 )";

TEST(Output, LayersHaveTheirDocumentedNames) {
  const Rendered plain;
  std::vector<std::string> names;
  for (const Layer& layer : film_layers(*plain.session, LayerSet(LayerGroup::Film)))
    names.push_back(layer.name);
  EXPECT_EQ(names, (std::vector<std::string>{"", "Z", "normal", "albedo", "variance", "samples"}));
  const Rendered mapped(kExposure);
  EXPECT_EQ(film_layers(*mapped.session, LayerSet(LayerGroup::Film)).back().name, "display");
  EXPECT_EQ(film_layers(*plain.session, {}).size(), 1u);
}

TEST(Output, LayersContainTheViewOfTheCamera) {
  const Rendered r;
  const auto layers = film_layers(*r.session, LayerSet(LayerGroup::Film));
  const auto at = [&](const char* name) { return find_layer(layers, name)->image.at(8, 6); };
  EXPECT_NEAR(*at("Z"), 5, 0.05);  // near the axis, the square is at distance 5
  EXPECT_NEAR(at("normal")[2], 1, 1e-5);
  EXPECT_EQ(*at("samples"), 4);
  EXPECT_EQ(layers[0].image.at(8, 6)[3], 1);
}

TEST(Output, CropShowsTheSamePixelsAndNothingElse) {
  const Rendered whole;
  const Rendered crop({}, {}, Window{3, 2, 9, 7});
  const Image a = film_layers(*whole.session, {})[0].image;
  const Image b = film_layers(*crop.session, {})[0].image;
  ASSERT_EQ(b.width, 16);
  ASSERT_EQ(b.height, 12);
  for (int y = 0; y < 12; ++y)
    for (int x = 0; x < 16; ++x) {
      // The window counts rows from below: 2...6 are rows 5...9 from above.
      const bool inside = x >= 3 && x < 9 && y >= 5 && y < 10;
      for (int c = 0; c < 4; ++c)
        EXPECT_EQ(b.at(x, y)[c], inside ? a.at(x, y)[c] : 0) << x << ' ' << y;
    }
}

TEST(Output, ExrCarriesLayersAndSettings) {
  const TestFolder folder;
  const Rendered r(kExposure);
  PictureFile file = float_file(folder.file("a.exr"));
  file.layers = LayerSet("normal") | LayerSet("display");
  file.unmapped = true;
  write_picture(file, *r.session, {{"oriel.seed", 7}});
  const ExrFile read = read_exr(file.path);
  ASSERT_EQ(read.layers.size(), 3u);
  EXPECT_EQ(read.layers[0].image.pixels, film_layers(*r.session, {})[0].image.pixels);
  EXPECT_NE(find_layer(read.layers, "display"), nullptr);
  EXPECT_EQ(number_attribute(read, "oriel.seed"), 7.0f);
  EXPECT_TRUE(read.has_chromaticities);
}

TEST(Output, FloatFilesContainLensShaderResultsAndExrTheLinearLayerToo) {
  const TestFolder folder;
  const Rendered r(kExposure);
  for (const char* name : {"a.exr", "a.tif", "a.hdr"}) {
    PictureFile file = float_file(folder.file(name));
    file.float_pixels = true;
    file.samples = SampleFormat::Float;
    write_picture(file, *r.session, {});
    const Image mapped = read_image(file.path);
    for (int x = 0; x < 16; ++x)
      for (int c = 0; c < 3; ++c) {
        // Gain 2 and gamma 2 of a colour that hardly changes over the pixel; hdr has 8 bits.
        const Rgb beauty = rgb(r.session->film().pixel(x, 6).beauty);
        EXPECT_NEAR(mapped.at(x, 6)[c], std::sqrt(2 * beauty[c]), 0.02f) << name;
      }
    file.unmapped = true;  // --linear
    write_picture(file, *r.session, {});
    EXPECT_NEAR(read_image(file.path).at(4, 6)[1], r.session->film().pixel(4, 6).beauty.g, 8e-3f);
  }
  const PictureFile file = float_file(folder.file("b.exr"));
  write_picture(file, *r.session, {});
  const ExrFile read = read_exr(file.path);
  ASSERT_NE(find_layer(read.layers, "linear"), nullptr);
  EXPECT_EQ(find_layer(read.layers, "linear")->image.pixels,
            film_layers(*r.session, {})[0].image.pixels);
  EXPECT_EQ(find_layer(read.layers, "display"), nullptr);  // it is the picture itself
  // Without shaders there is no difference.
  const Rendered plain;
  write_picture(file, *plain.session, {});
  EXPECT_EQ(find_layer(read_exr(file.path).layers, "linear"), nullptr);
}

TEST(Output, ViewsShowTheDisplayBufferWhereLensShadersMapColours) {
  const TestFolder folder;
  const Rendered r(kExposure);
  write_picture(float_file(folder.file("a.png")), *r.session, {});
  const Image view = read_image(folder.file("a.png"));
  const Film& film = r.session->film();
  for (int x = 0; x < 16; ++x)
    for (int c = 0; c < 3; ++c) {
      const float shown = clamp01(film.shown(x, 6)[c]);
      EXPECT_NEAR(view.at(x, 6)[c], shown, 0.5f / 255 + 1e-5f);
      // gain 2, gamma 2 of a colour that hardly changes over the pixel
      const Rgb beauty = rgb(film.pixel(x, 6).beauty);
      EXPECT_NEAR(film.shown(x, 6)[c], std::sqrt(2 * beauty[c]), 0.02f);
    }
}

TEST(Output, ViewsTakeTheGammaOfTheOptions) {
  const TestFolder folder;
  const Rendered r({}, "gamma 2");
  write_picture(float_file(folder.file("a.png")), *r.session, {});
  const Image view = read_image(folder.file("a.png"));
  const Rgba film = r.session->film().pixel(5, 5).beauty;
  EXPECT_NEAR(view.at(5, 5)[0], std::sqrt(film.r), 0.5f / 255 + 1e-5f);
}

TEST(Output, IntensityIsTheWeightedSumOfTheColour) {
  const TestFolder folder;
  const Rendered r;
  PictureFile file = float_file(folder.file("a.tif"));
  file.view = PixelView::Intensity;
  file.samples = SampleFormat::Float;
  file.float_pixels = true;
  write_picture(file, *r.session, {});
  const Image written = read_image(file.path), shown = shown_image(*r.session, {});
  const auto& weight = r.session->world().options.luminance_weight;
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x) {
      const float* c = shown.at(x, y);
      const float sum = c[0] * weight[0] + c[1] * weight[1] + c[2] * weight[2];
      EXPECT_NEAR(*written.at(x, y), sum, 1e-6f);
    }
}

TEST(Output, ViewsFitColourAndAlphaAsTheOptionsSay) {
  scene::RenderOptions options;
  options.colorclip = scene::ColorClip::Raw;
  EXPECT_EQ(view_options(options).clip, ColorClip::Raw);
  options.colorclip = scene::ColorClip::Rgb;
  EXPECT_EQ(view_options(options).clip, ColorClip::KeepColor);
  options.colorclip = scene::ColorClip::Alpha;
  EXPECT_EQ(view_options(options).clip, ColorClip::KeepAlpha);
}

// acceptance: H7
TEST(Output, GammaNeverTouchesFloatFiles) {
  const TestFolder folder;
  const Rendered with({}, "gamma 2"), without;
  PictureFile file = float_file(folder.file("a.exr"));
  write_picture(file, *with.session, {});
  EXPECT_EQ(read_exr_image(file.path).pixels, film_layers(*without.session, {})[0].image.pixels);
}

TEST(Output, DenoisedImagesAreAddedToTheNoisyOnes) {
  const TestFolder folder;
  const Rendered r(kExposure);
  const Image clean(16, 12, 3, 0.125f);
  PictureFile file = float_file(folder.file("a.exr"));
  write_picture(file, *r.session, {}, &clean);
  const ExrFile read = read_exr(file.path);
  EXPECT_EQ(find_linear_beauty(read.layers)->image.pixels,
            film_layers(*r.session, {})[0].image.pixels);
  ASSERT_NE(find_layer(read.layers, "denoised"), nullptr);
  EXPECT_EQ(find_layer(read.layers, "denoised")->image.pixels, clean.pixels);
  // Gain 2 and gamma 2: the root of a quarter.
  write_picture(float_file(folder.file("a.png")), *r.session, {}, &clean);
  EXPECT_NEAR(read_image(folder.file("a.png")).at(5, 5)[1], 0.5f, 0.01f);
  write_picture(float_file(folder.file("a.hdr")), *r.session, {}, &clean);
  EXPECT_NEAR(read_image(folder.file("a.hdr")).at(5, 5)[1], 0.5f, 0.01f);
}

TEST(Output, DenoisedBeautyIsTheFilmsLessItsNoise) {
  const Rendered r;
  const Image film = film_layers(*r.session, {})[0].image,
              clean = denoised_beauty(*r.session, Denoiser::Own).color;
  ASSERT_EQ(clean.channels, 3);
  for (std::size_t i = 0; i < clean.pixel_count(); ++i)
    EXPECT_NEAR(clean.pixels[3 * i], film.pixels[4 * i], 0.02f);
}

TEST(Output, OutputShadersActOnAllFilesAndLeaveTheLinearLayerAlone) {
  const TestFolder folder;
  Rendered r("output \"mia_exposure_simple\" ( \"gain\" .5, \"compression\" 0, \"gamma\" 1 )");
  const scene::Scene& scene = r.prepared.scene;
  const scene::Camera* camera = find_camera(scene, scene.renders.back());
  ASSERT_NE(camera, nullptr);
  const NodeList shaders = camera_output_shaders(*camera, scene, builtin_shaders(),
                                                 *r.prepared.world, r.prepared.diagnostics);
  ASSERT_EQ(shaders.size(), 1u);
  const Image shown = shown_image(*r.session, shaders);
  const Image plain = shown_image(*r.session, {});
  EXPECT_NEAR(shown.at(4, 4)[1], plain.at(4, 4)[1] / 2, 1e-6f);
  PictureFile file = float_file(folder.file("a.exr"));
  file.shaders = shaders;
  write_picture(file, *r.session, {});
  EXPECT_NEAR(read_exr_image(file.path).at(4, 4)[1], plain.at(4, 4)[1] / 2, 1e-6f);
  const ExrFile read = read_exr(file.path);
  ASSERT_NE(find_layer(read.layers, "linear"), nullptr);
  EXPECT_EQ(find_layer(read.layers, "linear")->image.at(4, 4)[1], plain.at(4, 4)[1]);
}

TEST(Output, FormatMayDifferFromTheSuffix) {
  const TestFolder folder;
  const Rendered r;
  PictureFile file = float_file(folder.file("a.pic"));
  file.format = "png";
  write_picture(file, *r.session, {});
  const auto bytes = bytes_of(file.path);
  ASSERT_GT(bytes.size(), 4u);
  EXPECT_EQ(std::string(bytes.data() + 1, 3), "PNG");
  EXPECT_EQ(folder.count(), 1);
}

}  // namespace output_test
}  // namespace oriel
