// SPDX-License-Identifier: Apache-2.0
// oriel check --report.
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace oriel {
namespace check_report_test {

constexpr const char* kHostile = "<script>alert('x')</script>&\"";

class CheckReport : public ProgramTest {
 protected:
  std::string report(int exit_code = 0) const {
    const RunResult r = run({"check", "scene.mi", "--report", "out.html"});
    EXPECT_EQ(r.exit_code, exit_code) << r.err;
    return text_of(file("out.html"));
  }
};

void expect_in(const std::string& page, const std::string& words) {
  EXPECT_NE(page.find(words), std::string::npos) << words;
}

TEST_F(CheckReport, ListsTheSupportOfShadersAndParameters) {
  write("scene.mi",
        "color texture \"wood\" \"gone.tif\"\n"
        "declare shader color \"house_paint\" ( color \"tone\" ) end declare\n"
        "material \"odd\" \"house_paint\" ( \"tone\" .25 .5 .75 ) end material\n"
        "link \"house.so\"\n" +
            small_scene("\"some option\" 3"));
  const std::string page = report();
  for (const char* words : {"<code>mia_material_x</code>", "<code>refl_gloss</code>",
                            "<code>0.6</code>", "scene.mi:", "<code>mib_light_point</code>",
                            "<code>gone.tif</code>", "<code>house.so</code>", "some option",
                            "48 x 32 pixels", "data:image/png;base64,iVBORw0KGgo"})
    expect_in(page, words);
  EXPECT_EQ(page.find("<script"), std::string::npos) << "no scripts";
  EXPECT_EQ(page.find("http://"), std::string::npos) << "no other files";
  EXPECT_EQ(page.find("https://"), std::string::npos);
}

TEST_F(CheckReport, HostileNamesAreEscaped) {
  std::string quoted = kHostile;
  quoted.erase(quoted.find('"'));
  write("scene.mi", "color texture \"" + quoted + "\" \"" + quoted +
                        ".tif\"\n"
                        "material \"m" +
                        quoted + "\" \"" + quoted + "\" ( \"" + quoted + "\" \"" + quoted +
                        "\" ) end material\nlink \"" + quoted + "\"\n" +
                        small_scene("\"" + quoted + "\" 1"));
  const std::string page = report();
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("alert('x')"), std::string::npos) << "quotes are written out";
  expect_in(page, "&lt;script&gt;alert(&#39;x&#39;)&lt;/script&gt;&amp;");
}

TEST_F(CheckReport, ScenesThatCannotBeRenderedHaveAReportWithoutPicture) {
  write("scene.mi", "options \"opt\" object space end options\n");
  const std::string page = report(1);
  expect_in(page, "No picture:");
  expect_in(page, "cannot be rendered");
}

TEST_F(CheckReport, TextAndPageAgreeOnParameters) {
  write("scene.mi", small_scene());
  const RunResult r = run({"check", "scene.mi", "--json", "--report", "out.html"});
  ASSERT_EQ(r.exit_code, 0) << r.err;
  const auto facts = nlohmann::json::parse(r.out, nullptr, false);
  int calls = 0;
  for (const auto& shader : facts["used_shaders"]) {
    EXPECT_EQ(facts["shaders"][shader["type"].get<std::string>()], shader["calls"]);
    calls += shader["calls"].get<int>();
  }
  EXPECT_EQ(calls, 2) << "the lamp's and the material's";
}

}  // namespace check_report_test
}  // namespace oriel
