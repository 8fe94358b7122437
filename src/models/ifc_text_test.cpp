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

// A wall of layers whose second material has a style; its shape is a boolean without one.
TEST(IfcText, StylesOfMaterialsAreThoseOfShapes) {
  const std::string wall =
      "#1=IFCWALL('0000000000000000000001',$,'w',$,$,$,#2,$,$);\n"
      "#2=IFCPRODUCTDEFINITIONSHAPE($,$,(#3));\n"
      "#3=IFCSHAPEREPRESENTATION($,'Body','Clipping',(#4));\n"
      "#4=IFCBOOLEANRESULT(.DIFFERENCE.,#5,#6);\n"
      "#10=IFCMATERIAL('a',$,$);\n#11=IFCMATERIAL('b',$,$);\n#12=IFCMATERIALLAYER(#10,1.,$);\n"
      "#13=IFCMATERIALLAYER(#11,1.,$);\n#14=IFCMATERIALLAYERSET((#12,#13),$);\n"
      "#15=IFCRELASSOCIATESMATERIAL('0000000000000000000002',$,$,$,(#1),#14);\n"
      "#20=IFCMATERIALDEFINITIONREPRESENTATION($,$,(#21),#11);\n"
      "#21=IFCSTYLEDREPRESENTATION($,$,$,(#22));\n#22=IFCSTYLEDITEM($,(#23),$);\n";
  const auto styled = [](const std::string& text) {
    std::string found;
    for (const StepEntity& e : parse_step(as_ifc2x3(file(text)).text).entities)
      if (e.name == "IFCSTYLEDITEM") found += e.arguments[0] + e.arguments[1] + " ";
    return found;
  };
  EXPECT_EQ(styled(wall), "$(#23) #4(#23) ");
  // The first operand's style has precedence, and the shape's own.
  EXPECT_EQ(styled(wall + "#30=IFCSTYLEDITEM(#5,(#31),$);\n"), "$(#23) #5(#31) #4(#31) ");
  EXPECT_EQ(styled(wall + "#30=IFCSTYLEDITEM(#4,(#31),$);\n"), "$(#23) #4(#31) ");
}

TEST(IfcText, RoughHighlightsBecomeExponents) {
  const std::string made =
      as_ifc2x3(file("#1=IFCSURFACESTYLERENDERING(#9,0.,$,$,$,$,$,IFCSPECULARROUGHNESS(0.5),$);\n"))
          .text;
  // A Phong lobe of width alpha = r^2 has the exponent 2 / alpha^2 - 2.
  EXPECT_EQ(arguments(made, "IFCSURFACESTYLERENDERING"),
            "#9|0.|$|$|$|$|$|IFCSPECULAREXPONENT(30.)|.NOTDEFINED.");
}

// What is not rendered has no shape; openings of IFC4 are cut out.
TEST(IfcText, VirtualElementsAndOpenings) {
  const std::string made =
      as_ifc2x3(
          file("#1=IFCVIRTUALELEMENT('0000000000000000000001',#9,'v',$,$,#2,#3,$);\n"
               "#4=IFCOPENINGSTANDARDCASE('0000000000000000000002',#9,'o',$,$,#2,#3,$,.OPENING.);\n"
               "#5=IFCEXTRUDEDAREASOLID(#7,$,#8,1.);\n#9=IFCOWNERHISTORY($,$,$,$,$,$,$,0);\n"))
          .text;
  EXPECT_EQ(arguments(made, "IFCVIRTUALELEMENT"), "'0000000000000000000001'|#9|'v'|$|$|#2|$|$");
  EXPECT_FALSE(arguments(made, "IFCOPENINGELEMENT").empty());
  const std::string placed = arguments(made, "IFCAXIS2PLACEMENT3D");
  EXPECT_EQ(placed.substr(placed.find('|')), "|$|$");
  EXPECT_EQ(arguments(made, "IFCEXTRUDEDAREASOLID").find("|$|"), std::string::npos);
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
