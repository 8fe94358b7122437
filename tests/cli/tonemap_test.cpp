// SPDX-License-Identifier: Apache-2.0
// oriel tonemap: automatic exposure, OpenColorIO, look-up tables, chunks of PNG files.
#include <cmath>
#include <cstring>

#include "image/exr.h"
#include "image/files.h"
#include "support/files.h"
#include "support/program.h"

namespace oriel {
namespace tonemap_test {

class Tonemap : public ProgramTest {
 protected:
  void write_greys(const std::vector<float>& greys) const {
    Image image(static_cast<int>(greys.size()), 1, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = greys[i / 3];
    write_image(file("in.exr"), image, {.format = SampleFormat::Float});
  }
  std::vector<float> mapped(std::vector<std::string> arguments) {
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

double decoded(double v) { return v <= .04045 ? v / 12.92 : std::pow((v + .055) / 1.055, 2.4); }

// acceptance: M10
TEST_F(Tonemap, AutoShowsTheLogMeanAsMiddleGrey) {
  // The log mean is the middle value, whatever the unit.
  for (const float unit : {1e-4f, 1.0f, 3e6f}) {
    write_greys({unit / 8, unit, unit * 8, 0});
    EXPECT_NEAR(decoded(mapped({"--auto"})[1]), .18, 1e-3) << unit;
    EXPECT_NEAR(decoded(mapped({"--auto", "--burn", "1", "--crush", "0"})[1]), .18, 1e-3) << unit;
    EXPECT_NEAR(decoded(mapped({"--auto", "--view", "agx"})[1]), .18, 1e-3) << unit;
  }
  write_greys({0, 0});
  EXPECT_EQ(mapped({"--auto"})[0], 0) << "black stays black";
  EXPECT_EQ(run({"tonemap", "in.exr", "-o", "a.png", "--auto", "--iso", "100"}).exit_code, 2);
}

/// A configuration whose view "Half" halves linear light, and "Square" squares it.
const char* const kConfig = R"(ocio_profile_version: 2
roles:
  scene_linear: lin
  default: lin
file_rules:
  - !<Rule> {name: Default, colorspace: lin}
displays:
  Screen:
    - !<View> {name: Half, colorspace: half}
    - !<View> {name: Square, colorspace: square}
active_displays: []
active_views: []
colorspaces:
  - !<ColorSpace>
    name: lin
  - !<ColorSpace>
    name: twice
    to_scene_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: half
    to_scene_reference: !<MatrixTransform> {matrix: [2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]}
  - !<ColorSpace>
    name: square
    from_scene_reference: !<ExponentTransform> {value: 2}
)";

// acceptance: M10
TEST_F(Tonemap, OpenColorIoAppliesViewsOfAConfiguration) {
  write("config.ocio", kConfig);
  write_greys({.25f, .5f, 2});
  const std::vector<std::string> unit = {"--iso", "0", "--cm2", "1", "--ocio", "config.ocio"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), unit.begin(), unit.end());
    return mapped(more);
  };
  const auto half = with({}), square = with({"--view", "Square"});
  const auto twice = with({"--ocio-space", "twice"});
  for (int i = 0; i < 3; ++i) {
    const float grey = std::array{.25f, .5f, 2.0f}[static_cast<std::size_t>(i)];
    EXPECT_NEAR(half[static_cast<std::size_t>(i)], grey / 2, 1e-5f) << "the first view";
    EXPECT_NEAR(square[static_cast<std::size_t>(i)], grey * grey, 2e-4f * grey);
    EXPECT_NEAR(twice[static_cast<std::size_t>(i)], grey, 1e-5f);
  }
  for (const auto& wrong : std::vector<std::vector<std::string>>{
           {"--view", "Cube"}, {"--display", "Wall"}, {"--ocio-space", "rec999"}}) {
    std::vector<std::string> all = {"tonemap", "in.exr", "-o", "a.png", "--ocio", "config.ocio"};
    all.insert(all.end(), wrong.begin(), wrong.end());
    const RunResult r = run(all);
    EXPECT_EQ(r.exit_code, 1);
    EXPECT_NE(r.err.find(wrong[1]), std::string::npos) << r.err;
    EXPECT_NE(r.err.find(wrong[0] == "--display" ? "Screen"
                         : wrong[0] == "--view"  ? "Half"
                                                 : "lin"),
              std::string::npos)
        << r.err;
  }
  EXPECT_EQ(run({"tonemap", "in.exr", "-o", "a.png", "--ocio", "missing.ocio"}).exit_code, 1);
}

// acceptance: M10
TEST_F(Tonemap, LookUpTablesAreApplied) {
  // Inverts: 0 maps to 1 and 1 to 0.
  write("invert.cube", "LUT_1D_SIZE 2\n1 1 1\n0 0 0\n");
  write_greys({.25f, 1});
  const auto v = mapped({"--iso", "0", "--cm2", "1", "--lut", "invert.cube"});
  EXPECT_NEAR(v[0], .75f, 1e-5f);
  EXPECT_NEAR(v[1], 0, 1e-5f);
  EXPECT_EQ(run({"tonemap", "in.exr", "-o", "a.png", "--lut", "missing.cube"}).exit_code, 1);
}

/// Names of the chunks, and the content of one.
std::vector<std::string> chunks(const std::string& path, const std::string& wanted,
                                std::string* content) {
  const std::vector<char> bytes = bytes_of(path);
  std::vector<std::string> names;
  for (std::size_t at = 8; at + 8 <= bytes.size();) {
    const auto byte = [&](std::size_t i) {
      return static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + i]));
    };
    const std::size_t length = byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3);
    names.emplace_back(&bytes[at + 4], 4);
    if (names.back() == wanted && content) content->assign(&bytes[at + 8], length);
    at += 12 + length;
  }
  return names;
}

// acceptance: M10. Values: PNG, third edition, 11.3.2.
TEST_F(Tonemap, PngFilesHaveTheColourChunksOfSrgb) {
  write("scene.mi", small_scene());
  ASSERT_EQ(run({"render", "scene.mi", "-o", "a.png", "-o", "w.png", "--samples", "2"}).exit_code,
            0);
  write_greys({.25f, 1});
  ASSERT_EQ(run({"tonemap", "in.exr", "-o", "b.png", "--bits", "16"}).exit_code, 0);
  for (const char* name : {"a.png", "b.png"}) {
    std::string gamma, chromaticities, header;
    const auto all = chunks(file(name), "gAMA", &gamma);
    chunks(file(name), "cHRM", &chromaticities);
    chunks(file(name), "IHDR", &header);
    EXPECT_NE(std::find(all.begin(), all.end(), "sRGB"), all.end()) << name;
    EXPECT_EQ(gamma, std::string("\0\0\xb1\x8f", 4)) << "45455";
    ASSERT_EQ(chromaticities.size(), 32u);
    EXPECT_EQ(chromaticities.substr(0, 8), std::string("\0\0\x7a\x26\0\0\x80\x84", 8))
        << "white 31270 32900";
    EXPECT_EQ(header[8], name[0] == 'a' ? 8 : 16) << "bits";
    const auto at = [&](const char* chunk) { return std::find(all.begin(), all.end(), chunk); };
    EXPECT_LT(at("sRGB"), at("IDAT"));
  }
  ASSERT_EQ(run({"render", "scene.mi", "-o", "c.png", "--bits", "16", "--samples", "2"}).exit_code,
            0);
  std::string header;
  chunks(file("c.png"), "IHDR", &header);
  EXPECT_EQ(header[8], 16);
}

}  // namespace tonemap_test
}  // namespace oriel
