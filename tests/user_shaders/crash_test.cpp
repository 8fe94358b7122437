// SPDX-License-Identifier: Apache-2.0
// A crash in any function of a library is reported with the name of the function, and the program
// exits with an error code.
#include "crash_scene.h"

namespace oriel {
namespace crash_test {

using testing::kWhiteShader;
using testing::partly_faulty;
const std::string kHead = testing::kCrashHead;

using UserCrashes = testing::CrashScene;

// acceptance: Z8
TEST_F(UserCrashes, OfInitFunctionsAreNamed) {
  const RunResult r = rendered(kHead + kWhiteShader +
                               "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {"
                               "  fall(); }");
  expect_named(r, "fault_init");
  EXPECT_NE(r.err.find("shader \"fault\""), std::string::npos) << r.err;
}

TEST_F(UserCrashes, OfInitFunctionsOfACallAreNamed) {
  expect_named(rendered(kHead + kWhiteShader +
                        "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {"
                        "  if (e) *e = miTRUE; if (p) fall(); }"),
               "fault_init");
}

TEST_F(UserCrashes, OfExitFunctionsAreNamedAndThePictureIsThere) {
  expect_named(rendered(kHead + kWhiteShader +
                        "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {}"
                        "DLLEXPORT void fault_exit(miState *s, void *p) { fall(); }"),
               "fault_exit");
  EXPECT_TRUE(std::filesystem::exists(file("a.exr")));
}

TEST_F(UserCrashes, OfVersionFunctionsAreNamed) {
  expect_named(rendered(kHead + kWhiteShader +
                        "DLLEXPORT int fault_version(void) {"
                        "  fall(); return 1; }"),
               "fault_version");
}

TEST_F(UserCrashes, OfModulesAreNamed) {
  expect_named(rendered(kHead + kWhiteShader + "DLLEXPORT void module_init(void) { fall(); }"),
               "module_init");
  expect_named(rendered(kHead + kWhiteShader + "DLLEXPORT void module_exit(void) { fall(); }"),
               "module_exit");
}

const std::string kHandler =
    "static void leave(int n) { _exit(0); }"
    "static void keep(void) { signal(SIGSEGV, leave); }";
const std::string kFaulty = partly_faulty("fall();");

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

TEST_F(UserCrashes, AStackOverflowIsNamedAndThePictureIsThere) {
  const RunResult r = rendered(kHead +
                               "static int deep(int n) {"
                               "  volatile char room[500]; room[n % 500] = (char)n;"
                               "  return deep(n + 1) + room[n % 499]; }" +
                               partly_faulty("r->g = deep((int)state->raster_x);"));
  expect_named(r, "fault");
  EXPECT_NE(r.err.find("(stack overflow)"), std::string::npos) << r.err;
  EXPECT_TRUE(std::filesystem::exists(file("a.exr")));
}

TEST_F(UserCrashes, ExceptionsAreNamedWithTheirTextAndThePictureIsThere) {
  const std::string head = "#include <shader.h>\n#include <stdexcept>\n";
  const std::string thrown = "throw std::runtime_error(\"no table\");";
  const std::string shader = "extern \"C\" " + kWhiteShader;
  const RunResult called = rendered(head + "extern \"C\" " + partly_faulty(thrown), "fault.cpp");
  expect_named(called, "fault of fault.so (no table)", "threw an exception");
  EXPECT_TRUE(std::filesystem::exists(file("a.exr")));
  for (const std::string function :
       {"void module_init(void)", "void module_exit(void)", "int fault_version(void)",
        "void fault_init(miState*, void*, miBoolean*)"}) {
    const RunResult r = rendered(
        head + shader + "extern \"C\" DLLEXPORT " + function + " {" + thrown + "}", "fault.cpp");
    const std::size_t name = function.find(' ') + 1;
    expect_named(r, function.substr(name, function.find('(') - name), "threw an exception");
  }
  // The loader of the system ends the program.
  const RunResult loaded =
      rendered(head + shader + "static struct Made { Made() { throw 1; } } made;", "fault.cpp");
  expect_named(loaded, "a static constructor");
}

TEST_F(UserCrashes, AShaderThatEndsTheProgramIsNamedAndThePictureIsThere) {
  for (const char* ends : {"exit(0);", "_exit(0);", "_Exit(0);", "quick_exit(0);"}) {
    const RunResult r =
        rendered("#include <stdlib.h>\n#include <unistd.h>\n" + kHead + partly_faulty(ends));
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
      rendered("#include <unistd.h>\n" + kHead + kHandler + partly_faulty("keep(); fall();"));
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("shader \"fault\" ended the program"), std::string::npos) << r.err;
  EXPECT_TRUE(std::filesystem::exists(file("a.exr")));
}

TEST_F(UserCrashes, AThreadOfALibraryThatEndsTheProgramIsReported) {
  const RunResult r =
      rendered("#include <unistd.h>\n#include <pthread.h>\n" + kHead +
               "static void *leave(void *p) { _exit(0); }" +
               partly_faulty("pthread_t t; pthread_create(&t, 0, leave, 0); pthread_join(t, 0);"));
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
  const RunResult r = rendered(kHead + kWhiteShader +
                               "static __attribute__((constructor)) void loaded(void) { fall(); }");
  expect_named(r, "a static constructor");
}

TEST_F(UserCrashes, OfStaticDestructorsNameTheLibrary) {
  const RunResult r = rendered(kHead + kWhiteShader +
                               "static __attribute__((destructor)) void closed(void) { fall(); }");
  expect_named(r, "a static destructor");
  EXPECT_TRUE(std::filesystem::exists(file("a.exr")));
}

TEST_F(UserCrashes, AreReportedByEveryCommandThatRunsShaders) {
  make_scene(kHead + partly_faulty("fall();"));
  expect_named(run({"explain", "scene.mi", "--shader-path", ".", "--pixel", "30,4"}), "fault");
  expect_named(run({"measure", "scene.mi", "--shader-path", ".", "--pixel", "30,4"}), "fault");
  make_scene(kHead + kWhiteShader + "DLLEXPORT int fault_version(void) { fall(); return 1; }");
  const RunResult checked = run({"check", "scene.mi", "--shader-path", "."});
  EXPECT_EQ(checked.exit_code, 0) << checked.err;  // the scene renders, without the shader
  EXPECT_NE(checked.err.find("crashed in fault_version of fault.so"), std::string::npos)
      << checked.err;
  make_scene(kHead + partly_faulty("fall();"));
  EXPECT_EQ(run({"check", "scene.mi", "--shader-path", ".", "--report", "a.html"}).exit_code, 0);
  EXPECT_NE(text_of(file("a.html")).find("crashed in fault of fault.so"), std::string::npos);
}

TEST_F(UserCrashes, MeasureRunsExitFunctions) {
  make_scene(kHead + kWhiteShader +
             "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {}"
             "DLLEXPORT void fault_exit(miState *s, void *p) { mi_warning(\"the end\"); }");
  const RunResult r =
      run({"measure", "scene.mi", "--shader-path", ".", "--pixel", "30,20", "--json"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE((r.out + r.err).find("the end"), std::string::npos) << r.out << r.err;
}

}  // namespace crash_test
}  // namespace oriel
