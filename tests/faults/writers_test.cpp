// SPDX-License-Identifier: Apache-2.0
// Every file that the program writes: complete, or the old one is unchanged.
#include "fault_test.h"
#include "image/exr.h"
#include "image/files.h"
#include "models/testing/model_file.h"

namespace oriel {
namespace writers_test {

class Writers : public FaultTest {
 protected:
  /// From 0 to the size of a file.
  static std::set<std::size_t> limits_of(std::size_t size) {
    std::set<std::size_t> limits = {0, 100, size / 2, size - 1};
    if (size > 4096) limits.insert(4096);
    return limits;
  }
  static Image test_image(int width, int height) {
    Image image(width, height, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      image.pixels[i] = float(i * 7919 % 1009) / 1009;
    return image;
  }

  /// Runs the command with limits from 0 to the size of the file that it writes. Below that size
  /// the old file is unchanged, the exit code is 1, one message names the file, and nothing else is
  /// left.
  void sweep(const std::vector<std::string>& command, const std::string& output) const {
    SCOPED_TRACE(output);
    std::filesystem::remove(file(output));
    ASSERT_EQ(run(command).exit_code, 0) << text_of(file("stderr.txt"));
    const auto whole = bytes_of(file(output));
    ASSERT_GT(whole.size(), 100u);
    const auto before = names();
    for (const std::size_t limit : limits_of(whole.size())) {
      SCOPED_TRACE(limit);
      const RunResult r = [&] {
        const FileSizeLimit limited(limit);
        return run(command);
      }();
      EXPECT_EQ(r.exit_code, 1) << r.err;
      // The messages go to a file, too.
      if (limit >= 4096) {
        EXPECT_NE(r.err.find("'" + output + "'"), std::string::npos) << r.err;
      }
      EXPECT_TRUE(bytes_of(file(output)) == whole);
      EXPECT_EQ(names(), before);
    }
  }
};

// In this process, which loads the libraries of picture formats once.
// acceptance: Z3
TEST_F(Writers, EveryPictureFormatSurvivesEverySizeLimit) {
  const Image image = test_image(80, 60);
  for (const std::string type : {"exr", "png", "hdr", "tif", "jpg", "tga", "bmp", "ppm", "iff",
                                 "sgi", "rla", "dpx", "fits", "gif", "jp2", "webp"}) {
    SCOPED_TRACE(type);
    const std::string output = file("out." + type);
    write_image(output, image);
    const auto whole = bytes_of(output);
    ASSERT_GT(whole.size(), 100u);
    const auto before = names();
    for (const std::size_t limit : limits_of(whole.size())) {
      std::string message;
      try {
        const FileSizeLimit limited(limit);
        write_image(output, image);
      } catch (const std::runtime_error& e) {
        message = e.what();
      }
      EXPECT_NE(message.find("'" + output + "'"), std::string::npos) << limit << ": " << message;
      EXPECT_TRUE(bytes_of(output) == whole) << limit;
      EXPECT_EQ(names(), before) << limit;
    }
  }
}

// acceptance: Z3
TEST_F(Writers, ToneMappedPicturesSurviveEverySizeLimit) {
  write_image(file("in.exr"), test_image(80, 60));
  for (const std::string output : {"out.exr", "out.png", "out.tif"})
    sweep({"tonemap", "in.exr", "--simple", "-o", output}, output);
}

// acceptance: Z3
TEST_F(Writers, RendersSurviveEverySizeLimit) {
  for (const char* output : {"out.exr", "out.png"})
    sweep({"render", "scene.mi", "--samples", "1", "-q", "-o", output}, output);
}

// acceptance: Z3
TEST_F(Writers, ReportsTablesAndScenesSurviveEverySizeLimit) {
  sweep({"check", "scene.mi", "--report", "report.html"}, "report.html");
  sweep({"measure", "scene.mi", "--grid", "-1,-.9,-6:2,0,0:0,0,3:8x8", "--csv", "lux.csv",
         "--max-samples", "4", "--precision", "900%"},
        "lux.csv");
  sweep({"convert", "scene.mi", "copy.glb"}, "copy.glb");
  write("quad.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  sweep({"convert", "quad.obj", "quad.mi", "--daylight", "-q"}, "quad.mi");
}

// acceptance: Z3
TEST_F(Writers, TexturesOfModelsSurviveEverySizeLimit) {
  write_image(file("in.png"), test_image(64, 64));
  write("chair.gltf", models::testing::gltf(
                          R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})", "",
                          R"("textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,)" +
                              models::testing::base64(text_of(file("in.png"))) + R"("}],)"));
  sweep({"convert", "chair.gltf", "chair.mi", "--daylight", "-q"},
        "./chair_textures/texture_0.png");
  EXPECT_TRUE(bytes_of(file("chair_textures/texture_0.png")) == bytes_of(file("in.png")));
  std::filesystem::rename(file("chair_textures"), file("elsewhere"));
  std::filesystem::create_directory_symlink("elsewhere", file("chair_textures"));
  write("elsewhere/texture_0.png", "old");
  EXPECT_EQ(run({"convert", "chair.gltf", "chair.mi", "--daylight"}).exit_code, 1);
  EXPECT_EQ(text_of(file("elsewhere/texture_0.png")), "old");
}

