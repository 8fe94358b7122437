// SPDX-License-Identifier: Apache-2.0
// Reading of subdivision surfaces, ccmeshes and hair, and reports of errors in them.
#include "mi/subdivision.h"

#include <gtest/gtest.h>

#include "mi/codes.h"
#include "mi/testing/test_support.h"

#define EXPECT_SILENT(read) EXPECT_TRUE((read).diagnostics.all().empty()) << (read).messages()

namespace oriel::mi {
namespace subdivision_test {

using scene::SubdivisionSurface;

const std::string kSquare = "object \"o\" group 0 0 0 1 0 0 1 1 0 0 1 0\n";

// acceptance: H1
TEST(Subdivision, FacesCreasesAndMarksOfVerticesAreRead) {
  const Snippet read(kSquare +
                     "v 0 t 1 cusp level 2\nv 1 t 2 corner\nv 2 dart\nv 3\n"
                     "subdivision surface \"s\" polygon 1 0 0 0 texture space [face, subdivision]\n"
                     "p \"m\" 0 1 2 3 crease 9 .5 1\np 2 1 0 trim 1 { child 0 { } }\n"
                     "derivative 1 space 0\nend subdivision surface\nend group end object");
  EXPECT_SILENT(read);
  const auto& group = read.get<scene::Object>("o").groups[0];
  ASSERT_EQ(group.subdivisions.size(), 1u);
  const SubdivisionSurface& s = group.subdivisions[0];
  EXPECT_EQ(s.name, "s");
  EXPECT_EQ(s.faces.first, (std::vector<std::uint32_t>{0, 4, 7}));
  EXPECT_EQ(s.faces.material, (std::vector<std::uint32_t>{0, 0})) << "inherited";
  EXPECT_EQ(s.texture_rules[0], SubdivisionSurface::TextureRule::Face);
  EXPECT_EQ(s.creases, (std::vector<SubdivisionSurface::Crease>{{0, 0, .5f}, {0, 3, 1}}));
  EXPECT_EQ(s.trims, (std::vector<SubdivisionSurface::Trim>{{1, 1}}));
  ASSERT_EQ(s.details.size(), 1u);
  EXPECT_EQ(s.details[0].text.text, "child 0 { } }");
  EXPECT_EQ(s.derivatives[0].space, 0);
  ASSERT_EQ(group.vertices.marks.size(), 3u);
  EXPECT_EQ(group.vertices.marks[0].level, 2);
  EXPECT_EQ(group.vertices.marks[1].kind, scene::VertexMark::Kind::Corner);
  EXPECT_EQ(group.vertices.marks[2].vertex, 2u);
}

TEST(Subdivision, AMeshHasOneSharpnessForEachEdge) {
  const Snippet read(kSquare +
                     "v 0 v 1 v 2 v 3 ccmesh \"c\" polygon 1 vertex 4 p 0 1 2 3 crease 0 .5 0 9 "
                     "end ccmesh end group end object");
  EXPECT_SILENT(read);
  EXPECT_EQ(read.get<scene::Object>("o").groups[0].subdivisions[0].creases,
            (std::vector<SubdivisionSurface::Crease>{{0, 1, .5f}, {0, 3, 1}}));
}

TEST(Subdivision, FacesWithMissingVerticesAreDroppedWithTheirCreases) {
  const Snippet read(kSquare +
                     "v 0 v 1 v 2 v 3 subdivision surface \"s\" p 0 1 9 crease 1 1 { } p 0 1 "
                     "p 0 1 2 crease 2 1 end subdivision surface end group end object");
  EXPECT_EQ(read.count(code::kBadPolygon), 2u);
  const auto& s = read.get<scene::Object>("o").groups[0].subdivisions[0];
  EXPECT_EQ(s.faces.size(), 1u);
  EXPECT_TRUE(s.details.empty());
  EXPECT_EQ(s.creases, (std::vector<SubdivisionSurface::Crease>{{0, 1, 1}}));
}

// acceptance: H1
TEST(Hair, FieldsNumbersAndOffsetsAreRead) {
  const Snippet read(
      "object \"h\" hair material \"m\" radius .1 degree 3 hair n t 2 vertex radius m 2 "
      "scalar [6] 0 1 2 3\n4 5 hair [3] 0 2 6 end hair end object");
  EXPECT_SILENT(read);
  const scene::Hair& hair = read.get<scene::Object>("h").hairs.at(0);
  EXPECT_EQ(hair.material, "m");
  EXPECT_EQ(hair.degree, 3);
  ASSERT_EQ(hair.per_hair.size(), 2u);
  EXPECT_EQ(hair.per_hair[1].numbers(), 2u);
  ASSERT_EQ(hair.per_vertex.size(), 2u);
  EXPECT_EQ(hair.per_vertex[1].numbers(), 6u);
  EXPECT_EQ(hair.scalars, (std::vector<float>{0, 1, 2, 3, 4, 5}));
  EXPECT_EQ(hair.first, (std::vector<std::uint32_t>{0, 2, 6}));
}

TEST(Hair, BinaryBlocksAreRead) {
  std::string text = "object \"h\" hair scalar [2] `";
  text += std::string("\x3f\x80\0\0\x60\x60\x60\x60", 8) + "` hair [2] `";
  text += std::string("\0\0\0\0\0\0\0\x02", 8) + "` end hair end object";
  const Snippet read(text);
  EXPECT_SILENT(read);
  const scene::Hair& hair = read.get<scene::Object>("h").hairs.at(0);
  ASSERT_EQ(hair.scalars.size(), 2u);
  EXPECT_EQ(hair.scalars[0], 1);
  EXPECT_EQ(hair.first, (std::vector<std::uint32_t>{0, 2}));
}

TEST(Hair, OffsetsBeyondTheNumbersAreDropped) {
  const Snippet read("object \"h\" hair scalar [2] 0 1 hair [4] 0 2 9 1 end hair end object");
  EXPECT_EQ(read.count(code::kBadIndex), 1u);
  EXPECT_EQ(read.get<scene::Object>("h").hairs.at(0).first, (std::vector<std::uint32_t>{0, 2}));
}

}  // namespace subdivision_test
}  // namespace oriel::mi
