// SPDX-License-Identifier: Apache-2.0
// Material templates: list, printed text, availability in all scenes.
#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "support/program.h"

namespace oriel {
namespace templates_test {

const char* const kWanted[] = {"wood_floor",
                               "linoleum",
                               "ceramic",
                               "stone",
                               "brick",
                               "clear_glass",
                               "frosted_glass",
                               "coloured_glass",
                               "window_pane",
                               "water",
                               "ocean",
                               "tropical_ocean",
                               "beverage_air_glass",
                               "beverage_air_liquid",
                               "beverage_glass_liquid",
                               "chrome",
                               "gold",
                               "copper",
                               "silver",
                               "aluminium",
                               "brushed_metal",
                               "curtain",
                               "paper",
                               "plastic",
                               "lacquer"};

class TemplatesProgram : public ProgramTest {
 protected:
  std::vector<nlohmann::json> listed() const {
    const RunResult r = run({"shaders", "--templates", "--json"});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    std::vector<nlohmann::json> all;
    std::istringstream lines(r.out);
    for (std::string line; std::getline(lines, line);) all.push_back(nlohmann::json::parse(line));
    return all;
  }

  /// Output of `oriel check` for a scene with one square per material.
  nlohmann::json checked(const std::string& definitions, const std::vector<std::string>& names) {
    std::string scene = definitions +
                        "\noptions \"opt\" object space end options\n"
                        "camera \"cam\" resolution 16 16 end camera\n"
                        "instance \"cam_inst\" \"cam\" end instance\n"
                        "object \"square\" visible trace shadow tagged group\n"
                        "  0 0 -5  1 0 -5  1 1 -5  0 1 -5  0 0 0  1 0 0  1 1 0  0 1 0\n"
                        "  v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7 p 0 0 1 2 3 end group end object\n";
    std::string members = "\"cam_inst\"";
    for (const std::string& name : names) {
      scene +=
          fmt::format("instance \"{0}_inst\" \"square\" material [ \"{0}\" ] end instance\n", name);
      members += fmt::format(" \"{}_inst\"", name);
    }
    scene += fmt::format(
        "instgroup \"root\" {} end instgroup\nrender \"root\" \"cam_inst\" "
        "\"opt\"\n",
        members);
    write("scene.mi", scene);
    const RunResult r = run({"check", "scene.mi", "--json"});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    return nlohmann::json::parse(r.out);
  }

  static void expect_clean(const nlohmann::json& check, std::size_t materials) {
    EXPECT_TRUE(check["renders"]);
    EXPECT_EQ(check["shaders"]["mia_material_x"], materials);
    EXPECT_TRUE(check["missing"]["textures"].empty()) << check["missing"];
    EXPECT_TRUE(check["missing"]["shaders"].empty()) << check["missing"];
    for (const auto& d : check["diagnostics"]) EXPECT_EQ(d["severity"], "note") << d;
  }
};

TEST_F(TemplatesProgram, ListHasEveryRecipeWithItsComment) {
  std::set<std::string> names;
  for (const auto& t : listed()) {
    names.insert(t["name"]);
    EXPECT_GT(t["doc"].get<std::string>().size(), 20u) << t["name"];
  }
  for (const char* wanted : kWanted)
    EXPECT_TRUE(names.contains(fmt::format("template_{}", wanted))) << wanted;
  const RunResult text = run({"shaders", "--templates"});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_NE(text.out.find("template_gold\n  Gold"), std::string::npos) << text.out;
}

TEST_F(TemplatesProgram, SceneUsesThemAllThroughOneInclude) {
  std::vector<std::string> names;
  for (const auto& t : listed()) names.push_back(t["name"]);
  expect_clean(checked("$include \"templates.mi\"", names), names.size());
}

TEST_F(TemplatesProgram, PrintedParagraphsStandAlone) {
  for (const char* name : {"brick", "template_coloured_glass", "ocean"}) {
    const RunResult r = run({"shaders", "--templates", name});
    EXPECT_EQ(r.exit_code, 0) << r.err;
    const std::string full =
        std::string(name).starts_with("template_") ? name : fmt::format("template_{}", name);
    EXPECT_EQ(r.out.find('#'), 0u) << r.out;
    expect_clean(checked(r.out, {full}), 1);
  }
}

TEST_F(TemplatesProgram, NearestNameIsOffered) {
  const RunResult r = run({"shaders", "--templates", "coper"});
  EXPECT_EQ(r.exit_code, 1);
  EXPECT_NE(r.err.find("did you mean \"template_copper\"?"), std::string::npos) << r.err;
  EXPECT_EQ(run({"shaders", "--templates", "gold", "--mi", "base"}).exit_code, 2);
}

// A scene beside a file of that name means its own.
TEST_F(TemplatesProgram, ScenesOwnFileComesFirst) {
  write("templates.mi",
        "shader \"own_s\" \"mia_material_x\" ( ) material \"own\" = \"own_s\" end material\n");
  expect_clean(checked("$include \"templates.mi\"", {"own"}), 1);
}

}  // namespace templates_test
}  // namespace oriel
