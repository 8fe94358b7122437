// SPDX-License-Identifier: Apache-2.0
// Frames of one file: each equals, to the last bit, a file that describes its state from scratch,
// and keeps the meshes that did not change.
#include "mi/reader.h"
#include "output/output.h"
#include "support/probe.h"

namespace oriel::testing {
namespace animation_test {

/// The elements of a small scene as texts, so that a file may say them differently from scratch.
struct Parts {
  std::string options =
      "options \"opt\" object space trace depth 4 4 8 \"indirect\" \"path\" {} "
      "end options\n";
  std::string more_options;
  std::string camera = "camera \"cam\" focal 1 aperture 1 aspect 1 resolution 24 24 end camera\n";
  std::string camera_place;
  std::string lamp = "\"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 1 2 -2";
  std::string lamp_place;
  std::string paint = "\"mib_illum_lambert\" ( \"diffuse\" .8 .4 .2 )";
  std::string material = "= \"paint\"";
  std::string block = box(.5f, 1);
  std::string block_place = "transform 1 0 0 0 0 1 0 0 0 0 1 0 .3 .2 3 1";
  std::string deletions;
  std::string more_instances;
  std::string group = "\"cam_i\" \"lamp_i\" \"floor_i\" \"block_i\"";

  static std::string box(float size, float high) {
    return fmt::format(
        "visible shadow trace group\n"
        "-{0} -{0} 0  {0} -{0} 0  {0} {1} 0  -{0} {1} 0  -{0} -{0} -1  {0} -{0} -1  0 {1} -.5\n"
        "v 0 v 1 v 2 v 3 v 4 v 5 v 6\n"
        "p 0 1 2 3  p 1 0 4 5  p 4 6 5\nend group",
        size, high);
  }

