// SPDX-License-Identifier: Apache-2.0
// Outlines with holes, and profiles of IFC files: areas compared with closed forms.
#include "models/outline.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "models/ifc_profiles.h"
#include "models/ifc_text.h"

namespace oriel::models {
namespace outline_test {

Outline square(double x, double y, double half) {
  return {{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}};
}

/// Whether a point is inside, by the crossings of a ray toward positive x.
bool contains(const Outline& outline, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1]))
      inside = !inside;
  }
  return inside;
}

TEST(Outline, EnclosesTheAreaOutsideItsHoles) {
  const double xs[] = {-3, 0, 3};
  std::vector<Outline> holes;
  for (const double x : xs)
    for (const double y : xs) {
      holes.push_back(square(x, y, 1));
      if (x == y) std::reverse(holes.back().begin(), holes.back().end());
    }
  Outline outer = square(0, 0, 5);
  for (const bool clockwise : {false, true}) {
    const Outline whole = with_holes(outer, holes);
    EXPECT_EQ(whole.size(), 4u + 9 * (4 + 2)) << clockwise;
    EXPECT_NEAR(signed_area(whole), 100 - 9 * 4, 1e-12);
    for (double x = -5.41; x < 5.5; x += .37)
      for (double y = -5.21; y < 5.5; y += .41) {
        const auto in_hole = [](double c) {
          return std::abs(std::abs(c) - 3) < 1 || std::abs(c) < 1;
        };
        const bool expected = std::abs(x) < 5 && std::abs(y) < 5 && !(in_hole(x) && in_hole(y));
        EXPECT_EQ(contains(whole, x, y), expected) << x << ' ' << y;
      }
    std::reverse(outer.begin(), outer.end());
  }
}

// The two arms of a U end beside the hole, so that bridges to the nearest corner leave the outline.
TEST(Outline, BridgesStayInside) {
  const Outline u = {{0, 0}, {6, 0}, {6, 5}, {4, 5}, {4, 2}, {2, 2}, {2, 5}, {0, 5}};
  const Outline whole = with_holes(u, {square(5, 4, .5), square(1, 4, .5), square(3, 1, .25)});
  EXPECT_NEAR(signed_area(whole), 24 - 1 - 1 - .25, 1e-12);
  EXPECT_FALSE(contains(whole, 3, 3));
  EXPECT_FALSE(contains(whole, 5, 4));
  EXPECT_TRUE(contains(whole, 4.3, 4));
}

/// The outline of entity #1 of a file.
std::optional<Outline> outline_of(const std::string& entities) {
  const StepFile file = parse_step("DATA;\n" + entities + "ENDSEC;\n");
  std::map<std::string, const StepEntity*> by_id;
  for (const StepEntity& e : file.entities) by_id[fmt::format("#{}", e.id)] = &e;
  const IfcCurves curves([&](const std::string& reference) { return by_id[reference]; },
                         angle_unit(file));
  return profile_outline(file.entities.at(0), curves);
}

struct Moments {
  double area = 0, x = 0, y = 0;  ///< area and centroid
};

Moments moments(const Outline& outline) {
  Moments m;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const double cross = a[0] * b[1] - b[0] * a[1];
    m.area += cross / 2;
    m.x += (a[0] + b[0]) * cross / 6;
    m.y += (a[1] + b[1]) * cross / 6;
  }
  m.x /= m.area;
  m.y /= m.area;
  return m;
}

TEST(IfcProfiles, ShapesHaveTheirAreaAndCentroid) {
  // The area of a regular polygon of 32 corners by that of its circle.
  const double round = 16 * std::sin((2 * std::numbers::pi) / 32);
  const struct {
    const char* profile;
    double area, x, y;
  } kCases[] = {
      {"IFCISHAPEPROFILEDEF(.AREA.,$,$,10.,20.,1.,2.,$)", 2 * 20 + 16, 0, 0},
      {"IFCASYMMETRICISHAPEPROFILEDEF(.AREA.,$,$,10.,20.,1.,2.,$,6.,4.,$,$)", 20 + 24 + 14, 0,
       (20 * -9 + 24 * 8 + 14 * -1) / 58.},
      {"IFCLSHAPEPROFILEDEF(.AREA.,$,$,10.,6.,1.,$,$,$)", 6 + 9, (6 * 0 + 9 * -2.5) / 15.,
       (6 * -4.5 + 9 * .5) / 15.},
      {"IFCLSHAPEPROFILEDEF(.AREA.,$,$,10.,$,1.,$,$,$)", 19, 9 * -4.5 / 19., 9 * -4.5 / 19.},
      {"IFCTSHAPEPROFILEDEF(.AREA.,$,$,10.,6.,1.,2.,$,$,$,$,$)", 8 + 12, 0,
       (8 * -1 + 12 * 4) / 20.},
      {"IFCUSHAPEPROFILEDEF(.AREA.,$,$,10.,6.,1.,2.,$,$,$)", 2 * 12 + 6, 6 * -2.5 / 30., 0},
      {"IFCZSHAPEPROFILEDEF(.AREA.,$,$,10.,6.,1.,2.,$,$)", 2 * 12 + 6, 0, 0},
      {"IFCCSHAPEPROFILEDEF(.AREA.,$,$,10.,6.,1.,3.,$)", 8 + 2 * 6 + 2 * 2,
       (8 * -2.5 + 4 * 2.5) / 24., 0},
      {"IFCTRAPEZIUMPROFILEDEF(.AREA.,$,$,6.,2.,3.,1.)", 12, -5 / 12., -.25},
      {"IFCRECTANGLEHOLLOWPROFILEDEF(.AREA.,$,$,6.,4.,.5,$,$)", 24 - 15, 0, 0},
      {"IFCCIRCLEHOLLOWPROFILEDEF(.AREA.,$,$,2.,.5)", round * (4 - 2.25), 0, 0},
      {"IFCELLIPSEPROFILEDEF(.AREA.,$,$,2.,3.)", round * 6, 0, 0},
      {"IFCRECTANGLEPROFILEDEF(.AREA.,$,$,2.,3.)", 6, 0, 0},
      {"IFCCIRCLEPROFILEDEF(.AREA.,$,$,2.)", round * 4, 0, 0},
  };
  for (const auto& c : kCases) {
    const auto outline = outline_of(fmt::format("#1={};\n", c.profile));
    ASSERT_TRUE(outline) << c.profile;
    const Moments m = moments(*outline);
    EXPECT_NEAR(m.area, c.area, 1e-9) << c.profile;
    EXPECT_NEAR(m.x, c.x, 1e-9) << c.profile;
    EXPECT_NEAR(m.y, c.y, 1e-9) << c.profile;
  }
  EXPECT_FALSE(outline_of("#1=IFCRECTANGLEPROFILEDEF(.AREA.,$,#2,2.,3.);\n"));  // assimp's own
}

