// SPDX-License-Identifier: Apache-2.0
#include "image/png.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "support/files.h"

namespace oriel {
namespace png_test {

/// Every value is a multiple of one step of the given bit depth.
Image steps(int width, int height, int channels, int bits) {
  const int most = (1 << bits) - 1;
  std::mt19937 random(5);
  Image image(width, height, channels);
  for (float& v : image.pixels) v = float(random() % (most + 1)) / float(most);
  image.pixels.front() = 0;
  image.pixels.back() = 1;
  return image;
}

TEST(Png, QuantisedValuesRoundTripExactly) {
  const TestFolder folder;
  for (const int bits : {8, 16})
    for (int channels = 1; channels <= 4; ++channels) {
      const Image image = steps(37, 11, channels, bits);
      PngOptions options;
      options.bits = bits;
      options.encoding = PngEncoding::Srgb;
      write_png(folder.file("a.png"), image, options);
      const Image back = read_png(folder.file("a.png"));
      EXPECT_EQ(back.channels, channels);
      EXPECT_EQ(back.pixels, image.pixels) << bits << " bits, " << channels << " channels";
    }
}

TEST(Png, OutOfRangeIsClippedAndNanIsBlack) {
  const TestFolder folder;
  Image image(4, 1, 1);
  image.pixels = {-3, 7, std::numeric_limits<float>::quiet_NaN(),
                  std::numeric_limits<float>::infinity()};
  write_png(folder.file("a.png"), image);
  EXPECT_EQ(read_png(folder.file("a.png")).pixels, (std::vector<float>{0, 1, 0, 1}));
}

TEST(Png, GammaIsInTheHeaderOnRequestOnly) {
  const TestFolder folder;
  const auto says = [&](const PngOptions& options, const std::string& chunk) {
    write_png(folder.file("a.png"), steps(4, 4, 3, 8), options);
    const std::vector<char> bytes = bytes_of(folder.file("a.png"));
    return std::search(bytes.begin(), bytes.end(), chunk.begin(), chunk.end()) != bytes.end();
  };
  PngOptions options;
  EXPECT_FALSE(says(options, "gAMA"));
  options.encoding = PngEncoding::Gamma;
  // 1 / 2.2 in units of 1/100000 is 45455 = 0xb18f (PNG specification, 11.3.3.2).
  EXPECT_TRUE(says(options, std::string("gAMA\x00\x00\xb1\x8f", 8)));
  options.encoding = PngEncoding::Srgb;
  EXPECT_TRUE(says(options, "sRGB"));
}

TEST(Png, DitherKeepsTheMeanBetweenTwoSteps) {
  const TestFolder folder;
  Image image(128, 128, 1, 100.3f / 255);
  PngOptions options;
  options.dither = true;
  write_png(folder.file("a.png"), image, options);
  double sum = 0;
  for (const float v : read_png(folder.file("a.png")).pixels) {
    ASSERT_LE(std::abs(v * 255 - 100.3f), 1.0f);
    sum += v * 255;
  }
  EXPECT_NEAR(sum / (128 * 128), 100.3, 0.01);
}

TEST(Png, BrokenFilesThrowAndNeverCrash) {
  const TestFolder folder;
  EXPECT_THROW(read_png(folder.file("missing.png")), std::runtime_error);
  write_png(folder.file("good.png"), steps(40, 30, 3, 8));
  const std::vector<char> good = bytes_of(folder.file("good.png"));
  const std::string path = folder.file("broken.png");
  for (std::size_t n = 0; n + 20 < good.size(); n += 1 + good.size() / 97) {
    write_bytes(path, std::vector<char>(good.begin(), good.begin() + long(n)));
    EXPECT_THROW(read_png(path), std::runtime_error) << n;
  }
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    std::vector<char> bytes = good;
    for (int k = 0; k < 3; ++k) bytes[random() % (i % 2 ? bytes.size() : 60)] = char(random());
    write_bytes(path, bytes);
    try {
      read_png(path);
    } catch (const std::runtime_error&) {
    }
  }
}

TEST(Png, UnknownShapesAreRefused) {
  const TestFolder folder;
  EXPECT_THROW(write_png(folder.file("a.png"), Image(2, 2, 5)), std::runtime_error);
  EXPECT_THROW(write_png(folder.file("a.png"), Image()), std::runtime_error);
  PngOptions options;
  options.bits = 12;
  EXPECT_THROW(write_png(folder.file("a.png"), Image(2, 2, 3), options), std::runtime_error);
}

}  // namespace png_test
}  // namespace oriel
