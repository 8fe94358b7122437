// SPDX-License-Identifier: Apache-2.0
// Every function that the C interface offers is called by a shader in functions/, in a context that
// it is meant for, and answers as it should. docs/c-interface-functions.md is made from it:
// ORIEL_UPDATE=1 user_shaders_tests --gtest_filter=SdkCoverage.*
#include <map>
#include <set>
#include <sstream>

#include "coverage_table.h"
#include "support/program.h"

namespace oriel {
namespace functions_test {

namespace fs = std::filesystem;

const fs::path kSource = ORIEL_SOURCE_DIR;
const fs::path kTable = kSource / "docs/c-interface-functions.md";
const fs::path kGuide = kSource / "docs/c-interface.md";
const fs::path kHeaders = kSource / "include/oriel/sdk";

std::vector<Offered> offered() { return offered_functions(kHeaders); }

/// Messages of shaders about one function.
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

  /// Renders a scene whose shaders must report only expected messages.
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

  /// Message functions return nothing: the shader calls them, the program shows the messages.
  void expect_messages(const std::string& shown, const std::string& example,
                       const std::map<std::string, std::string>& said) {
    std::ofstream told(file("covered.txt"), std::ios::app);
    for (const auto& [name, words] : said) {
      const bool there = shown.find(words) != std::string::npos;
      told << name << " " << example << " 0 " << (there ? "right" : "wrong") << "\n";
    }
  }

  /// Each function with nothing behind it warns once.
  static void expect_warnings(const std::string& shown, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      const std::size_t first = shown.find(name + ": ");
      ASSERT_NE(first, std::string::npos) << name << " does not warn:\n" << shown;
      EXPECT_EQ(shown.find(name + ": ", first + 1), std::string::npos) << name << " warns twice";
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

  /// coverage.txt lists each name once with a reason, and agrees with functions.txt.
  static void expect_names() {
    if (std::getenv("ORIEL_UPDATE")) CoverageTable(kHeaders).prune(kHeaders);
    const CoverageTable coverage(kHeaders);
    const std::set<std::string> groups = {"declared", "shader", "geometry", "program"};
    std::set<std::string> names;
    for (const CoverageLine& line : coverage.lines()) {
      if (!line.names()) continue;
      EXPECT_TRUE(names.insert(line.name).second) << line.name << " is listed twice";
      EXPECT_NE(line.reason, "") << line.name;
      EXPECT_EQ(groups.count(line.group), 1u) << line.text;
    }
    EXPECT_FALSE(names.empty());
    for (const std::string& name : coverage.superfluous())
      ADD_FAILURE() << name << " is offered, coverage.txt says why it is not: ORIEL_UPDATE=1";
    for (const std::string& name : coverage.not_offered())
      ADD_FAILURE() << name << " is not offered: coverage.txt calls it declared";
  }

  /// The page with its table of counts between two markers.
  static std::string guide(const std::string& counts) {
    const std::string begin = "<!-- made by SdkCoverage -->\n", end = "<!-- end -->\n";
    std::string text = text_of(kGuide.string());
    const std::size_t from = text.find(begin), to = text.find(end);
    if (from == std::string::npos || to == std::string::npos) return "without marks";
    return text.replace(from, to - from, begin + "\n" + counts + "\n");
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
TEST_F(SdkCoverage, EveryFunctionReturnsTheExpectedResult) {
  std::map<std::string, std::string> said;
  for (const char* scene :
       {"vectors",   "random",      "directions",    "highlights", "spaces",   "images",
        "evaluate",  "textures",    "tracing",       "lights",     "indirect", "photons",
        "output",    "geometry",    "elements",      "shapes",     "spectra",  "particles",
        "blackbody", "image_tools", "parameter_set", "texture_x",  "volume"})
    said[scene] = expect_rendered(scene);
  expect_messages(render("memory").err, "memory.c",
                  {{"mi_error", "covered: mi_error"},
                   {"mi_warning", "covered: mi_warning"},
                   {"mi_info", "covered: mi_info"},
                   {"mi_progress", "covered: mi_progress"},
                   {"mi_debug", "covered: mi_debug"},
                   {"mi_vdebug", "covered: mi_vdebug"},
                   {"mi_nerror", "covered: mi_nerror"},
                   {"mi_nwarning", "covered: mi_nwarning"}});
  expect_messages(render("database").err, "database.c",
                  {{"mi_db_dump", "shaders have created 2 elements with 8000 bytes"}});
  expect_messages(render("memory_blocks").err, "memory_blocks.c",
                  {{"mi_mem_summary", "memory in use: "}, {"mi_mem_dump", "memory in use: "}});
  expect_warnings(render("renderpass").err,
                  {"mi_renderpass_access", "mi_renderpass_resolution", "mi_renderpass_sample_get",
                   "mi_renderpass_sample_put", "mi_renderpass_samplerect_black",
                   "mi_renderpass_samplerect_flush"});
  expect_warnings(said["output"], {"mi_get_contour_line", "mi_add_contour_lines"});
  expect_warnings(said["geometry"], {"mi_geoshader_echo_tag"});
  expect_warnings(said["photons"], {"mi_store_volume_photon", "mi_photon_volume_scattering"});
  expect_warnings(said["indirect"],
                  {"mi_compute_volume_irradiance", "mi_compute_directional_irradiance"});
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

  expect_names();
  const CoverageTable coverage(kHeaders);
  const std::string made = table(all) + coverage.names(), counted = guide(coverage.counts());
  if (std::getenv("ORIEL_UPDATE")) {
    std::ofstream(kTable) << made;
    std::ofstream(kGuide) << counted;
  }
  EXPECT_EQ(text_of(kTable.string()), made) << "docs/c-interface-functions.md is out of date";
  EXPECT_EQ(text_of(kGuide.string()), counted) << "docs/c-interface.md is out of date";
}

}  // namespace functions_test
}  // namespace oriel