// acceptance: Z3
TEST_F(Writers, LinksAreNotFollowed) {
  ASSERT_EQ(render({"-o", "old.exr", "-o", "old.png", "--samples", "1"}).exit_code, 0);
  const auto old = bytes_of(file("old.exr"));
  write("old.csv", "text");
  write("old.html", "text");
  for (const char* suffix : {"exr", "csv", "html"})
    std::filesystem::create_symlink(std::string("old.") + suffix,
                                    file(std::string("link.") + suffix));
  std::filesystem::create_symlink("created.exr", file("dangling.exr"));
  const std::vector<std::vector<std::string>> commands = {
      {"render", "scene.mi", "--samples", "1", "-o", "link.exr"},
      {"render", "scene.mi", "--samples", "1", "-o", "dangling.exr"},
      {"tonemap", "old.exr", "-o", "link.exr"},
      {"denoise", "old.exr", "-o", "link.exr"},
      {"check", "scene.mi", "--report", "link.html"}};
  for (const auto& command : commands) {
    const RunResult r = run(command);
    EXPECT_EQ(r.exit_code, 1) << command[0] << r.err;
    EXPECT_NE(r.err.find("symbolic link"), std::string::npos) << r.err;
  }
  EXPECT_TRUE(bytes_of(file("old.exr")) == old);
  EXPECT_EQ(text_of(file("old.html")), "text");
  EXPECT_FALSE(there("created.exr"));
  EXPECT_TRUE(std::filesystem::is_symlink(file("link.exr")));
}

// acceptance: Z3
TEST_F(Writers, PipesAndDevicesAreRefusedWithoutWaiting) {
  ASSERT_EQ(mkfifo(file("pipe.exr").c_str(), 0600), 0);
  ASSERT_EQ(mkfifo(file("pipe.html").c_str(), 0600), 0);
  const std::vector<std::vector<std::string>> commands = {
      {"render", "scene.mi", "--samples", "1", "-o", "pipe.exr"},
      {"check", "scene.mi", "--report", "pipe.html"},
      {"check", "scene.mi", "--report", "/dev/full"}};
  for (const auto& command : commands) {
    const pid_t child = start(command);
    const bool ended = wait_until([&] {
      siginfo_t info{};
      waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT);
      return info.si_pid == child;
    });
    EXPECT_TRUE(ended) << command[0] << " waits for a reader";
    if (!ended) kill(child, SIGKILL);
    const RunResult r = finish(child);
    EXPECT_EQ(r.exit_code, 1) << r.err;
    EXPECT_NE(r.err.find("pipe or a device"), std::string::npos) << r.err;
  }
}

TEST_F(Writers, OnlyPicturesAreReplacedByPictures) {
  const std::string text = small_scene();
  for (const char* name : {"notes.exr", "notes.png", "notes.tif"}) {
    write(name, text);
    const RunResult r = render({"--samples", "1", "-o", name});
    EXPECT_EQ(r.exit_code, 1) << name;
    EXPECT_NE(r.err.find("not a picture; remove it or choose another name"), std::string::npos)
        << r.err;
    EXPECT_EQ(text_of(file(name)), text);
  }
  const RunResult hidden = render({"--samples", "1", "-o", ".hidden.png"});
  EXPECT_EQ(hidden.exit_code, 1);
  EXPECT_FALSE(there(".hidden.png"));
}

TEST_F(Writers, ScenesWritePicturesOnly) {
  write("run.sh", "#!/bin/sh\n");
  for (const char* name : {"run.sh", "new.sh", "Makefile", ".profile", ".x.exr"}) {
    write("scene.mi", small_scene("", "output \"rgba\" \"exr\" \"" + std::string(name) +
                                          "\" output \"rgba\" \"exr\" \"good.exr\""));
    const auto before = name == std::string("run.sh") ? text_of(file(name)) : std::string();
    const RunResult r = render({"--samples", "1"});
    EXPECT_EQ(r.exit_code, 1) << name << r.err;
    EXPECT_EQ(text_of(file(name)), before) << name;
    EXPECT_TRUE(there("good.exr")) << name;
    EXPECT_NE(r.err.find("OR-RN-065"), std::string::npos) << r.err;
  }
}

TEST_F(Writers, ScenesThatUsersWroteAreKept) {
  write("chair.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string text = small_scene();
  write("chair.mi", text);
  const std::vector<std::vector<std::string>> commands = {
      {"quick", "chair.obj", "-o", "chair.png", "--samples", "1", "--size", "24x16"},
      {"convert", "chair.obj", "chair.mi", "--daylight"}};
  for (std::vector<std::string> command : commands) {
    write("chair.mi", text);
    const RunResult kept = run(command);
    EXPECT_EQ(kept.exit_code, 1) << kept.err;
    EXPECT_NE(kept.err.find("--force"), std::string::npos) << kept.err;
    EXPECT_EQ(text_of(file("chair.mi")), text);
    command.emplace_back("--force");
    EXPECT_EQ(run(command).exit_code, 0);
    EXPECT_NE(text_of(file("chair.mi")), text);
    command.pop_back();
    EXPECT_EQ(run(command).exit_code, 0) << "its own scene is replaced";
    const std::string edited = text_of(file("chair.mi")) + "# mine\n";
    write("chair.mi", edited);
    EXPECT_EQ(run(command).exit_code, 1);
    EXPECT_EQ(text_of(file("chair.mi")), edited);
  }
}

}  // namespace writers_test
}  // namespace oriel
