// SPDX-License-Identifier: Apache-2.0
// Messages of `oriel render` about missing or unloadable libraries.
#include "support/program.h"

namespace oriel {
namespace load_failures_test {

const std::string kHead = "#include <shader.h>\n";

class LoadFailure : public ProgramTest {
 protected:
  void compile(const std::string& name, const std::string& text,
               const std::string& more = "") const {
    write(name + ".c", kHead + text);
    const std::string command = "cd '" + file(".") + "' && cc -std=gnu99 -shared -fPIC -I '" +
                                ORIEL_SOURCE_DIR "/include/oriel/sdk' -o " + name + ".so " + name +
                                ".c " + more;
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  RunResult render(const std::string& link, const std::string& options, const std::string& camera) {
    write("scene.mi", link + small_scene(options, camera));
    std::filesystem::remove(file("a.png"));
    return run({"render", "scene.mi", "-o", "a.png", "--shader-path", ".", "--samples", "1"});
  }
  bool has_picture() const { return std::filesystem::exists(file("a.png")); }
  static int count(const std::string& text, const std::string& part) {
    int n = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++n;
    return n;
  }
};

const std::string kDeclared =
    "link \"away.so\" declare shader color \"away\" ( scalar \"s\" ) end declare\n";

class MissingRoles : public LoadFailure {};

// acceptance: I4
TEST_F(MissingRoles, AreNamedAndThePictureIsSavedWithAnExitCode) {
  struct Case {
    const char *role, *options, *camera;
  };
  for (const Case& c : {Case{"lens", "", "lens \"away\" ( \"s\" 1 )"},
                        Case{"output", "", "output \"+rgba\" \"away\" ( \"s\" 1 )"},
                        Case{"state", "state \"away\" ( \"s\" 1 )", ""}}) {
    const RunResult r = render(kDeclared, c.options, c.camera);
    EXPECT_EQ(r.exit_code, 1) << c.role << r.err;
    EXPECT_NE(r.err.find(std::string("the ") + c.role + " shader \"away\" is missing"),
              std::string::npos)
        << r.err;
    EXPECT_NE(r.err.find("away.so is missing"), std::string::npos) << r.err;
    EXPECT_EQ(count(r.err, "OR-SDK-006"), 1) << r.err;
    EXPECT_TRUE(has_picture()) << c.role;
  }
  const RunResult checked = run({"check", "scene.mi"});
  EXPECT_NE((checked.out + checked.err).find("OR-SDK-006"), std::string::npos) << checked.out;
  // A named shader, too.
  const RunResult named =
      render(kDeclared + "shader \"l\" \"away\" ( \"s\" 1 )\n", "", "lens = \"l\"");
  EXPECT_EQ(named.exit_code, 1) << named.err;
  EXPECT_NE(named.err.find("the lens shader \"away\" is missing"), std::string::npos) << named.err;
}

TEST_F(MissingRoles, ALibraryThatNoRoleNeedsIsANote) {
  const RunResult r = render(kDeclared, "", "");
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_NE(r.err.find("OR-SDK-001"), std::string::npos) << r.err;
  EXPECT_EQ(count(r.err, "OR-SDK-006"), 0) << r.err;
}

// acceptance: I4
TEST_F(LoadFailure, NamesTheSymbolAndWhatToDo) {
  compile("asks",
          "int mi_made_up(void); int helper_of(void);\n"
          "int asks(void) { return mi_made_up() + helper_of(); }\n");
  RunResult r = render("link \"asks.so\"\n", "", "");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_TRUE(has_picture());
  EXPECT_EQ(count(r.err, "OR-SDK-003"), 1) << r.err;
  EXPECT_NE(r.err.find("functions that Oriel does not provide: mi_made_up"), std::string::npos)
      << r.err;
  EXPECT_NE(r.err.find("docs/c-interface-functions.md"), std::string::npos) << r.err;

  compile("lacks",
          "int helper_of(void); int helper(void) { return 0; }\n"
          "int lacks(void) { return helper_of(); }\n");
  r = render("link \"lacks.so\"\n", "", "");
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("it requires helper_of, which no library defines"), std::string::npos)
      << r.err;
  EXPECT_NE(r.err.find("--helper PATH"), std::string::npos) << r.err;

  compile("base", "int base_of(void) { return 1; }\n");
  compile("needs", "int base_of(void); int needs(void) { return base_of(); }\n", "./base.so");
  std::filesystem::remove(file("base.so"));
  r = render("link \"needs.so\"\n", "", "");
  EXPECT_NE(r.err.find("base.so: cannot open shared object file"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("LD_LIBRARY_PATH"), std::string::npos) << r.err;
}

TEST_F(LoadFailure, OtherMachinesAreNamed) {
  compile("flat", "int flat(void) { return 1; }\n");
  {
    std::fstream library(file("flat.so"), std::ios::in | std::ios::out | std::ios::binary);
    library.seekp(4);  // the class of an ELF file
    library.put('\x01');
  }
  const RunResult bits = render("link \"flat.so\"\n", "", "");
  EXPECT_EQ(bits.exit_code, 1);
  EXPECT_NE(bits.err.find("built for a 32-bit processor"), std::string::npos) << bits.err;
  EXPECT_NE(bits.err.find("oriel shader-build"), std::string::npos) << bits.err;
  write("flat.so", "MZ, as libraries of another system begin");
  const RunResult windows = render("link \"flat.so\"\n", "", "");
  EXPECT_NE(windows.err.find("it is a Windows library"), std::string::npos) << windows.err;
}

}  // namespace load_failures_test
}  // namespace oriel
