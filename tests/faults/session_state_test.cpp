// SPDX-License-Identifier: Apache-2.0
// The state of a session in a checkpoint: restored exactly, and harmless if it is forged.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <random>

#include "base/checkpoint_file.h"
#include "base/file_text.h"
#include "base/temporary_folder.h"
#include "support/picture.h"
#include "support/scene_text.h"

namespace oriel {
namespace session_state_test {

using testing::Probe;
using testing::SceneText;

/// A lit box with an exposed picture, a filter with negative lobes, light groups and mattes.
SceneText room(const std::string& method) {
  SceneText scene(
      "trace depth 4 4 8 shadow segments caustic on filter mitchell 4 4 "
      "\"light group key\" \"lamp*\" samples 0 3 contrast .1 .1 .1 .1 finalgather accuracy 16 "
      "photon trace depth 4 4 8");
  scene.method(method);
  scene.lambert("white", 0.6f).emitter("glow", 3);
  scene.box("white", Vec3(-2), Vec3(2), true);
  scene.square("glow", Vec3(0, 1.9f, -1), 0.3f, Vec3(0, -1, 0));
  scene.light("lamp",
              "\"mib_light_point\" (\"color\" 5 5 5) origin 0 1 0 energy 9 9 9 "
              "globillum photons 500 caustic photons 50");
  scene.camera("focal 1 aperture 1 aspect 1 resolution 12 10");
  return scene;
}

SessionSettings settings_of(std::size_t instances) {
  SessionSettings settings;
  settings.budget.samples = 16;
  settings.outputs = true;
  settings.surface_values.set();
  const std::vector<std::string> names(instances, "n");
  settings.mattes = MatteNames{names, names, std::vector<std::uint32_t>(instances, 0)};
  return settings;
}

class SessionState : public ::testing::Test {
 protected:
  explicit SessionState() = default;
  std::string path() const { return folder_.file("a.checkpoint"); }

  void save(RenderSession& session, const std::string& name = "a.checkpoint") const {
    CheckpointWriter out(folder_.file(name), {});
    session.save(out);
    out.commit();
  }
  std::string content(const std::string& name = "a.checkpoint") const {
    return file_text(folder_.file(name));
  }

  /// The file with a checksum that fits its content.
  void write_with_checksum(std::string bytes) const {
    constexpr std::size_t kHeader = 40, kSummed = 32;
    Checksum64 sum;
    sum.add(std::string_view(bytes).substr(kHeader));
    sum.add(std::string_view(bytes).substr(0, kSummed));
    const std::uint64_t value = sum.value();
    std::memcpy(bytes.data() + kSummed, &value, sizeof value);
    std::ofstream(path(), std::ios::binary) << bytes;
  }

