// SPDX-License-Identifier: Apache-2.0
// Checkpoints: when they are written, what they replace, and which are refused.
#include <random>

#include "resume_test.h"

namespace oriel {
namespace checkpoints_test {

namespace fs = std::filesystem;

class Checkpoints : public ResumeTest {
 protected:
  static constexpr const char* kMany = "1000000";
};

// acceptance: Z4
TEST_F(Checkpoints, TornOnesAreRefused) {
  const Words options = {"--samples", kMany};
  stop(options);
  const std::vector<char> whole = bytes_of(file("a.chk"));
  // The limit ends a render that should have been refused.
  const Words resuming = joined(options, {"--resume", "a.chk", "--time", ".01"});
  const Words message = {"cannot resume 'a.chk'", "render without --resume"};
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{39}, std::size_t{40},
                                 std::size_t{500}, whole.size() / 2, whole.size() - 1}) {
    write_bytes(file("a.chk"), {whole.begin(), whole.begin() + std::ptrdiff_t(size)});
    expect_refused(resuming, message);
  }
  std::mt19937 random(2);
  for (int i = 0; i < 30; ++i) {
    std::vector<char> torn = whole;
    const std::size_t at = i < 20 ? std::size_t(2 * i) : random() % whole.size();
    torn[at] = static_cast<char>(torn[at] ^ (1 << random() % 8));
    write_bytes(file("a.chk"), torn);
    expect_refused(resuming, message);
  }
}

// acceptance: Z4
TEST_F(Checkpoints, OtherRendersAreRefusedByTheirDifference) {
  const Words options = {"--samples", kMany};
  stop(options);
  const auto refused = [&](const Words& more, const std::string& words) {
    expect_refused(joined({"--resume", "a.chk"}, more), {"belongs to another render", words});
  };
  refused({"--samples", "64"}, "--samples was '1000000' and is '64'");
  refused(joined(options, {"--seed", "1"}), "--seed was '0' and is '1'");
  refused(joined(options, {"--size", "47x32"}), "--size was '48x32' and is '47x32'");
  refused(joined(options, {"--crop", "0,0,46,31"}), "--crop");
  refused(joined(options, {"--gi", "fg"}), "--gi was 'path' and is 'fg'");
  refused(joined(options, {"--noise", ".1"}), "--noise was '0' and is '0.1'");
  refused(joined(options, {"--clamp", "2"}), "--clamp");
  refused(joined(options, {"--set", "grey.diffuse=1 0 0"}), "--set was not given");
  refused(joined(options, {"--light-group", "key=lamp*"}), "--light-group");
  refused(joined(options, {"--layers", "position"}), "layers");
  refused(joined(options, {"--cryptomatte"}), "layers");
  const std::string text = text_of(file("scene.mi"));
  write("scene.mi", text + "# a comment\n");
  refused(options, "the file 'scene.mi' has changed");
  write("scene.mi", text);
  EXPECT_EQ(
      render(joined(options, {"-o", "b.exr", "--resume", "a.chk", "--time", ".01"})).exit_code, 0)
      << "the render itself";
}

