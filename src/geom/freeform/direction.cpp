// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/direction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace oriel::geom::freeform {
namespace {

using Kind = scene::Basis::Kind;

/// Bernstein polynomials of degree n at t into out[0...n].
void bernstein(int n, double t, double* out) {
  out[0] = 1;
  for (int j = 1; j <= n; ++j) {
    double saved = 0;
    for (int k = 0; k < j; ++k) {
      const double value = out[k];
      out[k] = saved + (1 - t) * value;
      saved = t * value;
    }
    out[j] = saved;
  }
}

void bezier(int n, double t, Blend& b) {
  bernstein(n, t, b.weight[0].data());
  // The derivative is n times the difference of polynomials of one degree less.
  std::array<double, kMaxDegree + 3> lower{};
  const auto differences = [&](int order, double factor, double* out) {
    lower.fill(0);
    std::fill_n(out, n + 1, 0.0);
    if (order > n) return;
    bernstein(n - order, t, lower.data() + order);  // shifted: lower[i + order] = B_i
    for (int i = 0; i <= n; ++i) {
      const auto at = [&](int k) { return k < 0 || k > n - order ? 0 : lower[k + order]; };
      out[i] =
          order == 1 ? factor * (at(i - 1) - at(i)) : factor * (at(i - 2) - 2 * at(i - 1) + at(i));
    }
  };
  differences(1, n, b.weight[1].data());
  differences(2, n * (n - 1.0), b.weight[2].data());
}

/// Evaluates sums of powers of t with the given coefficients, and their derivatives.
template <typename Coefficient>
void from_powers(int n, double t, Coefficient coefficient, Blend& b) {
  for (int i = 0; i <= n; ++i) {
    double value = 0, first = 0, second = 0;
    for (int j = n; j >= 0; --j) {  // Horner's scheme for all three at once
      second = second * t + 2 * first;
      first = first * t + value;
      value = value * t + coefficient(i, j);
    }
    b.weight[0][i] = value;
    b.weight[1][i] = first;
    b.weight[2][i] = second;
  }
}

// E. Catmull, R. Rom, 1974, in rows of coefficients of 1, t, t^2, t^3.
constexpr double kCardinal[4][4] = {
    {0, -.5, 1, -.5}, {1, 0, -2.5, 1.5}, {0, .5, 2, -1.5}, {0, 0, -.5, .5}};

std::string find_fault(const scene::Basis* basis, const scene::BasisUse& use) {
  if (!basis) return fmt::format("unknown basis \"{}\"", use.basis);
  if (basis->degree < 1 || basis->degree > kMaxDegree)
    return fmt::format("basis \"{}\" has degree {}, which must be in 1...{}", basis->name,
                       basis->degree, kMaxDegree);
  const auto order = static_cast<std::size_t>(basis->degree) + 1;
  if (basis->kind == Kind::Matrix && basis->matrix.size() != order * order)
    return fmt::format("the matrix of basis \"{}\" has {} numbers, not {}", basis->name,
                       basis->matrix.size(), order * order);
  if (basis->kind == Kind::Matrix && (basis->step < 1 || basis->step > kMaxDegree + 1))
    return fmt::format("basis \"{}\" has step {}", basis->name, basis->step);
  const bool spline = basis->kind == Kind::BSpline;
  if (use.parameters.size() < (spline ? 2 * order : 2))
    return fmt::format("it has too few parameters ({})", use.parameters.size());
  for (std::size_t i = 1; i < use.parameters.size(); ++i)
    if (!(spline ? use.parameters[i] >= use.parameters[i - 1]
                 : use.parameters[i] > use.parameters[i - 1]))
      return "its parameters are not ascending";
  return {};
}

}  // namespace

