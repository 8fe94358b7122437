// SPDX-License-Identifier: Apache-2.0
#include "output/camera_output.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "output/output_names.h"
#include "prepare/testing/prepared_scene.h"
#include "support/files.h"

namespace oriel {
namespace camera_output_test {

namespace fs = std::filesystem;
using testing::PreparedScene;

constexpr const char* kSurface = "material \"m\" \"mib_illum_lambert\" ( ) end material ";

/// The files of a camera with these statements, written below `folder`.
struct AovValues {
  PreparedScene prepared;
  std::vector<PictureFile> files;

  AovValues(const std::string& statements, const std::string& folder)
      : prepared(testing::scene_text(kSurface, {}, statements)) {
    const scene::Camera* camera = find_camera(prepared.scene, prepared.scene.renders.back());
    files = camera_outputs(*camera, {folder, {folder}}, prepared.scene, builtin_shaders(),
                           *prepared.world, prepared.diagnostics);
  }
};

std::string name_of(const PictureFile& file) { return fs::path(file.path).filename().string(); }

TEST(CameraOutput, ThreeStringsAreTypesFormatAndFile) {
  const TestFolder folder;
  const AovValues o("output \"+rgba_h,z\" \"exr\" \"a.exr\" output \"rgb\" \"png\" \"b.pic\"",
                    folder.file(""));
  ASSERT_EQ(o.files.size(), 2u);
  EXPECT_EQ(name_of(o.files[0]), "a.exr");
  EXPECT_EQ(o.files[0].samples, SampleFormat::Half);
  EXPECT_EQ(o.files[0].layers, LayerSet("depth"));
  EXPECT_EQ(o.files[1].format, "png");
  EXPECT_EQ(o.files[1].view, PixelView::Color);
}

TEST(CameraOutput, WithTwoStringsTheSuffixDecides) {
  const TestFolder folder;
  const AovValues o(
      "output \"rgba\" \"a.tif\" output \"rgb\" \"b.sgi\" output \"png\" \"c\" output \"rgb\" "
      "\"d.jpg\"",
      folder.file(""));
  ASSERT_EQ(o.files.size(), 4u);
  EXPECT_EQ(o.files[0].format, "tif");
  EXPECT_EQ(o.files[0].view, PixelView::ColorAlpha);
  EXPECT_EQ(o.files[1].format, "sgi");
  EXPECT_EQ(o.files[1].view, PixelView::Color);
  EXPECT_EQ(o.files[2].format, "png");
  EXPECT_EQ(o.files[3].format, "jpg");
}

TEST(CameraOutput, NumberTypesChooseDepthOfTheFile) {
  const TestFolder folder;
  const AovValues o(
      "output \"rgba_16\" \"tif\" \"a.tif\" output \"rgba_fp\" \"tif\" \"b.tif\" "
      "output \"rgba\" \"exr\" \"c.exr\"",
      folder.file(""));
  ASSERT_EQ(o.files.size(), 3u);
  EXPECT_EQ(o.files[0].samples, SampleFormat::U16);
  EXPECT_FALSE(o.files[0].float_pixels);
  EXPECT_EQ(o.files[1].samples, SampleFormat::Float);
  EXPECT_TRUE(o.files[1].float_pixels);
  EXPECT_EQ(o.files[2].samples, SampleFormat::Float);
}

TEST(CameraOutput, EveryTypeOfDataIsAFileOfItsOwn) {
  const TestFolder folder;
  const struct {
    const char* type;
    PixelView view;
    SampleFormat samples;
    bool linear;
  } types[] = {{"rgba", PixelView::ColorAlpha, SampleFormat::U8, false},
               {"+rgba_16", PixelView::ColorAlpha, SampleFormat::U16, false},
               {"-rgb_h", PixelView::Color, SampleFormat::Half, true},
               {"rgbe", PixelView::Color, SampleFormat::Float, true},
               {"a_16", PixelView::Alpha, SampleFormat::U16, false},
               {"s", PixelView::Intensity, SampleFormat::U8, false},
               {"s_fp", PixelView::Intensity, SampleFormat::Float, true},
               {"bit", PixelView::Bit, SampleFormat::U8, false},
               {"z", PixelView::Depth, SampleFormat::Float, true},
               {"-n", PixelView::Normal, SampleFormat::Float, true},
               {"tag", PixelView::Tag, SampleFormat::Float, true},
               {"coverage", PixelView::Coverage, SampleFormat::Float, true}};
  for (const auto& t : types) {
    const AovValues o("output \"" + std::string(t.type) + "\" \"tif\" \"a.tif\"", folder.file(""));
    ASSERT_EQ(o.files.size(), 1u) << t.type << o.prepared.messages();
    EXPECT_EQ(o.files[0].view, t.view) << t.type;
    EXPECT_EQ(o.files[0].samples, t.samples) << t.type;
    EXPECT_EQ(o.files[0].float_pixels, t.linear) << t.type;
    EXPECT_EQ(o.prepared.messages(), "") << t.type;
    EXPECT_EQ(needs(o.files[0], LayerNeed::Mattes),
              t.view == PixelView::Tag || t.view == PixelView::Coverage);
  }
}

TEST(CameraOutput, UnsupportedDataIsReported) {
  const TestFolder folder;
  const auto told = [&](const std::string& statement) {
    return AovValues(statement, folder.file("")).prepared.messages();
  };
  EXPECT_NE(told("output \"z\" \"png\" \"a.png\"").find("OR-RN-061"), std::string::npos);
  EXPECT_NE(told("output \"rgba_fp\" \"png\" \"a.png\"").find("16 bits"), std::string::npos);
  EXPECT_NE(told("output \"rgba_16\" \"jpg\" \"a.jpg\"").find("8 bits"), std::string::npos);
  EXPECT_EQ(told("output \"rgba_16\" \"png\" \"a.png\""), "");
  // Unsupported formats of the language are reported with the nearest supported one.
  EXPECT_NE(told("output \"rgba\" \"pic\" \"a.pic\"").find("nearest supported format is png"),
            std::string::npos);
  EXPECT_NE(told("output \"z\" \"zt\" \"a.zt\"").find("nearest supported format is exr"),
            std::string::npos);
  EXPECT_EQ(told("output \"m\" \"exr\" \"a.exr\""), "");
}

TEST(CameraOutput, NothingIsWrittenOutsideTheSceneFolder) {
  const TestFolder folder;
  fs::create_directory(folder.file("scene"));
  fs::create_directory(folder.file("other"));
  fs::create_symlink(folder.file("other"), folder.file("scene/link"));
  for (const char* name :
       {"../a.exr", "..\\\\a.exr", "sub/../../a.exr", "link/a.exr", "C:\\\\.."}) {
    const AovValues o("output \"rgba\" \"exr\" \"" + std::string(name) + "\"",
                      folder.file("scene"));
    EXPECT_TRUE(o.files.empty()) << name;
    EXPECT_TRUE(o.prepared.diagnostics.has("OR-RN-050")) << name << o.prepared.messages();
  }
  for (const char* name : {"a.exr", "./a.exr", "sub/../a.exr", "sub/a.exr"}) {
    const AovValues o("output \"rgba\" \"exr\" \"" + std::string(name) + "\"",
                      folder.file("scene"));
    EXPECT_EQ(o.files.size(), 1u) << name;
  }
}

TEST(CameraOutput, SiblingFolderWithTheSameBeginningIsOutside) {
  const TestFolder folder;
  fs::create_directory(folder.file("scene"));
  fs::create_directory(folder.file("scene2"));
  EXPECT_EQ(allowed_path("../scene2/a.exr", {folder.file("scene"), {folder.file("scene")}}), "");
}

TEST(CameraOutput, WriteErrorsAreReported) {
  const TestFolder folder;
  const AovValues o("output \"contour\" \"png\" \"a.png\" output \"rgba\" \"ps\" \"b.ps\"",
                    folder.file(""));
  EXPECT_TRUE(o.files.empty());
  EXPECT_TRUE(o.prepared.diagnostics.has("OR-RN-051"));
}

TEST(CameraOutput, OutputShadersActOnTheFilesAfterThem) {
  const TestFolder folder;
  const AovValues o(
      "output \"rgba\" \"png\" \"a.png\" output \"mia_exposure_simple\" ( \"gain\" 2 ) "
      "output \"rgba\" \"png\" \"b.png\" output \"mib_illum_lambert\" ( )",
      folder.file(""));
  ASSERT_EQ(o.files.size(), 2u);
  EXPECT_TRUE(o.files[0].shaders.empty());
  EXPECT_EQ(o.files[1].shaders.size(), 1u);
  EXPECT_TRUE(o.prepared.diagnostics.has("OR-RN-052"));
}

TEST(CameraOutput, FrameBuffersNamedAsAnOutputShowIt) {
  const TestFolder folder;
  const AovValues o(
      "framebuffer \"fb_diffuse_raw\" datatype \"rgba_h\" filename \"d.exr\" filetype \"exr\" "
      "framebuffer \"opacity\" datatype \"rgb_16\" filename \"o.tif\" "
      "framebuffer \"main:spec_level\" filename \"s.bin\" filetype \"png\" user on filtering off "
      "framebuffer \"refl_raw\" datatype \"rgba\"",
      folder.file(""));
  EXPECT_TRUE(o.prepared.diagnostics.all().empty()) << o.prepared.messages();
  ASSERT_EQ(o.files.size(), 3u);
  EXPECT_EQ(name_of(o.files[0]), "d.exr");
  EXPECT_EQ(o.files[0].shown_layer, "diffuse_raw");
  EXPECT_EQ(o.files[0].samples, SampleFormat::Half);
  EXPECT_TRUE(o.files[0].layers.empty());
  EXPECT_TRUE(o.files[0].float_pixels);
  EXPECT_EQ(o.files[1].shown_layer, "opacity");
  EXPECT_EQ(o.files[1].samples, SampleFormat::U16);
  EXPECT_EQ(o.files[1].format, "tif");
  EXPECT_EQ(o.files[2].shown_layer, "spec_level");
  EXPECT_EQ(o.files[2].format, "png");
}

TEST(CameraOutput, EveryOutputCanBeAFrameBuffer) {
  const TestFolder folder;
  std::string statements;
  for (const std::string& name : material_output_names())
    statements += "framebuffer \"" + name + "\" filename \"" + name + ".exr\" ";
  const AovValues o(statements, folder.file(""));
  ASSERT_EQ(o.files.size(), material_output_names().size()) << o.prepared.messages();
  for (std::size_t i = 0; i < o.files.size(); ++i)
    EXPECT_EQ(o.files[i].shown_layer, material_output_names()[i]);
}

TEST(CameraOutput, ThePrimaryFrameBufferIsThePicture) {
  const TestFolder folder;
  const AovValues o(
      "output \"mia_exposure_simple\" ( \"gain\" 2 ) "
      "framebuffer \"main\" datatype \"rgba\" filename \"a.jpg\" quality 70 primary on "
      "framebuffer \"Beauty\" datatype \"rgb\" filename \"b.png\" "
      "framebuffer \"depth\" datatype \"z\" filename \"z.exr\" "
      "framebuffer \"diffuse_result\" filename \"d.png\"",
      folder.file(""));
  ASSERT_EQ(o.files.size(), 4u) << o.prepared.messages();
  EXPECT_EQ(o.files[0].shown_layer, "");
  EXPECT_EQ(o.files[0].view, PixelView::ColorAlpha);
  EXPECT_EQ(o.files[0].quality, 70);
  EXPECT_EQ(o.files[0].shaders.size(), 1u);
  EXPECT_EQ(o.files[1].shown_layer, "");
  EXPECT_EQ(o.files[1].view, PixelView::Color);
  EXPECT_EQ(o.files[2].view, PixelView::Depth);
  EXPECT_EQ(o.files[2].shown_layer, "");
  EXPECT_EQ(o.files[3].shown_layer, "diffuse_result");
  EXPECT_TRUE(o.files[3].shaders.empty());
}

TEST(CameraOutput, FrameBuffersOfOneExrFileAreItsLayers) {
  const TestFolder folder;
  const AovValues o(
      "output \"rgba_h,z\" \"exr\" \"all.exr\" "
      "framebuffer \"diffuse_raw\" datatype \"rgb_fp\" filename \"all.exr\" "
      "framebuffer \"spec_raw\" filename \"./all.exr\" "
      "framebuffer \"ao_raw\" filename \"two.exr\" framebuffer \"add_result\" filename "
      "\"two.exr\"",
      folder.file(""));
  ASSERT_EQ(o.files.size(), 2u);
  EXPECT_EQ(o.files[0].layers, LayerSet("depth") | LayerSet("diffuse_raw") | LayerSet("spec_raw"));
  EXPECT_EQ(o.files[0].samples, SampleFormat::Float);
  EXPECT_EQ(o.files[1].layers, LayerSet("ao_raw") | LayerSet("add_result"));
  for (const PictureFile& file : o.files) EXPECT_EQ(file.shown_layer, "");
}

TEST(CameraOutput, UnknownFrameBuffersAreReportedInOneMessage) {
  const TestFolder folder;
  const AovValues o(
      "framebuffer \"mystery\" datatype \"rgba\" filename \"a.exr\" "
      "framebuffer \"another\" datatype \"rgba\" filename \"b.exr\" "
      "framebuffer \"unwritten\" datatype \"rgba\"",
      folder.file(""));
  EXPECT_TRUE(o.files.empty());
  const Diagnostic* message = o.prepared.only("OR-RN-053");
  ASSERT_NE(message, nullptr) << o.prepared.messages();
  EXPECT_NE(message->message.find("\"mystery\", \"another\""), std::string::npos);
  EXPECT_EQ(message->message.find("unwritten"), std::string::npos);
  for (const std::string& name : material_output_names())
    EXPECT_NE(message->hint.find(name), std::string::npos) << name;
}

TEST(CameraOutput, FrameBuffersStayInTheSceneFolderAndInKnownFormats) {
  const TestFolder folder;
  fs::create_directory(folder.file("scene"));
  const AovValues o(
      "framebuffer \"diffuse_raw\" filename \"../a.exr\" "
      "framebuffer \"spec_raw\" filename \"b.ps\" "
      "framebuffer \"refl_raw\" datatype \"vts\" filename \"c.exr\"",
      folder.file("scene"));
  EXPECT_TRUE(o.files.empty());
  const Diagnostic* outside = o.prepared.only("OR-RN-050");
  ASSERT_NE(outside, nullptr) << o.prepared.messages();
  EXPECT_NE(outside->message.find("framebuffer \"../a.exr\""), std::string::npos);
  EXPECT_NE(o.prepared.messages().find("unsupported file format \"ps\""), std::string::npos);
  EXPECT_NE(o.prepared.messages().find("unsupported picture type \"vts\""), std::string::npos);
}

TEST(CameraOutput, NumberedBuffersAreLeftOutWithOneMessage) {
  const TestFolder folder;
  const AovValues alone("output \"fb0\" \"exr\" \"a.exr\"", folder.file(""));
  EXPECT_TRUE(alone.files.empty());
  EXPECT_NE(alone.prepared.only("OR-RN-054"), nullptr) << alone.prepared.messages();
  EXPECT_EQ(alone.prepared.diagnostics.all().size(), 1u) << alone.prepared.messages();

  const AovValues two("output \"+fb1\" \"a.exr\"", folder.file(""));
  EXPECT_TRUE(two.files.empty());
  EXPECT_NE(two.prepared.only("OR-RN-054"), nullptr) << two.prepared.messages();

  const AovValues among("output \"rgba,fb0,fb12\" \"exr\" \"a.exr\"", folder.file(""));
  EXPECT_EQ(among.files.size(), 1u);
  EXPECT_NE(among.prepared.only("OR-RN-054"), nullptr) << among.prepared.messages();
}

}  // namespace camera_output_test
}  // namespace oriel
