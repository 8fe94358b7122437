// SPDX-License-Identifier: Apache-2.0
// After each kind of edit, undo and redo the picture is that of a scene that was read afresh.
#include "interactive/edit_effects.h"

#include <chrono>
#include <thread>

#include "interactive/loop_support.h"
#include "mi/reader.h"
#include "prepare/prepare.h"

namespace oriel::interactive {
namespace {

struct EditCase {
  const char* name;
  const char* edit;
  EffectBits effect;
  bool changes = true;  ///< the picture
};

/// The editable scene with a wall whose shader has a name, and a shader of a light and a material.
class EditTableScene : public LoopTest {
 protected:
  void SetUp() override {
    std::string scene = editable_scene();
    const auto insert = [&](const std::string& before, const std::string& text) {
      scene.insert(scene.find(before), text);
    };
    insert(
        "light \"lamp\"",
        "shader \"tone\" \"mib_blackbody\" ( \"temperature\" 4000, \"intensity\" 1 )\n"
        "light \"second\" \"mib_light_point\" ( \"color\" = \"tone\" ) origin 1 -2 2 end light\n"
        "instance \"second_inst\" \"second\" end instance\n"
        "shader \"paint\" \"mia_material_x\" ( \"diffuse\" .6 .2 .2, \"reflectivity\" 0 )\n"
        "material \"side_mtl\" = \"paint\" end material\n"
        "shader \"coat.001\" \"mia_material_x\" ( \"diffuse\" .5 .5 .2, \"reflectivity\" 0 )\n"
        "material \"coat_mtl\" = \"coat.001\" end material\n"
        "material \"toned_mtl\" \"mib_illum_lambert\" ( \"diffuse\" = \"tone\" ) end material\n");
    insert("camera \"cam\"",
           "object \"side\" visible shadow trace group 1 -1 0 1 1 0 1 1 2 1 -1 2 v 0 v 1 v 2 v 3 "
           "p \"side_mtl\" 0 1 2 3 end group end object\n"
           "object \"step\" visible shadow trace group -1 0 .5 0 0 .5 0 1 .5 -1 1 .5 v 0 v 1 v 2 "
           "v 3 p \"toned_mtl\" 0 1 2 3 end group end object\n"
           "object \"lid\" visible shadow trace group .2 -1 .5 1 -1 .5 1 0 .5 .2 0 .5 v 0 v 1 v 2 "
           "v 3 p \"coat_mtl\" 0 1 2 3 end group end object\n"
           "instance \"lid_inst\" \"lid\" end instance\n"
           "instance \"side_inst\" \"side\" end instance\n"
           "instance \"step_inst\" \"step\" end instance\n");
    insert("\"cam_inst\" end instgroup",
           "\"second_inst\" \"side_inst\" \"step_inst\" \"lid_inst\" ");
    write("scene.mi", scene);
  }
};

class EditTable : public EditTableScene, public ::testing::WithParamInterface<EditCase> {};

using std::vector;

TEST_P(EditTable, PictureEqualsAFreshScene) {
  const EditCase& c = GetParam();
  RenderLoop live(source(), {}, {});
  live.set_view(small_view());
  ASSERT_TRUE(live.read());
  finish(live);
  const vector<float> before = beauty(live);
  ASSERT_FALSE(before.empty());
  live.set_edits({c.edit});
  finish(live);
  const vector<float> edited = beauty(live);

  RenderLoop fresh(source(), {}, {});
  fresh.set_view(small_view());
  ASSERT_TRUE(fresh.read());
  fresh.set_edits({c.edit});
  finish(fresh);
  EXPECT_EQ(edited, beauty(fresh));
  EXPECT_EQ(edited != before, c.changes) << "the edit has no effect, so the test shows nothing";

  live.set_edits({});
  finish(live);
  EXPECT_EQ(beauty(live), before) << "undo";
  live.set_edits({c.edit});
  finish(live);
  EXPECT_EQ(beauty(live), edited) << "redo";
}

TEST_P(EditTable, EffectsAreThoseOfTheTable) {
  RenderLoop loop(source(), {}, {});
  ASSERT_TRUE(loop.read());
  EditedScene& scene = loop.scene().edited();
  EXPECT_EQ(scene.set({GetParam().edit}).bits, GetParam().effect);
}

INSTANTIATE_TEST_SUITE_P(
    All, EditTable,
    ::testing::Values(
        EditCase{"Colour", "floor_mtl.diffuse=.1 .6 .2", kEffectElements},
        EditCase{"Gloss", "floor_mtl.refl_gloss=.4", kEffectElements},
        EditCase{"Emission", "box_mtl.ambience=1 1 1", kEffectElements, false},
        EditCase{"CutOut", "floor_mtl.cutout_opacity=.5", kEffectElements},
        EditCase{"NamedShader", "paint.diffuse=.1 .1 .9", kEffectElements},
        EditCase{"SharedShader", "tone.temperature=2000", kEffectElements},
        EditCase{"DottedName", "coat.001.diffuse=.1 .9 .1", kEffectElements},
        EditCase{"Glow", "floor_mtl.additional_color=.3 .2 .1", kEffectElements},
        EditCase{"Glass", "paint.transparency=.7", kEffectElements},
        EditCase{"LightColour", "lamp.color=1 40 3", kEffectElements},
        EditCase{"LightOrigin", "lamp.origin=1 0 2", kEffectElements},
        EditCase{"Focal", "cam.focal=50", kEffectCamera},
        EditCase{"Resolution", "cam.resolution=32 32", kEffectCamera},
        EditCase{"CameraTransform",
                 "cam_inst.transform=1 0 0 0 0 .4472136 -.8944272 0 0 .8944272 .4472136 0 .5 "
                 "-1.3416408 -4.9193496 1",
                 kEffectCamera},
        EditCase{"ObjectTransform", "wall_inst.transform=1 0 0 0 0 1 0 0 0 0 1 0 .5 0 0 1",
                 kEffectElements},
        EditCase{"ObjectVisible", "wall_inst.visible=off", kEffectElements},
        EditCase{"Depth", "opt.trace depth=0 0 0", kEffectWorld},
        EditCase{"Shadow", "opt.shadow=off", kEffectWorld}),
    [](const auto& info) { return info.param.name; });

class EditCosts : public EditTableScene {};

TEST_F(EditCosts, EditsOfElementsPrepareTheirDependentsOnly) {
  RenderLoop loop(source(), {}, {});
  loop.set_view(small_view());
  ASSERT_TRUE(loop.read());
  finish(loop);
  const auto preparations_of = [&](const char* edit) {
    const std::size_t before = loop.scene().preparations();
    loop.set_edits({edit});
    finish(loop);
    return loop.scene().preparations() - before;
  };
  EXPECT_EQ(preparations_of("floor_mtl.diffuse=.1 .6 .2"), 0u);
  EXPECT_EQ(preparations_of("floor_mtl.refl_gloss=.4"), 0u);
  EXPECT_EQ(preparations_of("paint.diffuse=.1 .1 .9"), 0u);
  EXPECT_EQ(preparations_of("tone.temperature=2000"), 0u) << "a light and a material use it";
  EXPECT_EQ(preparations_of("floor_mtl.additional_color=.3 .2 .1"), 0u) << "it becomes a light";
  EXPECT_EQ(preparations_of("paint.transparency=.7"), 0u) << "shadows pass it";
  EXPECT_EQ(preparations_of("lamp.color=1 40 3"), 0u);
  EXPECT_EQ(preparations_of("lamp.origin=1 0 2"), 0u);
  EXPECT_EQ(preparations_of("wall_inst.transform=1 0 0 0 0 1 0 0 0 0 1 0 .5 0 0 1"), 0u);
  EXPECT_EQ(preparations_of("wall_inst.visible=off"), 0u);
  EXPECT_EQ(preparations_of("opt.shadow=off"), 1u);
}

TEST_F(EditCosts, ColoursOfGlassPrepareNothingElse) {
  const vector<std::string> glass = {"paint.transparency=.7"};
  const vector<std::string> tinted = {"paint.transparency=.7", "paint.refr_color=.2 .9 .3"};
  RenderLoop live(source(), {}, {});
  live.set_view(small_view());
  ASSERT_TRUE(live.read());
  live.set_edits(glass);
  finish(live);
  const vector<float> clear = beauty(live);
  const std::size_t before = live.scene().preparations();
  live.set_edits(tinted);
  finish(live);
  EXPECT_EQ(live.scene().preparations(), before);
  RenderLoop fresh(source(), {}, {});
  fresh.set_view(small_view());
  ASSERT_TRUE(fresh.read());
  fresh.set_edits(tinted);
  finish(fresh);
  EXPECT_EQ(beauty(live), beauty(fresh));
  EXPECT_NE(beauty(live), clear);
}

TEST_F(EditCosts, TheLastOfTwoEditsOfOneParameterCounts) {
  // Both name the same parameter: the material refers to the shader.
  const vector<std::string> red = {"side_mtl.diffuse=.1 .9 .1", "paint.diffuse=.9 .1 .1"};
  const vector<std::string> green = {red[1], red[0]};
  RenderLoop live(source(), {}, {});
  live.set_view(small_view());
  ASSERT_TRUE(live.read());
  for (const auto& edits : {red, green}) {
    live.set_edits(edits);
    finish(live);
    RenderLoop fresh(source(), {}, {});
    fresh.set_view(small_view());
    ASSERT_TRUE(fresh.read());
    fresh.set_edits(edits);
    finish(fresh);
    EXPECT_EQ(beauty(live), beauty(fresh));
  }
}

TEST_F(EditCosts, ShadersThatAreBoundAgainDoNotPileUp) {
  RenderLoop loop(source(), {}, {});
  loop.set_view(small_view());
  ASSERT_TRUE(loop.read());
  ASSERT_TRUE(loop.prepare());
  const std::size_t first = loop.scene().world()->nodes.size();
  std::size_t most = 0;
  for (int i = 0; i < 3000; ++i) {
    loop.set_edits({"floor_mtl.diffuse=.1 .6 " + std::to_string(i % 100 / 100.0)});
    ASSERT_TRUE(loop.prepare());
    most = std::max(most, loop.scene().world()->nodes.size());
  }
  EXPECT_GT(most, 2 * first) << "nothing was bound again, so the test shows nothing";
  EXPECT_LE(most, 2 * first + 2010);
  EXPECT_LE(loop.scene().preparations(), 10u);
}

/// A room that the sky lights through a window, so that what the camera sees decides on openings.
std::string sky_scene() {
  return R"(options "opt" samples 0 1 trace depth 3 3 4 "indirect" "path" end options
light "sun" "mia_physicalsun" ("samples" 4) direction .3 .8 -.5 end light
instance "sun_inst" "sun" end instance
shader "sky" "mia_physicalsky" ("sun" "sun_inst")
material "wall_mtl" "mia_material_x" ("diffuse" .7 .7 .6, "reflectivity" 0) end material
material "box_mtl" "mia_material_x" ("diffuse" .2 .3 .7, "reflectivity" .3) end material
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
instance "room_inst" "room" end instance
instance "box_inst" "box" end instance
camera "cam" output "rgba" "exr" "out.exr" focal 20 aperture 36 aspect 1.5 resolution 48 32
  environment = "sky" end camera
instance "cam_inst" "cam"
  transform 1 0 0 0  0 0 -1 0  0 1 0 0  0 -1.5 -2.5 1
end instance
instgroup "root" "sun_inst" "room_inst" "box_inst" "cam_inst" end instgroup
render "root" "cam_inst" "opt"
)";
}

class SkyEditTable : public LoopTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override { write("scene.mi", sky_scene()); }
};

