// SPDX-License-Identifier: Apache-2.0
// Small files that expand to huge scenes, in 4 GB of memory.
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <iterator>

#include "fault_test.h"

namespace oriel {
namespace budget_test {

namespace fs = std::filesystem;

class BudgetTest : public FaultTest {
 protected:
  /// Renders a scene in 4 GB of memory; one that takes minutes ends with code 124.
  RunResult render(const std::string& text, const std::string& options = "") const {
    write("scene.mi", text);
    fs::remove(file("p.png"));
    return shell("ulimit -v 4194304; timeout 120 \"$ORIEL\" render scene.mi -o p.png --samples 1 " +
                 options + " >stdout.txt 2>stderr.txt");
  }
  static bool says(const RunResult& r, const std::string& words) {
    return r.err.find(words) != std::string::npos;
  }
  /// One message with the line of the scene and the option; the picture may be missing.
  void expect_budget(const RunResult& r, const std::string& name, const std::string& code,
                     bool picture) const {
    EXPECT_TRUE(r.exit_code == 0 || r.exit_code == 1) << name << r.exit_code << r.err;
    EXPECT_TRUE(says(r, "--budget " + name + "=")) << r.err;
    const std::size_t at = r.err.find("[" + code + "]");
    ASSERT_NE(at, std::string::npos) << r.err;
    EXPECT_EQ(r.err.find("[" + code + "]", at + 1), std::string::npos) << "one message\n" << r.err;
    const std::size_t line = r.err.rfind('\n', at) + 1;
    EXPECT_EQ(r.err.substr(line, 9), "scene.mi:") << r.err;
    EXPECT_EQ(there("p.png"), picture) << r.err;
  }

