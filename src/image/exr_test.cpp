// SPDX-License-Identifier: Apache-2.0
#include "image/exr.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <stdexcept>

#include "support/files.h"

namespace oriel {
namespace exr_test {

Image noise(int width, int height, int channels, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-2, 50);
  Image image(width, height, channels);
  for (float& v : image.pixels) v = value(random);
  return image;
}

std::vector<Layer> three_layers() {
  return {{"", {"R", "G", "B", "A"}, noise(33, 21, 4, 1)},
          {"diffuse_result", {"R", "G", "B"}, noise(33, 21, 3, 2)},
          {"Z", {""}, noise(33, 21, 1, 3)}};
}

TEST(Exr, LayersAndMetadataRoundTripExactly) {
  const TestFolder folder;
  const std::string path = folder.file("a.exr");
  const std::vector<Layer> layers = three_layers();
  ExrOptions options;
  const ExrMatrix matrix = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16};
  options.metadata = {{"oriel.samples", 64.5f},
                      {"oriel.seed", 7},
                      {"oriel.scene", std::string("room.mi")},
                      {"worldToCamera", matrix}};
  write_exr(path, layers, options);

  const ExrFile back = read_exr(path);
  ASSERT_EQ(back.layers.size(), 3u);
  EXPECT_EQ(back.layers[0].name, "") << "the beauty comes first";
  for (const Layer& want : layers) {
    const Layer* got = find_layer(back.layers, want.name);
    ASSERT_NE(got, nullptr) << want.name;
    EXPECT_EQ(got->channel_names, want.channel_names);
    EXPECT_EQ(got->image.pixels, want.image.pixels);
  }
  EXPECT_EQ(back.metadata, options.metadata);
  EXPECT_EQ(number_attribute(back, "oriel.samples"), 64.5f);
  EXPECT_EQ(number_attribute(back, "oriel.seed"), 7.0f);
  EXPECT_EQ(text_attribute(back, "oriel.scene"), "room.mi");
  EXPECT_EQ(number_attribute(back, "oriel.scene"), std::nullopt);
  EXPECT_EQ(folder.count(), 1) << "no temporary file is left";
}

// Primaries and white of ITU-R BT.709-6, table 1.
TEST(Exr, HeaderNamesRec709) {
  const TestFolder folder;
  write_exr(folder.file("a.exr"), three_layers());
  const ExrFile back = read_exr(folder.file("a.exr"));
  ASSERT_TRUE(back.has_chromaticities);
  const float rec709[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
  for (int i = 0; i < 8; ++i) EXPECT_FLOAT_EQ(back.chromaticities[i], rec709[i]) << i;
}

TEST(Exr, HalfAppliesToColourNotDepth) {
  const TestFolder folder;
  std::vector<Layer> layers = three_layers();
  layers[0].image.pixels[0] = 1e9f;
  ExrOptions options;
  options.precision = ExrPrecision::Half;
  write_exr(folder.file("a.exr"), layers, options);
  const ExrFile back = read_exr(folder.file("a.exr"));
  EXPECT_EQ(find_layer(back.layers, "Z")->image.pixels, layers[2].image.pixels);
  const Image& colour = find_layer(back.layers, "")->image;
  EXPECT_EQ(colour.pixels[0], 65504.0f) << "too large a value becomes the largest half";
  for (std::size_t i = 1; i < colour.pixels.size(); ++i)
    ASSERT_NEAR(colour.pixels[i], layers[0].image.pixels[i], 50 * 0x1p-11f);
}

TEST(Exr, HalvesAreRoundedToNearestAlsoBelowTheNormalRange) {
  const TestFolder folder;
  // Exact values, ties, and values on both sides of ties, in units of 2^-24 and near 1 and 65504.
  std::vector<float> values = {
      0,          0x1p-24f,        0x1p-25f,       0x1.000002p-25f, 0x1.8p-24f,
      0x1.4p-23f, 0x1.7ffffep-24f, 0x1.ff8p-15f,   0x1.ffcp-15f,    0x1p-14f,
      5.65e-5f,   1.00048828125f,  1.00146484375f, 65503.9f,        1e-30f};
  const std::vector<float> wanted = {
      0,        0x1p-24f, 0,           0x1p-24f, 0x1p-23f,     0x1p-23f, 0x1p-24f, 0x1.ff8p-15f,
      0x1p-14f, 0x1p-14f, 0x1.dap-15f, 1,        1.001953125f, 65504,    0};
  Image image(static_cast<int>(2 * values.size()), 1, 3);
  for (std::size_t i = 0; i < values.size(); ++i) {
    image.pixels[6 * i] = values[i];
    image.pixels[6 * i + 3] = -values[i];
  }
  write_exr(folder.file("a.exr"), {{"", {"R", "G", "B"}, image}},
            {.precision = ExrPrecision::Half});
  const Image back = read_exr_image(folder.file("a.exr"));
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_EQ(back.pixels[6 * i], wanted[i]) << values[i];
    EXPECT_EQ(back.pixels[6 * i + 3], -wanted[i]) << values[i];
  }
}

