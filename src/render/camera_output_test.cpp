// SPDX-License-Identifier: Apache-2.0
#include "render/camera_output.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "image/test_files.h"
#include "render/testing/prepared_scene.h"

namespace oriel {
namespace {

namespace fs = std::filesystem;
using testing::PreparedScene;

constexpr const char* kSurface = "material \"m\" \"mib_illum_lambert\" ( ) end material ";

/// The files of a camera with these statements, written below `folder`.
struct Outputs {
  PreparedScene prepared;
  std::vector<PictureFile> files;

  Outputs(const std::string& statements, const std::string& folder)
      : prepared(testing::scene_text(kSurface, {}, statements)) {
    const scene::Camera* camera = find_camera(prepared.scene, prepared.scene.renders.back());
    files = camera_outputs(*camera, {folder, {folder}}, prepared.scene, builtin_shaders(),
                           *prepared.world, prepared.diagnostics);
  }
};

std::string name_of(const PictureFile& file) { return fs::path(file.path).filename().string(); }

TEST(CameraOutput, ThreeStringsAreTypesFormatAndFile) {
  const TestFolder folder;
  const Outputs o("output \"+rgba_h,z\" \"exr\" \"a.exr\" output \"rgb\" \"png\" \"b.pic\"",
                  folder.file(""));
  ASSERT_EQ(o.files.size(), 2u);
  EXPECT_EQ(name_of(o.files[0]), "a.exr");
  EXPECT_EQ(o.files[0].samples, SampleFormat::Half);
  EXPECT_EQ(o.files[0].layers, unsigned{kLayerDepth});
  EXPECT_EQ(o.files[1].format, "png");
  EXPECT_EQ(o.files[1].channels, Channels::Color);
}

TEST(CameraOutput, WithTwoStringsTheSuffixDecides) {
  const TestFolder folder;
  const Outputs o(
      "output \"rgba\" \"a.tif\" output \"rgb\" \"b.sgi\" output \"png\" \"c\" output \"rgb\" "
      "\"d.jpg\"",
      folder.file(""));
  ASSERT_EQ(o.files.size(), 4u);
  EXPECT_EQ(o.files[0].format, "tif");
  EXPECT_EQ(o.files[0].channels, Channels::ColorAlpha);
  EXPECT_EQ(o.files[1].format, "sgi");
  EXPECT_EQ(o.files[1].channels, Channels::Color);
  EXPECT_EQ(o.files[2].format, "png");
  EXPECT_EQ(o.files[3].format, "jpg");
}

TEST(CameraOutput, NumberTypesChooseDepthOfTheFile) {
  const TestFolder folder;
  const Outputs o(
      "output \"rgba_16\" \"tif\" \"a.tif\" output \"rgba_fp\" \"tif\" \"b.tif\" "
      "output \"rgba\" \"exr\" \"c.exr\"",
      folder.file(""));
  ASSERT_EQ(o.files.size(), 3u);
  EXPECT_EQ(o.files[0].samples, SampleFormat::U16);
  EXPECT_FALSE(o.files[0].linear);
  EXPECT_EQ(o.files[1].samples, SampleFormat::Float);
  EXPECT_TRUE(o.files[1].linear);
  EXPECT_EQ(o.files[2].samples, SampleFormat::Float);
}

TEST(CameraOutput, NothingIsWrittenOutsideTheSceneFolder) {
  const TestFolder folder;
  fs::create_directory(folder.file("scene"));
  fs::create_directory(folder.file("other"));
  fs::create_symlink(folder.file("other"), folder.file("scene/link"));
  for (const char* name :
       {"../a.exr", "/tmp/a.exr", "sub/../../a.exr", "link/a.exr", "/etc/passwd.exr"}) {
    const Outputs o("output \"rgba\" \"exr\" \"" + std::string(name) + "\"", folder.file("scene"));
    EXPECT_TRUE(o.files.empty()) << name;
    EXPECT_TRUE(o.prepared.diagnostics.has("OR-RN-050")) << name << o.prepared.messages();
  }
  for (const char* name : {"a.exr", "./a.exr", "sub/../a.exr", "sub/a.exr"}) {
    const Outputs o("output \"rgba\" \"exr\" \"" + std::string(name) + "\"", folder.file("scene"));
    EXPECT_EQ(o.files.size(), 1u) << name;
  }
}

TEST(CameraOutput, SiblingFolderWithTheSameBeginningIsOutside) {
  const TestFolder folder;
  fs::create_directory(folder.file("scene"));
  fs::create_directory(folder.file("scene2"));
  EXPECT_EQ(allowed_path("../scene2/a.exr", {folder.file("scene"), {folder.file("scene")}}), "");
}

TEST(CameraOutput, WhatCannotBeWrittenIsSaid) {
  const TestFolder folder;
  const Outputs o("output \"contour\" \"png\" \"a.png\" output \"rgba\" \"ps\" \"b.ps\"",
                  folder.file(""));
  EXPECT_TRUE(o.files.empty());
  EXPECT_TRUE(o.prepared.diagnostics.has("OR-RN-051"));
}

TEST(CameraOutput, OutputShadersActOnTheFilesAfterThem) {
  const TestFolder folder;
  const Outputs o(
      "output \"rgba\" \"png\" \"a.png\" output \"mia_exposure_simple\" ( \"gain\" 2 ) "
      "output \"rgba\" \"png\" \"b.png\" output \"mib_illum_lambert\" ( )",
      folder.file(""));
  ASSERT_EQ(o.files.size(), 2u);
  EXPECT_TRUE(o.files[0].shaders.empty());
  EXPECT_EQ(o.files[1].shaders.size(), 1u);
  EXPECT_TRUE(o.prepared.diagnostics.has("OR-RN-052"));
}

}  // namespace
}  // namespace oriel
