// SPDX-License-Identifier: Apache-2.0
// Shaders of users fail after an edit: the client hears of it and no edit is lost.
#include <algorithm>
#include <filesystem>

#include "session_support.h"

namespace oriel::studio {
namespace {

/// A texture shader that fails for one value of a parameter: 1 = invalid memory, 2 = a signal that
/// no handler sees.
constexpr const char* kFailingShader = R"(#include <shader.h>
#include <signal.h>
#include <unistd.h>
struct fails { miInteger how; miColor tint; };
DLLEXPORT int fails_version(void) { return 1; }
DLLEXPORT miBoolean fails(miColor* result, miState* state, struct fails* paras) {
  miInteger how = *mi_eval_integer(&paras->how);
  if (how == 1) *(volatile int*)0 = 1;
  if (how == 2) kill(getpid(), SIGKILL);
  *result = *mi_eval_color(&paras->tint);
  return miTRUE;
}
)";

class FailingShaderTest : public StudioSessionTest {
 protected:
  void SetUp() override {
    StudioSessionTest::SetUp();
    write("fails.c", kFailingShader);
    std::filesystem::create_directories(file("lib"));
    ASSERT_EQ(run({"shader-build", "fails.c", "-o", "lib/fails.so"}).exit_code, 0)
        << run({"shader-build", "fails.c", "-o", "lib/fails.so"}).err;
    std::string scene = small_scene();
    scene.insert(0,
                 "link \"fails.so\"\n"
                 "declare shader color \"fails\" ( integer \"how\", color \"tint\" ) version 1 "
                 "apply texture end declare\n"
                 "shader \"own\" \"fails\" ( \"how\" 0, \"tint\" .3 .6 .2 )\n");
    write("scene.mi", scene);
    serve({"scene.mi", "--shader-path", "lib"});
  }
  const std::vector<std::string> kUse = {"grey.diffuse==own", "grey.reflectivity=.1"};
};

TEST_F(FailingShaderTest, InvalidMemoryIsReportedAndRenderingContinues) {
  auto socket = client();
  ASSERT_EQ(socket->ask({{"type", "view"}, {"budget", {{"samples", 2}}}})["type"], "reply");
  json reply = socket->ask({{"type", "edit"}, {"edits", kUse}});
  ASSERT_EQ(reply["type"], "reply") << reply;
  converged(*socket, reply["epoch"]);
  reply = socket->ask({{"type", "edit"}, {"edits", {"own.how=1"}}});
  ASSERT_EQ(reply["type"], "reply") << reply;
  socket->wait([](const json& m) {
    if (m["type"] != "messages") return false;
    return std::any_of(m["list"].begin(), m["list"].end(), [](const json& d) {
      return d["code"].get<std::string>().starts_with("OR-SDK") && d["severity"] != "note";
    });
  });
  reply = socket->ask({{"type", "undo"}});
  converged(*socket, reply["epoch"]);
}

// acceptance: W6
TEST_F(FailingShaderTest, EndOfTheRendererByAShaderLosesNoEdit) {
  {
    auto socket = client();
    json reply = socket->ask({{"type", "edit"}, {"edits", kUse}});
    ASSERT_EQ(reply["type"], "reply") << reply;
    socket->send({{"type", "edit"}, {"id", 1000}, {"edits", {"own.how=2"}}});
    socket->close_code();  // the renderer ends
  }
  auto socket = client();
  EXPECT_EQ(socket->wait_for("crashed")["edits"], 3);
  // The edit that ended it is taken back before the renderer starts again.
  EXPECT_EQ(socket->ask({{"type", "undo"}})["type"], "reply");
  json reply = socket->ask({{"type", "set_edits"}, {"edits", kUse}});
  ASSERT_EQ(reply["type"], "reply") << reply;
  reply = socket->ask({{"type", "restart"}});
  ASSERT_EQ(reply["type"], "reply") << reply;
  reply = socket->ask({{"type", "view"}, {"budget", {{"samples", 2}}}});
  converged(*socket, reply["epoch"]);
  EXPECT_EQ(
      socket->ask({{"type", "element"}, {"name", "own"}})["shaders"][0]["parameters"][0]["value"],
      0);
}

}  // namespace
}  // namespace oriel::studio