TEST_P(SkyEditTable, PictureEqualsAFreshScene) {
  RenderLoop live(source(), {}, {});
  live.set_view(small_view());
  ASSERT_TRUE(live.read());
  finish(live);
  const vector<float> before = beauty(live);
  live.set_edits({GetParam()});
  finish(live);
  RenderLoop fresh(source(), {}, {});
  fresh.set_view(small_view());
  ASSERT_TRUE(fresh.read());
  fresh.set_edits({GetParam()});
  finish(fresh);
  EXPECT_EQ(beauty(live), beauty(fresh));
  EXPECT_NE(beauty(live), before);
  live.set_edits({});
  finish(live);
  EXPECT_EQ(beauty(live), before) << "undo";
}

INSTANTIATE_TEST_SUITE_P(
    Sky, SkyEditTable,
    ::testing::Values("sun.direction=-.2 .8 -.7", "sun.haze=4", "sky.haze=4", "cam.focal=35",
                      "cam.aspect=1.2", "cam_inst.transform=1 0 0 0 0 0 -1 0 0 1 0 0 .4 -1.5 -1 1",
                      "box_inst.transform=1 0 0 0 0 1 0 0 0 0 1 0 .5 0 0 1",
                      "box_mtl.diffuse=.9 .1 .1", "box_mtl.additional_color=2 3 1",
                      "box_mtl.transparency=.5", "box_mtl.refl_gloss=.3",
                      "wall_mtl.diffuse=.3 .7 .3", "box_inst.visible=off",
                      "opt.trace depth=0 0 0"));

