// SPDX-License-Identifier: Apache-2.0
#include "image/files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

#include "image/exr.h"
#include "image/module.h"
#include "image/png.h"
#include "image/texture.h"
#include "support/files.h"

namespace oriel {
namespace files_test {

bool openimageio_is_loaded() {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);)
    if (line.find("libOpenImageIO") != std::string::npos) return true;
  return false;
}

// Initialised before any test runs, in any order of tests.
const bool kLoadedAtStart = openimageio_is_loaded();

TEST(ImageModule, OpenImageIoIsAbsentUntilAFileTextureIsOpened) {
  EXPECT_FALSE(kLoadedAtStart);
  const TestFolder folder;
  const bool opened_by_another_test = image_module_is_open();
  write_png(folder.file("a.png"), Image(2, 2, 3, 0.5f));
  write_exr(folder.file("a.exr"), {{"", {"R", "G", "B"}, Image(2, 2, 3, 0.5f)}});
  EXPECT_EQ(read_image(folder.file("a.png")).width, 2);
  EXPECT_EQ(read_image(folder.file("a.exr")).width, 2);
  const std::uint8_t byte[] = {255};
  EXPECT_NE(make_memory_texture(1, 1, 1, byte), nullptr);
  EXPECT_EQ(openimageio_is_loaded(), opened_by_another_test);

  TextureSystem system;
  EXPECT_NE(system.open(folder.file("a.png")).texture, nullptr);
  EXPECT_TRUE(image_module_is_open());
  EXPECT_TRUE(openimageio_is_loaded());
}

TEST(ImageModule, UserPathIsSearchedFirst) {
  ::setenv("ORIEL_MODULE_PATH", "/first:/second", 1);
  const std::vector<std::string> places = module_candidates();
  ::unsetenv("ORIEL_MODULE_PATH");
  ASSERT_GE(places.size(), 4u);
  EXPECT_EQ(places[0], "/first/liboriel_image_files.so");
  EXPECT_EQ(places[1], "/second/liboriel_image_files.so");
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  EXPECT_EQ(places[2], program + "/liboriel_image_files.so") << "then beside the program";
  const std::string prefix = std::filesystem::path(program).parent_path();
  EXPECT_EQ(places[3], prefix + "/lib/oriel/liboriel_image_files.so");
}

Image gradient(int channels) {
  Image image(17, 9, channels);
  for (int y = 0; y < 9; ++y)
    for (int x = 0; x < 17; ++x)
      for (int c = 0; c < channels; ++c) image.at(x, y)[c] = float(10 * x + 5 * y + c) / 255;
  return image;
}

TEST(Files, LosslessFormatsRoundTripExactly) {
  const TestFolder folder;
  for (const char* name : {"a.tif", "a.png", "a.exr", "a.tga", "a.bmp", "a.TIF"}) {
    const Image image = gradient(3);
    FileOptions options;
    if (std::string(name) == "a.exr") options.format = SampleFormat::Float;
    write_image(folder.file(name), image, options);
    const Image back = read_image(folder.file(name));
    ASSERT_EQ(back.channels, 3) << name;
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      ASSERT_NEAR(back.pixels[i], image.pixels[i], 1e-6f) << name;
  }
}

TEST(Files, TiffKeepsColourUnderAlphaInEveryFormat) {
  const TestFolder folder;
  Image image = gradient(4);
  for (std::size_t p = 0; p < image.pixel_count(); ++p) image.pixels[4 * p + 3] = 51.0f / 255;
  for (const auto format :
       {SampleFormat::U8, SampleFormat::U16, SampleFormat::Half, SampleFormat::Float}) {
    FileOptions options;
    options.format = format;
    write_image(folder.file("a.tif"), image, options);
    const Image back = read_image(folder.file("a.tif"));
    ASSERT_EQ(back.channels, 4);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      ASSERT_NEAR(back.pixels[i], image.pixels[i], format == SampleFormat::Half ? 5e-4f : 1e-6f);
  }
}

TEST(Files, JpegDropsAlphaAndFollowsItsQuality) {
  const TestFolder folder;
  Image image(64, 64, 4);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (int c = 0; c < 4; ++c) image.at(x, y)[c] = 0.5f + 0.4f * std::sin(x * 0.7f + y * c);
  FileOptions fine, coarse;
  coarse.jpeg_quality = 10;
  write_image(folder.file("fine.jpg"), image, fine);
  write_image(folder.file("coarse.jpg"), image, coarse);
  EXPECT_EQ(read_image(folder.file("fine.jpg")).channels, 3);
  EXPECT_LT(2 * bytes_of(folder.file("coarse.jpg")).size(),
            bytes_of(folder.file("fine.jpg")).size());
}

TEST(Files, RadianceFilesKeepHighValuesToOnePercent) {
  const TestFolder folder;
  Image image = gradient(3);
  for (float& v : image.pixels) v = 1 + 900 * v;
  write_image(folder.file("a.hdr"), image, {SampleFormat::Float, 95, false});
  const Image back = read_image(folder.file("a.hdr"));
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    ASSERT_NEAR(back.pixels[i], image.pixels[i], 0.01f * image.pixels[i]);
}

TEST(Files, UnknownOrMissingFilesThrowWithTheirName) {
  const TestFolder folder;
  for (const char* name : {"a.nonsense", "missing.tif", "missing.png", "missing.exr"}) {
    try {
      read_image(folder.file(name));
      FAIL() << name;
    } catch (const std::runtime_error& e) {
      EXPECT_NE(std::string(e.what()).find(name), std::string::npos) << e.what();
    }
  }
  EXPECT_THROW(write_image(folder.file("a.nonsense"), gradient(3)), std::runtime_error);
  EXPECT_THROW(write_image(folder.file("a.tif"), Image()), std::runtime_error);
  EXPECT_EQ(folder.count(), 0);
}

}  // namespace files_test
}  // namespace oriel
