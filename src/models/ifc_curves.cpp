// SPDX-License-Identifier: Apache-2.0
#include "models/ifc_curves.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/math.h"

namespace oriel::models {
namespace {

/// Pieces of an arc, and of a quarter of a circle.
constexpr int kArcPieces = 16;
constexpr int kQuarterPieces = 8;
constexpr double kTurn = 2 * std::numbers::pi;

double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }

IfcPoint point_of(const std::string& list) {
  IfcPoint p;
  for (const std::string& coordinate : step_list(list)) p.push_back(number(coordinate));
  return p;
}

/// Through three points of a plane; straight if they lie in a line.
std::vector<IfcPoint> arc(const std::vector<IfcPoint>& p) {
  const double ax = p[1][0] - p[0][0], ay = p[1][1] - p[0][1];
  const double bx = p[2][0] - p[0][0], by = p[2][1] - p[0][1];
  const double twice = 2 * (ax * by - ay * bx);
  if (twice == 0) return p;
  const double aa = ax * ax + ay * ay, bb = bx * bx + by * by;
  const double cx = (by * aa - ay * bb) / twice, cy = (ax * bb - bx * aa) / twice;
  const auto angle = [&](double x, double y) {
    return math::atan2(static_cast<float>(y - cy), static_cast<float>(x - cx));
  };
  const double start = angle(0, 0);
  double turn = angle(bx, by) - start;
  // Counter-clockwise if the middle point lies to the right of the chord.
  if (twice > 0 && turn < 0) turn += kTurn;
  if (twice < 0 && turn > 0) turn -= kTurn;
  std::vector<IfcPoint> path{p[0]};
  for (int i = 1; i < kArcPieces; ++i) {
    const auto t = static_cast<float>(turn * i / kArcPieces);
    const double c = math::cos(t), s = math::sin(t);
    path.push_back({p[0][0] + cx - cx * c + cy * s, p[0][1] + cy - cx * s - cy * c});
  }
  path.push_back(p[2]);
  return path;
}

std::optional<std::array<double, 2>> plane_point(const StepEntity* entity) {
  if (!entity || entity->name != "IFCCARTESIANPOINT" || entity->arguments.empty())
    return std::nullopt;
  const IfcPoint p = point_of(entity->arguments[0]);
  if (p.size() < 2) return std::nullopt;
  return std::array{p[0], p[1]};
}

bool is_same(const std::array<double, 2>& a, const std::array<double, 2>& b, double size) {
  constexpr double kSame = 1e-6;
  return math::hypot(a[0] - b[0], a[1] - b[1]) <= kSame * size;
}

/// Removes corners that follow one at the same place; the outline is closed.
void drop_repeated(Outline& outline) {
  double size = 0;
  for (const auto& p : outline)
    size = std::max(size, math::hypot(p[0] - outline[0][0], p[1] - outline[0][1]));
  outline.erase(std::unique(outline.begin(), outline.end(),
                            [&](const auto& a, const auto& b) { return is_same(a, b, size); }),
                outline.end());
  while (outline.size() > 1 && is_same(outline.front(), outline.back(), size)) outline.pop_back();
}

/// The value or the point of a trim, "(IFCPARAMETERVALUE(1.),#2)".
std::optional<double> parameter_of(const std::string& trim) {
  constexpr std::string_view kValue = "IFCPARAMETERVALUE(";
  for (const std::string& item : step_list(trim))
    if (item.starts_with(kValue)) return number(item.substr(kValue.size()));
  return std::nullopt;
}

}  // namespace

double angle_unit(const StepFile& file) {
  constexpr double kDegree = std::numbers::pi / 180;
  for (const StepEntity& e : file.entities)
    if (e.name == "IFCCONVERSIONBASEDUNIT" && e.arguments.size() > 1 &&
        e.arguments[1] == ".PLANEANGLEUNIT.")
      return kDegree;
  return 1;
}

std::vector<IfcPoint> IfcCurves::points(const std::string& reference) const {
  std::vector<IfcPoint> points;
  const StepEntity* list = find_(reference);
  if (list && list->name.starts_with("IFCCARTESIANPOINTLIST") && !list->arguments.empty())
    for (const std::string& point : step_list(list->arguments[0]))
      points.push_back(point_of(point));
  return points;
}

std::vector<IfcPoint> IfcCurves::indexed_path(const StepEntity& curve) const {
  const std::vector<IfcPoint> all = points(curve.arguments[0]);
  const auto segments =
      curve.arguments.size() > 1 ? step_list(curve.arguments[1]) : std::vector<std::string>();
  if (segments.empty()) return all;
  std::vector<IfcPoint> path;
  for (const std::string& segment : segments) {
    const std::size_t open = segment.find('(');
    if (open == segment.npos || segment.back() != ')') continue;
    std::vector<IfcPoint> corners;
    std::string indices = segment.substr(open);
    if (indices.starts_with("((")) indices = indices.substr(1, indices.size() - 2);
    for (const std::string& index : step_list(indices)) {
      const std::size_t i = std::strtoull(index.c_str(), nullptr, 10);
      if (i >= 1 && i <= all.size()) corners.push_back(all[i - 1]);
    }
    if (segment.starts_with("IFCARCINDEX") && corners.size() == 3 && corners[0].size() == 2)
      corners = arc(corners);
    for (const IfcPoint& p : corners)
      if (path.empty() || path.back() != p) path.push_back(p);
  }
  return path;
}