TEST(Exr, HalfIfFitsKeepsLayersBeyondItsRangeInFloat) {
  const TestFolder folder;
  std::vector<Layer> layers = three_layers();
  layers[0].image.pixels[0] = 65505;
  write_exr(folder.file("a.exr"), layers, {.precision = ExrPrecision::HalfIfFits});
  const ExrFile back = read_exr(folder.file("a.exr"));
  EXPECT_EQ(find_layer(back.layers, "")->image.pixels, layers[0].image.pixels);
  const Image& colour = find_layer(back.layers, "diffuse_result")->image;
  EXPECT_NE(colour.pixels, layers[1].image.pixels) << "16 bits";
  for (std::size_t i = 0; i < colour.pixels.size(); ++i)
    ASSERT_NEAR(colour.pixels[i], layers[1].image.pixels[i], 50 * 0x1p-11f);
}

// acceptance: M9
TEST(Exr, EveryCompressionKeepsExactLayersAndDwaLosesColourOnly) {
  const TestFolder folder;
  std::vector<Layer> layers = three_layers();
  // Names that OpenEXR compresses with loss by DWAA and DWAB: R, G, B and Y.
  layers.push_back({"variance", {"R", "G", "B"}, noise(33, 21, 3, 4), true});
  layers.push_back({"normal", {"X", "Y", "Z"}, noise(33, 21, 3, 5), true});
  layers.push_back({"CryptoObject00", {"r", "g", "b", "a"}, noise(33, 21, 4, 6)});
  for (std::size_t c = 0; c < kExrCompressionNames.size(); ++c) {
    const auto compression = static_cast<ExrCompression>(c);
    const bool lossy = kExrCompressionNames[c].starts_with("dwa");
    for (const ExrPrecision precision : {ExrPrecision::Float, ExrPrecision::HalfIfFits}) {
      write_exr(folder.file("a.exr"), layers, {.precision = precision, .compression = compression});
      const ExrFile back = read_exr(folder.file("a.exr"));
      for (const Layer& want : layers) {
        const Layer* got = find_layer(back.layers, want.name);
        ASSERT_NE(got, nullptr) << want.name;
        const bool exact = want.exact || want.name == "Z" || want.name == "CryptoObject00";
        if (exact || (!lossy && precision == ExrPrecision::Float))
          EXPECT_EQ(got->image.pixels, want.image.pixels)
              << want.name << " " << kExrCompressionNames[c];
        else
          EXPECT_NE(got->image.pixels, want.image.pixels)
              << want.name << " " << kExrCompressionNames[c];
      }
    }
  }
}

TEST(Exr, DataWindowIsWrittenInTheDisplayWindow) {
  const TestFolder folder;
  const std::vector<Layer> layers = three_layers();
  write_exr(folder.file("a.exr"), layers, {.window = ExrWindow{5, 3, 20, 9}});
  Imf::InputFile file(folder.file("a.exr").c_str());
  EXPECT_EQ(file.header().displayWindow(), Imath::Box2i({0, 0}, {32, 20}));
  EXPECT_EQ(file.header().dataWindow(), Imath::Box2i({5, 3}, {19, 8}));
  const Image image = read_exr_image(folder.file("a.exr"));
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 33; ++x) {
      const bool inside = x >= 5 && x < 20 && y >= 3 && y < 9;
      ASSERT_EQ(image.at(x, y)[2], inside ? layers[0].image.at(x, y)[2] : 0) << x << " " << y;
    }
}