  static std::string square(int number, const std::string& more, const std::string& approximation) {
    return fmt::format(
        "object \"sq{0}\" visible trace shadow tagged group -1 -1 0 1 -1 0 1 1 0 -1 1 0 v 0 v 1 v "
        "2 v 3 {1} {2} end group end object instance \"sq{0}_inst\" \"sq{0}\" transform 1 0 0 0 0 "
        "1 0 0 0 0 1 0 {3} 0 6 1 material [ \"rough\" ] end instance\n",
        number, more, approximation, 0.1 * number);
  }
  /// Squares in front of the camera with displacement.
  static std::string squares(int count, const std::string& more, const std::string& approximation) {
    std::string text = small_scene() +
                       "material \"rough\" \"mib_illum_lambert\" ( \"diffuse\" .5 .5 .5 ) displace "
                       "\"mib_color_average\" ( \"input\" .1 .1 .1 1 ) end material\n";
    std::string names;
    for (int i = 0; i < count; ++i) {
      text += square(i, more, approximation);
      names += fmt::format(" \"sq{}_inst\"", i);
    }
    return text + "incremental instgroup \"root\" \"cam_inst\" \"lamp_inst\"" + names +
           " end instgroup\nrender \"root\" \"cam_inst\" \"opt\"\n";
  }
};

// acceptance: Z7
TEST_F(BudgetTest, CompressedText) {
  ASSERT_EQ(shell("head -c 3000000000 /dev/zero | tr '\\0' ' ' | gzip -1 > bomb.mi.gz").exit_code,
            0);
  expect_budget(render("$include \"bomb.mi.gz\"\n" + small_scene()), "expansion", "OR-MI-017",
                true);
}

// acceptance: Z7
TEST_F(BudgetTest, TextAndFilesOfIncludes) {
  // Two includes of the next file each: 2^20 files.
  for (int i = 0; i < 20; ++i)
    write(fmt::format("f{}.mi", i),
          fmt::format("$include \"f{0}.mi\"\n$include \"f{0}.mi\"\n", i + 1));
  write("f20.mi", std::string(1000, '\n'));
  const RunResult files = render("$include \"f0.mi\"\n" + small_scene(), "--budget includes=500");
  EXPECT_TRUE(says(files, "OR-MI-013") && says(files, "--budget includes=")) << files.err;
  EXPECT_TRUE(there("p.png"));
  const RunResult text = render("$include \"f0.mi\"\n" + small_scene(), "--budget text=20k");
  EXPECT_TRUE(says(text, "OR-MI-017") && says(text, "--budget text=")) << text.err;
  EXPECT_TRUE(there("p.png"));
}

// acceptance: Z7
TEST_F(BudgetTest, NestedGroups) {
  std::string text = small_scene();
  const auto group = [&](int i, const std::string& members) {
    text += fmt::format(
        "instgroup \"g{0}\" {1} end instgroup\ninstance \"i{0}\" \"g{0}\" end instance\n", i,
        members);
  };
  group(0, "\"floor_inst\"");
  for (int i = 1; i <= 24; ++i) {
    // Beside each other: rays through millions of coincident objects would take hours.
    const int shift = 20 << (i - 1) % 12;
    text += fmt::format(
        "instance \"again{0}\" \"g{0}\" transform 1 0 0 0 0 1 0 0 0 0 1 0 {1} {2} 0 1 end "
        "instance\n",
        i - 1, i <= 12 ? shift : 0, i <= 12 ? 0 : shift);
    group(i, fmt::format("\"i{0}\" \"again{0}\"", i - 1));
  }
  const std::string wide = text +
                           "incremental instgroup \"root\" \"cam_inst\" \"lamp_inst\" \"i24\" "
                           "end instgroup\nrender \"root\" \"cam_inst\" \"opt\"\n";
  expect_budget(render(wide), "instances", "OR-SC-305", true);
  for (int i = 25; i <= 994; ++i) group(i, fmt::format("\"i{0}\"", i - 1));
  text +=
      "incremental instgroup \"root\" \"cam_inst\" \"lamp_inst\" \"i994\" end instgroup\n"
      "render \"root\" \"cam_inst\" \"opt\"\n";
  expect_budget(render(text), "instances", "OR-SC-305", true);
}

// acceptance: Z7
TEST_F(BudgetTest, DisplacedTriangles) {
  // The 16 million of the default take half a minute to displace.
  expect_budget(render(squares(100, "p 0 0 1 2 3", "approximate displace parametric 10 10"),
                       "--budget triangles=2M"),
                "triangles", "OR-RN-081", true);
}

// acceptance: Z7
TEST_F(BudgetTest, SubdividedTriangles) {
  std::string text = squares(100, "ccmesh \"c\" polygon 1 vertex 4 p 0 0 1 2 3 end ccmesh",
                             "approximate ccmesh parametric 12 12 \"c\"");
  expect_budget(render(text, "--set opt.displace=off"), "triangles", "OR-RN-080", true);
}

// acceptance: Z7
TEST_F(BudgetTest, Pixels) {
  const std::string text = small_scene("", "resolution 65536 65536");
  expect_budget(render(text), "pixels", "OR-RN-082", false);
}

// acceptance: Z7
TEST_F(BudgetTest, Photons) {
  std::string text = small_scene("globillum 1 \"indirect\" \"photons\"");
  const std::string lamp = "origin 0 1 -3";
  text.replace(text.find(lamp), lamp.size(),
               lamp + " energy 10 10 10 globillum photons 1000000000");
  // The default takes minutes on slow machines.
  expect_budget(render(text, "--budget photons=200k"), "photons", "OR-RN-083", true);
}

/// A TIFF of one tile whose bytes are missing.
std::string tiff(std::uint32_t side) {
  std::string bytes("II*\0\x08\0\0\0", 8);
  const auto put = [&](std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  };
  constexpr std::uint32_t kShort = 3, kLong = 4;
  const std::array<std::uint32_t, 3> tags[] = {
      {256, kLong, side}, {257, kLong, side},       {258, kShort, 8},   {259, kShort, 1},
      {262, kShort, 1},   {277, kShort, 1},         {322, kLong, side}, {323, kLong, side},
      {324, kLong, 200},  {325, kLong, side * side}};
  put(std::size(tags), 2);
  for (const auto& [tag, type, value] : tags) {
    put(tag, 2), put(type, 2), put(1, 4);
    put(value, 4);
  }
  put(0, 4);
  return bytes;
}

// acceptance: Z7
TEST_F(BudgetTest, TextureTiles) {
  write("big.tif", tiff(30000));
  fs::resize_file(file("big.tif"), 200 + std::uint64_t{30000} * 30000);  // sparse
  const std::string text =
      "color texture \"t\" \"big.tif\"\nshader \"look\" \"mib_texture_lookup2\" ( \"tex\" \"t\" "
      ")\n" +
      small_scene() +
      "incremental material \"grey\" \"mib_illum_lambert\" ( \"diffuse\" = \"look\" ) end "
      "material\nrender \"root\" \"cam_inst\" \"opt\"\n";
  expect_budget(render(text), "texture-tile", "OR-RT-020", true);
}

TEST_F(BudgetTest, WrongBudgetsAreErrorsOfUse) {
  for (const char* budget : {"instance=3", "instances", "instances=0", "instances=many"})
    EXPECT_EQ(render(small_scene(), std::string("--budget ") + budget).exit_code, 2) << budget;
}

}  // namespace budget_test
}  // namespace oriel
