// SPDX-License-Identifier: Apache-2.0
// Every name that the C interface offers compiles in the oldest standards of both languages, and
// libraries that use all of them link: functions of functions.txt, other names of names/names.txt.
#include "coverage_table.h"
#include "support/program.h"

namespace oriel {
namespace names_test {

namespace fs = std::filesystem;

const fs::path kSource = ORIEL_SOURCE_DIR;
const std::string kIncludes =
    "#include <shader.h>\n#include <geoshader.h>\n#include <mayaapi.h>\n"
    "#include <mia_material_api.h>\n";

class SdkNames : public ProgramTest {
 protected:
  /// Compiles a source in both languages into one library each.
  void expect_builds(const std::string& group, const std::string& source, bool c = true) {
    SCOPED_TRACE(group);
    if (c) {
      write(group + ".c", source);
      const RunResult r = run(
          {"shader-build", group + ".c", "-o", group + "_c.so", "--std=gnu89", "--flag=-pedantic"});
      EXPECT_EQ(r.exit_code, 0) << r.err;
      EXPECT_TRUE(fs::exists(file(group + "_c.so"))) << r.err;
    }
    write(group + ".cpp", source);
    const RunResult r = run({"shader-build", group + ".cpp", "-o", group + "_cpp.so", "--std=c++98",
                             "--flag=-pedantic", "--flag=-fno-permissive"});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    EXPECT_TRUE(fs::exists(file(group + "_cpp.so"))) << r.err;
  }
};

/// Mentions of functions and macros by header. A function's address makes the library need it.
std::map<std::string, std::string> mentions_of_functions() {
  std::map<std::string, std::string> groups, addresses;
  for (const auto& one : functions_test::offered_functions(kSource / "include/oriel/sdk")) {
    const std::string group = fs::path(one.header).stem();
    if (one.kind == "macro")
      groups[group] += "#ifndef " + one.name + "\n#error " + one.name + " is no macro\n#endif\n";
    else
      addresses[group] += "  (any_function)" + one.name + ",\n";
  }
  for (const auto& [group, list] : addresses)
    groups[group] += "typedef void (*any_function)(void);\nany_function all_of_" + group +
                     "[] = {\n" + list + "  0};\n";
  return groups;
}

/// Declarations that only compile where each name of the list is what the list says, by kind.
std::map<std::string, std::string> mentions_of_names() {
  std::map<std::string, std::string> groups;
  int n = 0;
  for (functions_test::NameLine& line : functions_test::name_lines()) {
    const std::string number = std::to_string(++n);
    std::string& text = groups[line.kind];
    if (line.kind == "type" || line.kind == "constant")
      text += "char n" + number + "[sizeof(" + line.name + ") ? 1 : -1];\n";
    else if (line.kind == "member")
      text +=
          "char n" + number + "[sizeof(((" + line.name + "*)0)->" + line.more + ") ? 1 : -1];\n";
    else
      text += line.name + "* n" + number + ";\n";
  }
  return groups;
}

// acceptance: I4
TEST_F(SdkNames, AllFunctionsCompileInTheOldestStandardsAndLink) {
  const auto groups = mentions_of_functions();
  EXPECT_GT(groups.size(), 30u);
  for (const auto& [group, text] : groups) expect_builds(group, kIncludes + text);
}

// acceptance: I4
TEST_F(SdkNames, AllTypesConstantsAndMembersCompileInTheOldestStandards) {
  const auto groups = mentions_of_names();
  EXPECT_EQ(groups.size(), 5u) << "kinds of names";
  for (const auto& [kind, text] : groups)
    expect_builds(kind + "_names", kIncludes + text, kind != "class");
}

}  // namespace names_test
}  // namespace oriel