std::optional<Direction> Direction::make(const scene::Basis* basis, const scene::BasisUse& use,
                                         std::string& fault) {
  fault = find_fault(basis, use);
  if (!fault.empty()) return std::nullopt;
  Direction d;
  d.kind_ = basis->kind;
  d.degree_ = basis->kind == Kind::Cardinal ? 3 : basis->degree;
  d.step_ = static_cast<std::size_t>(basis->step);
  d.matrix_ = basis->matrix;
  d.control_points_ = basis->control_points(use.parameters.size());
  d.parameters_.assign(use.parameters.begin(), use.parameters.end());
  const bool spline = d.kind_ == Kind::BSpline;
  const std::size_t margin = spline ? static_cast<std::size_t>(d.degree_) : 0;
  for (std::size_t i = margin; i + margin < d.parameters_.size(); ++i) {
    if (!d.breaks_.empty() && d.parameters_[i] == d.breaks_.back()) {
      d.span_of_break_.back() = i;  // an empty span; the next span begins at the same break
      continue;
    }
    d.breaks_.push_back(d.parameters_[i]);
    d.span_of_break_.push_back(i);
  }
  if (d.breaks_.size() < 2) {
    fault = "its knots define an empty range";
    return std::nullopt;
  }
  return d;
}

void Direction::blend(double t, Blend& result) const {
  t = std::clamp(t, begin(), end());
  const auto after = std::upper_bound(breaks_.begin(), breaks_.end() - 1, t);
  const auto at =
      static_cast<std::size_t>(std::max<std::ptrdiff_t>(after - breaks_.begin() - 1, 0));
  const std::size_t span = span_of_break_[at];
  result.count = degree_ + 1;
  if (kind_ == Kind::BSpline) return blend_spline(span, t, result);
  const double width = breaks_[at + 1] - breaks_[at];
  const auto order = static_cast<std::size_t>(degree_) + 1;
  const std::size_t stride = kind_ == Kind::Bezier     ? order - 1
                             : kind_ == Kind::Taylor   ? order
                             : kind_ == Kind::Cardinal ? 1
                                                       : step_;
  result.first = span * stride;
  blend_local((t - breaks_[at]) / width, 1 / width, result);
}

void Direction::blend_local(double t, double scale, Blend& result) const {
  const auto row = [this](int i) {
    return matrix_.data() + static_cast<std::size_t>(i) * static_cast<std::size_t>(degree_ + 1);
  };
  switch (kind_) {
    case Kind::Taylor:
      from_powers(
          degree_, t, [](int i, int j) { return i == j ? 1.0 : 0.0; }, result);
      break;
    case Kind::Cardinal:
      from_powers(
          degree_, t, [](int i, int j) { return kCardinal[i][j]; }, result);
      break;
    case Kind::Matrix:
      from_powers(
          degree_, t, [row](int i, int j) { return double{row(i)[j]}; }, result);
      break;
    default:
      bezier(degree_, t, result);
  }
  for (int i = 0; i < result.count; ++i) {
    result.weight[1][i] *= scale;
    result.weight[2][i] *= scale * scale;
  }
}

void Direction::blend_spline(std::size_t span, double t, Blend& result) const {
  const int p = degree_;
  const double* const knot = parameters_.data() + span;  // knot[0] <= t < knot[1]
  result.first = span - static_cast<std::size_t>(p);
  // Basis functions of degree p - 2, p - 1 and p; the derivatives need the lower degrees.
  std::array<std::array<double, kMaxDegree + 1>, 3> level{};
  std::array<double, kMaxDegree + 1> n{};
  n[0] = 1;
  for (int d = 0; d <= p; ++d) {
    if (d > 0) {
      double saved = 0;
      for (int r = 0; r < d; ++r) {
        const double right = knot[r + 1], left = knot[r + 1 - d];
        const double share = n[r] / (right - left);
        n[r] = saved + (right - t) * share;
        saved = (t - left) * share;
      }
      n[d] = saved;
    }
    if (p - d <= 2) level[p - d] = n;
  }
  result.weight[0] = level[0];
  // N'_i,d = d (N_i,d-1 / (k_i+d - k_i) - N_i+1,d-1 / (k_i+d+1 - k_i+1)); index i starts at the
  // first nonzero function, whose support begins at knot[-d].
  const auto derive = [knot](const auto& below, int d, auto& out) {
    for (int i = 0; i <= d; ++i) {
      const double a = i > 0 ? below[i - 1] / (knot[i] - knot[i - d]) : 0;
      const double b = i < d ? below[i] / (knot[i + 1] - knot[i + 1 - d]) : 0;
      out[i] = d * (a - b);
    }
  };
  derive(level[1], p, result.weight[1]);
  result.weight[2].fill(0);
  if (p < 2) return;
  std::array<double, kMaxDegree + 1> slope{};
  derive(level[2], p - 1, slope);
  derive(slope, p, result.weight[2]);
}

}  // namespace oriel::geom::freeform
