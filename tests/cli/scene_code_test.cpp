// SPDX-License-Identifier: Apache-2.0
// C code in a scene: refused by default, compiled once and run if the user trusts the scene.
#include <fmt/format.h>

#include <cstdlib>

#include "image/exr.h"
#include "support/program.h"

namespace oriel {
namespace scene_code_test {

namespace fs = std::filesystem;

class SceneCode : public ProgramTest {
 protected:
  void SetUp() override {
    setenv("XDG_CACHE_HOME", file("cache").c_str(), 1);
    unsetenv("ORIEL_SHADER_PATH");
  }
  void TearDown() override { unsetenv("XDG_CACHE_HOME"); }

  static std::string shader(const std::string& value) {
    return "#include <shader.h>\n"
           "DLLEXPORT int even_version(void) { return 1; }\n"
           "DLLEXPORT miBoolean even(miColor *result, miState *state, void *paras) {\n"
           "  (void)state; (void)paras;\n"
           "  result->r = result->g = result->b = " +
           value + "; result->a = 1; return miTRUE;\n}\n";
  }
  /// The environment has the colour of the shader; the upper corners look past the wall at it.
  static std::string scene(const std::string& code) {
    return code + "declare shader color \"even\" () version 1 end declare\n" +
           small_scene("", "focal .5 environment \"even\" ()");
  }
  RunResult render(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = {"render", "scene.mi", "-o", "a.exr", "--samples", "1"};
    all.insert(all.end(), more.begin(), more.end());
    return run(all);
  }
  float corner() const { return read_exr_image(file("a.exr")).at(0, 0)[1]; }
  std::size_t compiled() const {
    std::size_t count = 0;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(file("cache/oriel/code"), error))
      count += entry.path().extension() == ".so";
    return count;
  }
};

std::string in_line(const std::string& code) { return "$code\n" + code + "$end code\n"; }

std::string hex(const std::string& text) {
  std::string digits;
  for (const char c : text) digits += fmt::format("{:02x}", static_cast<unsigned char>(c));
  return digits;
}

TEST_F(SceneCode, IsNotRunUnlessTheSceneIsTrusted) {
  write("b.c", shader(".25"));
  for (const std::string& code :
       {in_line(shader(".25")), std::string("code \"b.c\"\n"), "code '" + hex("int x;") + "'\n",
        std::string("registry \"r\" { code \"b.c\" } end registry\n")}) {
    write("scene.mi", scene(code));
    const RunResult r = render();
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_NE(r.err.find("OR-MI-022"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("--trust-code"), std::string::npos) << r.err;
    EXPECT_FALSE(fs::exists(file("cache")));
  }
}

TEST_F(SceneCode, IsCompiledOnceWhereTheUserTrustsIt) {
  write("scene.mi", scene(in_line(shader(".25"))));
  RunResult r = render({"--trust-code"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.err.find("OR-"), std::string::npos) << r.err;
  EXPECT_EQ(corner(), .25f);
  ASSERT_EQ(compiled(), 1u);
  // Without a compiler: it is there already.
  setenv("CC", "/nowhere/cc", 1);
  r = render({"--trust-code"});
  EXPECT_EQ(corner(), .25f) << r.err;
  // Other text is other code.
  write("scene.mi", scene(in_line(shader(".75"))));
  r = render({"--trust-code"});
  unsetenv("CC");
  EXPECT_EQ(r.exit_code, 1) << "its shaders are missing";
  EXPECT_NE(r.err.find("OR-SDK-030"), std::string::npos) << r.err;
  EXPECT_EQ(render({"--trust-code"}).exit_code, 0);
  EXPECT_EQ(corner(), .75f);
  EXPECT_EQ(compiled(), 2u);
}

TEST_F(SceneCode, FilesAndBytesAreCodeAsWell) {
  write("b.c", "#include \"value.h\"\n" + shader("VALUE"));
  write("value.h", "#define VALUE .5f\n");
  write("scene.mi", scene("code \"b.c\"\n"));
  RunResult r = render({"--trust-code"});
  EXPECT_EQ(corner(), .5f) << r.err;
  // A header that changed makes it other code.
  write("value.h", "#define VALUE .125f\n");
  r = render({"--trust-code"});
  EXPECT_EQ(corner(), .125f) << r.err;
  write("scene.mi", scene("code '" + hex(shader(".75")) + "'\n"));
  r = render({"--trust-code"});
  EXPECT_EQ(corner(), .75f) << r.err;
}

TEST_F(SceneCode, FilesMustBeBelowTheSceneOrTheShaderPath) {
  fs::create_directory(file("inner"));
  fs::create_directory(file("trusted"));
  write("outer.c", shader(".25"));
  write("inner/scene.mi", scene("code \"../outer.c\"\n"));
  const auto render_inner = [&](const std::string& path) {
    return run({"render", "inner/scene.mi", "-o", "a.exr", "--samples", "1", "--trust-code",
                "--shader-path", path});
  };
  RunResult r = render_inner("trusted");
  EXPECT_NE(r.err.find("\"../outer.c\" was not found"), std::string::npos) << r.err;
  write("trusted/outer.c", shader(".5"));
  r = render_inner("trusted");
  EXPECT_EQ(corner(), .5f) << r.err;
}

TEST_F(SceneCode, CompileErrorsAffectOnlyTheirShaders) {
  write("scene.mi", scene(in_line("this is no C\n")));
  const RunResult r = render({"--trust-code"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("OR-SDK-030"), std::string::npos) << r.err;
  EXPECT_EQ(compiled(), 0u);
}

TEST_F(SceneCode, ACacheThatOthersWriteToIsNotUsed) {
  fs::create_directories(file("cache/oriel/code"));
  fs::permissions(file("cache/oriel/code"), fs::perms::all);
  write("scene.mi", scene(in_line(shader(".25"))));
  const RunResult r = render({"--trust-code"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("OR-SDK-031"), std::string::npos) << r.err;
}

}  // namespace scene_code_test
}  // namespace oriel