std::array<double, 4> IfcCurves::placement(const std::string& reference) const {
  std::array<double, 4> placed{0, 0, 1, 0};
  const StepEntity* axes = find_(reference);
  if (!axes || axes->name != "IFCAXIS2PLACEMENT2D" || axes->arguments.size() < 2) return placed;
  if (const auto at = plane_point(find_(axes->arguments[0]))) {
    placed[0] = (*at)[0];
    placed[1] = (*at)[1];
  }
  const StepEntity* x = find_(axes->arguments[1]);
  if (!x || x->name != "IFCDIRECTION" || x->arguments.empty()) return placed;
  const IfcPoint direction = point_of(x->arguments[0]);
  if (direction.size() < 2) return placed;
  const double length = math::hypot(direction[0], direction[1]);
  if (!(length > 0)) return placed;
  placed[2] = direction[0] / length;
  placed[3] = direction[1] / length;
  return placed;
}

std::optional<Outline> IfcCurves::outline(const std::string& reference) const {
  const StepEntity* curve = find_(reference);
  if (!curve) return std::nullopt;
  auto made = path(*curve, 0);
  if (!made) return std::nullopt;
  drop_repeated(*made);
  if (made->size() < 3) return std::nullopt;
  return made;
}

std::optional<Outline> IfcCurves::path(const StepEntity& curve, int depth) const {
  constexpr int kMaxDepth = 20;
  if (curve.arguments.empty() || depth > kMaxDepth) return std::nullopt;
  Outline made;
  if (curve.name == "IFCPOLYLINE") {
    for (const std::string& reference : step_list(curve.arguments[0])) {
      const auto point = plane_point(find_(reference));
      if (!point) return std::nullopt;
      made.push_back(*point);
    }
    return made;
  }
  if (curve.name == "IFCINDEXEDPOLYCURVE") {
    for (const IfcPoint& p : indexed_path(curve)) {
      if (p.size() < 2) return std::nullopt;
      made.push_back({p[0], p[1]});
    }
    return made;
  }
  if (curve.name == "IFCCIRCLE" || curve.name == "IFCELLIPSE") return conic(curve);
  if (curve.name == "IFCCOMPOSITECURVE") return composite(curve, depth + 1);
  if (curve.name == "IFCTRIMMEDCURVE") return trimmed(curve);
  return std::nullopt;
}

std::optional<Outline> IfcCurves::conic(const StepEntity& curve) const {
  const bool is_circle = curve.name == "IFCCIRCLE";
  if (curve.arguments.size() < (is_circle ? 2 : 3)) return std::nullopt;
  const double a = number(curve.arguments[1]), b = is_circle ? a : number(curve.arguments[2]);
  Outline made;
  for (int i = 0; i < 4 * kQuarterPieces; ++i) {
    const double angle = std::numbers::pi / 2 * i / kQuarterPieces;
    made.push_back({a * math::cos(angle), b * math::sin(angle)});
  }
  return placed(made, placement(curve.arguments[0]));
}

std::optional<Outline> IfcCurves::composite(const StepEntity& curve, int depth) const {
  Outline made;
  for (const std::string& reference : step_list(curve.arguments[0])) {
    const StepEntity* segment = find_(reference);
    if (!segment || segment->name != "IFCCOMPOSITECURVESEGMENT" || segment->arguments.size() < 3)
      return std::nullopt;
    const StepEntity* parent = find_(segment->arguments[2]);
    auto piece = parent ? path(*parent, depth) : std::nullopt;
    if (!piece) return std::nullopt;
    if (segment->arguments[1] == ".F.") std::reverse(piece->begin(), piece->end());
    made.insert(made.end(), piece->begin(), piece->end());
  }
  return made;
}

/// BasisCurve, Trim1, Trim2, SenseAgreement, MasterRepresentation.
std::optional<Outline> IfcCurves::trimmed(const StepEntity& curve) const {
  if (curve.arguments.size() < 4) return std::nullopt;
  const StepEntity* basis = find_(curve.arguments[0]);
  if (!basis || basis->arguments.size() < 2) return std::nullopt;
  std::array<std::optional<std::array<double, 2>>, 2> ends;
  for (int i = 0; i < 2; ++i)
    for (const std::string& item : step_list(curve.arguments[1 + i]))
      if (item.starts_with('#')) ends[i] = plane_point(find_(item));
  if (basis->name == "IFCLINE" && ends[0] && ends[1]) return Outline{*ends[0], *ends[1]};
  if (basis->name != "IFCCIRCLE") return std::nullopt;
  const std::array<double, 4> axes = placement(basis->arguments[0]);
  const double radius = number(basis->arguments[1]);
  std::array<double, 2> angles{};
  for (int i = 0; i < 2; ++i) {
    if (const auto value = parameter_of(curve.arguments[1 + i])) {
      angles[i] = *value * angle_unit_;
    } else if (ends[i]) {
      const double x = (*ends[i])[0] - axes[0], y = (*ends[i])[1] - axes[1];
      angles[i] = math::atan2(axes[2] * y - axes[3] * x, axes[2] * x + axes[3] * y);
    } else {
      return std::nullopt;
    }
  }
  const bool forwards = curve.arguments[3] != ".F.";
  double sweep = std::fmod(forwards ? angles[1] - angles[0] : angles[0] - angles[1], kTurn);
  if (!std::isfinite(sweep)) return std::nullopt;
  if (sweep <= 0) sweep += kTurn;
  Outline made;
  for (int i = 0; i <= kArcPieces; ++i) {
    const double angle = angles[0] + (forwards ? sweep : -sweep) * i / kArcPieces;
    made.push_back({radius * math::cos(angle), radius * math::sin(angle)});
  }
  return placed(made, axes);
}

}  // namespace oriel::models
