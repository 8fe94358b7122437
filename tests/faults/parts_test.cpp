// SPDX-License-Identifier: Apache-2.0
// Parts of a picture: merged, they have the bytes of the whole render.
#include "resume_test.h"

namespace oriel {
namespace parts_test {

namespace fs = std::filesystem;

class Parts : public ResumeTest {
 protected:
  static std::string part(int k, int n) {
    return "p.part-" + std::to_string(k) + "-of-" + std::to_string(n);
  }

  void render_part(int k, int n, const Words& options) const {
    const RunResult r = render(
        joined(options, {"-o", "p.exr", "-q", "--part", std::to_string(k) + "/" + std::to_string(n),
                         "--threads", std::to_string(1 + k % 2)}));
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(r.err, "");
    EXPECT_TRUE(there(part(k, n)));
    EXPECT_FALSE(there("p.exr"));
  }

  RunResult merge(int n, const Words& options = {}) const {
    Words words = {"merge"};
    for (int k = 1; k <= n; ++k) words.push_back(part(k, n));
    return run(joined(words, options));
  }

  /// Renders all parts and merges them, with the rounds that a noise target needs. Returns the
  /// number of rounds.
  int render_and_merge(int n, const Words& options) const {
    for (int round = 1; round < 100; ++round) {
      for (int k = 1; k <= n; ++k) render_part(k, n, options);
      const RunResult r = merge(n, {"-o", "p.exr"});
      if (r.exit_code == 75) {
        EXPECT_TRUE(there("p.round"));
        EXPECT_FALSE(there("p.exr"));
        continue;
      }
      EXPECT_EQ(r.exit_code, 0) << r.err;
      return round;
    }
    ADD_FAILURE() << "the rounds do not end";
    return 0;
  }

  void remove_parts() const {
    for (const std::string& name : names())
      if (name.starts_with("p.")) fs::remove(file(name));
  }

  void expect_same(const Words& options, const std::string& what,
                   const std::vector<int>& counts = {3}) const {
    const std::vector<char> whole = uninterrupted(options);
    for (const int n : counts) {
      remove_parts();
      render_and_merge(n, options);
      EXPECT_TRUE(bytes_of(file("p.exr")) == whole) << what << ", " << n << " parts";
    }
    remove_parts();
  }

