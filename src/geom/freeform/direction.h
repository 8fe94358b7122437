// SPDX-License-Identifier: Apache-2.0
// One parameter direction of a curve or surface: which control points count at t, and how much.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/freeform.h"

namespace oriel::geom::freeform {

/// The language's own limit.
inline constexpr int kMostDegree = 21;

/// Weights of the degree + 1 control points from `first` on, and their first two derivatives by the
/// parameter. Double: degree 21 leaves float no digits.
struct Blend {
  std::size_t first = 0;
  int count = 0;
  std::array<std::array<double, kMostDegree + 1>, 3> weight;
};

/// A checked basis with its parameters.
///
/// Model:   piecewise polynomials. A B-spline's knots are its parameters and each span is of
///          Cox-de Boor form. All others map each span between two parameters to t = 0...1:
///          Bernstein polynomials, powers of t (Taylor), the cubic with tangents half as long as
///          the chord of the neighbours (cardinal), or the matrix's rows.
/// Source:  "Object Files (.obj)", Wavefront 1991-1995, section "Mathematics for free-form
///          curves/surfaces", written with mental images, whose bases are those of the language;
///          L. Piegl, W. Tiller, "The NURBS Book", 2nd ed., algorithm A2.3.
/// Checked: FreeFormDirection.*
class Direction {
 public:
  /// Nothing, and `fault` says why, when basis and parameters do not fit.
  static std::optional<Direction> make(const scene::Basis* basis, const scene::BasisUse& use,
                                       std::string& fault);

  std::size_t control_points() const { return control_points_; }
  int degree() const { return degree_; }
  double begin() const { return breaks_.front(); }
  double end() const { return breaks_.back(); }
  /// Where spans that have a length meet, ascending, ends included.
  const std::vector<double>& breaks() const { return breaks_; }
  /// t outside of the range counts as its end.
  void blend(double t, Blend& result) const;

 private:
  void blend_spline(std::size_t span, double t, Blend& result) const;
  void blend_local(double t, double scale, Blend& result) const;

  scene::Basis::Kind kind_ = scene::Basis::Kind::Bezier;
  int degree_ = 0;
  std::size_t step_ = 1, control_points_ = 0;
  std::vector<double> parameters_, breaks_;
  std::vector<std::size_t> span_of_break_;  // index in parameters_ at which a break's span begins
  std::vector<float> matrix_;
};

}  // namespace oriel::geom::freeform
