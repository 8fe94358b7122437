// SPDX-License-Identifier: Apache-2.0
// After any sequence of edits the picture is that of a scene that was read afresh: nothing of a
// former edit stays in what was not prepared again.
#include <map>
#include <random>

#include "interactive/loop_support.h"

namespace oriel::interactive {
namespace {

using std::vector;

/// A room with a window to the sky, a sun, a lamp with an area, a glowing and a glass pane, a light
/// on an object, textures and an exposure.
std::string full_scene() {
  return R"(options "opt" samples 0 1 trace depth 3 3 4 "indirect" "path" end options
light "sun" "mia_physicalsun" ("samples" 4) direction .3 .8 -.5 end light
instance "sun_inst" "sun" end instance
shader "sky" "mia_physicalsky" ("sun" "sun_inst")
shader "tone" "mib_blackbody" ("temperature" 4000, "intensity" 1)
light "lamp" "mib_light_point" ("color" = "tone") origin 0 0 2.5
  rectangle .4 0 0 0 .4 0 2 2 end light
instance "lamp_inst" "lamp" end instance
light "strip" "mib_light_point" ("color" 4 3 2) origin 0 0 0 object "pane_inst" end light
instance "strip_inst" "strip" end instance
color texture "spots" "spots.ppm"
shader "spots_map" "mib_texture_lookup" ("tex" "spots", "coord" = "spots_coord")
shader "spots_coord" "mib_texture_vector" ("select" -1, "selspace" 1)
material "wall_mtl" "mia_material_x" ("diffuse" .7 .7 .6, "reflectivity" 0) end material
material "box_mtl" "mia_material_x" ("diffuse" = "spots_map", "reflectivity" .3)
  shadow "mia_material_x" () end material
shader "glass" "mia_material_x" ("diffuse" .2 .2 .2, "transparency" .6, "reflectivity" .1)
material "glass_mtl" "mia_material_x" ("diffuse" .3 .5 .3, "transparency" 0., "reflectivity" .1)
  shadow "mia_material_x" () end material
object "room" visible shadow trace tag 1 group
  -2 -3 0  2 -3 0  2 3 0  -2 3 0  -2 -3 3  2 -3 3  2 3 3  -2 3 3
  -1 -3 1  1 -3 1  1 -3 2  -1 -3 2
  v 0 v 1 v 2 v 3 v 4 v 5 v 6 v 7 v 8 v 9 v 10 v 11
  p "wall_mtl" 0 1 2 3  p 4 7 6 5  p 1 2 6 5  p 0 4 7 3  p 2 3 7 6
  p 0 1 9 8  p 1 5 10 9  p 5 4 11 10  p 4 0 8 11
end group end object
object "box" visible shadow trace tag 2 group
  -.5 -.5 1  .5 -.5 1  .5 .5 1  -.5 .5 1  v 0 v 1 v 2 v 3  p "box_mtl" 0 1 2 3
end group end object
object "pane" visible shadow trace tag 3 group
  -1 1 .5  1 1 .5  1 1 2  -1 1 2  v 0 v 1 v 2 v 3  p "glass_mtl" 0 1 2 3
end group end object
instance "room_inst" "room" end instance
instance "box_inst" "box" end instance
instance "box_too" "box" transform 1 0 0 0 0 1 0 0 0 0 1 0 -1.2 -.8 0 1 end instance
instance "pane_inst" "pane" end instance
instgroup "furniture" "box_inst" "lamp_inst" end instgroup
instance "furniture_inst" "furniture" end instance
camera "cam" output "rgba" "exr" "out.exr" focal 20 aperture 36 aspect 1.5 resolution 48 32
  lens "mia_exposure_photographic" ("film_iso" 100, "camera_shutter" 60)
  environment = "sky" end camera
instance "cam_inst" "cam"
  transform 1 0 0 0  0 0 -1 0  0 1 0 0  0 -1.5 -2.5 1
end instance
instgroup "root" "sun_inst" "strip_inst" "room_inst" "furniture_inst" "box_too" "pane_inst"
  "cam_inst" end instgroup
render "root" "cam_inst" "opt"
)";
}

/// Values for each parameter that a step of the sequence may set.
const vector<vector<std::string>> kValues = {
    {"box_mtl.refl_gloss=", ".3", ".8"},
    {"wall_mtl.diffuse=", ".3 .7 .3", ".8 .4 .3"},
    {"wall_mtl.additional_color=", "1 .5 .2", "0 0 0"},
    {"glass_mtl.transparency=", ".5", ".9", "0"},
    {"glass_mtl.additional_color=", "3 2 1", "0 0 0"},
    {"tone.temperature=", "2500", "9000"},
    {"lamp.origin=", "1 0 2.2", "-1 1 2"},
    {"strip.color=", "1 9 2", "0 0 0"},
    {"sun.direction=", "-.2 .8 -.7", ".1 .6 -.4"},
    {"sun.haze=", "3", "0"},
    {"sky.haze=", "5", "1"},
    {"sky.on=", "off", "on"},
    {"sun_inst.transform=", "0 1 0 0 -1 0 0 0 0 0 1 0 0 0 0 1", "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"},
    {"box_too.transform=", "1 0 0 0 0 1 0 0 0 0 1 0 .7 0 .2 1", "1 0 0 0 0 1 0 0 0 0 1 0 0 2 0 1"},
    {"furniture_inst.transform=", "1 0 0 0 0 1 0 0 0 0 1 0 .3 .2 .2 1",
     "1 0 0 0 0 1 0 0 0 0 1 0 0 -.4 0 1"},
    {"pane_inst.transform=", "1 0 0 0 0 1 0 0 0 0 1 0 0 -.7 0 1"},
    {"pane_inst.visible=", "off", "on"},
    {"box_inst.shadow=", "off", "on"},
    {"spots.file=", "stripes.ppm", "spots.ppm"},
    {"cam.film_iso=", "400"},
    {"cam.focal=", "28"},
    {"opt.trace depth=", "1 1 2"},
};

bool prepares_everything(const std::string& target) { return target.starts_with("opt."); }

class FullScene : public LoopTest {
 protected:
  void SetUp() override {
    write("scene.mi", full_scene());
    write("spots.ppm", "P3\n2 2\n255\n200 20 20  20 200 20  20 20 200  200 200 20\n");
    write("stripes.ppm", "P3\n2 1\n255\n250 250 250  10 10 10\n");
  }
};

/// Radiance and the picture that the lens shaders make of it.
vector<float> pictures(const RenderLoop& loop) {
  vector<float> values = beauty(loop);
  const Film& film = loop.session()->film();
  for (int y = 0; y < film.height(); ++y)
    for (int x = 0; x < film.width(); ++x) {
      const Rgb c = film.shown(x, y);
      values.insert(values.end(), {c.x, c.y, c.z});
    }
  return values;
}

class EditSequence : public FullScene, public ::testing::WithParamInterface<unsigned> {};

std::string messages_of(const RenderLoop& loop) {
  std::string text;
  for (const Diagnostic& d : loop.diagnostics().all()) text += "\n" + d.message;
  return text;
}

TEST_P(EditSequence, EveryPictureIsThatOfAFreshScene) {
  std::mt19937 random(GetParam());
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  ViewSettings view = small_view();
  view.budget.samples = 2;
  LoopSettings settings;
  settings.first_divider = 1;
  RenderLoop live(source(), settings, {});
  live.set_view(view);
  ASSERT_TRUE(live.read());
  finish(live);
  std::map<std::size_t, std::string> edits;
  std::size_t changes = 0;
  vector<float> before = pictures(live);
  std::string history;
  constexpr int kSteps = 15;
  for (int step = 0; step < kSteps; ++step) {
    const std::size_t at = below(kValues.size());
    if (edits.contains(at) && below(3) == 0)
      edits.erase(at);
    else
      edits[at] = kValues[at][0] + kValues[at][1 + below(kValues[at].size() - 1)];
    vector<std::string> list;
    for (const auto& edit : edits) list.push_back(edit.second);
    history += "\n" + (edits.contains(at) ? edits[at] : "without " + kValues[at][0]);
    const std::size_t preparations = live.scene().preparations();
    live.set_edits(list);
    finish(live);
    EXPECT_EQ(live.scene().preparations() - preparations, prepares_everything(kValues[at][0]))
        << "after" << history << messages_of(live);
    RenderLoop fresh(source(), settings, {});
    fresh.set_view(view);
    ASSERT_TRUE(fresh.read());
    fresh.set_edits(list);
    finish(fresh);
    const vector<float> picture = pictures(live);
    ASSERT_EQ(picture == pictures(fresh), true) << "after" << history;
    changes += picture != before;
    before = picture;
  }
  EXPECT_GE(changes, kSteps / 2u) << "most edits have no effect, so the test shows little";
}

INSTANTIATE_TEST_SUITE_P(Random, EditSequence, ::testing::Range(0u, 3u));

/// Reduced pictures do not wait for the tables of the environment and the search for openings.
TEST_F(FullScene, TheLightSamplerIsADraftUntilTheFullPicture) {
  RenderLoop live(source(), {}, {});
  live.set_view(small_view());
  ASSERT_TRUE(live.read());
  finish(live);
  const World& world = *live.scene().world();
  const auto drafts = [&] { return std::pair(world.draft_environment, world.draft_openings); };
  const std::map<std::string, std::pair<bool, bool>> expected = {
      {"box_mtl.refl_gloss=.3", {false, false}},
      {"sky.haze=5", {true, false}},
      {"box_too.transform=1 0 0 0 0 1 0 0 0 0 1 0 .7 0 .2 1", {false, true}},
      {"cam.focal=28", {true, true}}};
  for (const auto& [edit, draft] : expected) {
    live.set_edits({edit});
    ASSERT_TRUE(live.prepare());
    EXPECT_EQ(drafts(), draft) << edit;
    finish(live);
    EXPECT_EQ(drafts(), std::pair(false, false)) << edit;
    live.set_edits({});
    ASSERT_TRUE(live.prepare_completely());
    EXPECT_EQ(drafts(), std::pair(false, false)) << edit;
  }
}

/// Each edit alone and taken back, and what it prepares.
TEST_F(FullScene, EachEditPreparesItsDependentsOnly) {
  LoopSettings settings;
  settings.first_divider = 1;
  ViewSettings view = small_view();
  view.budget.samples = 2;
  const auto opened = [&] {
    auto loop = std::make_unique<RenderLoop>(source(), settings, RenderLoop::Show());
    loop->set_view(view);
    EXPECT_TRUE(loop->read());
    return loop;
  };
  const auto kept = opened();
  RenderLoop& live = *kept;
  finish(live);
  const vector<float> first = pictures(live);
  for (const vector<std::string>& values : kValues) {
    const std::string edit = values[0] + values[1];
    const std::size_t before = live.scene().preparations();
    live.set_edits({edit});
    finish(live);
    EXPECT_EQ(live.scene().preparations() - before, prepares_everything(values[0]) ? 1u : 0u)
        << edit;
    EXPECT_NE(pictures(live), first) << edit << " has no effect";
    const auto fresh = opened();
    fresh->set_edits({edit});
    finish(*fresh);
    EXPECT_EQ(pictures(live), pictures(*fresh)) << edit;
    live.set_edits({});
    finish(live);
    EXPECT_EQ(pictures(live), first) << edit << " taken back";
  }
}

}  // namespace
}  // namespace oriel::interactive
