// SPDX-License-Identifier: Apache-2.0
// What the page asks for beside edits: thumbnails, denoised pictures, rest while it is hidden.
#include <chrono>
#include <cmath>
#include <thread>

#include "image/exr.h"
#include "session_support.h"

namespace oriel::studio {
namespace {

class StudioPageTest : public StudioSessionTest {};

TEST_F(StudioPageTest, ThumbnailsShowFilesOfTheSceneAlone) {
  write("scene.mi",
        "color texture \"wood\" \"wood.png\"\ncolor texture \"gone\" \"gone.png\"\n"
        "color texture \"text\" \"secret.txt\"\n" +
            small_scene());
  Image wide(64, 16, 3);
  for (int x = 0; x < 64; ++x)
    for (int y = 0; y < 16; ++y) wide.at(x, y)[0] = y < 8 ? 1.0f : 0.5f;
  write_image(file("wood.png"), wide);
  serve();
  auto socket = client();
  const json reply = socket->ask({{"type", "thumbnail"}, {"texture", "wood"}});
  ASSERT_EQ(reply["type"], "reply") << reply;
  EXPECT_EQ(reply["width"], 64);
  std::ofstream(file("thumbnail.png"), std::ios::binary) << fetch(reply["url"]);
  const Image image = read_image(file("thumbnail.png"));
  ASSERT_EQ(image.width, 96);
  ASSERT_EQ(image.height, 24);
  EXPECT_NEAR(image.at(48, 3)[0], 1, 0.01);
  EXPECT_NEAR(image.at(48, 20)[0], 0.5, 0.01) << "the lower half, as stored";
  EXPECT_NEAR(image.at(48, 3)[1], 0, 0.01);
  for (const char* name : {"gone", "text", "wood.png", "grey"})
    EXPECT_EQ(socket->ask({{"type", "thumbnail"}, {"texture", name}})["code"], "not-found") << name;
}

TEST_F(StudioPageTest, NothingIsRenderedForPagesThatAreHiddenOrClosed) {
  serve();
  auto socket = client();
  socket->ask({{"type", "view"}, {"budget", {{"samples", 65536}}}, {"size", {400, 300}}});
  socket->wait([](const json& m) { return m["type"] == "progress" && m["samples"] > 0; });
  socket->ask({{"type", "view"}, {"hidden", true}});
  const json stopped = socket->wait(
      [](const json& m) { return m["type"] == "progress" && m["status"] == "paused"; });
  const json shown = socket->ask({{"type", "view"}, {"hidden", false}});
  socket->wait([&](const json& m) {
    return m["type"] == "progress" && m["status"] == "rendering" &&
           m["samples"] > stopped["samples"];
  });
  // Without a client the renderer uses no processor time.
  socket.reset();
  const pid_t child = renderer();
  const auto ticks = [&] {
    std::ifstream stat("/proc/" + std::to_string(child) + "/stat");
    std::string word;
    long sum = 0;
    for (int i = 1; i <= 15 && stat >> word; ++i)
      if (i >= 14) sum += std::atol(word.c_str());
    return sum;
  };
  long before = ticks();
  bool still = false;
  for (int i = 0; i < 100 && !still; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    const long now = ticks();
    still = now - before <= 1;
    before = now;
  }
  EXPECT_TRUE(still);
  client()->wait(
      [](const json& m) { return m["type"] == "progress" && m["status"] == "rendering"; });
}

TEST_F(StudioPageTest, DenoisedPicturesAreThoseOfTheProgram) {
  serve();
  auto socket = client();
  socket->ask({{"type", "view"}, {"budget", {{"samples", 8}}}, {"layers", {"denoised"}}});
  const json view = socket->ask({{"type", "view"}, {"scale", 1}});
  converged(*socket, view["epoch"]);
  socket->ask({{"type", "outline"}});
  const std::vector<float> noisy = layer_of_last_frame(*socket, 0);
  const std::vector<float> clean = layer_of_last_frame(*socket, 1);
  const RunResult r = run({"render", "scene.mi", "-o", "d.exr", "--samples", "8", "--denoise"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(clean, noisy);
  const std::vector<Layer> layers = read_exr(file("d.exr")).layers;
  const Layer* expected = find_layer(layers, "denoised");
  ASSERT_TRUE(expected);
  ASSERT_EQ(clean.size(), expected->image.pixel_count() * 3);
  const auto channels = static_cast<std::size_t>(expected->image.channels);
  for (std::size_t i = 0; i < expected->image.pixel_count(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = expected->image.pixels[channels * i + c];
      EXPECT_NEAR(clean[3 * i + c], value, 1e-6f + std::abs(value) / 512);
    }
}

TEST_F(StudioPageTest, PlaceAndTimeAreInTheStateWhileTheirEditsAre) {
  write("scene.mi", "shader \"sky\" \"mia_physicalsky\" ()\n" + small_scene());
  serve();
  auto socket = client();
  const json now = {{"latitude", 48.14},
                    {"longitude", 11.58},
                    {"time", "2026-06-21T15:00+02:00"},
                    {"north", 30},
                    {"haze", 2}};
  json request = now;
  request["type"] = "daylight";
  ASSERT_EQ(socket->ask(request)["type"], "reply");
  socket.reset();
  socket = client();
  const json state = socket->wait_for("state");
  EXPECT_EQ(state["daylight"], now) << state;
  const json undone = socket->ask({{"type", "undo"}});
  // A state of before the undo may still arrive.
  const json after = socket->wait(
      [&](const json& m) { return m["type"] == "state" && m["epoch"] >= undone["epoch"]; });
  EXPECT_FALSE(after.contains("daylight")) << after;
}

TEST_F(StudioPageTest, ExposureHasTheGammaOfIntegerFiles) {
  write("scene.mi", small_scene("gamma 2", "lens \"mia_exposure_photographic\" (\"gamma\" 1.5)"));
  serve();
  const json state = client()->wait_for("state");
  EXPECT_EQ(state["exposure"]["parameters"]["gamma"], 3) << state;
  EXPECT_EQ(state["gamma"], 2);
}

TEST_F(StudioPageTest, TheCameraTurnsAboutTheSurfaceThatItLooksAt) {
  serve();
  const json look = client()->wait_for("state")["look"];
  // The middle of the picture shows the wall at z = -8.
  EXPECT_NEAR(look["to"][2].get<double>() - look["from"][2].get<double>(), -8, 1e-4) << look;
}

TEST_F(StudioPageTest, SavingCanBeUndone) {
  serve();
  auto socket = client();
  json reply = socket->ask({{"type", "view"}, {"budget", {{"samples", 8}}}});
  converged(*socket, reply["epoch"]);
  const std::vector<float> original = delivered(*socket);
  const std::vector<std::string> edits = {"grey.diffuse=.7 .2 .1", "grey.cutout_opacity=.5",
                                          "lamp.origin=1 1 -3"};
  reply = socket->ask({{"type", "edit"}, {"edits", edits}});
  converged(*socket, reply["epoch"]);
  const std::vector<float> edited = delivered(*socket);
  ASSERT_NE(edited, original);
  ASSERT_EQ(socket->ask({{"type", "save"}, {"mode", "mi"}})["type"], "reply");
  const std::string saved = text_of(file("scene.mi"));
  reply = socket->ask({{"type", "undo"}});
  converged(*socket, reply["epoch"]);
  EXPECT_EQ(delivered(*socket), original);
  EXPECT_EQ(text_of(file("scene.mi")), saved) << "the file changes when it is saved again";
  reply = socket->ask({{"type", "redo"}});
  converged(*socket, reply["epoch"]);
  EXPECT_EQ(delivered(*socket), edited);
}

}  // namespace
}  // namespace oriel::studio
