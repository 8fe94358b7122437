// SPDX-License-Identifier: Apache-2.0
// oriel shader-build: libraries from sources, and error messages.
#include <dlfcn.h>

#include "mi/reader.h"
#include "support/program.h"

namespace oriel {
namespace shader_build_test {

namespace fs = std::filesystem;

const fs::path kSource = ORIEL_SOURCE_DIR;

class ShaderBuildProgram : public ProgramTest {
 protected:
  /// Whether the library has a function of that name. Functions of the renderer stay unbound.
  bool offers(const std::string& library, const std::string& name) const {
    void* const handle = dlopen(file(library).c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (handle == nullptr) {
      ADD_FAILURE() << dlerror();
      return false;
    }
    const bool found = dlsym(handle, name.c_str()) != nullptr;
    dlclose(handle);
    return found;
  }
  bool exists(const std::string& name) const { return fs::exists(file(name)); }
};

const char* const kShader =
    "#include <shader.h>\n"
    "DLLEXPORT miBoolean plain(miColor *result, miState *state, void *paras) {\n"
    "  (void)paras; result->r = state->dot_nd; return miTRUE;\n}\n";

// acceptance: I4
TEST_F(ShaderBuildProgram, OldSourcesOfBothLanguagesBuildUnchanged) {
  const std::string folder = (kSource / "tests/sdk/traps").string();
  const RunResult r = run({"shader-build", folder});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.out, "traps.so: 3 sources\n");
  EXPECT_NE(r.err.find("trap_dll.cpp is left out"), std::string::npos) << r.err;
  for (const char* name : {"trap_old", "trap_old_init", "trap_old_version", "trap_new",
                           "trap_new_version", "trap_geometry"})
    EXPECT_TRUE(offers("traps.so", name)) << name;
}

// acceptance: I4
TEST_F(ShaderBuildProgram, TheExamplesBuildWithoutAWarning) {
  const fs::path examples = kSource / "examples/shaders";
  int folders = 0;
  for (const auto& entry : fs::directory_iterator(examples)) {
    if (!entry.is_directory()) continue;
    ++folders;
    const std::string library = entry.path().filename().string() + ".so";
    const RunResult r = run({"shader-build", entry.path().string(), "--flag=-Wall",
                             "--flag=-Wextra", "--flag=-Wno-unused-parameter"});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_EQ(r.err, "") << library;
    EXPECT_TRUE(exists(library));
    // Every shader that the folder declares is there.
    for (const auto& part : fs::directory_iterator(entry.path())) {
      if (part.path().extension() != ".mi") continue;
      Diagnostics diagnostics;
      const scene::Scene scene = mi::read_scene(part.path().string(), {}, diagnostics);
      EXPECT_TRUE(diagnostics.all().empty()) << part.path();
      EXPECT_FALSE(scene.declarations.empty()) << part.path();
      for (const scene::ShaderDeclaration& declaration : scene.declarations) {
        EXPECT_TRUE(offers(library, declaration.name)) << declaration.name;
        EXPECT_TRUE(offers(library, declaration.name + "_version")) << declaration.name;
      }
    }
  }
  EXPECT_GE(folders, 13);
}

TEST_F(ShaderBuildProgram, NamesAreTakenAsTheyAre) {
  fs::create_directory(file("my shaders; exit 3"));
  write("my shaders; exit 3/a 'plain' $one.c", kShader);
  const RunResult r = run({"shader-build", "my shaders; exit 3", "-o", "the library.so"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  EXPECT_TRUE(offers("the library.so", "plain"));
}

TEST_F(ShaderBuildProgram, TheCompilersMessagesAreShownAndNothingIsWritten) {
  fs::create_directory(file("bad"));
  write("bad/good.c", kShader);
  write("bad/wrong.c", "#include <shader.h>\nint wrong_version(void) { return no_such; }\n");
  write("bad.so", "an older one");
  const RunResult r = run({"shader-build", "bad"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("wrong.c:2:"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("oriel: 1 of 2 sources did not compile; nothing was written"),
            std::string::npos)
      << r.err;
  EXPECT_EQ(text_of(file("bad.so")), "an older one");
}

TEST_F(ShaderBuildProgram, MissingCompilerIsReported) {
  write("plain.c", kShader);
  const RunResult r = run({"shader-build", "plain.c", "--cc", "no-such-compiler"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_EQ(r.error_lines(), 1) << r.err;
  EXPECT_NE(r.err.find("there is no C compiler: tried 'no-such-compiler'"), std::string::npos)
      << r.err;
  EXPECT_NE(r.err.find("--cc"), std::string::npos);
  EXPECT_FALSE(exists("plain.so"));
}

TEST_F(ShaderBuildProgram, HeadersCanBeNamed) {
  write("plain.c", kShader);
  RunResult r = run({"shader-build", "plain.c", "--include", "."});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("there is no shader.h in it"), std::string::npos) << r.err;
  r = run({"shader-build", "plain.c", "--include", (kSource / "include/oriel/sdk").string()});
  EXPECT_EQ(r.exit_code, 0) << r.err;
}

TEST_F(ShaderBuildProgram, HeadersAreFoundUnderOthersPaths) {
  fs::create_directory(file("s"));
  write("s/own.h", "#include \"..\\..\\include\\Shader.h\"\n#include \"mray/sdk/geoshader.h\"\n");
  write("s/plain.c",
        "#include \"own.h\"\n#include \"../../../mray/shader.h\"\n" + std::string(kShader));
  const RunResult r = run({"shader-build", "s"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  write("s/plain.c", "#include \"/opt/nowhere/shader.h\"\n");
  const RunResult stray = run({"shader-build", "s"});
  EXPECT_EQ(stray.exit_code, 1);
  EXPECT_NE(stray.err.find("s/plain.c:1: there is no \"/opt/nowhere/shader.h\" here; write "
                           "#include <shader.h>"),
            std::string::npos)
      << stray.err;
}

TEST_F(ShaderBuildProgram, BuildErrorsAreReportedInOneLine) {
  fs::create_directory(file("empty"));
  write("notes.txt", "");
  write("a.c", kShader);
  write("b.c", "");
  for (const char* path : {"empty", "none", "notes.txt"}) {
    const RunResult r = run({"shader-build", path});
    EXPECT_EQ(r.exit_code, 1) << path;
    EXPECT_EQ(r.error_lines(), 1) << r.err;
  }
  EXPECT_EQ(run({"shader-build", "a.c", "b.c"}).exit_code, 2);
  EXPECT_EQ(run({"shader-build"}).exit_code, 2);
  EXPECT_EQ(run({"shader-build", "a.c", "b.c", "-o", "both.so"}).exit_code, 0);
  EXPECT_TRUE(offers("both.so", "plain"));
}

}  // namespace shader_build_test
}  // namespace oriel