 private:
  TemporaryFolder folder_;
};

// A session that is stopped after a third of its samples and saved, and another that goes on from
// the file, have the state of one that was never stopped: its file has the same bytes, except for
// the time.
TEST_F(SessionState, RoundTripIsExact) {
  for (const char* method : {"path", "fg", "photons", "fg+photons"}) {
    const Probe probe(room(method));
    SessionSettings settings = settings_of(probe.world().instances.size());
    RenderSession whole(probe.world(), settings), first(probe.world(), settings),
        second(probe.world(), settings);
    whole.run();
    std::atomic<bool> cancel{false};
    Progressive::Callbacks stop;
    stop.pass = [&](const Progress& p) { cancel = p.mean_samples >= 4; };
    EXPECT_EQ(first.run(stop, &cancel), StopReason::Cancelled);
    ASSERT_TRUE(first.can_save());
    save(first);
    CheckpointReader in(path());
    second.restore(in);
    EXPECT_GT(second.film().light_layers(), 0u);
    EXPECT_EQ(second.integrator().gather_points() > 10, std::string_view(method).starts_with("fg"));
    EXPECT_EQ(second.film().mean_samples(), first.film().mean_samples());
    save(second, "again");
    second.run();
    EXPECT_EQ(second.rays().rays(), whole.rays().rays()) << method;
    EXPECT_EQ(second.progress().pass, whole.progress().pass);
    save(second, "second");
    save(whole, "whole");
    std::string a = content("second"), b = content("whole");
    ASSERT_EQ(a.size(), b.size());
    // The elapsed time, before two times seven numbers of rays; and the checksum.
    const std::size_t time = a.size() - 2 * 7 * 8 - 8;
    for (std::string* bytes : {&a, &b}) {
      bytes->replace(time, 8, 8, '\0');
      bytes->replace(32, 8, 8, '\0');
    }
    EXPECT_TRUE(a == b) << method;
  }
}

// Stopped in the middle of a pass that leaves out pixels. The film does not contain which ones.
TEST_F(SessionState, AdaptivePassesContinue) {
  SceneText scene = room("path");
  scene.camera("focal 1 aperture 1 aspect 1 resolution 40 40");
  const Probe probe(scene);
  const SessionSettings settings;  // with the noise target of the scene for every pixel
  RenderSession whole(probe.world(), settings), first(probe.world(), settings),
      second(probe.world(), settings);
  whole.run();
  std::atomic<bool> cancel{false}, is_partial{false};
  std::atomic<int> rows{0};
  Progressive::Callbacks callbacks;
  callbacks.pass = [&](const Progress& p) { is_partial = p.mean_samples >= 16 && p.active < 0.9; };
  callbacks.wants_pause = [&] {
    if (is_partial && ++rows > 40) cancel = true;
    return false;
  };
  ASSERT_EQ(first.run(callbacks, &cancel), StopReason::Cancelled);
  EXPECT_LT(first.film().mean_samples(), whole.film().mean_samples());
  save(first);
  CheckpointReader in(path());
  second.restore(in);
  EXPECT_EQ(second.run(), StopReason::Noise);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      ASSERT_EQ(second.film().samples(x, y), whole.film().samples(x, y)) << x << ' ' << y;
      ASSERT_EQ(second.film().pixel(x, y).beauty, whole.film().pixel(x, y).beauty);
    }
}

// The last sample of a pass is the 64th since the last test for a pause.
TEST_F(SessionState, APauseAtTheEndOfAPassCountsIt) {
  const Probe probe(room("path"));
  SessionSettings settings = settings_of(probe.world().instances.size());
  settings.budget.samples = 64;
  RenderSession whole(probe.world(), settings), first(probe.world(), settings),
      second(probe.world(), settings);
  whole.run();
  int pauses = 0;
  Progressive::Callbacks callbacks;
  callbacks.wants_pause = [&] { return pauses == 0 && first.film().mean_samples() == 32; };
  callbacks.paused = [&] {
    ++pauses;
    save(first);
  };
  first.run(callbacks);
  ASSERT_EQ(pauses, 1);
  EXPECT_EQ(first.progress().pass, whole.progress().pass);
  CheckpointReader in(path());
  second.restore(in);
  second.run();
  EXPECT_EQ(second.progress().pass, whole.progress().pass);
}

TEST_F(SessionState, OtherSizesAreRefused) {
  const Probe probe(room("path"));
  const std::size_t instances = probe.world().instances.size();
  SessionSettings settings = settings_of(instances);
  RenderSession session(probe.world(), settings);
  session.run();
  save(session);
  const auto is_refused = [&](const SessionSettings& other) {
    RenderSession refusing(probe.world(), other);
    CheckpointReader in(path());
    EXPECT_THROW(refusing.restore(in), CheckpointError);
  };
  SessionSettings other = settings;
  other.crop = Window{0, 0, 12, 9};
  is_refused(other);
  other = settings;
  other.outputs = false;
  is_refused(other);
  other = settings;
  other.mattes.reset();
  is_refused(other);
  other = settings;
  other.budget.samples = 8;
  is_refused(other);
}

// What a hostile file can contain: any byte is changed, with a checksum that fits.
TEST_F(SessionState, ForgedStatesDoNotCrash) {
  std::mt19937 random(4);
  int refused = 0, accepted = 0;
  for (const char* method : {"path", "fg+photons"}) {
    const Probe probe(room(method));
    const SessionSettings settings = settings_of(probe.world().instances.size());
    RenderSession session(probe.world(), settings);
    std::atomic<bool> cancel{false};
    Progressive::Callbacks stop;
    stop.pass = [&](const Progress& p) { cancel = p.mean_samples >= 4; };
    session.run(stop, &cancel);
    save(session);
    const std::string whole = content();
    for (int i = 0; i < 400; ++i) {
      std::string forged = whole;
      for (int k = 0; k < 1 + i % 3; ++k) {
        // A random byte, or in turn one of all bytes of the header and of the body's first sizes.
        const std::size_t at = i % 2 ? random() % forged.size() : std::size_t(i + k) % 200;
        forged[at] = static_cast<char>(random());
      }
      write_with_checksum(forged);
      try {
        CheckpointReader in(path());
        RenderSession other(probe.world(), settings);
        other.restore(in);
        ++accepted;
        if (accepted % 10 == 0) other.run();
      } catch (const CheckpointError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(accepted, 10) << "some changes are values like any other";
}

}  // namespace session_state_test
}  // namespace oriel
