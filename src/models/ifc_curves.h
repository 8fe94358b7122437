// SPDX-License-Identifier: Apache-2.0
// Points of the curves of IFC files.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "models/outline.h"
#include "models/step_text.h"

namespace oriel::models {

using IfcPoint = std::vector<double>;  ///< as written; map coordinates have many digits

/// The unit of plane angles in radians.
double angle_unit(const StepFile& file);

/// Evaluates curves. It refers to entities of a file through a function; null = no such entity.
class IfcCurves {
 public:
  using Find = std::function<const StepEntity*(const std::string& reference)>;

  IfcCurves(Find find, double angle_unit) : find_(std::move(find)), angle_unit_(angle_unit) {}

  /// Of a point list in two or three dimensions.
  std::vector<IfcPoint> points(const std::string& reference) const;
  /// The path of an indexed curve; arcs are divided into pieces.
  std::vector<IfcPoint> indexed_path(const StepEntity& curve) const;
  /// The outline of a closed curve in the plane; unset for kinds other than polylines, indexed
  /// curves, circles, ellipses, and composites of polylines and of trimmed lines and circles.
  std::optional<Outline> outline(const std::string& reference) const;
  /// Location and direction of x of a placement in the plane; the identity for "$".
  std::array<double, 4> placement(const std::string& reference) const;

 private:
  std::optional<Outline> path(const StepEntity& curve, int depth) const;
  std::optional<Outline> conic(const StepEntity& curve) const;
  std::optional<Outline> composite(const StepEntity& curve, int depth) const;
  std::optional<Outline> trimmed(const StepEntity& curve) const;

  Find find_;
  double angle_unit_;
};

}  // namespace oriel::models
