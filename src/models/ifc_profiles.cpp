// SPDX-License-Identifier: Apache-2.0
#include "models/ifc_profiles.h"

#include <cstdlib>
#include <numbers>
#include <string_view>
#include <utility>

#include "base/math.h"

namespace oriel::models {
namespace {

/// More corners are left to assimp: the time to connect holes grows fast.
constexpr std::size_t kMaxCorners = 2000;
constexpr int kRoundPieces = 32;  // as many as assimp's

Outline box(double width, double height) {
  const double x = width / 2, y = height / 2;
  return {{-x, -y}, {x, -y}, {x, y}, {-x, y}};
}

Outline ellipse(double a, double b) {
  Outline made;
  for (int i = 0; i < kRoundPieces; ++i) {
    const double angle = 2 * std::numbers::pi * i / kRoundPieces;
    made.push_back({a * math::cos(angle), b * math::sin(angle)});
  }
  return made;
}

/// OverallWidth, OverallDepth, WebThickness, FlangeThickness, fillet, TopFlangeWidth,
/// TopFlangeThickness; the last two only of asymmetric shapes.
Outline i_shape(const std::vector<double>& v, bool asymmetric) {
  const double x = v[0] / 2, y = v[1] / 2, web = v[2] / 2, low = -y + v[3];
  const double top = asymmetric && v[5] > 0 ? v[5] / 2 : x;
  const double high = y - (asymmetric && v[6] > 0 ? v[6] : v[3]);
  return {{-x, -y}, {x, -y},   {x, low},     {web, low},   {web, high}, {top, high},
          {top, y}, {-top, y}, {-top, high}, {-web, high}, {-web, low}, {-x, low}};
}

/// Depth, FlangeWidth, WebThickness, FlangeThickness.
Outline t_shape(const std::vector<double>& v) {
  const double x = v[1] / 2, y = v[0] / 2, web = v[2] / 2, flange = y - v[3];
  return {{-web, -y}, {web, -y}, {web, flange}, {x, flange},
          {x, y},     {-x, y},   {-x, flange},  {-web, flange}};
}

/// The web is on the side of negative x.
Outline u_shape(const std::vector<double>& v) {
  const double x = v[1] / 2, y = v[0] / 2, web = -x + v[2], flange = y - v[3];
  return {{-x, -y},      {x, -y},     {x, -flange}, {web, -flange},
          {web, flange}, {x, flange}, {x, y},       {-x, y}};
}

/// The lower flange points to positive x.
Outline z_shape(const std::vector<double>& v) {
  const double y = v[0] / 2, web = v[2] / 2, x = v[1] - web, flange = y - v[3];
  return {{-web, -y}, {x, -y}, {x, -flange}, {web, -flange},
          {web, y},   {-x, y}, {-x, flange}, {-web, flange}};
}

/// Depth, Width, Thickness; Width 0: as Depth.
Outline l_shape(const std::vector<double>& v) {
  const double y = v[0] / 2, x = (v[1] > 0 ? v[1] : v[0]) / 2, t = v[2];
  return {{-x, -y}, {x, -y}, {x, -y + t}, {-x + t, -y + t}, {-x + t, y}, {-x, y}};
}

/// Depth, Width, WallThickness, Girth.
Outline c_shape(const std::vector<double>& v) {
  const double y = v[0] / 2, x = v[1] / 2, t = v[2], girth = y - v[3];
  return {{-x, -y},        {x, -y},          {x, -girth},     {x - t, -girth},
          {x - t, -y + t}, {-x + t, -y + t}, {-x + t, y - t}, {x - t, y - t},
          {x - t, girth},  {x, girth},       {x, y},          {-x, y}};
}

/// BottomXDim, TopXDim, YDim, TopXOffset.
Outline trapezium(const std::vector<double>& v) {
  const double x = v[0] / 2, y = v[2] / 2, left = -x + v[3];
  return {{-x, -y}, {x, -y}, {left + v[1], y}, {left, y}};
}

/// Outline of a parameterized profile about its origin; empty for other profiles.
Outline shape_of(std::string_view name, const std::vector<double>& v) {
  if (name == "IFCRECTANGLEHOLLOWPROFILEDEF")
    return with_holes(box(v[0], v[1]), {box(v[0] - 2 * v[2], v[1] - 2 * v[2])});
  if (name == "IFCCIRCLEHOLLOWPROFILEDEF")
    return with_holes(ellipse(v[0], v[0]), {ellipse(v[0] - v[1], v[0] - v[1])});
  if (name == "IFCELLIPSEPROFILEDEF") return ellipse(v[0], v[1]);
  if (name == "IFCISHAPEPROFILEDEF") return i_shape(v, false);
  if (name == "IFCASYMMETRICISHAPEPROFILEDEF") return i_shape(v, true);
  if (name == "IFCTSHAPEPROFILEDEF") return t_shape(v);
  if (name == "IFCUSHAPEPROFILEDEF") return u_shape(v);
  if (name == "IFCZSHAPEPROFILEDEF") return z_shape(v);
  if (name == "IFCLSHAPEPROFILEDEF") return l_shape(v);
  if (name == "IFCCSHAPEPROFILEDEF") return c_shape(v);
  if (name == "IFCTRAPEZIUMPROFILEDEF") return trapezium(v);
  return {};
}

/// ProfileType, ProfileName, OuterCurve, InnerCurves.
std::optional<Outline> outline_with_voids(const StepEntity& profile, const IfcCurves& curves) {
  const auto outer = curves.outline(profile.arguments[2]);
  if (!outer) return std::nullopt;
  std::size_t corners = outer->size();
  std::vector<Outline> holes;
  for (const std::string& reference : step_list(profile.arguments[3])) {
    const auto hole = curves.outline(reference);
    if (!hole) return std::nullopt;
    corners += hole->size();
    holes.push_back(*hole);
  }
  if (corners > kMaxCorners) return std::nullopt;
  return with_holes(*outer, std::move(holes));
}

}  // namespace

std::optional<Outline> profile_outline(const StepEntity& profile, const IfcCurves& curves) {
  constexpr std::size_t kFirst = 3;  // arguments before the measures
  constexpr std::size_t kCount = 8;
  if (profile.arguments.size() <= kFirst || profile.arguments[0] != ".AREA.") return std::nullopt;
  if (profile.name == "IFCARBITRARYPROFILEDEFWITHVOIDS") return outline_with_voids(profile, curves);
  std::vector<double> measures(kCount, 0.0);
  for (std::size_t i = 0; i < kCount && kFirst + i < profile.arguments.size(); ++i)
    measures[i] = std::strtod(profile.arguments[kFirst + i].c_str(), nullptr);
  Outline shape = shape_of(profile.name, measures);
  // assimp requires the position that IFC4 made optional.
  if (profile.arguments[2] == "$" && profile.name == "IFCRECTANGLEPROFILEDEF")
    shape = box(measures[0], measures[1]);
  if (profile.arguments[2] == "$" && profile.name == "IFCCIRCLEPROFILEDEF")
    shape = ellipse(measures[0], measures[0]);
  if (shape.empty()) return std::nullopt;
  return placed(shape, curves.placement(profile.arguments[2]));
}

}  // namespace oriel::models
