// SPDX-License-Identifier: Apache-2.0
#include "mi/freeform.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mi/testing/test_support.h"

namespace oriel::mi {
namespace freeform_test {

using Points = std::vector<scene::ControlPoint>;
using Parameters = std::vector<float>;

std::string in_group(std::string_view statements) {
  return fmt::format(
      "object \"o\" visible basis \"b1\" bezier 1 basis \"s2\" rational bspline 2\n"
      "group 0 0 0 1 0 0 0 1 0 1 1 0 v 0 v 1 v 2 v 3\n{}\nend group end object",
      statements);
}

// acceptance: H1
TEST(FreeFormReader, NumbersWithDecimalPointAreParameters) {
  const Snippet read(in_group("surface \"f\" \"m\" \"b1\" 0 1 0. 1. \"b1\" 0.0 2.0 0. 2. 0 1 2 3"));
  const auto& group = read.get<scene::Object>("o").groups.at(0);
  const auto& surface = group.freeform.surfaces.at(0);
  EXPECT_EQ(surface.name, "f");
  EXPECT_EQ(group.materials.at(surface.material), "m");
  EXPECT_EQ(surface.u.parameters, (Parameters{0, 1}));
  EXPECT_EQ(surface.v.parameters, (Parameters{0, 2}));
  EXPECT_EQ(surface.v_max, 2);
  EXPECT_EQ(surface.points, (Points{{0, 1}, {1, 1}, {2, 1}, {3, 1}}));
}

TEST(FreeFormReader, ControlPointCountSplitsAmbiguousRows) {
  const Snippet read(
      in_group("surface \"f\" \"\" \"b1\" 0 1 0 1 \"s2\" 0 1 0 0 0 1 1 1 0 1 2 3 0 1\n"
               "curve \"c\" \"s2\" 0 0 0 1 1 1 0 w 2 1 w .5 2 w 1"));
  const auto& freeform = read.get<scene::Object>("o").groups.at(0).freeform;
  EXPECT_EQ(freeform.surfaces.at(0).v.parameters, (Parameters{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(freeform.surfaces.at(0).points.size(), 6u);
  EXPECT_EQ(freeform.surfaces.at(0).material, scene::kNone);
  EXPECT_EQ(freeform.curves.at(0).basis.parameters, (Parameters{0, 0, 0, 1, 1, 1}));
  EXPECT_EQ(freeform.curves.at(0).points, (Points{{0, 2}, {1, .5f}, {2, 1}}));
}

TEST(FreeFormReader, ATaggedSurfaceHasALabel) {
  const Snippet read(
      "object \"o\" visible tagged on basis \"b\" bezier 1 group 0 0 0 1 0 0 0 1 0 1 1 0\n"
      "v 0 v 1 v 2 v 3 surface \"f\" 2 \"b\" 0.0 1.0 0.0 1.0 \"b\" 0.0 1.0 0.0 1.0 0 1 2 3\n"
      "approximate surface parametric 2.0 2.0 \"f\" end group end object");
  EXPECT_TRUE(read.diagnostics.all().empty()) << read.messages();
  const auto& group = read.get<scene::Object>("o").groups.at(0);
  EXPECT_EQ(group.freeform.surfaces.at(0).material, 2u);
  EXPECT_EQ(group.settings.size(), 1u);
}

TEST(FreeFormReader, TexturesTrimsAndConnectionsBelongToTheirSurface) {
  const Snippet read(
      in_group("curve \"c\" \"b1\" 0. 1. 0 1\n"
               "surface \"f\" \"\" \"b1\" 0 1 0. 1. \"b1\" 0 1 0. 1. 0 1 2 3\n"
               "volume vector texture \"b1\" 0.0 1.0 \"b1\" 0.0 1.0 3 2 1 0\n"
               "trim \"c\" 0 .5 \"c\" .5 1. hole \"c\" 0 1 special 1 2 derivative 1\n"
               "connect \"f\" \"c\" 0 1 \"f\" \"c\" 1 0"));
  EXPECT_TRUE(read.diagnostics.all().empty()) << read.messages();
  const auto& freeform = read.get<scene::Object>("o").groups.at(0).freeform;
  const auto& surface = freeform.surfaces.at(0);
  ASSERT_EQ(surface.textures.size(), 1u);
  EXPECT_TRUE(surface.textures[0].volume);
  EXPECT_TRUE(surface.textures[0].vector);
  EXPECT_EQ(surface.textures[0].points.front().vertex, 3u);
  ASSERT_EQ(surface.loops.size(), 3u);
  EXPECT_EQ(surface.loops[0].parts.size(), 2u);
  EXPECT_EQ(surface.loops[0].parts[1].min, .5f);
  EXPECT_EQ(surface.loops[2].points, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(surface.derivative, std::vector<int>{1});
  ASSERT_EQ(freeform.connections.size(), 1u);
  EXPECT_EQ(freeform.connections[0].part[1].min, 1);
}

TEST(FreeFormReader, TruncatedSurfaceIsOneErrorAndReadingContinues) {
  for (const char* text : {"basis \"b\"", "basis \"b\" nurbs 3", "surface \"f\"",
                           "surface \"f\" \"m\" \"b1\" 0", "surface \"f\" \"m\" \"b1\" 0 1 0. 1.",
                           "curve \"c\"", "space \"c\"", "connect \"f\" \"c\" 0 1 \"f\"",
                           "surface \"f\" \"m\" \"b1\" 0 1 0. 1. \"b1\" 0 1 0. 1. 0 1 w"}) {
    SCOPED_TRACE(text);
    const Snippet read(in_group(text) + "\nobject \"after\" group end group end object");
    EXPECT_EQ(read.diagnostics.count(Severity::Error), 1u);
    EXPECT_NE(read.scene.get<scene::Object>("after"), nullptr);
  }
}

}  // namespace freeform_test
}  // namespace oriel::mi
