// SPDX-License-Identifier: Apache-2.0
// Crashes of libraries: wherever they happen, the message names the function and the program fails.
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
    make_scene(source);
    return run({"render", "scene.mi", "-o", "a.exr", "--shader-path", ".", "--samples", "2",
                "--threads", "2"});
  }
  void make_scene(const std::string& source) {
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

/// Shader "fault", which does something in a part of the picture.
std::string faulty(const std::string& does) {
  return "DLLEXPORT miBoolean fault(miColor *r, miState *state, void *p) {"
         "  if (state->raster_x > 20 && state->raster_y > 12) {" +
         does +
         "}"
         "  r->r = r->g = r->b = r->a = 1; return miTRUE; }";
}

TEST_F(UserCrashes, AStackOverflowIsNamedAndThePictureIsThere) {
  const RunResult r = rendered(kHead +
                               "static int deep(int n) {"
                               "  volatile char room[500]; room[n % 500] = (char)n;"
                               "  return deep(n + 1) + room[n % 499]; }" +
                               faulty("r->g = deep((int)state->raster_x);"));
  expect_named(r, "fault");
  EXPECT_NE(r.err.find("(stack overflow)"), std::string::npos) << r.err;
  EXPECT_TRUE(std::filesystem::exists(file("a.exr")));
}

TEST_F(UserCrashes, AShaderThatEndsTheProgramIsNamedAndThePictureIsThere) {
  for (const char* ends : {"exit(0);", "_exit(0);", "_Exit(0);", "quick_exit(0);"}) {
    const RunResult r =
        rendered("#include <stdlib.h>\n#include <unistd.h>\n" + kHead + faulty(ends));
    EXPECT_EQ(r.exit_code, 1) << ends << r.err;
    EXPECT_NE(r.err.find("shader \"fault\" ended the program in fault of fault.so"),
              std::string::npos)
        << ends << r.err;
    EXPECT_TRUE(std::filesystem::exists(file("a.exr"))) << ends;
    std::filesystem::remove(file("a.exr"));
  }
}

TEST_F(UserCrashes, AHandlerThatAShaderInstallsAtTheLastMomentDoesNotHideThem) {
  const RunResult r =
      rendered("#include <unistd.h>\n" + kHead + kHandler + faulty("keep(); fall();"));
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("shader \"fault\" ended the program"), std::string::npos) << r.err;
  EXPECT_TRUE(std::filesystem::exists(file("a.exr")));
}

TEST_F(UserCrashes, AThreadOfALibraryThatEndsTheProgramIsReported) {
  const RunResult r =
      rendered("#include <unistd.h>\n#include <pthread.h>\n" + kHead +
               "static void *leave(void *p) { _exit(0); }" +
               faulty("pthread_t t; pthread_create(&t, 0, leave, 0); pthread_join(t, 0);"));
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("the shader library fault.so ended the program"), std::string::npos)
      << r.err;
}

TEST_F(UserCrashes, AChildProcessOfAShaderMayEnd) {
  const RunResult r =
      rendered("#include <unistd.h>\n#include <sys/wait.h>\n" + kHead +
               "DLLEXPORT miBoolean fault(miColor *r, miState *state, void *p) {"
               "  r->r = r->g = r->b = r->a = 1; return miTRUE; }"
               "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {"
               "  int status = 0; pid_t child = fork(); if (child == 0) _exit(7);"
               "  waitpid(child, &status, 0); if (WEXITSTATUS(status) != 7) fall(); }");
  EXPECT_EQ(r.exit_code, 0) << r.err;
}

TEST_F(UserCrashes, OfStaticConstructorsNameTheLibrary) {
  const RunResult r = rendered(kHead + kShader +
                               "static __attribute__((constructor)) void loaded(void) { fall(); }");
  expect_named(r, "a static constructor");
}

TEST_F(UserCrashes, OfStaticDestructorsNameTheLibrary) {
  const RunResult r = rendered(kHead + kShader +
                               "static __attribute__((destructor)) void closed(void) { fall(); }");
  expect_named(r, "a static destructor");
  EXPECT_TRUE(std::filesystem::exists(file("a.exr")));
}

TEST_F(UserCrashes, AreReportedByEveryCommandThatRunsShaders) {
  make_scene(kHead + faulty("fall();"));
  expect_named(run({"explain", "scene.mi", "--shader-path", ".", "--pixel", "30,4"}), "fault");
  expect_named(run({"measure", "scene.mi", "--shader-path", ".", "--pixel", "30,4"}), "fault");
  make_scene(kHead + kShader + "DLLEXPORT int fault_version(void) { fall(); return 1; }");
  const RunResult checked = run({"check", "scene.mi", "--shader-path", "."});
  EXPECT_EQ(checked.exit_code, 0) << checked.err;  // the scene renders, without the shader
  EXPECT_NE(checked.err.find("crashed in fault_version of fault.so"), std::string::npos)
      << checked.err;
  make_scene(kHead + faulty("fall();"));
  EXPECT_EQ(run({"check", "scene.mi", "--shader-path", ".", "--report", "a.html"}).exit_code, 0);
  EXPECT_NE(text_of(file("a.html")).find("crashed in fault of fault.so"), std::string::npos);
}

TEST_F(UserCrashes, MeasureRunsExitFunctions) {
  make_scene(kHead + kShader +
             "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {}"
             "DLLEXPORT void fault_exit(miState *s, void *p) { mi_warning(\"the end\"); }");
  const RunResult r =
      run({"measure", "scene.mi", "--shader-path", ".", "--pixel", "30,20", "--json"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE((r.out + r.err).find("the end"), std::string::npos) << r.out << r.err;
}

}  // namespace crash_test
}  // namespace oriel
