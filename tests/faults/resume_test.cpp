// SPDX-License-Identifier: Apache-2.0
// Renders that are killed at any time and resumed: the picture has the same bytes.
#include "resume_test.h"

#include <random>

namespace oriel {
namespace resume_test {

namespace fs = std::filesystem;

class Resume : public ResumeTest {
 protected:
  void write_scene_with_photons(const std::string& options) const {
    std::string text = small_scene("globillum on caustic on " + options);
    const std::string place = "origin 0 1 -3";
    text.replace(text.find(place), place.size(),
                 place + " energy 5 5 5 globillum photons 1000 caustic photons 100");
    write("scene.mi", text);
  }
};

/// All kinds of layers, a light group and a material with outputs.
const std::vector<std::string> kAllLayers = {"--layers", "all", "--cryptomatte", "--light-group",
                                             "key=lamp*"};

// The program is killed at random times between its start and its end, also while it resumes and
// while it writes a checkpoint, until one run finishes; the picture then has the same bytes as that
// of a render that was never interrupted.
// acceptance: Z4
TEST_F(Resume, KillingAtAnyTimeGivesTheSameBytes) {
  const Words options = joined({"--samples", "64", "--seed", "5", "--size", "24x16"}, kAllLayers);
  const auto begin = std::chrono::steady_clock::now();
  const std::vector<char> whole = uninterrupted(options);
  const auto micros = std::chrono::duration_cast<std::chrono::microseconds>(
      std::chrono::steady_clock::now() - begin);
  std::mt19937 random(1);
  int kills = 0, finished = 0, resumed = 0;
  while (kills < 50 || finished == 0) {
    const bool had_state = there("a.chk");
    const pid_t child =
        start_render(joined(options, {"-o", "a.exr", "--checkpoint", "a.chk,every .005", "--resume",
                                      "a.chk", "--threads", std::to_string(1 + kills % 3)}));
    std::this_thread::sleep_for(
        std::chrono::microseconds(random() % (1 + static_cast<unsigned long>(micros.count()))));
    kill(child, SIGKILL);
    const RunResult r = finish(child);
    if (r.exit_code == -1) {
      ++kills;
      continue;
    }
    ASSERT_EQ(r.exit_code, 0) << r.err;
    resumed += had_state;
    ++finished;
    ASSERT_TRUE(bytes_of(file("a.exr")) == whole) << "after " << kills << " kills";
    EXPECT_FALSE(there("a.chk"));
  }
  EXPECT_GT(resumed, 0);
  std::printf("%d kills, %d pictures, %d of them resumed\n", kills, finished, resumed);
}

TEST_F(Resume, KeepsLayersAndMattes) {
  expect_same_bytes(joined({"--samples", "100"}, kAllLayers), "all layers");
  expect_same_bytes({"--samples", "100", "--crop", "3,4,40,30"}, "crop");
  expect_same_bytes({"--samples", "32", "--size", "128x128"}, "distributed samples");
  write("scene.mi", small_scene("filter mitchell 4 4"));
  expect_same_bytes(joined({"--samples", "100"}, kAllLayers), "filter with negative lobes");
}

TEST_F(Resume, DecidesOnNoiseAlike) {
  expect_same_bytes({"--noise", ".03"}, "noise of the picture");
  // The scene's own options judge every pixel.
  write("scene.mi", small_scene("samples 0 4 contrast .1 .1 .1 .1"));
  expect_same_bytes({}, "noise of every pixel");
}

TEST_F(Resume, KeepsPhotonsAndGatherPoints) {
  write_scene_with_photons("finalgather accuracy 32");
  for (const char* method : {"fg", "scene"})
    expect_same_bytes(joined({"--gi", method, "--samples", "64"}, kAllLayers), method);
  write_scene_with_photons("finalgather on finalgather accuracy 32");
  expect_same_bytes(joined({"--gi", "scene", "--samples", "64"}, kAllLayers), "both");
}

// The first run writes map files. The resumed one must not read them: gather points in files have
// no light groups, and more points would be added.
TEST_F(Resume, DoesNotReadMapFilesOfTheFirstRun) {
  const Words options = joined({"--gi", "scene", "--samples", "64"}, kAllLayers);
  write_scene_with_photons(
      "finalgather on finalgather accuracy 32 finalgather file \"a.fgm\" photonmap file \"a.pm\"");
  const std::vector<char> whole = uninterrupted(options);
  ASSERT_TRUE(there("a.fgm"));
  fs::remove(file("a.fgm"));
  fs::remove(file("a.pm"));
  stop(options);
  EXPECT_TRUE(there("a.fgm"));
  EXPECT_TRUE(resume(options) == whole);
}

TEST_F(Resume, MappedColoursAndDenoisedPicturesAreTheSame) {
  std::string scene = small_scene("", "lens \"mia_exposure_simple\" (\"gain\" 2)");
  write("scene.mi", scene);
  expect_same_bytes({"--samples", "100", "--denoise"}, "exposure");
}

// A frame that was finished is not rendered again, one that was interrupted is resumed, and those
// after it are rendered.
TEST_F(Resume, AnimationsContinueInTheirFrame) {
  const std::string first = small_scene();
  const std::string turn =
      "incremental light \"lamp\" \"mib_light_point\" ( \"color\" .5 1 1 ) origin 0 1 -3 end "
      "light\n"
      "render \"root\" \"cam_inst\" \"opt\"\n";
  write("scene.mi", first + turn + turn);
  const Words options = {"--samples", "150", "-o", "f.#.exr"};
  ASSERT_EQ(render(options).exit_code, 0);
  std::vector<std::vector<char>> whole;
  for (const char* name : {"f.1.exr", "f.2.exr", "f.3.exr"}) {
    whole.push_back(bytes_of(file(name)));
    fs::remove(file(name));
  }
  const pid_t child = start_render(joined(options, {"--checkpoint", "a.chk,every .02", "--json"}));
  ASSERT_TRUE(wait_until([&] { return there("f.1.exr"); }));
  const int before = written_checkpoints();
  ASSERT_TRUE(wait_until([&] { return written_checkpoints() > before + 1; }));
  kill(child, SIGKILL);
  ASSERT_EQ(finish(child).exit_code, -1);
  ASSERT_FALSE(there("f.2.exr"));
  fs::remove(file("f.1.exr"));
  const RunResult r = render(joined(options, {"--resume", "a.chk"}));
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-RN-075"), std::string::npos) << r.err;
  EXPECT_FALSE(there("f.1.exr")) << "the first run finished it";
  EXPECT_TRUE(bytes_of(file("f.2.exr")) == whole[1]);
  EXPECT_TRUE(bytes_of(file("f.3.exr")) == whole[2]);
  EXPECT_FALSE(there("a.chk"));
}

// Killed between two frames: the checkpoint says which one is finished.
TEST_F(Resume, AnimationsContinueAfterAFinishedFrame) {
  const std::string again = "render \"root\" \"cam_inst\" \"opt\"\n";
  write("scene.mi", small_scene() + again + again);
  const Words options = {"--samples", "150", "-o", "f.#.exr"};
  const pid_t child = start_render(joined(options, {"--checkpoint", "a.chk", "--json"}));
  ASSERT_TRUE(wait_until([&] { return there("a.chk"); }));
  kill(child, SIGKILL);
  ASSERT_EQ(finish(child).exit_code, -1);
  ASSERT_TRUE(there("f.1.exr"));
  fs::remove(file("f.1.exr"));
  expect_refused({"--resume", "a.chk", "--samples", "151"}, {"--samples was '150' and is '151'"});
  const RunResult r = render(joined(options, {"--resume", "a.chk"}));
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_FALSE(there("f.1.exr"));
  EXPECT_TRUE(there("f.2.exr"));
  EXPECT_TRUE(there("f.3.exr"));
}

TEST_F(Resume, StereoContinuesInItsEye) {
  write("scene.mi", small_scene("", "stereo offset eye separation .1"));
  const Words options = {"--samples", "150", "-o", "s.exr"};
  ASSERT_EQ(render(options).exit_code, 0);
  const auto pictures = names();
  const std::vector<char> left = bytes_of(file("s_left.exr")),
                          right = bytes_of(file("s_right.exr"));
  const pid_t child = start_render(joined(options, {"--checkpoint", "a.chk,every .02", "--json"}));
  ASSERT_TRUE(wait_until([&] { return written_checkpoints() > 0; }));
  kill(child, SIGTERM);
  finish(child);
  EXPECT_EQ(render(joined(options, {"--resume", "a.chk"})).exit_code, 0);
  EXPECT_FALSE(left.empty());
  EXPECT_TRUE(bytes_of(file("s_left.exr")) == left);
  EXPECT_TRUE(bytes_of(file("s_right.exr")) == right);
}

TEST_F(Resume, ModelsContinue) {
  write("chair.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Words options = {"quick", "chair.obj", "--samples", "150", "--size", "48x32", "-o"};
  ASSERT_EQ(run(joined(options, {"whole.png"})).exit_code, 0);
  const pid_t child =
      start(joined(options, {"whole.png", "--checkpoint", "a.chk,every .02", "--json"}));
  const std::vector<char> whole = bytes_of(file("whole.png"));
  ASSERT_TRUE(wait_until([&] { return written_checkpoints() > 0; }));
  kill(child, SIGKILL);
  ASSERT_EQ(finish(child).exit_code, -1);
  fs::remove(file("whole.png"));
  const RunResult r = run(joined(options, {"whole.png", "--resume", "a.chk"}));
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-RN-075"), std::string::npos) << r.err;
  EXPECT_TRUE(bytes_of(file("whole.png")) == whole);
}

// The time of both runs is in the file; without --timestamps it is not, and the whole file is the
// same.
TEST_F(Resume, RenderTimeIsTheSum) {
  stop({"--samples", "100000", "--timestamps"}, SIGTERM, 20);
  const std::string note = [&] {
    return render({"-o", "b.exr", "--samples", "100000", "--time", ".01", "--timestamps",
                   "--checkpoint", "b.chk", "--resume", "a.chk", "--json"})
        .out;
  }();
  const std::string key = "\"elapsed\":";
  const std::size_t at = note.rfind(key);
  ASSERT_NE(at, note.npos) << note;
  EXPECT_GT(std::stod(note.substr(at + key.size())), 20 * .02) << "twenty intervals of the first";
}

}  // namespace resume_test
}  // namespace oriel
