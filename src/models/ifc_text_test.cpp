// SPDX-License-Identifier: Apache-2.0
// STEP text, and conversion of IFC4.
#include "models/ifc_text.h"

#include <gtest/gtest.h>

#include <cmath>

#include "models/step_text.h"

namespace oriel::models {
namespace ifc_text_test {

std::string file(const std::string& entities) {
  return "ISO-10303-21;\nHEADER;FILE_SCHEMA(('IFC4'));ENDSEC;\nDATA;\n" + entities +
         "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// The arguments of the only entity of a name, joined.
std::string arguments(const std::string& text, const std::string& name) {
  std::string found;
  for (const StepEntity& e : parse_step(text).entities) {
    if (e.name != name) continue;
    EXPECT_TRUE(found.empty()) << name;
    for (const std::string& a : e.arguments) found += (found.empty() ? "" : "|") + a;
  }
  return found;
}

TEST(StepText, ArgumentsMayHoldListsStringsAndComments) {
  const StepFile parsed = parse_step(
      file("#1 = IfcThing('a;b''(',(1,(2,3)),$ /* no, ) */ ,#2,\n.T.);\n#2=IFCNONE();\n"));
  ASSERT_EQ(parsed.entities.size(), 2u);
  EXPECT_EQ(parsed.entities[0].name, "IFCTHING");
  EXPECT_EQ(parsed.entities[0].arguments,
            (std::vector<std::string>{"'a;b''('", "(1,(2,3))", "$", "#2", ".T."}));
  EXPECT_TRUE(parsed.entities[1].arguments.empty());
  EXPECT_EQ(step_list("(1, (2,3))"), (std::vector<std::string>{"1", "(2,3)"}));
  EXPECT_EQ(step_reference("#17"), 17u);
}

TEST(StepText, TruncatedFilesDoNotCrash) {
  const std::string whole = file(
      "#1=IFCTRIANGULATEDFACESET(#2,$,$,((1,2,3)),$);\n"
      "#2=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(1.,0.,0.),(0.,1.,'a')));\n");
  for (std::size_t size = 0; size <= whole.size(); ++size) as_ifc2x3(whole.substr(0, size));
}

TEST(IfcText, OptionalArgumentsGetValues) {
  const std::string made =
      as_ifc2x3(file("#1=IFCSPACE('0000000000000000000001',$,'the room',$,$,#2,#3,$);\n")).text;
  EXPECT_NE(arguments(made, "IFCSPACE").find("|.ELEMENT.|.INTERNAL.|$"), std::string::npos) << made;
  EXPECT_EQ(arguments(made, "IFCSPACE").find("'|$|'the_room'"), std::string::npos) << made;
  EXPECT_FALSE(arguments(made, "IFCOWNERHISTORY").empty());
}

TEST(IfcText, StylesOfItemsAreAssigned) {
  const std::string made =
      as_ifc2x3(file("#1=IFCSURFACESTYLESHADING(#9,0.8);\n#2=IFCSURFACESTYLE('g',.BOTH.,(#1));\n"
                     "#3=IFCSTYLEDITEM(#7,(#2),$);\n"))
          .text;
  EXPECT_EQ(arguments(made, "IFCPRESENTATIONSTYLEASSIGNMENT"), "(#2)");
  EXPECT_EQ(arguments(made, "IFCSTYLEDITEM"), "#7|(#4)|$");
  EXPECT_EQ(arguments(made, "IFCSURFACESTYLERENDERING"), "#9|0.8|$|$|$|$|$|$|.NOTDEFINED.");
}

TEST(IfcText, CurvesOfIndicesBecomePolylines) {
  const std::string made =
      as_ifc2x3(file("#1=IFCCARTESIANPOINTLIST2D(((1.,0.),(0.,1.),(-1.,0.)));\n"
                     "#2=IFCINDEXEDPOLYCURVE(#1,(IFCARCINDEX((1,2,3)),IFCLINEINDEX((3,1))),$);\n"))
          .text;
  int points = 0;
  for (const StepEntity& e : parse_step(made).entities) {
    if (e.name != "IFCCARTESIANPOINT") continue;
    const std::vector<std::string> p = step_list(e.arguments[0]);
    ASSERT_EQ(p.size(), 2u);
    // The upper half of the unit circle.
    EXPECT_NEAR(std::hypot(std::stod(p[0]), std::stod(p[1])), 1, 1e-6);
    EXPECT_GE(std::stod(p[1]), -1e-6);
    ++points;
  }
  EXPECT_EQ(points, 18);  // 16 pieces, and the first point again
}

}  // namespace ifc_text_test
}  // namespace oriel::models
