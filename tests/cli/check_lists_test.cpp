// SPDX-License-Identifier: Apache-2.0
// Lists of oriel check for scenes of other programs.
#include <nlohmann/json.hpp>

#include "support/program.h"

namespace oriel {
namespace check_lists_test {

class CheckLists : public ProgramTest {
 protected:
  nlohmann::json check(const std::string& scene, int exit_code = 0) {
    write("scene.mi", scene);
    const RunResult r = run({"check", "scene.mi", "--json"});
    EXPECT_EQ(r.exit_code, exit_code) << r.err;
    text_ = run({"check", "scene.mi"});
    return nlohmann::json::parse(r.out, nullptr, false);
  }
  bool says(const std::string& words) const {
    return (text_.out + text_.err).find(words) != std::string::npos;
  }
  std::string text() const { return text_.out + text_.err; }

 private:
  RunResult text_;
};

const std::string kOtherSlots =
    "lens \"acme_lens\" ( ) output \"rgba\" \"acme_output\" ( ) volume \"acme_fog\" ( ) ";

TEST_F(CheckLists, ShadersOfEverySlotAreListedAndOnlyThoseSeenAreMagenta) {
  const auto facts = check(
      "shader \"unused\" \"acme_unused\" ( )\n"
      "shader \"inner\" \"acme_inner\" ( )\n"
      "material \"m\" \"mib_reflect\" ( \"input\" = \"inner\" ) end material\n" +
      small_scene("state [ \"acme_state\" ( ) ]", kOtherSlots));
  for (const char* type : {"acme_lens", "acme_output", "acme_fog", "acme_state", "acme_unused",
                           "acme_inner", "mib_reflect", "mia_material_x"})
    EXPECT_EQ(facts["shaders"].value(type, 0), 1) << type;
  EXPECT_EQ(facts["missing"]["shaders"], nlohmann::json({"acme_inner"}));
  EXPECT_EQ(facts["missing"]["shaders_without_effect"].size(), 5u);
  EXPECT_FALSE(says("oriel_stand_in")) << text();
  EXPECT_FALSE(says("unavailable shader")) << text();
}

TEST_F(CheckLists, ParametersOfFallbackShadersAreNotUnknown) {
  std::string scene = small_scene();
  const std::string from =
      "\"mia_material_x\" ( \"diffuse\" .5 .5 .5, \"reflectivity\" .2, "
      "\"refl_gloss\" .6 )";
  scene.replace(scene.find(from), from.size(),
                "\"acme_paint\" ( \"diffuse_color\" .5 .4 .3, \"frobnicate\" 2 )");
  const auto facts = check(scene);
  for (const auto& shader : facts["used_shaders"]) {
    if (shader["type"] != "acme_paint") continue;
    EXPECT_EQ(shader["status"], "guessed");
    for (const auto& p : shader["parameters"])
      EXPECT_EQ(p["support"], p["name"] == "frobnicate" ? "unknown" : "approximated") << p;
  }
  EXPECT_FALSE(says("magenta")) << text();
  EXPECT_FALSE(says("oriel_guess")) << text();
}

TEST_F(CheckLists, FilesWithoutARenderAreInventoried) {
  const auto facts = check(
      "shader \"s\" \"maya_lambert\" ( )\nmaterial \"m\" = \"s\" end material\n"
      "color texture \"t\" \"gone.tif\"\n",
      1);
  EXPECT_EQ(facts["shaders"]["maya_lambert"], 1);
  EXPECT_EQ(facts["elements"]["material"], 1);
  EXPECT_EQ(facts["textures"].size(), 1u);
  EXPECT_TRUE(says("maya_lambert")) << text();
  EXPECT_TRUE(says("no render statement")) << text();
}

TEST_F(CheckLists, StatementsOfCamerasAndLightsWithoutEffectAreListed) {
  std::string scene = small_scene("", "clip .1 100 dof 3 4 field 1 ");
  scene.replace(scene.find("origin 0 1 -3"), 13,
                "origin 0 1 -3 exponent 2 shadowmap on shadowmap resolution 512");
  const auto kept = check(scene)["kept_without_effect"];
  for (const char* statement :
       {"camera dof", "camera field", "light shadowmap", "light shadowmap resolution"})
    EXPECT_EQ(kept.value(statement, 0), 1) << statement << kept;
  EXPECT_EQ(kept.size(), 4u) << kept;
}

TEST_F(CheckLists, MissingPackagesOfWhichNothingIsUsedAreOneLineEach) {
  check(
      "link \"paint.so\"\nlink \"subsurface.dll\"\nlink \"contour.dylib\"\n"
      "$include \"paint.mi\"\n$include \"subsurface.mi\"\n" +
      small_scene());
  int lines = 0;
  const std::string all = text();
  for (std::size_t at = all.find("not found"); at != std::string::npos;
       at = all.find("not found", at + 1))
    ++lines;
  EXPECT_EQ(lines, 2) << all;
  EXPECT_TRUE(says("contour.so") && says("subsurface.mi")) << all;
}

}  // namespace check_lists_test
}  // namespace oriel