// A quarter turn to the left about (3, 5).
TEST(IfcProfiles, PositionsMoveAndTurn) {
  const auto outline = outline_of(
      "#1=IFCLSHAPEPROFILEDEF(.AREA.,$,#2,10.,6.,1.,$,$,$);\n#2=IFCAXIS2PLACEMENT2D(#3,#4);\n"
      "#3=IFCCARTESIANPOINT((3.,5.));\n#4=IFCDIRECTION((0.,2.));\n");
  ASSERT_TRUE(outline);
  const Moments m = moments(*outline);
  EXPECT_NEAR(m.x, 3 + 22.5 / 15, 1e-9);
  EXPECT_NEAR(m.y, 5 - 22.5 / 15, 1e-9);
}

/// A stadium: a rectangle of 4 x 2 and two half circles; arcs have 16 pieces.
TEST(IfcProfiles, CompositeCurvesAndCirclesBoundProfiles) {
  const std::string points =
      "#10=IFCCARTESIANPOINT((-2.,-1.));\n#11=IFCCARTESIANPOINT((2.,-1.));\n"
      "#12=IFCCARTESIANPOINT((2.,1.));\n#13=IFCCARTESIANPOINT((-2.,1.));\n"
      "#14=IFCCARTESIANPOINT((2.,0.));\n#15=IFCCARTESIANPOINT((-2.,0.));\n"
      "#16=IFCAXIS2PLACEMENT2D(#14,$);\n#17=IFCAXIS2PLACEMENT2D(#15,$);\n"
      "#18=IFCCIRCLE(#16,1.);\n#19=IFCCIRCLE(#17,1.);\n"
      "#20=IFCPOLYLINE((#10,#11));\n#21=IFCPOLYLINE((#12,#13));\n#40=IFCCIRCLE(#41,.5);\n"
      "#41=IFCAXIS2PLACEMENT2D(#42,$);\n#42=IFCCARTESIANPOINT((0.,0.));\n";
  const std::string by_points =
      "#22=IFCTRIMMEDCURVE(#18,(#11),(#12),.T.,.CARTESIAN.);\n"
      "#23=IFCTRIMMEDCURVE(#19,(#10),(#13),.F.,.CARTESIAN.);\n";
  const std::string by_angles =
      "#22=IFCTRIMMEDCURVE(#18,(IFCPARAMETERVALUE(270.)),(IFCPARAMETERVALUE(90.)),.T.,"
      ".PARAMETER.);\n#23=IFCTRIMMEDCURVE(#19,(IFCPARAMETERVALUE(270.)),"
      "(IFCPARAMETERVALUE(90.)),.F.,.PARAMETER.);\n"
      "#50=IFCCONVERSIONBASEDUNIT(*,.PLANEANGLEUNIT.,'DEGREE',#51);\n";
  for (const std::string& arcs : {by_points, by_angles}) {
    const auto outline = outline_of(
        "#1=IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,#2,(#40));\n"
        "#2=IFCCOMPOSITECURVE((#3,#4,#5,#6),.F.);\n"
        "#3=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#20);\n"
        "#4=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#22);\n"
        "#5=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#21);\n"
        "#6=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.F.,#23);\n" +
        points + arcs);
    ASSERT_TRUE(outline);
    const double turn = (2 * std::numbers::pi);
    EXPECT_NEAR(moments(*outline).area,
                8 + 16 * std::sin(turn / 32) - 16 * std::sin(turn / 32) * .25, 1e-6);
    EXPECT_NEAR(moments(*outline).x, 0, 1e-6);
  }
}

TEST(IfcProfiles, DamagedEntitiesAreLeft) {
  for (const char* entities :
       {"#1=IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,#2,(#3));\n",
        "#1=IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,#2,(#2));\n#2=IFCCOMPOSITECURVE((#3),.F.);\n"
        "#3=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#2);\n",
        "#1=IFCARBITRARYPROFILEDEFWITHVOIDS(.AREA.,$,#2,$);\n#2=IFCPOLYLINE((#3,#3,#3));\n"
        "#3=IFCCARTESIANPOINT((1.));\n",
        "#1=IFCARBITRARYCLOSEDPROFILEDEF(.AREA.,$,#1);\n", "#1=IFCISHAPEPROFILEDEF();\n"})
    EXPECT_FALSE(outline_of(entities)) << entities;
}

}  // namespace outline_test
}  // namespace oriel::models
