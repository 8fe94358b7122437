// SPDX-License-Identifier: Apache-2.0
// Life cycle of shader libraries from `link` to the last exit: loading, order of calls, errors.

#include <algorithm>

#include "support/program.h"
#include "user_scene.h"

namespace oriel {
namespace life_cycle_test {

using testing::expect_near;
using testing::ShaderFolder;
using testing::UserScene;

const std::string kHead = "#include <shader.h>\n";
const std::string kFlat = kHead +
                          "struct flat { miColor c; };"
                          "DLLEXPORT int flat_version(void) { return 3; }"
                          "DLLEXPORT miBoolean flat(miColor *r, miState *state, struct flat *p) {"
                          "  *r = *mi_eval_color(&p->c); return miTRUE; }";

std::string flat_scene(const std::string& library, const std::string& version = "version 3") {
  return "link \"" + library + "\" declare shader color \"flat\" ( color \"c\" ) " + version +
         " apply material end declare material \"m\" \"flat\" ( \"c\" .1 .2 .3 1 ) end material " +
         UserScene::square("m");
}

std::vector<std::string> lines_of(const std::string& path) {
  std::vector<std::string> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

// acceptance: I4
TEST(LifeCycle, InitComesFirstOnceAndForEachCallThatIsUsedAndExitLast) {
  ShaderFolder folder;
  const std::string log = (folder.path() / "log").string();
  folder.compile("cycle",
                 kHead +
                     "struct cycle { miInteger n; };"
                     "static void say(const char *what, int n) {"
                     "  FILE *f = fopen(getenv(\"ORIEL_TEST_LOG\"), \"a\");"
                     "  fprintf(f, \"%s %d\\n\", what, n); fclose(f); }"
                     "void module_init(void) { say(\"module\", 1); }"
                     "void module_exit(void) { say(\"module\", 0); }"
                     "DLLEXPORT void cycle_init(miState *state, struct cycle *p, miBoolean *each) {"
                     "  say(\"init\", p ? *mi_eval_integer(&p->n) : 0); *each = miTRUE;"
                     "  if (p) { void **user; mi_query(miQ_FUNC_USERPTR, state, 0, &user);"
                     "    *user = mi_mem_strdup(\"mine\"); } }"
                     "DLLEXPORT void cycle_exit(miState *state, struct cycle *p) {"
                     "  say(\"exit\", p ? *mi_eval_integer(&p->n) : 0);"
                     "  if (p) { void **user; mi_query(miQ_FUNC_USERPTR, state, 0, &user);"
                     "    if (*user && strcmp(*user, \"mine\") == 0) say(\"kept\", 1);"
                     "    mi_mem_release(*user); } }"
                     "DLLEXPORT miBoolean cycle(miColor *r, miState *state, struct cycle *p) {"
                     "  if (state->raster_x != 0) say(\"call\", *mi_eval_integer(&p->n));"
                     "  r->r = r->g = r->b = r->a = 1;"
                     "  return miTRUE; }");
  setenv("ORIEL_TEST_LOG", log.c_str(), 1);
  {
    const std::string object =
        "object \"half\" visible shadow trace group 0 -8 1 8 -8 1 8 8 1 0 8 1 v 0 v 1 v 2 v 3 c 0 "
        "1 2 3 end group end object instance \"half_i\" \"half\" material \"m2\" end instance ";
    UserScene scene(folder,
                    "link \"cycle.so\" declare shader color \"cycle\" ( integer \"n\" ) apply "
                    "material end declare material \"m1\" \"cycle\" ( \"n\" 1 ) end material "
                    "material \"m2\" \"cycle\" ( \"n\" 2 ) end material "
                    "material \"m3\" \"cycle\" ( \"n\" 3 ) end material " +
                        object + UserScene::square("m1"),
                    "\"square_i\" \"half_i\"");
    for (const int x : {1, 6, 1}) scene.pixel(x, 4, 1);
  }
  unsetenv("ORIEL_TEST_LOG");
  const std::vector<std::string> said = lines_of(log);
  // The third is nowhere.
  const std::vector<std::string> wanted = {"module 1", "init 0", "init 1",  "call 1", "init 2",
                                           "call 2",   "call 1", "exit 1",  "kept 1", "exit 2",
                                           "kept 1",   "exit 0", "module 0"};
  EXPECT_EQ(said, wanted);
}

/// Two calls "m1" and "m2" of a shader without parameters, side by side: m2 right of the middle.
std::string two_calls(const std::string& shader) {
  return "link \"" + shader + ".so\" declare shader color \"" + shader +
         "\" ( ) apply material end declare material \"m1\" \"" + shader +
         "\" ( ) end material material \"m2\" \"" + shader +
         "\" ( ) end material object \"half\" visible shadow trace group 0 -8 1 8 -8 1 8 8 1 "
         "0 8 1 v 0 v 1 v 2 v 3 c 0 1 2 3 end group end object "
         "instance \"half_i\" \"half\" material \"m2\" end instance " +
         UserScene::square("m1");
}

// acceptance: I4
TEST(LifeCycle, WithoutAskingForEachCallInitComesOnce) {
  ShaderFolder folder;
  folder.compile("once", kHead +
                             "static int calls;"
                             "DLLEXPORT void once_init(miState *state, void *p, miBoolean *each) {"
                             "  ++calls; *each = miFALSE; }"
                             "DLLEXPORT miBoolean once(miColor *r, miState *state, void *p) {"
                             "  r->r = calls; r->g = r->b = r->a = 1; return miTRUE; }");
  UserScene scene(folder, two_calls("once"), "\"square_i\" \"half_i\"");
  for (const int x : {1, 6}) expect_near(scene.pixel(x, 4, 1), Rgb(1), 0);
}

TEST(LifeCycle, EachCallHasPointersOfThreadsOfItsOwn) {
  ShaderFolder folder;
  folder.compile("keep", kHead +
                             "DLLEXPORT miBoolean keep(miColor *r, miState *state, void *p) {"
                             "  void *before = p, *after = NULL, **all = NULL; int n = 0;"
                             "  mi_query(miQ_FUNC_TLS_GET, state, 0, &before);"
                             "  mi_query(miQ_FUNC_TLS_SET, state, 0, &p);"
                             "  mi_query(miQ_FUNC_TLS_GET, state, 0, &after);"
                             "  mi_query(miQ_FUNC_TLS_GETALL, state, 0, &all, &n);"
                             "  r->r = before == NULL; r->g = after == p;"
                             "  r->b = n == 1 && all[0] == p; r->a = 1; return miTRUE; }");
  UserScene scene(folder, two_calls("keep"), "\"square_i\" \"half_i\"");
  for (const int x : {1, 6}) expect_near(scene.pixel(x, 4, 1), Rgb(1), 0);
}

// acceptance: I4
TEST(LifeCycle, AnotherVersionIsAnErrorAndNoneIsTakenAsItIs) {
  ShaderFolder folder;
  folder.compile("flat", kFlat);
  UserScene wrong(folder, flat_scene("flat.so", "version 4"), "\"square_i\"");
  EXPECT_TRUE(wrong.diagnostics.has("OR-SDK-004"));
  EXPECT_NE(wrong.messages().find("shader \"flat\" is declared with version 4, its library has "
                                  "version 3"),
            std::string::npos)
      << wrong.messages();
  expect_near(wrong.pixel(4, 4), Rgb(.1f, .2f, .3f), 1e-6f);
  UserScene none(folder, flat_scene("flat.so", ""), "\"square_i\"");
  EXPECT_EQ(none.messages(), "");
}

// acceptance: I4
TEST(LifeCycle, LibrariesOfOtherSystemsAreFoundByTheirStem) {
  ShaderFolder folder;
  folder.compile("flat", kFlat);
  for (const char* written :
       {"flat.so", "flat.dll", "C:\\\\mray\\\\lib\\\\flat.dll", "/usr/local/mi/flat.so", "flat"}) {
    UserScene scene(folder, flat_scene(written), "\"square_i\"");
    EXPECT_EQ(scene.messages(), "") << written;
    expect_near(scene.pixel(4, 4), Rgb(.1f, .2f, .3f), 1e-6f);
  }
}

// acceptance: I4
TEST(LifeCycle, OnlyTrustedFoldersAreLoadedFrom) {
  const ShaderFolder folder, elsewhere;
  elsewhere.compile("flat", kFlat);
  const std::string path = (elsewhere.path() / "flat.so").string();
  UserScene scene(folder, flat_scene(path), "\"square_i\"");
  EXPECT_TRUE(scene.diagnostics.has("OR-SDK-001")) << scene.messages();
  EXPECT_NE(scene.messages().find("--shader-path"), std::string::npos) << scene.messages();
  EXPECT_TRUE(scene.host->libraries().empty());
}

// acceptance: I4
TEST(LifeCycle, AMissingFunctionIsNamed) {
  ShaderFolder folder;
  folder.compile("flat", kFlat +
                             "extern int mi_no_such_thing(miState *);"
                             "DLLEXPORT int flat_more(miState *state) {"
                             "  return mi_no_such_thing(state); }");
  UserScene scene(folder, flat_scene("flat.so"), "\"square_i\"");
  EXPECT_TRUE(scene.diagnostics.has("OR-SDK-003"));
  EXPECT_NE(scene.messages().find("mi_no_such_thing"), std::string::npos) << scene.messages();
  EXPECT_EQ(scene.messages().find("mi_phen_eval"), std::string::npos) << scene.messages();
}

// acceptance: I4
TEST(LifeCycle, LibrariesForOtherMachinesAreRefused) {
  ShaderFolder folder;
  folder.compile("flat", kFlat);
  const auto library = folder.path() / "flat.so";
  {
    std::fstream file(library, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(18);              // e_machine of an ELF header
    file.put('\x14').put('\0');  // PowerPC
  }
  UserScene foreign(folder, flat_scene("flat.so"), "\"square_i\"");
  EXPECT_TRUE(foreign.diagnostics.has("OR-SDK-002"));
  EXPECT_NE(foreign.messages().find("another processor"), std::string::npos) << foreign.messages();
  std::ofstream(library) << "MZ, as libraries of another system begin";
  UserScene windows(folder, flat_scene("flat.so"), "\"square_i\"");
  EXPECT_TRUE(windows.diagnostics.has("OR-SDK-002"));
  EXPECT_NE(windows.messages().find("not a shared library of this system"), std::string::npos);
}

class CrashingShader : public ProgramTest {};

// acceptance: I4
TEST_F(CrashingShader, EndsTheFrameWithItsNameAndThePictureSoFar) {
  write("crash.c", kHead +
                       "DLLEXPORT miBoolean crash(miColor *r, miState *state, void *p) {"
                       "  if (state->raster_x > 20 && state->raster_y > 12) {"
                       "    volatile int *volatile nowhere = NULL; *nowhere = 1; }"
                       "  r->r = r->g = r->b = r->a = 1; return miTRUE; }");
  ASSERT_EQ(run({"shader-build", "crash.c", "-o", "crash.so"}).exit_code, 0);
  std::string scene = small_scene();
  const std::string material =
      "\"mia_material_x\" ( \"diffuse\" .5 .5 .5, \"reflectivity\" .2, "
      "\"refl_gloss\" .6 )";
  scene.replace(scene.find(material), material.size(), "\"crash\" ( )");
  write(
      "scene.mi",
      "link \"crash.so\" declare shader color \"crash\" ( ) apply material end declare\n" + scene);
  const RunResult r =
      run({"render", "scene.mi", "-o", "a.exr", "--shader-path", ".", "--samples", "2"});
  EXPECT_EQ(r.exit_code, 1) << r.err;
  EXPECT_NE(r.err.find("shader \"crash\" crashed"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("OR-SDK-005"), std::string::npos) << r.err;
  EXPECT_TRUE(std::filesystem::exists(file("a.exr")));
}

}  // namespace life_cycle_test
}  // namespace oriel
