// SPDX-License-Identifier: Apache-2.0
// Renders whose outputs fail, and old pictures while a new one is rendered.
#include <functional>
#include <random>

#include "fault_test.h"
#include "image/exr.h"

namespace oriel {
namespace render_faults_test {

namespace fs = std::filesystem;

class RenderFaults : public FaultTest {
 protected:
  /// The path after "the picture is in".
  static std::string saved_path(const std::string& messages) {
    const std::string words = "the picture is in '";
    const std::size_t at = messages.find(words);
    if (at == std::string::npos) return {};
    const std::size_t begin = at + words.size();
    return messages.substr(begin, messages.find('\'', begin) - begin);
  }
  static float samples_of(const std::string& path) {
    return number_attribute(read_exr(path), "oriel.samples").value_or(0);
  }
  /// Changes the files of a render within its picture, while it is stopped.
  void while_stopped(pid_t child, const std::function<void()>& change) const {
    ASSERT_TRUE(wait_for_text("\"stage\":\"picture\""));
    kill(child, SIGSTOP);
    change();
    kill(child, SIGCONT);
  }
  /// Renders for a long time.
  pid_t start_long(const std::string& output, std::vector<std::string> more = {}) const {
    more.insert(more.end(),
                {"-o", output, "--samples", "1000000", "--json", "--seed", "1", "--threads", "1"});
    return start_render(more);
  }
};

// acceptance: Z1
TEST_F(RenderFaults, AFailingOutputKeepsTheOthersAndItsSamples) {
  fs::create_directory(file("taken.exr"));
  write("a_file", "");
  const RunResult r =
      render({"--samples", "3", "-o", "taken.exr", "-o", "good.exr", "-o", "notes.exr"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_EQ(samples_of(file("good.exr")), 3);
  EXPECT_EQ(samples_of(file("notes.exr")), 3);
  ASSERT_EQ(saved_path(r.err), "taken.part.exr") << r.err;
  EXPECT_EQ(samples_of(file("taken.part.exr")), 3);
}

// acceptance: Z1
TEST_F(RenderFaults, AnOutputThatFailsAtFirstIsTriedAgain) {
  fs::create_directory(file("late.exr"));
  const pid_t child = start_render({"-o", "late.exr", "-o", "good.exr", "--time", "1.5", "--json"});
  while_stopped(child, [&] { fs::remove(file("late.exr")); });
  const RunResult r = finish(child);
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(samples_of(file("late.exr")), samples_of(file("good.exr")));
  EXPECT_NE(r.out.find("\"late.exr\""), std::string::npos) << r.out;
}

// acceptance: Z1
TEST_F(RenderFaults, ALostFolderLeavesThePictureInTheTemporaryFolder) {
  fs::create_directory(file("out"));
  const pid_t child =
      start_render({"-o", "out/a.exr", "-o", "good.exr", "--time", "1.5", "--json"});
  while_stopped(child, [&] {
    fs::remove(file("out"));
    write("out", "now a file");
  });
  const RunResult r = finish(child);
  EXPECT_EQ(r.exit_code, 1) << r.err;
  const std::string saved = saved_path(r.out);
  ASSERT_EQ(fs::path(saved).filename(), "a.exr") << r.out;
  EXPECT_GT(samples_of(saved), 1);
  EXPECT_EQ(samples_of(saved), samples_of(file("good.exr")));
  fs::remove_all(fs::path(saved).parent_path());
}

TEST_F(RenderFaults, OutputsWithoutHopeAreReportedBeforeTheRender) {
  write("a_file", "");
  const RunResult r = render({"--samples", "1", "-o", "a_file/a.exr"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_EQ(r.error_lines(), 1) << r.err;
}

TEST_F(RenderFaults, FramesAfterOneThatCannotBeWrittenAreRendered) {
  std::string scene = small_scene();
  scene += "render \"root\" \"cam_inst\" \"opt\"\nrender \"root\" \"cam_inst\" \"opt\"\n";
  write("scene.mi", scene);
  fs::create_directory(file("f.2.exr"));
  const RunResult r = render({"--samples", "1", "-o", "f.#.exr"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_TRUE(there("f.1.exr"));
  EXPECT_TRUE(there("f.3.exr"));
}

// Three renders at the same time, since pictures in progress are written every few seconds: one is
// killed, one is interrupted, and one writes its passes to the file itself.
// acceptance: Z2
TEST_F(RenderFaults, TheOldPictureIsThereUntilTheNewOneIsFinished) {
  ASSERT_EQ(render({"-o", "a.exr", "--samples", "2"}).exit_code, 0);
  const auto old = bytes_of(file("a.exr"));
  for (const char* copy : {"b.exr", "c.exr"}) fs::copy_file(file("a.exr"), file(copy));
  const pid_t killed = start_long("a.exr"), interrupted = start_long("b.exr"),
              live = start_long("c.exr", {"--live"});
  EXPECT_TRUE(wait_until([&] { return there("a.part.exr") && there("b.part.exr"); }));
  EXPECT_TRUE(bytes_of(file("a.exr")) == old);
  EXPECT_TRUE(bytes_of(file("b.exr")) == old);
  EXPECT_GE(samples_of(file("a.part.exr")), 1);
  EXPECT_TRUE(wait_until([&] { return bytes_of(file("c.exr")) != old; }));
  EXPECT_FALSE(there("c.part.exr"));
  kill(killed, SIGKILL);
  kill(live, SIGKILL);
  kill(interrupted, SIGINT);
  finish(killed);
  finish(live);
  EXPECT_EQ(finish(interrupted).exit_code, 1);
  EXPECT_TRUE(bytes_of(file("a.exr")) == old);
  EXPECT_GE(samples_of(file("a.part.exr")), 1);
  EXPECT_GT(samples_of(file("b.exr")), 2) << "an interruption after a pass replaces the file";
  EXPECT_FALSE(there("b.part.exr")) << "it has become the picture";
  EXPECT_GE(samples_of(file("c.exr")), 1);
  // The next render replaces both.
  ASSERT_EQ(render({"-o", "a.exr", "--samples", "3"}).exit_code, 0);
  EXPECT_EQ(samples_of(file("a.exr")), 3);
}

// acceptance: Z2
TEST_F(RenderFaults, InterruptionInTheFirstPassKeepsTheOldPicture) {
  ASSERT_EQ(render({"-o", "a.exr", "--samples", "2"}).exit_code, 0);
  const auto old = bytes_of(file("a.exr"));
  const pid_t child =
      start_render({"-o", "a.exr", "--size", "1500x1000", "--threads", "1", "--json"});
  ASSERT_TRUE(wait_for_text("\"stage\":\"picture\""));
  kill(child, SIGINT);
  const RunResult r = finish(child);
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_TRUE(bytes_of(file("a.exr")) == old);
  EXPECT_TRUE(there("a.part.exr")) << r.err;
}

// acceptance: Z2
TEST_F(RenderFaults, KillingAtAnyTimeLeavesTheOldOrTheNewPicture) {
  const auto picture = [&](const char* seed) {
    const std::string name = std::string(seed) + ".exr";
    EXPECT_EQ(render({"-o", name, "--samples", "4", "--seed", seed}).exit_code, 0);
    return bytes_of(file(name));
  };
  const auto first = picture("1"), second = picture("2");
  ASSERT_FALSE(first == second);
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    fs::copy_file(file("1.exr"), file("a.exr"), fs::copy_options::overwrite_existing);
    const pid_t child = start_render({"-o", "a.exr", "--samples", "4", "--seed", "2"});
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 120000));
    kill(child, SIGKILL);
    finish(child);
    const auto left = bytes_of(file("a.exr"));
    EXPECT_TRUE(left == first || left == second) << i;
  }
}

}  // namespace render_faults_test
}  // namespace oriel
