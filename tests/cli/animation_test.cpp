// SPDX-License-Identifier: Apache-2.0
// oriel render on files with several render statements: selected frames and file names.
#include "support/program.h"

namespace oriel {
namespace animation_test {

class Animation : public ProgramTest {
 protected:
  /// Three frames of a light with growing energy; `second`: statements before the second frame.
  static std::string scene(const std::string& camera = "", const std::string& second = "") {
    const auto lamp = [](const char* colour) {
      return std::string("incremental light \"lamp\" \"mib_light_point\" ( \"color\" ") + colour +
             " ) origin 0 1 -3 end light\n";
    };
    const std::string render = "render \"root\" \"cam_inst\" \"opt\"\n";
    return small_scene("", camera) + lamp("2 2 2") + second + render + lamp("4 4 4") + render;
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(file(name)); }
  RunResult render(std::vector<std::string> more) const {
    std::vector<std::string> all = {"render", "scene.mi", "--samples", "1", "--size", "12x8"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
};

TEST_F(Animation, FilesCarryTheFramesNumber) {
  write("scene.mi", scene());
  ASSERT_EQ(render({"-o", "a.exr", "-o", "b.###.png"}).exit_code, 0);
  for (const char* name :
       {"a.exr", "a.0002.exr", "a.0003.exr", "b.001.png", "b.002.png", "b.003.png"})
    EXPECT_TRUE(exists(name)) << name;
  EXPECT_NE(text_of(file("a.exr")), text_of(file("a.0002.exr")));
}

TEST_F(Animation, OnlyRequestedFramesAreRendered) {
  write("scene.mi", scene());
  ASSERT_EQ(render({"-o", "all.#.exr"}).exit_code, 0);
  ASSERT_EQ(render({"-o", "some.#.exr", "--frames", "2..3"}).exit_code, 0);
  EXPECT_FALSE(exists("some.1.exr"));
  // With all previous statements.
  EXPECT_EQ(text_of(file("some.2.exr")), text_of(file("all.2.exr")));
  EXPECT_EQ(text_of(file("some.3.exr")), text_of(file("all.3.exr")));
  ASSERT_EQ(render({"-o", "last.#.exr", "--frames", "1,3.."}).exit_code, 0);
  EXPECT_TRUE(exists("last.1.exr") && !exists("last.2.exr") && exists("last.3.exr"));
}

TEST_F(Animation, InvalidFramesAreRefused) {
  write("scene.mi", scene());
  for (const char* wrong : {"0..3", "3..2", "a", "1,,2", "1...3", "-1"})
    EXPECT_EQ(render({"-o", "a.exr", std::string("--frames=") + wrong}).exit_code, 2) << wrong;
  const RunResult beyond = render({"-o", "a.exr", "--frames", "7"});
  EXPECT_EQ(beyond.exit_code, 1);
  EXPECT_NE(beyond.err.find("has 3 render statements"), std::string::npos) << beyond.err;
}

TEST_F(Animation, ExistingFilesMayBeSkipped) {
  write("scene.mi", scene());
  ASSERT_EQ(render({"-o", "a.#.exr", "--frames", "2"}).exit_code, 0);
  write("a.1.exr", "kept");
  ASSERT_EQ(render({"-o", "a.#.exr", "--skip-existing"}).exit_code, 0);
  EXPECT_EQ(text_of(file("a.1.exr")), "kept");
  EXPECT_TRUE(exists("a.3.exr"));
  EXPECT_EQ(render({"-o", "a.#.exr", "--skip-existing"}).exit_code, 0);
}

TEST_F(Animation, ExistingFilesAreCheckedForBothEyes) {
  write("scene.mi", scene("stereo offset eye separation .1"));
  ASSERT_EQ(render({"-o", "a.#.exr"}).exit_code, 0);
  const std::string kept = "\x76\x2f\x31\x01kept";  // begins like a picture, which may be replaced
  for (const char* name : {"a.1_left.exr", "a.2_left.exr", "a.2_right.exr"}) write(name, kept);
  std::filesystem::remove(file("a.1_right.exr"));
  ASSERT_EQ(render({"-o", "a.#.exr", "--skip-existing"}).exit_code, 0);
  // One eye of the first frame is missing, so both are rendered.
  EXPECT_TRUE(exists("a.1_right.exr"));
  EXPECT_NE(text_of(file("a.1_left.exr")), kept);
  EXPECT_EQ(text_of(file("a.2_left.exr")), kept);
}

TEST_F(Animation, CamerasNameTheirFilesFrameByFrame) {
  write(
      "scene.mi",
      scene("output \"rgba\" \"exr\" \"one.exr\"",
            "incremental camera \"cam\" output output \"rgba\" \"exr\" \"two.exr\" end camera\n"));
  ASSERT_EQ(render({}).exit_code, 0);
  // The camera of the third frame has the statements of the second one.
  for (const char* name : {"one.exr", "two.exr", "two.0003.exr"}) EXPECT_TRUE(exists(name)) << name;
  std::filesystem::remove(file("two.0003.exr"));
  ASSERT_EQ(render({"--frames", "3", "--skip-existing"}).exit_code, 0);
  EXPECT_TRUE(exists("two.0003.exr"));
}

}  // namespace animation_test
}  // namespace oriel