  std::string str() const {
    return fmt::format(fmt::runtime(options), more_options) + camera +
           "instance \"cam_i\" \"cam\" " + camera_place + " end instance\n" + "light \"lamp\" " +
           lamp + " end light\n" + "instance \"lamp_i\" \"lamp\" " + lamp_place +
           " end instance\n" + "shader \"paint\" " + paint + "\nmaterial \"mat\" " + material +
           " end material\n"
           "material \"grey\" \"mib_illum_lambert\" ( \"diffuse\" .5 .5 .5 ) end material\n"
           "object \"floor\" visible shadow trace group\n"
           "-4 -1 -9  4 -1 -9  4 -1 0  -4 -1 0  v 0 v 1 v 2 v 3  p 3 2 1 0 end group end object\n"
           "instance \"floor_i\" \"floor\" material \"grey\" end instance\n"
           "object \"block\" " +
           block + " end object\n" + "instance \"block_i\" \"block\" material \"mat\" " +
           block_place + " end instance\n" + deletions + more_instances + "instgroup \"root\" " +
           group + " end instgroup\n" + "render \"root\" \"cam_i\" \"opt\"\n";
  }
};

struct Rendered {
  std::vector<float> pixels;
  std::size_t reused = 0;
};

/// All frames of a file, as the program renders them.
std::vector<Rendered> frames(const std::string& text) {
  Diagnostics diagnostics;
  mi::ReadOptions options;
  options.packages = builtin_packages();
  options.knows_shader = [](std::string_view n) { return builtin_shaders().find(n) != nullptr; };
  mi::Reader reader = mi::Reader::from_text(text, options, diagnostics);
  scene::Scene scene;
  GeometryCache cache;
  std::vector<Rendered> out;
  while (reader.next_frame(scene)) {
    PrepareReport report;
    PrepareOptions prepare_options;
    prepare_options.cache = &cache;
    const auto world = prepare(scene, scene.renders.back(), builtin_shaders(), prepare_options,
                               diagnostics, report);
    if (!world) throw std::runtime_error("the scene cannot be rendered");
    RenderSession session(*world, {.budget = {.samples = 4}});
    session.run();
    out.push_back({film_layers(session, {}).front().image.pixels, cache.reused});
    cache.keep(*world);
  }
  for (const Diagnostic& d : diagnostics.all())
    if (d.severity != Severity::Note) ADD_FAILURE() << diagnostics.format(d);
  return out;
}

/// Frame 1, then `change`: frame 2 is as a file of `after` alone.
void expect_change(const std::string& change, const Parts& after, std::size_t reused = 2,
                   const Parts& before = {}) {
  const auto animated = frames(before.str() + change + "\nrender \"root\" \"cam_i\" \"opt\"\n");
  const auto scratch = frames(after.str());
  ASSERT_EQ(animated.size(), 2u) << change;
  ASSERT_EQ(scratch.size(), 1u) << change;
  EXPECT_NE(animated[0].pixels, animated[1].pixels) << change << ": nothing changed";
  EXPECT_EQ(animated[1].pixels, scratch[0].pixels) << change;
  EXPECT_EQ(animated[1].reused, reused) << change;
}

constexpr const char* kMoved = "transform 1 0 0 0 0 1 0 0 0 0 1 0 -.4 .1 2.5 1";

TEST(Animation, OptionsAndCameraChange) {
  Parts after;
  after.more_options = "shadow off";
  expect_change("incremental options \"opt\" shadow off end options", after);
  after = {};
  after.camera = "camera \"cam\" focal 1.5 aperture 1 aspect 1 resolution 24 24 end camera\n";
  expect_change("incremental camera \"cam\" focal 1.5 end camera", after);
  after = {};
  after.camera_place = "transform 1 0 0 0 0 1 0 0 0 0 1 0 .5 0 0 1";
  expect_change(
      "incremental instance \"cam_i\" transform 1 0 0 0 0 1 0 0 0 0 1 0 .5 0 0 1 "
      "end instance",
      after);
}

TEST(Animation, LightsAndShadersChange) {
  Parts after;
  after.lamp = "\"mib_light_point\" ( \"color\" 1 .5 .1, \"shadow\" on ) origin 0 2 -2";
  expect_change("incremental light \"lamp\" " + after.lamp + " end light", after);
  after = {};
  after.lamp_place = kMoved;
  expect_change(std::string("incremental instance \"lamp_i\" ") + kMoved + " end instance", after);
  after = {};
  after.paint = "\"mib_illum_lambert\" ( \"diffuse\" .1 .9 .2 )";
  expect_change("incremental shader \"paint\" " + after.paint, after);
  after = {};
  after.material = "\"mib_illum_lambert\" ( \"diffuse\" .1 .2 .9 )";
  expect_change("incremental material \"mat\" " + after.material + " end material", after);
}

TEST(Animation, ObjectsAndInstancesChange) {
  Parts after;
  after.block = Parts::box(.8f, 1.5f);
  expect_change("incremental object \"block\" " + after.block + " end object", after, 1);
  after = {};
  after.block_place = kMoved;
  // A mesh with a single instance is in world space and is rebuilt after a move.
  expect_change(std::string("incremental instance \"block_i\" ") + kMoved + " end instance", after);
  after = {};
  after.block_place += " hide on";
  expect_change("incremental instance \"block_i\" hide on end instance", after, 1);
  after = {};
  after.block_place += " material \"grey\"";
  expect_change("incremental instance \"block_i\" material \"grey\" end instance", after);
}

TEST(Animation, InstancesAppearAndDisappear) {
  Parts two;
  two.more_instances =
      std::string("instance \"second\" \"block\" material \"grey\" ") + kMoved + " end instance\n";
  two.group += " \"second\"";
  expect_change(
      two.more_instances + "incremental instgroup \"root\" " + two.group + " end instgroup", two);
  // And away again, by a group without it or by its own end.
  expect_change("incremental instgroup \"root\" " + Parts{}.group + " end instgroup", {}, 2, two);
  expect_change(
      "delete \"second\" incremental instgroup \"root\" " + Parts{}.group + " end instgroup", {}, 2,
      two);
  // The object with several instances moves.
  Parts moved = two;
  moved.block_place = "transform 1 0 0 0 0 1 0 0 0 0 1 0 .1 -.3 3 1";
  expect_change("incremental instance \"block_i\" " + moved.block_place + " end instance", moved, 2,
                two);
}

TEST(Animation, MotionChanges) {
  Parts before, after;
  before.block_place += " motion transform 1 0 0 0 0 1 0 0 0 0 1 0 -1 0 3 1";
  after = before;
  after.more_options = "shutter 1";
  expect_change("incremental options \"opt\" shutter 1 end options", after, 0, before);
  // Another shutter within the same interval keeps what moves.
  before.more_options = "shutter .5";
  expect_change("incremental options \"opt\" shutter 1 end options", after, 2, before);
  before.more_options = after.more_options = "shutter 1";
  after.block_place = std::string(kMoved) + " motion transform";
  expect_change(
      std::string("incremental instance \"block_i\" ") + after.block_place + " end instance", after,
      2, before);
}

TEST(Animation, TouchRebuildsAnObjectWithTheSameImage) {
  const auto twice = frames(Parts{}.str() + "touch \"block\" render \"root\" \"cam_i\" \"opt\"\n" +
                            "render \"root\" \"cam_i\" \"opt\"\n");
  ASSERT_EQ(twice.size(), 3u);
  EXPECT_EQ(twice[0].reused, 0u);
  EXPECT_EQ(twice[1].reused, 1u);
  EXPECT_EQ(twice[2].reused, 2u);
  EXPECT_EQ(twice[0].pixels, twice[1].pixels);
  EXPECT_EQ(twice[0].pixels, twice[2].pixels);
}

TEST(Animation, ManyFramesEndWhereOneWouldHaveBegun) {
  std::string text = Parts{}.str();
  for (int i = 0; i < 12; ++i)
    text += fmt::format(
        "incremental instance \"block_i\" transform 1 0 0 0 0 1 0 0 0 0 1 0 {} .2 3 1 end instance "
        "render \"root\" \"cam_i\" \"opt\"\n",
        i == 11 ? .3 : .1 * i);
  const auto all = frames(text);
  EXPECT_EQ(all.back().pixels, all.front().pixels);
}

}  // namespace animation_test
}  // namespace oriel::testing