class RenderLoopTest : public LoopTest {};

/// The picture of a session without any of this.
vector<float> plain_picture(const SceneSource& source, const BudgetRequest& budget) {
  Diagnostics diagnostics;
  scene::Scene scene = mi::read_scene(source.path, source.read, diagnostics);
  PrepareReport report;
  const auto world =
      prepare(scene, scene.renders.back(), *source.registry, {}, diagnostics, report);
  SessionSettings settings;
  settings.budget = budget;
  RenderSession session(*world, settings);
  session.run();
  vector<float> values;
  for (int y = 0; y < session.film().height(); ++y)
    for (int x = 0; x < session.film().width(); ++x) {
      const Rgba c = session.film().pixel(x, y).beauty;
      values.insert(values.end(), {c.r, c.g, c.b, c.a});
    }
  return values;
}

TEST_F(RenderLoopTest, FinishedPictureIsThatOfAPlainSession) {
  LoopSettings settings;
  settings.least_long_side = 4;  // all reduced pictures come first
  int pictures = 0;
  RenderLoop loop(source(), settings, [&](const auto& picture) {
    ++pictures;
    EXPECT_EQ(picture->width, (48 + picture->divider - 1) / picture->divider);
  });
  loop.set_view(small_view());
  ASSERT_TRUE(loop.read());
  finish(loop);
  EXPECT_GE(pictures, 4);
  EXPECT_EQ(beauty(loop), plain_picture(source(), small_view().budget));
}

