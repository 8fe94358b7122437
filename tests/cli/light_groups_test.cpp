// SPDX-License-Identifier: Apache-2.0
// oriel render --light-group and oriel recombine --light.
#include <nlohmann/json.hpp>

#include "image/exr.h"
#include "support/program.h"

namespace oriel {
namespace light_groups_test {

constexpr const char* kScene = R"(
options "opt" object space trace on trace depth 2 2 3 "indirect" "path" end options
material "grey" "mia_material_x" ( "diffuse" .5 .5 .5, "reflectivity" 0 ) end material
object "floor" visible on shadow on trace on
 group
  -5 -5 0  5 -5 0  5 5 0  -5 5 0
  v 0 v 1 v 2 v 3
  c 0 1 2 3
 end group
end object
instance "floor_i" "floor" material "grey" end instance
light "l1" "mib_light_point" ( "color" 3 1 1 ) origin 1 0 1 end light
instance "lamp_left" "l1" end instance
light "l2" "mib_light_point" ( "color" 1 1 3 ) origin -1 0 1 end light
instance "lamp_right" "l2" end instance
camera "cam" focal 1 aperture 2 aspect 1 resolution 12 12 end camera
instance "cam_i" "cam" transform 1 0 0 0  0 1 0 0  0 0 1 0  0 0 -2 1 end instance
instgroup "world" "cam_i" "floor_i" "lamp_left" "lamp_right" end instgroup
render "world" "cam_i" "opt"
)";

class LightGroupProgram : public ProgramTest {
 protected:
  void SetUp() override { write("scene.mi", kScene); }
  RunResult render(std::vector<std::string> more) {
    more.insert(more.begin(), {"render", "scene.mi", "--samples", "4", "-q", "--exr", "float"});
    return run(more);
  }
  std::vector<Layer> layers(const std::string& name) { return read_exr(file(name)).layers; }
  float pixel(const std::vector<Layer>& all, const std::string& name, int channel) {
    const Layer* layer = find_layer(all, name);
    if (!layer) throw std::runtime_error("no layer " + name);
    return layer->image.at(5, 6)[channel];
  }
};

TEST_F(LightGroupProgram, GroupsAreLayersThatSumToTheBeauty) {
  const RunResult r = render({"-o", "a.exr", "--light-group", "left=lamp_l*"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  EXPECT_EQ(r.err, "");
  const auto all = layers("a.exr");
  for (int c = 0; c < 3; ++c) {
    const float beauty = pixel(all, "", c);
    EXPECT_NEAR(pixel(all, "light_left", c) + pixel(all, "light_rest", c), beauty, 1e-4f * beauty);
  }
  EXPECT_EQ(find_layer(all, "light_indirect"), nullptr);
  EXPECT_EQ(text_attribute(read_exr(file("a.exr")), "oriel.lightGroups"), "left");
  const RunResult sum = run({"recombine", "a.exr", "--json"});
  EXPECT_EQ(sum.exit_code, 0) << sum.err;
  EXPECT_EQ(nlohmann::json::parse(sum.out)["groups"], (std::vector<std::string>{"left", "rest"}));
}

TEST_F(LightGroupProgram, RecombinedLightsAreStrongerAndOfOtherColours) {
  ASSERT_EQ(render({"-o", "a.exr", "--light-group", "left=lamp_left", "--light-group",
                    "right=lamp_right"})
                .exit_code,
            0);
  const RunResult r =
      run({"recombine", "a.exr", "--light", "left=0", "--light", "right=2,1,.5", "-o", "b.exr"});
  EXPECT_EQ(r.exit_code, 0) << r.err;
  const auto before = layers("a.exr"), after = layers("b.exr");
  constexpr float kFactor[] = {2, 1, .5f};
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(pixel(after, "", c), kFactor[c] * pixel(before, "light_right", c), 1e-5f);
    EXPECT_EQ(pixel(after, "light_left", c), 0);
  }
  // Warmer at the same luminance.
  ASSERT_EQ(run({"recombine", "a.exr", "--light", "left=1.5,0.2", "-o", "c.exr"}).exit_code, 0);
  EXPECT_GT(pixel(layers("c.exr"), "light_left", 0), 1.5f * pixel(before, "light_left", 0));
  EXPECT_LT(pixel(layers("c.exr"), "light_left", 2), 1.5f * pixel(before, "light_left", 2));
}

TEST_F(LightGroupProgram, ErrorsAreReportedInOneLine) {
  for (const char* wrong : {"key", "key=", "=lamp*", "rest=lamp*", "a.b=lamp*"}) {
    const RunResult r = render({"-o", "a.exr", "--light-group", wrong});
    EXPECT_EQ(r.exit_code, 2) << wrong;
    EXPECT_EQ(r.error_lines(), 1) << r.err;
    EXPECT_NE(r.err.find("NAME=PATTERN"), std::string::npos) << r.err;
  }
  const RunResult none = render({"-o", "a.exr", "--light-group", "key=lamp_lift"});
  EXPECT_EQ(none.exit_code, 0);
  EXPECT_NE(none.err.find("OR-RN-057"), std::string::npos) << none.err;
  EXPECT_NE(none.err.find("\"lamp_left\""), std::string::npos) << none.err;
  const RunResult png = render({"-o", "a.png", "--light-group", "key=lamp*"});
  EXPECT_EQ(png.exit_code, 0);
  EXPECT_NE(png.err.find("OR-RN-059"), std::string::npos) << png.err;

  ASSERT_EQ(render({"-o", "a.exr", "--light-group", "key=lamp*"}).exit_code, 0);
  for (const char* wrong : {"key", "key=", "key=a", "key=1,2,3,4", "kye=1", "=1", "key=nan"}) {
    const RunResult r = run({"recombine", "a.exr", "--light", wrong, "-o", "b.exr"});
    EXPECT_EQ(r.exit_code, 2) << wrong;
    EXPECT_EQ(r.error_lines(), 1) << r.err;
  }
  EXPECT_EQ(run({"recombine", "a.exr", "--light", "key=1"}).exit_code, 2) << "no file named";
}

}  // namespace light_groups_test
}  // namespace oriel
