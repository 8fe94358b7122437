// SPDX-License-Identifier: Apache-2.0
// Image files that are decoded in confined processes (--isolate-readers).
#include <fmt/format.h>

#include "fault_test.h"
#include "image/files.h"
#include "image/reader_process.h"

namespace oriel {
namespace readers_test {

class ReaderProcess : public FaultTest {
 protected:
  /// A scene whose floor shows the picture.
  void write_textured(const std::string& picture) const {
    std::string scene = small_scene();
    const std::string color = "\"diffuse\" .5 .5 .5";
    scene.replace(scene.find(color), color.size(), "\"diffuse\" = \"look\"");
    write("scene.mi", "color texture \"t\" \"" + picture +
                          "\"\nshader \"at\" \"mib_texture_vector\" ( \"select\" -1 )\n"
                          "shader \"look\" \"mib_texture_lookup\" ( \"tex\" \"t\", \"coord\" = "
                          "\"at\" )\n" +
                          scene);
  }
  void write_picture_file(const std::string& name) const {
    Image image(100, 70, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      image.pixels[i] = static_cast<float>(i * 37 % 256) / 255.0f;
    write_image(file(name), image);
  }
  /// Reader processes of a render.
  std::vector<pid_t> readers_of(pid_t render) const {
    std::vector<pid_t> all;
    for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
      const pid_t process = std::atoi(entry.path().filename().c_str());
      std::ifstream text(entry.path() / "stat");
      std::string number, name, state;
      pid_t parent = 0;
      if (process > 0 && text >> number >> name >> state >> parent && parent == render)
        all.push_back(process);
    }
    return all;
  }
};

TEST_F(ReaderProcess, GivesTheSamePictureAsThisProcess) {
  for (const char* suffix :
       {"png", "jpg", "tif", "exr", "hdr", "tga", "bmp", "iff", "sgi", "dpx"}) {
    const std::string name = std::string("picture.") + suffix;
    write_picture_file(name);
    write_textured(name);
    ASSERT_EQ(render({"-o", "a.exr", "--samples", "2"}).exit_code, 0) << suffix;
    const RunResult r = render({"-o", "b.exr", "--samples", "2", "--isolate-readers"});
    ASSERT_EQ(r.exit_code, 0) << suffix << r.err;
    EXPECT_EQ(text_of(file("a.exr")), text_of(file("b.exr"))) << suffix;
  }
}

TEST_F(ReaderProcess, DamagedFilesGiveTheSamePicture) {
  write_picture_file("picture.tif");
  write_textured("picture.tif");
  ASSERT_EQ(render({"-o", "whole.exr", "--samples", "2"}).exit_code, 0);
  std::filesystem::resize_file(file("picture.tif"),
                               std::filesystem::file_size(file("picture.tif")) / 2);
  const RunResult here = render({"-o", "a.exr", "--samples", "2"});
  const RunResult apart = render({"-o", "b.exr", "--samples", "2", "--isolate-readers"});
  EXPECT_EQ(here.exit_code, apart.exit_code);
  EXPECT_EQ(text_of(file("a.exr")), text_of(file("b.exr")));
  EXPECT_NE(text_of(file("a.exr")), text_of(file("whole.exr")));
}

// As if the decoder had crashed.
TEST_F(ReaderProcess, AnEndedProcessDoesNotEndTheRender) {
  write_picture_file("picture.png");
  write_textured("picture.png");
  write("stdout.txt", "");
  const pid_t child = start_render(
      {"-o", "a.exr", "--samples", "3000", "--json", "--isolate-readers", "--threads", "1"});
  ASSERT_TRUE(wait_for_text("\"pass\":2"));
  ASSERT_FALSE(readers_of(child).empty());
  for (const pid_t reader : readers_of(child)) kill(reader, SIGKILL);
  const RunResult r = finish(child);
  EXPECT_EQ(r.exit_code, 0) << r.err;  // its tiles are in the cache
  EXPECT_TRUE(there("a.exr"));
}

// Formats of which the image library has large, rarely tested readers.
TEST_F(ReaderProcess, OtherFormatsAreRefusedInEveryMode) {
  write_picture_file("picture.png");
  for (const char* name : {"picture.psd", "picture.dcm", "picture.mp4", "picture.cr2"}) {
    write(name, std::string("8BPS\0\1", 6) + std::string(200, '\0'));
    write_textured(name);
    const RunResult r = render({"-o", "a.exr", "--samples", "1"});
    EXPECT_NE(r.err.find("not a supported image file"), std::string::npos) << name << r.err;
  }
}

/// What read_image() says of a file with a process that the file has taken over; runs in a process
/// of its own, because reader processes are for the rest of the process.
[[noreturn]] void read_with_hostile_reader(const std::string& path, double seconds) {
  ReaderOptions options;
  options.program = ORIEL_HOSTILE_READER;
  options.seconds = seconds;
  options.processes = 1;
  isolate_readers(options);
  try {
    read_image(path);
    std::fputs("it was read", stderr);
  } catch (const std::runtime_error& e) {
    std::fputs(e.what(), stderr);
  }
  std::exit(0);
}

// acceptance: Z6
TEST_F(ReaderProcess, HostileReadersGiveOneMessage) {
  ::testing::GTEST_FLAG(death_test_style) = "threadsafe";
  for (const auto& [name, message] : std::initializer_list<std::pair<const char*, const char*>>{
           {"crash", "crashed"},
           {"short", "crashed"},
           {"hang", "took more than 0.3 s"},
           {"error", "error':  +"},  // escapes become blanks
           {"width", "unsupported size"},
           {"height", "unsupported size"},
           {"channels", "unsupported size"}}) {
    const std::string path = file(name);
    write(name, "any");
    // Only the process that hangs has little time, since the others may run on a busy machine.
    const double seconds = std::string_view(name) == "hang" ? .3 : 60;
    EXPECT_EXIT(read_with_hostile_reader(path, seconds), ::testing::ExitedWithCode(0), message)
        << name;
  }
}

}  // namespace readers_test
}  // namespace oriel