TEST_F(RenderLoopTest, InterruptionsDoNotChangeThePicture) {
  std::atomic<bool> stop = false;
  int calls = 0;
  RenderLoop loop(source(), {}, {}, [&] { stop = ++calls % 2 == 0; });
  loop.set_view(small_view());
  ASSERT_TRUE(loop.read());
  int runs = 0;
  while (!loop.run(stop)) {
    stop = false;
    ASSERT_LT(++runs, 1000);
  }
  EXPECT_GT(runs, 0);
  EXPECT_EQ(beauty(loop), plain_picture(source(), small_view().budget));
}

TEST_F(RenderLoopTest, InterruptedPreparationsDoNotChangeThePicture) {
  // The cache is computed before the picture.
  std::string cached = sky_scene();
  const std::string path = "\"path\"";
  cached.replace(cached.find(path), path.size(), "\"path+cache\"");
  write("sky.mi", cached);
  const vector<float> plain = plain_picture(source("sky.mi"), small_view().budget);
  LoopSettings settings;
  settings.first_divider = 1;
  RenderLoop loop(source("sky.mi"), settings, {});
  loop.set_view(small_view());
  ASSERT_TRUE(loop.read());
  // At different moments of the preparation.
  for (int milliseconds = 0; milliseconds < 40; milliseconds += 3) {
    loop.set_edits({});
    ASSERT_TRUE(loop.prepare());
    std::atomic<bool> stop = false;
    std::thread interruption([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
      stop = true;
    });
    loop.run(stop);
    interruption.join();
    finish(loop);
    EXPECT_EQ(beauty(loop), plain) << milliseconds;
  }
}

TEST_F(RenderLoopTest, BadEditsChangeNothing) {
  RenderLoop loop(source(), {}, {});
  loop.set_view(small_view());
  ASSERT_TRUE(loop.read());
  loop.set_edits({"floor_mtl.diffuse=.1 .6 .2"});
  finish(loop);
  const vector<float> edited = beauty(loop);
  EXPECT_THROW(loop.set_edits({"lamp.origin=1 0 2", "flor_mtl.diffuse=1"}), EditError);
  EXPECT_EQ(loop.scene().edited().edits(), vector<std::string>{"floor_mtl.diffuse=.1 .6 .2"});
  finish(loop);
  EXPECT_EQ(beauty(loop), edited);
}

TEST_F(RenderLoopTest, LooksArePlacedLikeInstances) {
  RenderLoop loop(source(), {}, {});
  ViewSettings view = small_view();
  view.look = Look{{0, -5, 2}, {0, 1, .5f}, {0, 0, 1}};
  loop.set_view(view);
  ASSERT_TRUE(loop.read());
  finish(loop);
  const vector<float> looked = beauty(loop);
  const Mat4 m = *camera_matrix(*view.look);
  std::string edit = "cam_inst.transform=";
  for (int i = 0; i < 16; ++i) {
    char number[32];
    std::snprintf(number, sizeof number, "%.9g ", static_cast<double>(m[i / 4][i % 4]));
    edit += number;
  }
  view.look.reset();
  loop.set_view(view);
  loop.set_edits({edit});
  finish(loop);
  EXPECT_EQ(beauty(loop), looked);
}

}  // namespace
}  // namespace oriel::interactive
