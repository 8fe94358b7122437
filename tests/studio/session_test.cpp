// SPDX-License-Identifier: Apache-2.0
// A client edits, measures, saves; the program's other commands give the same values.
#include <half.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>

#include "image/files.h"
#include "session_support.h"

namespace oriel::studio {
namespace {

const std::vector<std::string> kEdits = {"grey.diffuse=.7 .2 .1", "lamp.origin=1 1 -3"};

// acceptance: W2
TEST_F(StudioSessionTest, EveryParameterOfAPickedMaterialCanBeEditedUndoneAndSaved) {
  write("scene.mi", "shader \"tint\" \"mib_color_mix\" ( \"color_base\" .5 .5 .5 )\n" +
                        small_scene() + "# a last comment\n");
  serve();
  auto socket = client();
  const json budget = socket->ask({{"type", "view"}, {"budget", {{"samples", 8}}}});
  converged(*socket, budget["epoch"]);
  const std::vector<float> original = delivered(*socket);
  EXPECT_EQ(original, rendered("scene.mi", {}));

  const json pick = socket->ask({{"type", "pick"}, {"x", 24}, {"y", 28}});
  ASSERT_EQ(pick["material"], "grey") << pick;
  EXPECT_EQ(pick["instance"], "floor_inst");
  const json& parameters = pick["element"]["shaders"][0]["parameters"];
  ASSERT_GT(parameters.size(), 50u);
  int numbers = 0;
  for (const json& p : parameters) {
    const std::string type = p["type"], set = p["set"];
    const std::string value = type == "boolean"   ? "on"
                              : type == "integer" ? "1"
                              : type == "scalar"  ? "0.5"
                              : type == "color"   ? "0.1 0.2 0.3"
                              : type == "vector"  ? "0 0 1"
                              : type == "shader"  ? "=tint"
                                                  : "";
    if (value.empty()) continue;
    ++numbers;
    const json reply = socket->ask({{"type", "edit"}, {"edits", {set + "=" + value}}});
    ASSERT_EQ(reply["type"], "reply") << set << reply;
    const json again = socket->ask({{"type", "element"}, {"name", "grey"}});
    for (const json& q : again["shaders"][0]["parameters"])
      if (q["name"] == p["name"]) {
        EXPECT_EQ(q["edited"], true) << set;
        EXPECT_TRUE(q.contains("value")) << set;
      }
    ASSERT_EQ(socket->ask({{"type", "undo"}})["type"], "reply");
  }
  EXPECT_GT(numbers, 40);

  json reply = socket->ask({{"type", "edit"}, {"edits", kEdits}});
  converged(*socket, reply["epoch"]);
  const std::vector<float> edited = delivered(*socket);
  EXPECT_EQ(edited, rendered("scene.mi", kEdits));
  EXPECT_NE(edited, original);
  reply = socket->ask({{"type", "undo"}});
  converged(*socket, reply["epoch"]);
  EXPECT_EQ(delivered(*socket), original);
  reply = socket->ask({{"type", "redo"}});
  converged(*socket, reply["epoch"]);

  const std::string before = text_of(file("scene.mi"));
  const json saved = socket->ask({{"type", "save"}, {"mode", "mi"}});
  EXPECT_EQ(saved["files"], json({"scene.mi"})) << saved;
  EXPECT_EQ(rendered("scene.mi", {}), edited);
  std::string after = text_of(file("scene.mi"));
  const auto put_back = [&](const std::string& now, const std::string& old) {
    const std::size_t at = after.find(now);
    ASSERT_NE(at, std::string::npos) << now;
    after.replace(at, now.size(), old);
  };
  put_back("\"diffuse\" .7 .2 .1", "\"diffuse\" .5 .5 .5");
  put_back("origin 1 1 -3", "origin 0 1 -3");
  EXPECT_EQ(after, before) << "other bytes have changed";
}

TEST_F(StudioSessionTest, PixelsArriveReducedFirstAndAtFullSizeInTheEnd) {
  serve();
  auto socket = client();
  const json reply = socket->ask({{"type", "view"},
                                  {"size", {320, 200}},
                                  {"budget", {{"samples", 2}}},
                                  {"layers", {"depth", "normal"}}});
  socket->strips.clear();
  converged(*socket, reply["epoch"]);
  socket->ask({{"type", "outline"}});
  ASSERT_FALSE(socket->strips.empty());
  const auto u16 = [](const std::string& s, std::size_t at) {
    return static_cast<unsigned char>(s[at]) | static_cast<unsigned char>(s[at + 1]) << 8;
  };
  int first_divider = 0;
  for (const std::string& s : socket->strips) {
    ASSERT_GE(s.size(), 32u);
    EXPECT_EQ(TestSocket::word(s, 0), 0x4C49524Fu);
    constexpr int kBytes[] = {6, 8, 4};
    EXPECT_EQ(s.size(),
              32u + static_cast<std::size_t>(u16(s, 20) * u16(s, 22) * kBytes[int(s[6])]));
    if (TestSocket::word(s, 8) < reply["epoch"]) continue;
    if (first_divider == 0) first_divider = u16(s, 14);
  }
  // The long side of the first picture has at least 128 pixels, half of that where it would be
  // slow.
  EXPECT_TRUE(first_divider == 2 || first_divider == 4) << first_divider;
  const std::string& last = socket->strips.back();
  EXPECT_EQ(u16(last, 14), 1);
  EXPECT_EQ(u16(last, 20), 320);
}

TEST_F(StudioSessionTest, PingsAreAnswered) {
  serve();
  auto socket = client();
  for (int i = 0; i < 2; ++i) {
    socket->send({{"type", "ping"}});
    EXPECT_EQ(socket->wait_for("pong"), json({{"type", "pong"}}));
  }
}

TEST_F(StudioSessionTest, SlowClientsGetTheNewestPictureOnly) {
  serve();
  auto socket = client();
  socket->acknowledges = false;
  const auto frames_of = [&] {
    std::set<std::uint32_t> frames;
    for (const std::string& s : socket->strips) frames.insert(TestSocket::word(s, 28));
    return frames;
  };
  const std::size_t acknowledged = frames_of().size();  // while the client connected
  for (int i = 0; i < 5; ++i) {
    const json reply = socket->ask(
        {{"type", "edit"}, {"edits", {"grey.diffuse=." + std::to_string(i + 1) + " 0 0"}}});
    converged(*socket, reply["epoch"]);
  }
  EXPECT_LE(frames_of().size(), acknowledged + 2) << "two frames wait for their acknowledgement";
}

// acceptance: W4
TEST_F(StudioSessionTest, MeasuredValuesAreThoseOfTheProgram) {
  serve({"scene.mi", "--unit-luminance", "100"});
  auto socket = client();
  const json reply = socket->ask({{"type", "view"}, {"budget", {{"samples", 8}}}});
  converged(*socket, reply["epoch"]);

  const json probe = socket->ask({{"type", "probe"}, {"x", 24}, {"y", 28}, {"seconds", 60}});
  const RunResult m =
      run({"measure", "scene.mi", "--unit-luminance", "100", "--pixel", "24,28", "--json"});
  const json spot = json::parse(m.out)["spots"][0];
  for (const char* name :
       {"luminance", "illuminance", "position", "normal", "distance", "material", "instance"})
    EXPECT_EQ(probe[name], spot[name]) << name;

  const json grid = socket->ask({{"type", "lux_grid"},
                                 {"origin", {-2, -0.9, -6}},
                                 {"u", {4, 0, 0}},
                                 {"v", {0, 0, -2}},
                                 {"normal", {0, 1, 0}},
                                 {"columns", 3},
                                 {"rows", 2},
                                 {"seconds", 60}});
  const RunResult g = run({"measure", "scene.mi", "--unit-luminance", "100", "--grid",
                           "-2,-0.9,-6:4,0,0:0,0,-2:3x2", "--normal", "0,1,0", "--json"});
  EXPECT_EQ(grid["illuminance"]["mean"], json::parse(g.out)["illuminance"]["mean"]) << g.err;
  EXPECT_EQ(grid["illuminance"]["sensors"], json::parse(g.out)["illuminance"]["sensors"]);

  const json explained = socket->ask({{"type", "explain"}, {"x", 24}, {"y", 28}, {"samples", 16}});
  const RunResult e = run({"explain", "scene.mi", "--pixel", "24,28", "--samples", "16", "--json"});
  EXPECT_EQ(explained["facts"]["surfaces"], json::parse(e.out)["surfaces"]);
  EXPECT_EQ(explained["facts"]["colour"], json::parse(e.out)["colour"]);

  // False colours are those of the layer `luminance`, in cd/m2.
  socket->strips.clear();
  const json shown = socket->ask({{"type", "view"}, {"layers", {"luminance"}}});
  converged(*socket, shown["epoch"]);
  socket->ask({{"type", "outline"}});
  EXPECT_EQ(socket->strips.back()[6], 2) << "R32F";
}

TEST_F(StudioSessionTest, LightLayersSumToTheBeauty) {
  serve();
  auto socket = client();
  socket->ask({{"type", "view"}, {"light_groups", "auto"}, {"budget", {{"samples", 4}}}});
  const json state = socket->wait([](const json& m) {
    return m["type"] == "state" && m.contains("light_layers") && !m["light_layers"].empty();
  });
  EXPECT_EQ(state["light_layers"][0], "light_lamp_inst");
  const json layers = socket->ask({{"type", "view"}, {"layers", state["light_layers"]}});
  converged(*socket, layers["epoch"]);
  socket->ask({{"type", "outline"}});
  const std::vector<float> beauty = layer_of_last_frame(*socket, 0);
  ASSERT_EQ(beauty.size(), 48u * 32u * 3u);
  std::vector<float> sum(beauty.size());
  for (std::size_t i = 0; i < state["light_layers"].size(); ++i) {
    const std::vector<float> layer = layer_of_last_frame(*socket, static_cast<int>(i) + 1);
    ASSERT_EQ(layer.size(), beauty.size());
    for (std::size_t j = 0; j < sum.size(); ++j) sum[j] += layer[j];
  }
  float brightest = 0;
  for (std::size_t j = 0; j < sum.size(); ++j) {
    EXPECT_NEAR(sum[j], beauty[j], 1e-6f + beauty[j] / 512);
    brightest = std::max(brightest, beauty[j]);
  }
  EXPECT_GT(brightest, 0.01f);
}

TEST_F(StudioSessionTest, DaylightIsThatOfTheProgram) {
  std::string scene = small_scene();
  const std::string lamp =
      "light \"lamp\" \"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 1 -3 end light";
  const std::size_t at = scene.find(lamp);
  ASSERT_NE(at, std::string::npos);
  scene.replace(at, lamp.size(),
                "light \"lamp\" \"mia_physicalsun\" ( \"y_is_up\" on ) direction 0 -1 0 end light");
  write("sun.mi", scene);
  serve({"sun.mi"});
  auto socket = client();
  const json reply = socket->ask({{"type", "daylight"},
                                  {"latitude", 48.14},
                                  {"longitude", 11.58},
                                  {"time", "2026-06-21T15:00+02:00"},
                                  {"north", 30}});
  ASSERT_EQ(reply["type"], "reply") << reply;
  EXPECT_NEAR(reply["elevation"], 58, 3);
  const json view = socket->ask({{"type", "view"}, {"budget", {{"samples", 8}}}});
  converged(*socket, view["epoch"]);
  const RunResult r = run({"render", "sun.mi", "-o", "sun.exr", "--samples", "8", "--sun",
                           "48.14,11.58,2026-06-21T15:00+02:00", "--north", "30"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(delivered(*socket), read_image(file("sun.exr")).pixels);
}

// acceptance: W6
TEST_F(StudioSessionTest, EditsSurviveACrash) {
  serve();
  {
    auto socket = client();
    ASSERT_EQ(socket->ask({{"type", "edit"}, {"edits", kEdits}})["type"], "reply");
    const pid_t child = renderer();
    ASSERT_GT(child, 0);
    kill(child, SIGSEGV);
    socket->close_code();
  }
  // The supervisor still listens, so connecting waits for the new process.
  auto socket = client();
  const json crashed = socket->wait_for("crashed");
  EXPECT_EQ(crashed["edits"], 2);
  EXPECT_EQ(socket->ask({{"type", "outline"}})["code"], "failed") << "it waits for the user";
  json reply = socket->ask({{"type", "restart"}});
  EXPECT_EQ(reply["type"], "reply") << reply;
  reply = socket->ask({{"type", "view"}, {"budget", {{"samples", 8}}}});
  converged(*socket, reply["epoch"]);
  EXPECT_EQ(delivered(*socket), rendered("scene.mi", kEdits));
}

TEST_F(StudioSessionTest, UnsavedEditsAreThereInTheNextSession) {
  serve();
  client()->ask({{"type", "edit"}, {"edits", kEdits}});
  stop(SIGTERM);
  serve();
  auto socket = client();
  const json state = socket->wait_for("state");
  EXPECT_EQ(state["edits"], kEdits);
  // Each edit is a step of undo.
  EXPECT_EQ(socket->ask({{"type", "undo"}})["undo"], kEdits.size() - 1);
  while (socket->ask({{"type", "undo"}})["undo"] > 0) {
  }
  stop(SIGTERM);
  serve();
  EXPECT_EQ(client()->wait_for("state")["edits"], json::array());
}

TEST_F(StudioSessionTest, ClientsDoNotGetAnswersToOthers) {
  serve();
  auto first = client();
  first->ask({{"type", "outline"}});
  first->send({{"type", "lux_grid"},
               {"id", 1},
               {"origin", {-1, -1, 0.5}},
               {"u", {2, 0, 0}},
               {"v", {0, 2, 0}},
               {"columns", 40},
               {"rows", 40},
               {"precision", 1e-4},
               {"seconds", 60}});
  auto second = client();  // numbers its requests from 1 as well
  const json reply = second->ask({{"type", "outline"}});
  EXPECT_EQ(reply["type"], "reply") << reply;
  EXPECT_TRUE(reply.contains("materials")) << reply;
}

TEST_F(StudioSessionTest, FinalRendersPauseAndResume) {
  serve();
  auto socket = client();
  const auto job_in = [&](const char* state) {
    return socket->wait([&](const json& m) { return m["type"] == "job" && m["state"] == state; });
  };
  const json started =
      socket->ask({{"type", "job"}, {"action", "start"}, {"file", "final.exr"}, {"samples", 1024}});
  ASSERT_EQ(started["type"], "reply") << started;
  EXPECT_EQ(socket->ask({{"type", "job"}, {"action", "start"}, {"file", "b.exr"}})["code"], "busy");
  // Before its first sample it has no checkpoint.
  socket->wait([](const json& m) { return m["type"] == "job" && m.value("samples", 0.0) > 0; });
  socket->ask({{"type", "job"}, {"action", "pause"}});
  job_in("paused");
  EXPECT_TRUE(std::filesystem::exists(file("final.exr.checkpoint")));
  socket->ask({{"type", "job"}, {"action", "resume"}});
  const json done = job_in("done");
  EXPECT_EQ(done["done"], 1);
  EXPECT_FALSE(std::filesystem::exists(file("final.exr.checkpoint")));
  const std::vector<std::string> plain = {"render",    "scene.mi",  "-o",
                                          "plain.exr", "--samples", "1024"};
  EXPECT_EQ(run(plain).exit_code, 0);
  EXPECT_EQ(read_image(file("final.exr")).pixels, read_image(file("plain.exr")).pixels);

  socket->ask({{"type", "job"}, {"action", "start"}, {"file", "c.exr"}, {"samples", 100000}});
  socket->ask({{"type", "job"}, {"action", "cancel"}});
  job_in("cancelled");
  EXPECT_FALSE(std::filesystem::exists(file("c.exr.checkpoint")));
}

// The final render has the look of the page, the requested size and the requested layers.
TEST_F(StudioSessionTest, FinalRendersAreThatOfTheLook) {
  serve();
  auto socket = client();
  const std::vector<double> from = {.5, .3, 1}, to = {0, -.5, -6}, up = {0, 1, 0};
  json reply = socket->ask({{"type", "view"},
                            {"look", {{"from", from}, {"to", to}, {"up", up}}},
                            {"region", {2, 2, 9, 8}},
                            {"budget", {{"samples", 8}}}});
  ASSERT_EQ(reply["type"], "reply") << reply;
  reply = socket->ask({{"type", "job"},
                       {"action", "start"},
                       {"file", "final.exr"},
                       {"size", {24, 18}},
                       {"layers", {"beauty", "denoised", "normal"}}});
  ASSERT_EQ(reply["type"], "reply") << reply;
  const json done =
      socket->wait([&](const json& m) { return m["type"] == "job" && m["state"] != "running"; });
  ASSERT_EQ(done["state"], "done") << done;
  const Image made = read_image(file("final.exr"));
  EXPECT_EQ(made.width, 24);
  EXPECT_EQ(made.height, 18);
  EXPECT_NE(text_of(file("final.exr")).find("normal.X"), std::string::npos);

  // The same by a client that stores the look and renders the picture at that size.
  socket->ask({{"type", "view"}, {"region", nullptr}, {"size", {24, 18}}});
  reply = socket->ask({{"type", "store_camera"}});
  ASSERT_EQ(reply["type"], "reply") << reply;
  converged(*socket, reply["epoch"]);
  EXPECT_EQ(delivered(*socket), made.pixels);
}

// The measurement takes up to a minute if nothing ends it.
TEST_F(StudioSessionTest, LongMeasurementsAreCancelled) {
  serve();
  auto socket = client();
  socket->ask({{"type", "outline"}});
  socket->send({{"type", "lux_grid"},
                {"id", 500},
                {"origin", {-1, -.99, -4}},
                {"u", {2, 0, 0}},
                {"v", {0, 0, -2}},
                {"columns", 90},
                {"rows", 90},
                {"precision", 1e-4},
                {"seconds", 60}});
  socket->send({{"type", "cancel"}, {"target", 500}});
  const json answer =
      socket->wait([](const json& m) { return m.contains("id") && m["id"] == 500; });
  EXPECT_EQ(answer["code"], "cancelled") << answer["type"];
}

TEST_F(StudioSessionTest, PointersAreNoRequests) {
  serve();
  auto socket = client();
  json reply = socket->ask({{"type", "view"}, {"budget", {{"samples", 4}}}});
  socket->send({{"type", "pointer"}, {"x", 3}, {"y", 1e12}});
  EXPECT_EQ(socket->wait_for("error")["code"], "bad-request");
  socket->send({{"type", "pointer"}, {"x", 3}, {"y", 4}});
  socket->send({{"type", "pointer"}, {"x", -300}, {"y", 4000}});
  socket->send({{"type", "pointer"}});
  converged(*socket, reply["epoch"]);
  EXPECT_EQ(socket->ask({{"type", "view"}})["epoch"], reply["epoch"]) << "nothing was restarted";
}

TEST_F(StudioSessionTest, MissingTexturesAreRelinked) {
  write("scene.mi", "color texture \"wood\" \"gone.png\"\n" + small_scene());
  serve();
  auto socket = client();
  const json messages = socket->wait_for("messages");
  ASSERT_EQ(messages["missing"].size(), 1u) << messages;
  EXPECT_EQ(messages["missing"][0]["texture"], "wood");
  std::filesystem::create_directories(file("textures"));
  write("textures/wood.png", "pixels");
  const json reply =
      socket->ask({{"type", "relink"}, {"texture", "wood"}, {"file", "textures/wood.png"}});
  EXPECT_EQ(reply["type"], "reply") << reply;
  socket->wait([](const json& m) { return m["type"] == "messages" && m["missing"].empty(); });
  socket->ask({{"type", "save"}, {"mode", "mi"}});
  EXPECT_TRUE(
      text_of(file("scene.mi")).starts_with("color texture \"wood\" \"textures/wood.png\"\n"));
}

}  // namespace
}  // namespace oriel::studio