TEST_F(Checkpoints, ChangedFilesOfTheSceneAreRefused) {
  write("part.mi", "# empty\n");
  const auto write_picture = [&](const std::string& color) {
    write("bitmap.ppm", "P3 1 1 255 " + color + "\n");
  };
  write_picture("200 100 50");
  std::string text = "$include \"part.mi\"\ncolor texture \"map\" \"bitmap.ppm\"\n" + small_scene();
  const std::string constant = "\"diffuse\" .5 .5 .5,";
  text.replace(text.find(constant), constant.size(), "\"diffuse\" = \"look\",");
  text.insert(text.find("material \"grey\""),
              "shader \"look\" \"mib_texture_lookup\" (\"tex\" \"map\", \"coord\" .5 .5 0)\n");
  write("scene.mi", text);
  const Words options = {"--samples", kMany};
  stop(options);
  const Words resuming = joined(options, {"--resume", "a.chk"});
  write_picture("200 100 51");
  expect_refused(resuming, {"the file 'bitmap.ppm' has changed"});
  write_picture("200 100 50");
  write("part.mi", "# other\n");
  expect_refused(resuming, {"the file 'part.mi' has changed"});
  write("part.mi", "# empty\n");
  // The folder may be moved, and the files copied.
  fs::create_directory(file("moved"));
  for (const char* name : {"scene.mi", "part.mi", "bitmap.ppm"})
    fs::copy_file(file(name), file(std::string("moved/") + name));
  const RunResult r = run({"render", "moved/scene.mi", "-o", "b.exr", "--samples", kMany,
                           "--resume", "a.chk", "--time", ".01"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-RN-075"), std::string::npos) << r.err;
}

// acceptance: Z4
TEST_F(Checkpoints, OtherProgramsAreRefused) {
  stop({"--samples", kMany});
  // The same program with another build: bytes after the end of a program are ignored.
  const std::string other = file("other_oriel");
  fs::copy_file(ORIEL_PROGRAM, other);
  std::ofstream(other, std::ios::app | std::ios::binary) << "x";
  const RunResult r = shell(
      "./other_oriel render scene.mi -o b.exr -q --samples 1000000 --resume a.chk 2>stderr.txt");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_EQ(r.error_lines(), 1) << r.err;
  EXPECT_NE(r.err.find("was written by Oriel"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("render without --resume"), std::string::npos) << r.err;
}

// Threads, names of outputs and options that decide only how files show the film.
TEST_F(Checkpoints, OptionsOfOutputsMayDiffer) {
  const Words options = {"--samples", "100"};
  ASSERT_EQ(
      render({"--samples", "100", "-o", "whole.exr", "--exr", "float,zips", "--linear"}).exit_code,
      0);
  stop(options);
  const RunResult r = render({"--samples", "100", "-o", "b.exr", "--exr", "float,zips", "--linear",
                              "--threads", "1", "--resume", "a.chk"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(bytes_of(file("b.exr")) == bytes_of(file("whole.exr")));
}

TEST_F(Checkpoints, SignalsThatEndTheRenderWriteOne) {
  const Words options = {"--samples", "200"};
  const std::vector<char> whole = uninterrupted(options);
  for (const int number : {SIGTERM, SIGHUP, SIGINT}) {
    write("stdout.txt", "");
    const pid_t child = start_render(
        joined(options, {"-o", "a.exr", "--checkpoint", "a.chk", "--threads", "1", "--json"}));
    ASSERT_TRUE(wait_for_text("\"pass\":2"));
    kill(child, number);
    const RunResult r = finish(child);
    EXPECT_EQ(r.exit_code, 75) << r.err;
    EXPECT_EQ(written_checkpoints(), 1) << r.out;
    EXPECT_TRUE(resume(options) == whole) << number;
  }
}

TEST_F(Checkpoints, Usr1WritesOneAndGoesOn) {
  const Words options = {"--samples", "300"};
  const std::vector<char> whole = uninterrupted(options);
  const pid_t child =
      start_render(joined(options, {"-o", "a.exr", "--checkpoint", "a.chk", "--json"}));
  ASSERT_TRUE(wait_for_text("\"stage\":\"picture\""));
  kill(child, SIGUSR1);
  ASSERT_TRUE(wait_until([&] { return written_checkpoints() == 1; }));
  fs::copy_file(file("a.chk"), file("copy.chk"));
  const RunResult r = finish(child);
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(bytes_of(file("a.exr")) == whole);
  EXPECT_FALSE(there("a.chk"));
  fs::rename(file("copy.chk"), file("a.chk"));
  EXPECT_TRUE(resume(options) == whole);
}

TEST_F(Checkpoints, Usr1DoesNotEndRendersWithoutThem) {
  const pid_t child = start_render({"-o", "a.exr", "--time", "1", "--json"});
  ASSERT_TRUE(wait_for_text("\"stage\":\"picture\""));
  kill(child, SIGUSR1);
  EXPECT_EQ(finish(child).exit_code, 0);
}

TEST_F(Checkpoints, TheSecondInterruptKeepsTheLastOne) {
  const Words options = {"--samples", kMany, "--size", "700x500"};
  const pid_t child =
      start_render(joined(options, {"-o", "a.exr", "--checkpoint", "a.chk,every .2", "--json"}));
  ASSERT_TRUE(wait_until([&] { return written_checkpoints() > 0; }));
  kill(child, SIGINT);
  kill(child, SIGTERM);
  EXPECT_EQ(finish(child).exit_code, -1);
  const RunResult r =
      render(joined(options, {"-o", "a.exr", "--resume", "a.chk", "--time", ".01"}));
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-RN-075"), std::string::npos) << r.err;
}

TEST_F(Checkpoints, TheTimeLimitLeavesOne) {
  const Words options = {"--samples", "500", "--noise", "1e-6"};
  const std::vector<char> whole = uninterrupted(options);
  const RunResult r =
      render(joined(options, {"-o", "a.exr", "--checkpoint", "a.chk", "--time", ".2", "--json"}));
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.out.find("\"stopped_by\":\"time\""), std::string::npos) << r.out;
  ASSERT_TRUE(there("a.chk"));
  // The limit counts for each run.
  const RunResult more =
      render(joined(options, {"-o", "a.exr", "--resume", "a.chk", "--time", ".2", "--json"}));
  EXPECT_NE(more.out.find("\"stopped_by\":\"time\""), std::string::npos) << more.out;
  EXPECT_TRUE(resume(options) == whole);
}

// While the file cannot be written, the render goes on; it is written when that is possible again.
TEST_F(Checkpoints, FailedWritesDoNotEndTheRender) {
  const pid_t child =
      start_render({"-o", "a.exr", "--time", "2", "--checkpoint", "a.chk,every .1", "--json"});
  ASSERT_TRUE(wait_until([&] { return written_checkpoints() > 0; }));
  fs::remove(file("a.chk"));
  fs::create_directory(file("a.chk"));
  ASSERT_TRUE(wait_for_text("OR-RN-073"));
  fs::remove(file("a.chk"));
  ASSERT_TRUE(wait_until([&] { return there("a.chk"); }));
  const RunResult r = finish(child);
  EXPECT_EQ(r.exit_code, 0) << r.out;
}

TEST_F(Checkpoints, AFullDiskKeepsTheLastOne) {
  stop({"--samples", kMany}, SIGTERM);
  const std::vector<char> last = bytes_of(file("a.chk"));
  const auto before = names();
  const RunResult r = [&] {
    const FileSizeLimit limited(100000);
    return render({"-o", "a.exr", "--samples", kMany, "--resume", "a.chk", "--time", ".5"});
  }();
  EXPECT_EQ(r.exit_code, 1) << "the last write is an error";
  EXPECT_NE(r.err.find("OR-RN-073"), std::string::npos) << r.err;
  EXPECT_TRUE(bytes_of(file("a.chk")) == last);
  EXPECT_EQ(names(), before);
}

TEST_F(Checkpoints, AFileOfAnotherKindIsNotReplaced) {
  write("notes.txt", "mine");
  const RunResult r = render({"-o", "a.exr", "--samples", "1", "--checkpoint", "notes.txt"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_EQ(text_of(file("notes.txt")), "mine");
  fs::create_symlink("notes.txt", file("link.chk"));
  EXPECT_EQ(render({"-o", "a.exr", "--samples", "1", "--checkpoint", "link.chk"}).exit_code, 1);
  EXPECT_EQ(render({"-o", "a.exr", "--samples", "1", "--checkpoint", "no/a.chk"}).exit_code, 1);
  EXPECT_FALSE(there("a.exr"));
}

// Whoever forgets --resume does not lose the work.
TEST_F(Checkpoints, AnUnfinishedRenderIsNotReplaced) {
  stop({"--samples", kMany});
  expect_refused({"--samples", kMany, "--checkpoint", "a.chk"}, {"--resume a.chk"});
}

TEST_F(Checkpoints, MissingOnesStartTheRenderIfTheyAreWritten) {
  EXPECT_EQ(render({"-o", "a.exr", "--samples", "1", "--resume", "a.chk"}).exit_code, 1);
  EXPECT_FALSE(there("a.exr"));
  const RunResult r =
      render({"-o", "a.exr", "--samples", "1", "--checkpoint", "a.chk", "--resume", "a.chk"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-RN-074"), std::string::npos) << r.err;
}

TEST_F(Checkpoints, BadIntervalsAreErrorsOfUsage) {
  for (const char* value : {"a.chk,every", "a.chk,every 0", "a.chk,every -1", "a.chk,every x",
                            "a.chk,every 5s", ",every 5", "a.chk,every nan"})
    EXPECT_EQ(render({"--samples", "1", "--checkpoint", value}).exit_code, 2) << value;
}

// The picture cannot be written, so the samples stay in the checkpoint.
TEST_F(Checkpoints, APictureThatIsNotWrittenKeepsIt) {
  fs::create_directory(file("taken.exr"));
  const RunResult r =
      render({"-o", "taken.exr", "-o", "good.exr", "--samples", "4", "--checkpoint", "a.chk"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  ASSERT_TRUE(there("a.chk"));
  const RunResult again = render({"-o", "a.exr", "--samples", "4", "--resume", "a.chk"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(bytes_of(file("a.exr")) == bytes_of(file("good.exr")));
}

}  // namespace checkpoints_test
}  // namespace oriel
