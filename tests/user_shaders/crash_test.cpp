// SPDX-License-Identifier: Apache-2.0
// A crash in any function of a library is reported with the name of the function, and the program
// exits with an error code.
#include "../cli/program.h"

namespace oriel {
namespace crash_test {

const std::string kHead =
    "#include <shader.h>\n#include <signal.h>\n"
    "static void fall(void) { volatile int *volatile nowhere = 0; *nowhere = 1; }";
const std::string kShader =
    "DLLEXPORT miBoolean fault(miColor *r, miState *state, void *p) {"
    "  r->r = r->g = r->b = r->a = 1; return miTRUE; }";

class UserCrashes : public ProgramTest {
 protected:
  /// Renders a scene whose material is shader "fault" of the source.
  RunResult rendered(const std::string& source) {
    write("fault.c", source);
    const RunResult built = run({"shader-build", "fault.c", "-o", "fault.so"});
    EXPECT_EQ(built.exit_code, 0) << built.err;
    std::string scene = small_scene();
    const std::string material =
        "\"mia_material_x\" ( \"diffuse\" .5 .5 .5, \"reflectivity\" .2, "
        "\"refl_gloss\" .6 )";
    scene.replace(scene.find(material), material.size(), "\"fault\" ( )");
    write("scene.mi",
          "link \"fault.so\" declare shader color \"fault\" ( ) apply material end declare\n" +
              scene);
    return run({"render", "scene.mi", "-o", "a.exr", "--shader-path", ".", "--samples", "2",
                "--threads", "2"});
  }
  static void expect_named(const RunResult& r, const std::string& function) {
    EXPECT_EQ(r.exit_code, 1) << r.err;
    EXPECT_NE(r.err.find("OR-SDK-005"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("fault.so"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("crashed in " + function), std::string::npos) << r.err;
  }
};

TEST_F(UserCrashes, OfInitFunctionsAreNamed) {
  const RunResult r = rendered(kHead + kShader +
                               "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {"
                               "  fall(); }");
  expect_named(r, "fault_init");
  EXPECT_NE(r.err.find("shader \"fault\""), std::string::npos) << r.err;
}

TEST_F(UserCrashes, OfInitFunctionsOfACallAreNamed) {
  expect_named(rendered(kHead + kShader +
                        "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {"
                        "  if (e) *e = miTRUE; if (p) fall(); }"),
               "fault_init");
}

TEST_F(UserCrashes, OfExitFunctionsAreNamedAndThePictureIsThere) {
  expect_named(rendered(kHead + kShader +
                        "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {}"
                        "DLLEXPORT void fault_exit(miState *s, void *p) { fall(); }"),
               "fault_exit");
  EXPECT_TRUE(std::filesystem::exists(file("a.exr")));
}

TEST_F(UserCrashes, OfVersionFunctionsAreNamed) {
  expect_named(rendered(kHead + kShader +
                        "DLLEXPORT int fault_version(void) {"
                        "  fall(); return 1; }"),
               "fault_version");
}

TEST_F(UserCrashes, OfModulesAreNamed) {
  expect_named(rendered(kHead + kShader + "DLLEXPORT void module_init(void) { fall(); }"),
               "module_init");
  expect_named(rendered(kHead + kShader + "DLLEXPORT void module_exit(void) { fall(); }"),
               "module_exit");
}

const std::string kHandler =
    "static void leave(int n) { _exit(0); }"
    "static void keep(void) { signal(SIGSEGV, leave); }";
const std::string kFaulty =
    "DLLEXPORT miBoolean fault(miColor *r, miState *state, void *p) {"
    "  if (state->raster_x > 20 && state->raster_y > 12) fall();"
    "  r->r = r->g = r->b = r->a = 1; return miTRUE; }";

TEST_F(UserCrashes, ALibrarysOwnHandlerOfSignalsDoesNotHideThem) {
  for (const char* installs :
       {"DLLEXPORT void module_init(void) { keep(); }",
        "static __attribute__((constructor)) void loaded(void) { keep(); }",
        "DLLEXPORT int fault_version(void) { keep(); return 1; }",
        "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) { keep(); }"}) {
    const RunResult r = rendered("#include <unistd.h>\n" + kHead + kHandler + installs + kFaulty);
    expect_named(r, "fault");
    EXPECT_TRUE(std::filesystem::exists(file("a.exr"))) << installs;
    std::filesystem::remove(file("a.exr"));
  }
}

TEST_F(UserCrashes, AShaderThatEndsTheProgramIsNamed) {
  const RunResult r = rendered(kHead +
                               "DLLEXPORT miBoolean fault(miColor *r, miState *state, void *p) {"
                               "  exit(0); }");
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("shader \"fault\" ended the program in fault of fault.so"),
            std::string::npos)
      << r.err;
}

}  // namespace crash_test
}  // namespace oriel
