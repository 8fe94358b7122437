// SPDX-License-Identifier: Apache-2.0
// Exit codes of oriel render: 0 only if nothing requested is missing.
#include "support/program.h"

namespace oriel {
namespace exit_code_test {

class ExitCodes : public ProgramTest {
 protected:
  /// Renders one sample of the scene after a replacement in its text.
  RunResult render(const std::string& from, const std::string& to,
                   const std::string& output = "output \"rgba\" \"exr\" \"out.exr\"") {
    std::string text = small_scene("", output);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from << text;
    write("scene.mi", text.replace(at, from.size(), to));
    std::filesystem::remove(file("out.exr"));
    return run({"render", "scene.mi", "--samples", "1"});
  }
  bool there(const std::string& name) const { return std::filesystem::exists(file(name)); }
};

TEST_F(ExitCodes, ACompleteSceneIsZero) {
  const RunResult r = render("render ", "render ");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(there("out.exr"));
}

TEST_F(ExitCodes, UndefinedNamesOfRenderAreOneWithAnImage) {
  const RunResult root = render("render \"root\"", "render \"rot\"");
  EXPECT_EQ(root.exit_code, 1) << root.err;
  const RunResult camera = render("\"cam_inst\" \"opt\"", "\"cma_inst\" \"opt\"");
  EXPECT_EQ(camera.exit_code, 1) << camera.err;
  EXPECT_FALSE(there("out.exr"));
  const RunResult options = render("\"cam_inst\" \"opt\"", "\"cam_inst\" \"otp\"");
  EXPECT_EQ(options.exit_code, 1) << options.err;
  EXPECT_TRUE(there("out.exr"));
}

TEST_F(ExitCodes, ObjectsCutByASyntaxErrorAreOneWithThePicture) {
  const RunResult r = render(
      "render \"root\"", "object \"o\" group 0 0 0 v 0 ) end group end object\nrender \"root\"");
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_TRUE(there("out.exr"));
}

TEST_F(ExitCodes, GroupsThatContainThemselvesAreOneWithThePicture) {
  const RunResult r =
      render("instgroup \"root\"",
             "instance \"again\" \"root\" end instance\ninstgroup \"root\" \"again\"");
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("OR-SC-304"), std::string::npos) << r.err;
  EXPECT_TRUE(there("out.exr"));
}

TEST_F(ExitCodes, UnwritableOutputsAreOneWithTheOthersWritten) {
  std::filesystem::create_directory(file("taken.exr"));
  const RunResult one =
      render("render ", "render ",
             "output \"rgba\" \"exr\" \"taken.exr\" output \"rgba\" \"exr\" \"out.exr\"");
  EXPECT_EQ(one.exit_code, 1) << one.err;
  EXPECT_NE(one.err.find("OR-RN-065"), std::string::npos) << one.err;
  EXPECT_TRUE(there("out.exr"));
  const RunResult format = render(
      "render ", "render ", "output \"rgba\" \"ps\" \"a.ps\" output \"rgba\" \"exr\" \"out.exr\"");
  EXPECT_EQ(format.exit_code, 1) << format.err;
  EXPECT_TRUE(there("out.exr"));
}

TEST_F(ExitCodes, WithoutAnyWritableOutputNothingIsPrepared) {
  std::filesystem::create_directory(file("taken.exr"));
  // The missing shader would be reported while the scene is prepared.
  const RunResult r =
      render("\"mia_material_x\"", "\"acme_thing\"", "output \"rgba\" \"exr\" \"taken.exr\"");
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_EQ(r.err.find("OR-RT-001"), std::string::npos) << r.err;
}

TEST_F(ExitCodes, OutputsOfOtherComputersLieBesideTheScene) {
  const RunResult r =
      render("render ", "render ", "output \"rgba\" \"exr\" \"C:\\Users\\me\\out.exr\"");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(there("out.exr"));
  EXPECT_NE(r.err.find("OR-RN-064"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("-o"), std::string::npos) << r.err;
  const RunResult plain = run({"ray", "scene.mi"});
  EXPECT_NE(plain.err.find("-file_dir"), std::string::npos) << plain.err;
  EXPECT_EQ(plain.err.find("with -o"), std::string::npos) << plain.err;
}

TEST_F(ExitCodes, MissingFoldersOfRelativeOutputsAreMade) {
  const RunResult r =
      render("render ", "render ", "output \"rgba\" \"exr\" \"images\\final\\out.exr\"");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(there("images/final/out.exr"));
}

}  // namespace exit_code_test
}  // namespace oriel