  void expect_not_merged(const Words& words, const Words& texts) const {
    const RunResult r = run(joined(joined({"merge"}, words), {"-o", "merged.exr"}));
    EXPECT_EQ(r.exit_code, 1) << r.err;
    for (const std::string& text : texts)
      EXPECT_NE(r.err.find(text), std::string::npos) << text << ": " << r.err;
    EXPECT_FALSE(there("merged.exr"));
  }
};

const std::vector<std::string> kEveryLayer = {"--layers", "all", "--cryptomatte", "--light-group",
                                              "key=lamp*"};

// More parts than the 6 tiles of the picture are possible.
// acceptance: F1
TEST_F(Parts, HaveTheBytesOfTheWholePicture) {
  expect_same(joined({"--samples", "20", "--seed", "3"}, kEveryLayer), "all layers", {1, 2, 3, 7});
  expect_same({"--samples", "20", "--crop", "3,4,40,30"}, "crop");
  expect_same({"--samples", "20", "--denoise"}, "denoised");
  write("scene.mi",
        small_scene("filter mitchell 4 4", "lens \"mia_exposure_simple\" (\"gain\" 2)"));
  expect_same(joined({"--samples", "20"}, kEveryLayer),
              "exposure and a filter with negative lobes");
}

TEST_F(Parts, AgreeOnNoise) {
  const Words picture = {"--noise", ".05"};
  expect_same(picture, "noise of the picture", {1, 2, 3, 7});
  EXPECT_GT(render_and_merge(2, picture), 1);
  write("scene.mi", small_scene("samples 0 4 contrast .1 .1 .1 .1"));
  expect_same({}, "noise of every pixel", {2});
}

// The second half of the samples is distributed over the picture, in a second round.
TEST_F(Parts, AgreeOnDistributedSamples) {
  const Words picture = {"--samples", "32", "--size", "128x128", "--layers", "samples"};
  expect_same(picture, "distributed", {3});
  EXPECT_EQ(render_and_merge(2, picture), 2);
  remove_parts();
  const Words even = joined(picture, {"--even-samples"});
  EXPECT_EQ(render_and_merge(2, even), 1);
  EXPECT_FALSE(bytes_of(file("p.exr")) == uninterrupted(picture));
}

TEST_F(Parts, AgreeOnIndirectLight) {
  std::string text = small_scene("globillum on caustic on finalgather accuracy 32");
  const std::string place = "origin 0 1 -3";
  text.replace(text.find(place), place.size(),
               place + " energy 5 5 5 globillum photons 1000 caustic photons 100");
  write("scene.mi", text);
  for (const char* method : {"path", "path+cache", "fg", "photons", "fg+photons", "scene"})
    expect_same(joined({"--gi", method, "--samples", "16"}, kEveryLayer), method);
}

TEST_F(Parts, AgreeOnMotionBlur) {
  std::string text = small_scene("shutter 0 1");
  const std::string still = "instance \"cam_inst\" \"cam\" end instance";
  text.replace(
      text.find(still), still.size(),
      "instance \"cam_inst\" \"cam\" motion transform 1 0 0 0 0 1 0 0 0 0 1 0 .3 0 0 1 end "
      "instance");
  write("scene.mi", text);
  expect_same(joined({"--samples", "20"}, kEveryLayer), "motion blur", {3});
}

TEST_F(Parts, OfBothEyesAreMerged) {
  write("scene.mi", small_scene("", "stereo offset eye separation .1"));
  ASSERT_EQ(render({"--samples", "8", "-o", "whole.exr", "-q"}).exit_code, 0);
  for (int k = 1; k <= 2; ++k)
    ASSERT_EQ(render({"--samples", "8", "-o", "p.exr", "-q", "--part", std::to_string(k) + "/2"})
                  .exit_code,
              0);
  const Words parts = {"p_left.part-1-of-2", "p_right.part-1-of-2", "p_left.part-2-of-2",
                       "p_right.part-2-of-2"};
  for (const std::string& name : parts) ASSERT_TRUE(there(name)) << name;
  expect_not_merged({parts[0], parts[1], parts[2]}, {"p_right.part-2-of-2", "is missing"});
  const RunResult r = run(joined(joined({"merge"}, parts), {"-o", "p.exr"}));
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(bytes_of(file("p_left.exr")) == bytes_of(file("whole_left.exr")));
  EXPECT_TRUE(bytes_of(file("p_right.exr")) == bytes_of(file("whole_right.exr")));
  EXPECT_FALSE(bytes_of(file("p_left.exr")) == bytes_of(file("p_right.exr")));
}

TEST_F(Parts, OfSeveralFramesAreMerged) {
  const std::string place =
      "incremental light \"lamp\" \"mib_light_point\" (\"color\" 3 1 1) "
      "origin 0 1 -3 end light\n";
  write("scene.mi", small_scene() + place + "render \"root\" \"cam_inst\" \"opt\"\n");
  ASSERT_EQ(render({"--samples", "8", "-o", "whole.#.exr", "-q"}).exit_code, 0);
  for (const char* part : {"1/2", "2/2"})
    ASSERT_EQ(render({"--samples", "8", "-o", "p.#.exr", "-q", "--part", part}).exit_code, 0);
  const Words parts = {"p.1.part-1-of-2", "p.1.part-2-of-2", "p.2.part-1-of-2", "p.2.part-2-of-2"};
  const RunResult r = run(joined(joined({"merge"}, parts), {"-o", "p.#.exr"}));
  ASSERT_EQ(r.exit_code, 0) << r.err;
  for (const std::string frame : {"1", "2"})
    EXPECT_TRUE(bytes_of(file("p." + frame + ".exr")) == bytes_of(file("whole." + frame + ".exr")))
        << frame;
  EXPECT_FALSE(bytes_of(file("p.1.exr")) == bytes_of(file("p.2.exr")));
}

// The same version, and another build: bytes after the end of a program are ignored.
TEST_F(Parts, OfAnotherProgramAreRefused) {
  fs::copy_file(ORIEL_PROGRAM, file("other_oriel"));
  std::ofstream(file("other_oriel"), std::ios::app | std::ios::binary) << "x";
  render_part(1, 2, {"--samples", "4"});
  ASSERT_EQ(shell("./other_oriel render scene.mi -o p.exr --samples 4 --part 2/2 -q 2>stderr.txt")
                .exit_code,
            0);
  expect_not_merged({part(1, 2), part(2, 2)},
                    {"p.part-2-of-2", "it was written by Oriel", "and this is Oriel"});
  // Nor does another program continue a part, or use maps.
  const RunResult r =
      shell("./other_oriel render scene.mi -o p.exr --samples 4 --part 1/2 -q 2>stderr.txt");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("was written by Oriel"), std::string::npos) << r.err;
  ASSERT_EQ(
      render({"--gi", "fg", "--samples", "4", "-o", "m.exr", "--maps-only", "maps"}).exit_code, 0);
  const RunResult maps =
      shell("./other_oriel render scene.mi -o m.exr --gi fg --samples 4 --maps maps 2>stderr.txt");
  EXPECT_EQ(maps.exit_code, 1);
  EXPECT_NE(maps.err.find("maps/frame-0001.maps"), std::string::npos) << maps.err;
  EXPECT_NE(maps.err.find("program was 'Oriel"), std::string::npos) << maps.err;
}

// An emulated processor without AVX2, where results could have other bytes.
TEST_F(Parts, AreNotRenderedOnOlderProcessors) {
  if (!runs_older_processor()) GTEST_SKIP() << "qemu-x86_64 is not installed";
  const RunResult r =
      shell(std::string(kOlderProcessor) +
            " \"$ORIEL\" render scene.mi -o p.exr --samples 4 --part 1/2 2> stderr.txt");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find(": the processor lacks AVX2"), std::string::npos) << r.err;
  EXPECT_EQ(r.error_lines(), 1) << r.err;
  EXPECT_FALSE(there(part(1, 2)));
}

