// SPDX-License-Identifier: Apache-2.0
// What paths learn before a picture, in files: restored exactly without tracing it again, and
// harmless if it is forged.
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
namespace learned_state_test {

using testing::Probe;
using testing::SceneText;

/// A room with patches of sun, interpolated reflections, and lamps behind a wall: paths learn where
/// light comes from and which lamps matter. Its picture has more than 2^20 paths.
SceneText sunny_room() {
  SceneText scene("trace depth 4 4 8 shadow segments \"indirect\" \"path\"");
  scene.lambert("white", .5f)
      .material(
          "floor",
          "\"diffuse\" .4 .4 .4, \"reflectivity\" .6, \"refl_gloss\" .6, \"refl_interpolate\" on");
  scene.polygon("floor", {Vec3(-2, -2, 0), Vec3(2, -2, 0), Vec3(2, 2, 0), Vec3(-2, 2, 0)});
  scene.polygon("white", {Vec3(-2, -2, 3), Vec3(2, -2, 3), Vec3(2, 2, 3), Vec3(-2, 2, 3)});
  scene.polygon("white", {Vec3(-2, -2, 0), Vec3(-2, 2, 0), Vec3(-2, 2, 3), Vec3(-2, -2, 3)});
  scene.polygon("white", {Vec3(-2, -2, 0), Vec3(2, -2, 0), Vec3(2, -2, 3), Vec3(-2, -2, 3)});
  scene.polygon("white", {Vec3(-2, 2, 0), Vec3(2, 2, 0), Vec3(2, 2, 3), Vec3(-2, 2, 3)});
  const auto board = [&](float y0, float z0, float y1, float z1) {
    scene.polygon("white", {Vec3(2, y0, z0), Vec3(2, y1, z0), Vec3(2, y1, z1), Vec3(2, y0, z1)});
  };
  board(-2, 0, 2, 1);
  board(-2, 2, 2, 3);
  board(-2, 1, -.5f, 2);
  board(.5f, 1, 2, 2);
  scene.light("sun",
              "\"mib_light_infinite\" ( \"color\" 4 4 4, \"shadow\" on ) direction -1 .2 -1.2");
  scene.box("white", Vec3(-2, 2.1f, 0), Vec3(2, 3, 3), true);
  for (int i = 0; i < 12; ++i)
    scene.light(fmt::format("lamp{}", i),
                fmt::format("\"physical_light\" ( \"color\" 30 30 30 ) origin {} {} 2",
                            i == 0 ? 0 : .3f * static_cast<float>(i - 6), i == 0 ? 0 : 2.5f));
  return scene.camera("focal 1 aperture 1.6 aspect 1.5 resolution 120 80",
                      "transform 0 0 -1 0 -1 0 0 0 0 1 0 0 0 -1.5 -1.9 1");
}

SessionSettings settings() { return {.budget = {.samples = 128}, .crop = Window{56, 30, 64, 34}}; }

class LearnedState : public ::testing::Test {
 protected:
  LearnedState() : probe_(sunny_room()), first_(probe_.world(), settings()) {
    first_.prepare();
    save(first_, "maps");
  }
  std::string path(const std::string& name) const { return folder_.file(name); }
  void save(RenderSession& session, const std::string& name) const {
    CheckpointWriter out(path(name), {});
    session.save_maps(out);
    out.commit();
  }

  TemporaryFolder folder_;
  const Probe probe_;
  RenderSession first_;
};

TEST_F(LearnedState, IsRestoredExactly) {
  ASSERT_GT(first_.learned_bytes(), 10000u) << "nothing was learned";
  ASSERT_TRUE(first_.has_unknown_light()) << "there is no grid of reflections";
  RenderSession second(probe_.world(), settings());
  CheckpointReader in(path("maps"));
  second.read_maps(in);
  EXPECT_EQ(second.learned_bytes(), first_.learned_bytes());
  EXPECT_EQ(second.rays().rays(), first_.rays().rays()) << "rays were traced again";
  save(second, "again");
  EXPECT_TRUE(file_text(path("again")) == file_text(path("maps")));
  first_.run();
  second.run();
  EXPECT_EQ(second.rays().rays(), first_.rays().rays());
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x)
      ASSERT_EQ(second.film().pixel(x, y).beauty, first_.film().pixel(x, y).beauty)
          << x << ' ' << y;
}

// What a hostile file can contain: bytes are changed, with a checksum that fits.
TEST_F(LearnedState, ForgedOnesDoNotCrash) {
  const std::string whole = file_text(path("maps"));
  std::mt19937 random(5);
  int refused = 0, accepted = 0;
  for (int i = 0; i < 200; ++i) {
    std::string forged = whole;
    for (int k = 0; k < 1 + i % 3; ++k)
      forged[40 + random() % (forged.size() - 40)] = static_cast<char>(random());
    constexpr std::size_t kHeader = 40, kSummed = 32;
    Checksum64 sum;
    sum.add(std::string_view(forged).substr(kHeader));
    sum.add(std::string_view(forged).substr(0, kSummed));
    const std::uint64_t value = sum.value();
    std::memcpy(forged.data() + kSummed, &value, sizeof value);
    std::ofstream(path("forged"), std::ios::binary) << forged;
    RenderSession other(probe_.world(), settings());
    try {
      CheckpointReader in(path("forged"));
      other.read_maps(in);
    } catch (const CheckpointError&) {
      ++refused;
      continue;
    }
    if (++accepted % 20 == 0) other.run();
  }
  EXPECT_GT(refused, 10);
  EXPECT_GT(accepted, 10) << "some changes are values like any other";
}

}  // namespace learned_state_test
}  // namespace oriel
