// SPDX-License-Identifier: Apache-2.0
// Command line of the original stand-alone program: typical calls and their output files.
#include "image/exr.h"
#include "image/files.h"
#include "support/program.h"

namespace oriel {
namespace ray_test {

/// A call, the files that users of the original program expect, and the messages.
struct Call {
  const char* what;
  std::vector<std::string> arguments;
  std::vector<std::string> files;
  int width = 48, height = 32;
  std::string says = {};
};

class RayProgram : public ProgramTest {
 protected:
  void write_scene(const std::string& output = "output \"rgba\" \"png\" \"a.png\"") {
    write("scene.mi", small_scene("samples -1 -1", output));
  }
  RunResult ray(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "ray");
    return run(arguments);
  }
  bool exists(const std::string& name) { return std::filesystem::exists(file(name)); }
};

std::vector<Call> typical_calls() {
  return {
      {"a scene alone", {"scene.mi"}, {"a.png"}},
      {"without the suffix", {"scene"}, {"a.png"}},
      {"messages", {"-verbose", "5", "scene.mi"}, {"a.png"}, 48, 32, "samples"},
      {"messages by word, threads", {"-v", "on", "-threads", "2", "scene.mi"}, {"a.png"}},
      {"size", {"-resolution", "24", "16", "scene.mi"}, {"a.png"}, 24, 16},
      {"size, shortened", {"-res", "24", "16", "scene.mi"}, {"a.png"}, 24, 16},
      {"another file", {"-file_name", "b.png", "scene.mi"}, {"b.png"}},
      {"another file, short", {"-fn", "b.png", "scene.mi"}, {"b.png"}},
      {"another type", {"-file_type", "exr", "-file_name", "c.exr", "scene.mi"}, {"c.exr"}},
      {"a folder", {"-file_dir", "out", "scene.mi"}, {"out/a.png"}},
      {"sampling",
       {"-samples", "-1", "0", "-contrast", ".2", ".2", ".2", ".2", "-filter", "gauss", "3", "3",
        "-jitter", "1", "scene.mi"},
       {"a.png"}},
      {"clipped filter", {"-filter", "clip", "mitchell", "4", "4", "scene.mi"}, {"a.png"}},
      {"rays",
       {"-trace", "on", "-trace_depth", "2", "2", "4", "-shadow", "segments", "-face", "both",
        "scene.mi"},
       {"a.png"}},
      {"gathering",
       {"-finalgather", "on", "-finalgather_accuracy", "view", "16", "20", "2",
        "-finalgather_rebuild", "freeze", "scene.mi"},
       {"a.png"}},
      {"photons",
       {"-caustic", "off", "-globillum", "on", "-globillum_accuracy", "32", "0",
        "-photon_trace_depth", "3", "3", "3", "scene.mi"},
       {"a.png"}},
      {"gamma and clipping",
       {"-gamma", "2.2", "-desaturate", "on", "-colorclip", "rgb", "-dither", "off", "scene.mi"},
       {"a.png"}},
      {"lens", {"-aperture", "2", "-focal", "1.5", "-aspect", "1.5", "scene.mi"}, {"a.png"}},
      {"parallel", {"-focal", "infinity", "-aperture", "4", "scene.mi"}, {"a.png"}},
      {"part of the picture", {"-window", "4", "4", "19", "11", "scene.mi"}, {"a.png"}},
      {"switches",
       {"-lens", "off", "-volume", "off", "-geometry", "on", "-output", "off", "-displace", "off",
        "-motion", "off", "-shutter", "0", "scene.mi"},
       {"a.png"}},
      {"machinery",
       {"-task_size", "32", "-memory", "1000", "-bsp_size", "10", "-acceleration", "bsp2", "-hosts",
        "one", "two:7003", "--", "scene.mi"},
       {"a.png"},
       48,
       32,
       "no effect: -task_size, -memory, -bsp_size, -acceleration, -hosts"},
      {"include path", {"-I", ".:elsewhere", "-include_path", "more", "scene.mi"}, {"a.png"}},
      {"written back, not rendered",
       {"-echo", "ascii", "copy.mi", "-render", "off", "scene.mi"},
       {"copy.mi"}},
      {"written back and rendered", {"-echo", "copy.mi", "scene.mi"}, {"copy.mi", "a.png"}},
  };
}

TEST_F(RayProgram, TypicalCallsLeaveTheFilesThatUsersExpect) {
  const std::vector<Call> calls = typical_calls();
  EXPECT_GE(calls.size(), 20u);
  for (const Call& call : calls) {
    write_scene();
    std::filesystem::create_directory(file("out"));
    const RunResult r = ray(call.arguments);
    EXPECT_EQ(r.exit_code, 0) << call.what << ": " << r.err;
    EXPECT_NE(r.err.find(call.says), std::string::npos) << call.what << ": " << r.err;
    for (const std::string& name : call.files) {
      ASSERT_TRUE(exists(name)) << call.what << ": " << name << "\n" << r.err;
      if (name.ends_with(".mi")) continue;
      const Image image = read_image(file(name));
      EXPECT_EQ(image.width, call.width) << call.what;
      EXPECT_EQ(image.height, call.height) << call.what;
    }
    EXPECT_EQ(exists("a.png"), call.files.back() == "a.png") << call.what;
    for (const char* left : {"a.png", "b.png", "c.exr", "out/a.png", "copy.mi"})
      std::filesystem::remove(file(left));
  }
}

TEST_F(RayProgram, FlagsEqualTheirStatements) {
  write("scene.mi", small_scene("samples -1 -1 trace off gamma 1.8 shadow off",
                                "window 5 6 20 15 output \"rgba\" \"exr\" \"a.exr\""));
  ASSERT_EQ(ray({"scene.mi"}).exit_code, 0);
  const ExrFile written = read_exr(file("a.exr"));
  write("scene.mi", small_scene("samples -1 -1", "output \"rgba\" \"exr\" \"a.exr\""));
  ASSERT_EQ(ray({"-trace", "off", "-gamma", "1.8", "-shadow", "off", "-window", "5", "6", "20",
                 "15", "scene.mi"})
                .exit_code,
            0);
  EXPECT_EQ(read_exr(file("a.exr")).layers.front().image.pixels,
            written.layers.front().image.pixels);
}

TEST_F(RayProgram, EchoedSceneRendersTheSameImage) {
  write("scene.mi", small_scene("samples -1 -1", "output \"rgba\" \"exr\" \"a.exr\""));
  ASSERT_EQ(ray({"-echo", "copy.mi", "scene.mi"}).exit_code, 0);
  const ExrFile first = read_exr(file("a.exr"));
  ASSERT_EQ(ray({"copy.mi"}).exit_code, 0);
  EXPECT_EQ(read_exr(file("a.exr")).layers.front().image.pixels, first.layers.front().image.pixels);
}

TEST_F(RayProgram, SeveralFilesAreReadAsOne) {
  const std::string text = small_scene("samples -1 -1", "output \"rgba\" \"png\" \"a.png\"");
  const std::size_t end = text.find("render \"root\"");
  write("body.mi", text.substr(0, end));
  write("shot.mi", text.substr(end));
  const RunResult r = ray({"body.mi", "shot.mi"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(exists("a.png"));
}

TEST_F(RayProgram, FilesAreWrittenToTheCurrentFolder) {
  std::filesystem::create_directory(file("scenes"));
  write("scenes/scene.mi", small_scene("samples -1 -1", "output \"rgba\" \"png\" \"a.png\""));
  EXPECT_EQ(ray({"scenes/scene.mi"}).exit_code, 0);
  EXPECT_TRUE(exists("a.png"));
  EXPECT_FALSE(exists("scenes/a.png"));
}

TEST_F(RayProgram, WrongUseIsReportedInOneLine) {
  write_scene();
  const struct {
    std::vector<std::string> arguments;
    const char* says;
  } wrong[] = {{{"-resolutoin", "8", "8", "scene.mi"}, "did you mean -resolution?"},
               {{"-resolution", "8", "scene.mi"}, "-resolution: expected int int"},
               {{"-sha", "on", "scene.mi"}, "is ambiguous:"},
               {{"-shadow", "maybe", "scene.mi"}, "-shadow: expected off|on|sort|segments"},
               {{"-hosts", "a", "scene.mi"}, "must end with --"}};
  for (const auto& w : wrong) {
    const RunResult r = ray(w.arguments);
    EXPECT_EQ(r.exit_code, 2) << w.says;
    EXPECT_NE(r.err.find(w.says), std::string::npos) << r.err;
    EXPECT_EQ(r.error_lines(), 1) << r.err;
  }
  const RunResult missing = ray({"nowhere.mi"});
  EXPECT_EQ(missing.exit_code, 1);
  EXPECT_NE(missing.err.find("nowhere.mi"), std::string::npos) << missing.err;
}

TEST_F(RayProgram, HelpListsFlagsAndMessageLevelsFilterOutput) {
  const RunResult help = ray({"-help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* flag : {"-resolution int int", "-finalgather_rebuild", "-echo", "-trace_depth"})
    EXPECT_NE(help.out.find(flag), std::string::npos) << flag;
  EXPECT_NE(ray({"-version"}).out.find("oriel"), std::string::npos);

  write_scene("frobnicate 3 output \"rgba\" \"png\" \"a.png\"");
  EXPECT_NE(ray({"-verbose", "3", "scene.mi"}).err.find("OR-MI-020"), std::string::npos);
  EXPECT_EQ(ray({"-verbose", "2", "scene.mi"}).err, "");
  EXPECT_EQ(ray({"-verbose", "off", "scene.mi"}).err, "");
}

}  // namespace ray_test
}  // namespace oriel
