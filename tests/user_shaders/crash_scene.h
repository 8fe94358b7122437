// SPDX-License-Identifier: Apache-2.0
// Test support: a scene whose material is a faulty shader in C or C++.
#pragma once

#include "support/program.h"

namespace oriel::testing {

/// fall() crashes.
inline const std::string kCrashHead =
    "#include <shader.h>\n#include <signal.h>\n"
    "static void fall(void) { volatile int *volatile nowhere = 0; *nowhere = 1; }";
/// Shader "fault" without a fault.
inline const std::string kWhiteShader =
    "DLLEXPORT miBoolean fault(miColor *r, miState *state, void *p) {"
    "  r->r = r->g = r->b = r->a = 1; return miTRUE; }";

/// Shader "fault", which does something in a part of the picture.
inline std::string partly_faulty(const std::string& does) {
  return "DLLEXPORT miBoolean fault(miColor *r, miState *state, void *p) {"
         "  if (state->raster_x > 20 && state->raster_y > 12) {" +
         does +
         "}"
         "  r->r = r->g = r->b = r->a = 1; return miTRUE; }";
}

class CrashScene : public ProgramTest {
 protected:
  /// Renders a scene whose material is shader "fault" of the source.
  RunResult rendered(const std::string& source, const std::string& source_file = "fault.c") {
    make_scene(source, source_file);
    return run({"render", "scene.mi", "-o", "a.exr", "--shader-path", ".", "--samples", "2",
                "--threads", "2"});
  }
  void make_scene(const std::string& source, const std::string& source_file = "fault.c") {
    write(source_file, source);
    const RunResult built = run({"shader-build", source_file, "-o", "fault.so"});
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
  static void expect_named(const RunResult& r, const std::string& function,
                           const std::string& did = "crashed") {
    EXPECT_EQ(r.exit_code, 1) << r.err;
    EXPECT_NE(r.err.find("OR-SDK-005"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find("fault.so"), std::string::npos) << r.err;
    EXPECT_NE(r.err.find(did + " in " + function), std::string::npos) << r.err;
  }
};

}  // namespace oriel::testing