// A part is killed while it renders, and continues.
TEST_F(Parts, ContinueAfterAKill) {
  const Words options = joined({"--samples", "200"}, kEveryLayer);
  const std::vector<char> whole = uninterrupted(options);
  render_part(1, 2, options);
  int kills = 0;
  for (; kills < 3; ++kills) {
    write("stdout.txt", "");
    const pid_t child = start_render(
        joined(options, {"-o", "p.exr", "--part", "2/2", "--checkpoint", ",every .02", "--json"}));
    ASSERT_TRUE(wait_until([&] { return written_checkpoints() >= 1; }));
    kill(child, SIGKILL);
    if (finish(child).exit_code != -1) break;
  }
  EXPECT_GT(kills, 0);
  const RunResult unfinished = merge(2, {"-o", "p.exr"});
  EXPECT_EQ(unfinished.exit_code, 1);
  EXPECT_NE(unfinished.err.find("part 2 of 2 is not finished"), std::string::npos)
      << unfinished.err;
  const RunResult r = render(joined(options, {"-o", "p.exr", "--part", "2/2"}));
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-RN-075"), std::string::npos) << r.err;
  ASSERT_EQ(merge(2, {"-o", "p.exr"}).exit_code, 0);
  EXPECT_TRUE(bytes_of(file("p.exr")) == whole);
}

TEST_F(Parts, SignalsSaveThePart) {
  const Words options = {"--samples", "4000", "-o", "p.exr", "--part", "1/2"};
  for (const int signal : {SIGUSR1, SIGTERM}) {
    write("stdout.txt", "");
    const pid_t child = start_render(joined(options, {"--json", "--checkpoint", ",every .05"}));
    ASSERT_TRUE(wait_until([&] { return written_checkpoints() >= 1; }));
    kill(child, signal);
    EXPECT_EQ(finish(child).exit_code, 75);
    EXPECT_TRUE(there(part(1, 2)));
    EXPECT_FALSE(there("p.exr"));
  }
}

TEST_F(Parts, AreFinishedOnce) {
  render_part(1, 2, {"--samples", "4"});
  const std::vector<char> before = bytes_of(file(part(1, 2)));
  render_part(1, 2, {"--samples", "4"});
  EXPECT_TRUE(bytes_of(file(part(1, 2))) == before);
}

