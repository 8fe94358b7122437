// SPDX-License-Identifier: Apache-2.0
// oriel_vertex_color: colours of texture spaces.
#include "probe.h"

namespace oriel {
namespace vertex_color_test {

Rgba color_at(const std::string& parameters, int spaces) {
  const testing::PreparedScene scene(testing::scene_text(
      "material \"m\" \"oriel_vertex_color\" ( " + parameters + " ) end material"));
  EXPECT_TRUE(scene.diagnostics.all().empty()) << scene.messages();
  ShadingPoint point;
  point.world = scene.world.get();
  point.texture_spaces = static_cast<std::uint8_t>(spaces);
  point.tex[0] = Vec3(.5f, .25f, 0);
  point.tex[1] = Vec3(.2f, .4f, .6f);
  point.tex[2] = Vec3(.5f, 9, 9);
  return scene.material("m")->surface[0]->color(point);
}

TEST(VertexColor, CoordinatesOfItsSpacesMultiplyTheColour) {
  EXPECT_EQ(color_at("\"space\" 1", 3), Rgba(.2f, .4f, .6f, 1));
  const Rgba both = color_at("\"color\" .5 1 2 .5, \"space\" 1, \"alpha_space\" 2", 3);
  EXPECT_FLOAT_EQ(both.r, .1f);
  EXPECT_FLOAT_EQ(both.g, .4f);
  EXPECT_FLOAT_EQ(both.b, 1.2f);
  EXPECT_FLOAT_EQ(both.a, .25f);
}

TEST(VertexColor, MissingSpacesAreWhite) {
  EXPECT_EQ(color_at("\"space\" 1, \"alpha_space\" 2", 1), Rgba(1, 1, 1, 1));
  EXPECT_EQ(color_at("\"color\" .5 1 2 .5, \"space\" -1", 3), Rgba(.5f, 1, 2, .5f));
}

}  // namespace vertex_color_test
}  // namespace oriel
