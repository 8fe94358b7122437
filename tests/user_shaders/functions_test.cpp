// SPDX-License-Identifier: Apache-2.0
// Every function that the C interface offers is called by a shader in functions/, in a context that
// it is meant for, and answers as it should. docs/c-interface-functions.md is made from it:
// ORIEL_UPDATE=1 user_shaders_tests --gtest_filter=SdkCoverage.*
#include <map>
#include <set>
#include <sstream>

#include "../cli/program.h"

namespace oriel {
namespace functions_test {

namespace fs = std::filesystem;

const fs::path kSource = ORIEL_SOURCE_DIR;
const fs::path kTable = kSource / "docs/c-interface-functions.md";
const fs::path kHeaders = kSource / "include/oriel/sdk";

struct Offered {
  std::string name, header, kind;
};

std::vector<Offered> offered() {
  std::vector<Offered> all;
  std::ifstream file(kHeaders / "functions.txt");
  for (std::string line; std::getline(file, line);) {
    Offered one;
    if (line.empty() || line[0] == '#') continue;
    std::istringstream(line) >> one.name >> one.header >> one.kind;
    all.push_back(one);
  }
  return all;
}

/// What shaders said of one function.
struct Covered {
  std::set<std::string> examples;  ///< source files
  int right = 0;
  std::string wrong;  ///< places
};

class SdkCoverage : public ProgramTest {
 protected:
  void SetUp() override {
    fs::copy(kSource / "tests/user_shaders/functions", file("functions"));
    const RunResult built = run({"shader-build", "functions", "--flag=-Wall",
                                 "--flag=-Wno-unused-parameter", "--flag=-Wno-unused-function"});
    ASSERT_EQ(built.exit_code, 0) << built.err;
    EXPECT_EQ(built.err, "");
    setenv("ORIEL_COVERAGE", file("covered.txt").c_str(), 1);
  }
  void TearDown() override { unsetenv("ORIEL_COVERAGE"); }

  RunResult render(const std::string& scene) {
    return run({"render", "functions/" + scene + ".mi", "--shader-path", ".", "--samples", "1",
                "--threads", "1", "-o", scene + ".png"});
  }

  /// Renders a scene whose shaders shall not have anything to say but the expected.
  std::string expect_rendered(const std::string& scene) {
    const RunResult r = render(scene);
    EXPECT_EQ(r.exit_code, 0) << scene << ":\n" << r.err;
    EXPECT_EQ(r.err.find("OR-SDK-00"), std::string::npos) << scene << ":\n" << r.err;
    return r.err;
  }

  std::map<std::string, Covered> covered() const {
    std::map<std::string, Covered> all;
    std::ifstream told(file("covered.txt"));
    std::string name, example, line, answer;
    while (told >> name >> example >> line >> answer) {
      Covered& c = all[name];
      c.examples.insert(example);
      if (answer == "right")
        ++c.right;
      else if (c.wrong.find(example + ":" + line) == std::string::npos)
        c.wrong += " " + example + ":" + line;
    }
    return all;
  }

  /// Messages have no answer: the shader says them, the program shows them.
  void expect_messages(const std::string& shown) {
    std::ofstream told(file("covered.txt"), std::ios::app);
    for (const char* name : {"mi_error", "mi_warning", "mi_info", "mi_progress", "mi_debug",
                             "mi_vdebug", "mi_nerror", "mi_nwarning"}) {
      const bool there = shown.find(std::string("covered: ") + name) != std::string::npos;
      told << name << " memory.c 0 " << (there ? "right" : "wrong") << "\n";
    }
  }

  /// Renders with each of the ways to stop.
  void expect_stops() {
    const std::string text = text_of(file("functions/stop.mi"));
    for (const char* way : {"0", "1", "2"}) {
      std::string scene = text;
      const std::string written = "\"way\" 0";
      scene.replace(scene.find(written), written.size(), std::string("\"way\" ") + way);
      write("functions/stop_now.mi", scene);
      const RunResult r = render("stop_now");
      EXPECT_TRUE(fs::exists(file("stop_now.png"))) << "the picture so far is kept: " << r.err;
      fs::remove(file("stop_now.png"));
      if (*way != '0') {
        EXPECT_NE(r.err.find(*way == '1' ? "covered: mi_fatal" : "covered: mi_nfatal (19)"),
                  std::string::npos)
            << r.err;
      }
    }
  }

  static std::string table(const std::map<std::string, Covered>& all) {
    std::ostringstream out;
    out << "# Functions of the C interface\n\n"
           "What shaders may call, by header of `include/oriel/sdk`; the shader in\n"
           "`tests/user_shaders/functions` that calls it in the picture; and whether it answered\n"
           "as it should. Made by the test that asks them all:\n\n"
           "```sh\n"
           "ORIEL_UPDATE=1 build/bin/user_shaders_tests --gtest_filter='SdkCoverage.*'\n"
           "```\n";
    std::string header;
    for (const Offered& one : offered()) {
      if (one.header != header) {
        header = one.header;
        out << "\n## " << header << "\n\n| name | kind | called in | answer |\n|---|---|---|---|\n";
      }
      std::string examples, answer = "not asked";
      if (const auto found = all.find(one.name); found != all.end()) {
        for (const std::string& e : found->second.examples)
          examples += (examples.empty() ? "" : ", ") + e;
        answer = found->second.wrong.empty() ? "right" : "wrong";
      }
      out << "| `" << one.name << "` | " << one.kind << " | " << examples << " | " << answer
          << " |\n";
    }
    return out.str();
  }
};

// acceptance: I4
TEST_F(SdkCoverage, EveryFunctionOfferedAnswersAsItShould) {
  for (const char* scene :
       {"vectors", "random", "directions", "highlights", "spaces", "images", "evaluate", "textures",
        "tracing", "lights", "indirect", "photons", "output", "geometry", "elements"})
    expect_rendered(scene);
  expect_messages(render("memory").err);
  expect_stops();

  const auto all = covered();
  std::set<std::string> names;
  for (const Offered& one : offered()) {
    names.insert(one.name);
    const auto found = all.find(one.name);
    if (found == all.end()) {
      ADD_FAILURE() << one.name << " of " << one.header << " is called by no example";
      continue;
    }
    EXPECT_EQ(found->second.wrong, "") << one.name;
    EXPECT_GT(found->second.right, 0) << one.name;
  }
  for (const auto& [name, what] : all)
    EXPECT_EQ(names.count(name), 1u) << name << " is covered, but not offered";

  const std::string made = table(all);
  if (std::getenv("ORIEL_UPDATE")) std::ofstream(kTable) << made;
  EXPECT_EQ(text_of(kTable.string()), made) << "docs/c-interface-functions.md is out of date";
}

}  // namespace functions_test
}  // namespace oriel
