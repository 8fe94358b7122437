// SPDX-License-Identifier: Apache-2.0
// Functions of libraries that do not return: a signal or the time limit ends them, and the picture
// so far is written.
#include "crash_scene.h"

namespace oriel {
namespace hang_test {

using testing::kCrashHead;
using testing::kWhiteShader;
using testing::partly_faulty;

const std::string kHang =
    "#include <unistd.h>\n#include <shader.h>\n"
    "static void hang(void) { volatile int n = 0; for (;;) ++n; }";

class UserHangs : public testing::CrashScene {
 protected:
  /// Sends SIGINT after the message "begun" of the library.
  RunResult interrupted(const std::string& source) {
    make_scene(source);
    write("stderr.txt", "");
    const pid_t child = start({"render", "scene.mi", "-o", "a.exr", "--shader-path", ".",
                               "--samples", "2", "--threads", "2"});
    for (int i = 0; i < 1500 && !std::filesystem::exists(file("begun")); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    kill(child, SIGINT);
    const RunResult r = finish(child);
    std::filesystem::remove(file("begun"));
    return r;
  }
  static void expect_interrupted(const RunResult& r, const std::string& function) {
    EXPECT_EQ(r.exit_code, 1) << r.err;
    EXPECT_NE(r.err.find("OR-SDK-005"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("did not return and was interrupted in " + function), std::string::npos)
        << r.err;
    EXPECT_NE(r.err.find("fault.so"), std::string::npos) << r.err;
  }
};

const std::string kBegun =
    "\n#include <stdio.h>\nstatic void begun(void) { fclose(fopen(\"begun\", \"w\")); }";

// acceptance: Z8
TEST_F(UserHangs, InAShaderAreEndedByASignalWithThePicture) {
  for (const char* hangs : {"hang();", "for (;;) pause();"}) {
    const RunResult r =
        interrupted(kHang + kBegun + partly_faulty(std::string("begun();") + hangs));
    expect_interrupted(r, "fault of");
    EXPECT_TRUE(std::filesystem::exists(file("a.exr"))) << r.err;
    std::filesystem::remove(file("a.exr"));
  }
}

TEST_F(UserHangs, InALoopOfRaysAreEnded) {
  const RunResult r = interrupted(kHang + kBegun +
                                  partly_faulty("miVector up = {0, 1, 0}; begun();"
                                                "for (;;) mi_trace_environment(r, state, &up);"));
  expect_interrupted(r, "fault of");
  EXPECT_TRUE(std::filesystem::exists(file("a.exr"))) << r.err;
}

TEST_F(UserHangs, InAShaderAreEndedByTheTimeLimitWithThePicture) {
  make_scene(kHang + partly_faulty("hang();"));
  const RunResult r = run({"render", "scene.mi", "-o", "a.exr", "--shader-path", ".", "--time",
                           ".5", "--threads", "2"});
  expect_interrupted(r, "fault of");
  EXPECT_TRUE(std::filesystem::exists(file("a.exr"))) << r.err;
}

// The other thread waits for the init function.
TEST_F(UserHangs, InInitFunctionsAreEnded) {
  expect_interrupted(interrupted(kHang + kBegun + kWhiteShader +
                                 "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {"
                                 "  begun(); hang(); }"),
                     "fault_init");
}

TEST_F(UserHangs, InFunctionsOfTheLibraryAreEnded) {
  expect_interrupted(interrupted(kHang + kBegun + kWhiteShader +
                                 "DLLEXPORT void module_init(void) { begun(); hang(); }"),
                     "module_init");
  expect_interrupted(interrupted(kHang + kBegun + kWhiteShader +
                                 "DLLEXPORT void module_exit(void) { begun(); hang(); }"),
                     "module_exit");
  expect_interrupted(
      interrupted(kHang + kBegun + kWhiteShader +
                  "static __attribute__((constructor)) void made(void) { begun(); hang(); }"),
      "a static constructor");
}

TEST_F(UserHangs, InExitFunctionsAreEndedAfterThePicture) {
  const RunResult r =
      interrupted(kHang + kBegun + kWhiteShader +
                  "DLLEXPORT void fault_init(miState *s, void *p, miBoolean *e) {}"
                  "DLLEXPORT void fault_exit(miState *s, void *p) { begun(); hang(); }");
  expect_interrupted(r, "fault_exit");
  EXPECT_TRUE(std::filesystem::exists(file("a.exr"))) << r.err;
}

}  // namespace hang_test
}  // namespace oriel
