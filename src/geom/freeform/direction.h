// SPDX-License-Identifier: Apache-2.0
// Basis functions of one parameter direction: weights of the control points at t.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/freeform.h"

namespace oriel::geom::freeform {

/// Limit of the .mi language.
inline constexpr int kMaxDegree = 21;

/// Weights of the degree + 1 control points from `first` on, with their first two derivatives.
/// Double, because float has too few digits for degree 21.
struct Blend {
  std::size_t first = 0;
  int count = 0;
  std::array<std::array<double, kMaxDegree + 1>, 3> weight;
};

/// A validated basis with its parameters.
///
/// Model:   piecewise polynomials. The knots of a B-spline are its parameters, and each span has
///          the Cox-de Boor form. All other bases map each span between two parameters to t =
///          0...1: Bernstein polynomials, powers of t (Taylor), the cubic whose tangents are half
///          the chord of the neighbours (cardinal), or the rows of a matrix.
/// Source:  "Object Files (.obj)", Wavefront 1991-1995, section "Mathematics for free-form
///          curves/surfaces", written with mental images and defining the same bases as the .mi
///          language; L. Piegl, W. Tiller, "The NURBS Book", 2nd ed., algorithm A2.3.
/// Checked: FreeFormDirection.*
class Direction {
 public:
  /// Returns nullopt and sets `fault` to the reason if basis and parameters do not match.
  static std::optional<Direction> make(const scene::Basis* basis, const scene::BasisUse& use,
                                       std::string& fault);

  std::size_t control_points() const { return control_points_; }
  int degree() const { return degree_; }
  double begin() const { return breaks_.front(); }
  double end() const { return breaks_.back(); }
  /// Ends of the non-empty spans, ascending.
  const std::vector<double>& breaks() const { return breaks_; }
  /// t is clamped to the range.
  void blend(double t, Blend& result) const;

 private:
  void blend_spline(std::size_t span, double t, Blend& result) const;
  void blend_local(double t, double scale, Blend& result) const;

  scene::Basis::Kind kind_ = scene::Basis::Kind::Bezier;
  int degree_ = 0;
  std::size_t step_ = 1, control_points_ = 0;
  std::vector<double> parameters_, breaks_;
  // index in parameters_ where the span of each break begins
  std::vector<std::size_t> span_of_break_;
  std::vector<float> matrix_;
};

}  // namespace oriel::geom::freeform