TEST(Exr, SameLayersGiveTheSameBytes) {
  const TestFolder folder;
  ExrOptions threaded;
  threaded.threads = 2;
  write_exr(folder.file("a.exr"), three_layers());
  write_exr(folder.file("b.exr"), three_layers(), threaded);
  EXPECT_EQ(bytes_of(folder.file("a.exr")), bytes_of(folder.file("b.exr")));
}

TEST(Exr, DataWindowIsPlacedInTheDisplayWindow) {
  const TestFolder folder;
  const std::string path = folder.file("a.exr");
  // Display 4 x 3; data covers columns -1...1 and rows 1...2.
  Imf::Header header(Imath::Box2i({0, 0}, {3, 2}), Imath::Box2i({-1, 1}, {1, 2}));
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  float values[6] = {1, 2, 3, 4, 5, 6};
  Imf::FrameBuffer frame;
  frame.insert("Y", Imf::Slice::Make(Imf::FLOAT, values, header.dataWindow()));
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(frame);
    file.writePixels(2);
  }
  const Image image = read_exr_image(path);
  ASSERT_EQ(image.width, 4);
  ASSERT_EQ(image.height, 3);
  const std::vector<float> want = {0, 0, 0, 0, 2, 3, 0, 0, 5, 6, 0, 0};
  EXPECT_EQ(image.pixels, want);
}

TEST(Exr, InvalidLayersAreRefused) {
  const TestFolder folder;
  std::vector<Layer> sizes = three_layers();
  sizes[1].image = noise(3, 3, 3, 1);
  EXPECT_THROW(write_exr(folder.file("a.exr"), sizes), std::runtime_error);
  std::vector<Layer> names = three_layers();
  names[1].name = "";
  EXPECT_THROW(write_exr(folder.file("a.exr"), names), std::runtime_error);
  EXPECT_THROW(write_exr(folder.file("no/such/folder/a.exr"), three_layers()), std::runtime_error);
  EXPECT_EQ(folder.count(), 0);
}

/// Reads bytes as a file; true if that threw an exception whose message contains the file name.
bool is_refused(const TestFolder& folder, const std::vector<char>& bytes) {
  const std::string path = folder.file("broken.exr");
  write_bytes(path, bytes);
  try {
    read_exr(path);
    return false;
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("broken.exr"), std::string::npos);
    return true;
  }
}

TEST(Exr, BrokenFilesThrowAndNeverCrash) {
  const TestFolder folder;
  EXPECT_THROW(read_exr(folder.file("missing.exr")), std::runtime_error);
  EXPECT_TRUE(is_refused(folder, {}));
  write_exr(folder.file("good.exr"), three_layers());
  const std::vector<char> good = bytes_of(folder.file("good.exr"));

  // Truncation at any position.
  for (std::size_t n = 1; n < good.size() - 1; n += good.size() / 97)
    EXPECT_TRUE(is_refused(folder, std::vector<char>(good.begin(), good.begin() + long(n)))) << n;

  // Random bytes, and valid files with a few wrong bytes, which may still be readable.
  std::mt19937 random(7);
  std::vector<char> garbage(4000);
  for (char& c : garbage) c = char(random());
  EXPECT_TRUE(is_refused(folder, garbage));
  for (int i = 0; i < 400; ++i) {
    std::vector<char> bytes = good;
    const std::size_t range = i % 2 ? bytes.size() : 600;
    for (int k = 0; k < 3; ++k) bytes[random() % range] = char(random());
    is_refused(folder, bytes);
  }
}

TEST(Exr, HugeImageInASmallFileIsRefused) {
  const TestFolder folder;
  write_exr(folder.file("good.exr"), three_layers());
  const std::vector<char> good = bytes_of(folder.file("good.exr"));
  for (const int side : {60000, 2000000000}) {
    std::vector<char> bytes = good;
    for (const char* name : {"dataWindow", "displayWindow"}) {
      const std::string key = std::string(name) + '\0' + "box2i" + '\0';
      const auto at = std::search(bytes.begin(), bytes.end(), key.begin(), key.end());
      ASSERT_NE(at, bytes.end());
      // After the key: 4 bytes of size, then x0 y0 x1 y1.
      for (int corner = 2; corner < 4; ++corner)
        std::memcpy(&*at + key.size() + 4 + 4 * corner, &side, 4);
    }
    EXPECT_TRUE(is_refused(folder, bytes)) << side;
  }
}

}  // namespace exr_test
}  // namespace oriel