TEST_F(Parts, OthersAreRefusedByName) {
  const Words options = {"--samples", "4"};
  for (int k = 1; k <= 3; ++k) render_part(k, 3, options);
  expect_not_merged({part(1, 3), part(3, 3)}, {"p.part-2-of-3", "part 2 of 3 is missing"});
  expect_not_merged({part(1, 3)}, {"part 2 of 3 is missing", "part 3 of 3 is missing"});
  fs::copy_file(file(part(2, 3)), file("copy.part"));
  expect_not_merged({part(1, 3), part(2, 3), part(3, 3), "copy.part"},
                    {"copy.part", "it is part 2 of 3, as is"});
  // Torn.
  const std::vector<char> bytes = bytes_of(file(part(2, 3)));
  std::ofstream(file("copy.part"), std::ios::binary)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size() / 2));
  expect_not_merged({part(1, 3), "copy.part", part(3, 3)}, {"copy.part", "incomplete or damaged"});
  std::vector<char> flipped = bytes;
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 1);
  std::ofstream(file("copy.part"), std::ios::binary)
      .write(flipped.data(), static_cast<std::streamsize>(flipped.size()));
  expect_not_merged({part(1, 3), "copy.part", part(3, 3)}, {"copy.part", "checksum"});
  expect_not_merged({part(1, 3), "scene.mi", part(3, 3)}, {"scene.mi", "not a checkpoint"});
  expect_not_merged({part(1, 3), "none.part", part(3, 3)}, {"none.part", "no such file"});
  // Another number of parts.
  render_part(1, 2, options);
  expect_not_merged({part(1, 3), part(2, 3), part(3, 3), part(1, 2)},
                    {"p.part-1-of-2", "parts of 3"});
  // Other settings.
  fs::remove(file(part(2, 3)));
  render_part(2, 3, {"--samples", "5"});
  expect_not_merged({part(1, 3), part(2, 3), part(3, 3)},
                    {"p.part-2-of-3", "another render", "--samples was '5' and is '4'"});
}

TEST_F(Parts, OfAnotherSceneAreRefused) {
  const Words options = {"--samples", "4"};
  for (int k = 1; k <= 2; ++k) render_part(k, 2, options);
  write("scene.mi", small_scene("", "lens \"mia_exposure_simple\" (\"gain\" 2)"));
  expect_not_merged({part(1, 2), part(2, 2)}, {"p.part-1-of-2", "the file 'scene.mi' has changed"});
  const RunResult r = render({"--samples", "4", "-o", "p.exr", "--part", "1/2"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("the file 'scene.mi' has changed"), std::string::npos) << r.err;
}

TEST_F(Parts, AreNumberedFromOne) {
  for (const char* text : {"0/2", "3/2", "1", "1/0", "a/b", "1/2/3", "1/200000"})
    EXPECT_EQ(render({"-o", "p.exr", "--part", text}).exit_code, 2) << text;
  EXPECT_EQ(render({"-o", "p.exr", "--part", "1/2", "--time", "3"}).exit_code, 2);
}

class Maps : public Parts {};

// Computed once, read by the parts: the bytes are those of one machine, and no photon is traced
// again.
// acceptance: F2
TEST_F(Maps, OfOneRunServeAllParts) {
  std::string text = small_scene("globillum on caustic on finalgather accuracy 32");
  const std::string place = "origin 0 1 -3";
  text.replace(text.find(place), place.size(),
               place + " energy 5 5 5 globillum photons 1000 caustic photons 100");
  write("scene.mi", text);
  for (const char* method : {"path", "path+cache", "fg", "photons", "fg+photons", "scene"}) {
    const Words options = joined({"--gi", method, "--samples", "16"}, kEveryLayer);
    const std::vector<char> whole = uninterrupted(options);
    const RunResult r = render(joined(options, {"-o", "p.exr", "--maps-only", "maps"}));
    ASSERT_EQ(r.exit_code, 0) << r.err;
    ASSERT_TRUE(there("maps/frame-0001.maps"));
    EXPECT_FALSE(there("p.exr"));
    render_and_merge(3, joined(options, {"--maps", "maps"}));
    EXPECT_TRUE(bytes_of(file("p.exr")) == whole) << method;
    remove_parts();
  }
}

TEST_F(Maps, OfAnotherRenderAreRefused) {
  const Words options = {"--gi", "photons", "--samples", "16", "-o", "p.exr"};
  ASSERT_EQ(render(joined(options, {"--maps-only", "maps"})).exit_code, 0);
  const RunResult r = render({"--gi", "fg", "--samples", "16", "-o", "p.exr", "--maps", "maps"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("--gi was 'photons' and is 'fg'"), std::string::npos) << r.err;
  const RunResult none = render(joined(options, {"--maps", "nothing"}));
  EXPECT_EQ(none.exit_code, 1);
  EXPECT_NE(none.err.find("nothing/frame-0001.maps"), std::string::npos) << none.err;
  EXPECT_FALSE(there("p.exr"));
}

}  // namespace parts_test
}  // namespace oriel
