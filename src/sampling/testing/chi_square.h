// SPDX-License-Identifier: Apache-2.0
// Test support: Pearson's chi-square test of samplers, with pooling of small cells.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "base/vec.h"
#include "sampling/sampler.h"

namespace oriel::testing {

// Conventions
//   Everything here runs in double: these are the yardsticks.
//   Chance comes from Sampler with a different pixel for every draw, which makes draws independent
//   (a stratified stream would pass too easily).

/// Upper tail probability of the chi-square distribution.
/// Source: the series and the continued fraction of the incomplete gamma function, Abramowitz,
///         Stegun 6.5.29 and 6.5.31.
inline double chi_square_tail(double statistic, int degrees) {
  const double a = 0.5 * degrees, x = 0.5 * statistic;
  if (degrees <= 0 || x <= 0) return 1;
  const double front = std::exp(-x + a * std::log(x) - std::lgamma(a));
  if (x < a + 1) {
    double term = 1 / a, sum = term;
    for (int n = 1; n < 10000 && term > sum * 1e-15; ++n) sum += term *= x / (a + n);
    return 1 - sum * front;
  }
  constexpr double kTiny = 1e-300;
  double b = x + 1 - a, c = 1 / kTiny, d = 1 / b, h = d;
  for (int n = 1; n < 10000; ++n) {
    const double an = -n * (n - a);
    b += 2;
    d = 1 / (std::abs(an * d + b) < kTiny ? kTiny : an * d + b);
    c = std::abs(b + an / c) < kTiny ? kTiny : b + an / c;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-14) break;
  }
  return front * h;
}

/// Significance of each of `tests` independent tests with the joint significance `overall`.
/// Source: Sidak 1967.
inline double sidak(double overall, int tests) { return 1 - std::pow(1 - overall, 1.0 / tests); }

struct ChiSquareResult {
  double p_value = 0;
  double statistic = 0;
  int degrees = 0;
};

/// Compares counts with expectations of equal total. Cells with an expectation below 5 are pooled,
/// including empty ones (a quadrature may miss a narrow region). Counts in a pool without
/// expectation give a p-value of 0.
inline ChiSquareResult chi_square(const std::vector<double>& observed,
                                  const std::vector<double>& expected) {
  std::vector<std::size_t> order(expected.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
  ChiSquareResult r;
  double pooled_expected = 0, pooled_observed = 0;
  int cells = 0;
  for (const std::size_t i : order) {
    if (expected[i] < 5 || (pooled_expected > 0 && pooled_expected < 5)) {
      pooled_expected += expected[i];
      pooled_observed += observed[i];
      continue;
    }
    r.statistic += (observed[i] - expected[i]) * (observed[i] - expected[i]) / expected[i];
    ++cells;
  }
  if (pooled_expected <= 0 && pooled_observed > 0) return r;
  if (pooled_expected > 0) {
    const double d = pooled_observed - pooled_expected;
    r.statistic += d * d / pooled_expected;
    ++cells;
  }
  r.degrees = cells - 1;
  r.p_value = chi_square_tail(r.statistic, r.degrees);
  return r;
}

/// Integral of f over a box by adaptive 4x4 Gauss-Legendre quadrature.
inline double integrate(const std::function<double(double, double)>& f, double x0, double x1,
                        double y0, double y1, double tolerance, int depth = 6) {
  constexpr double kNode[4] = {0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                               0.9305681557970263};
  constexpr double kWeight[4] = {0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                 0.1739274225687269};
  const auto rule = [&](double ax, double bx, double ay, double by) {
    double sum = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        sum += kWeight[i] * kWeight[j] * f(ax + kNode[i] * (bx - ax), ay + kNode[j] * (by - ay));
    return sum * (bx - ax) * (by - ay);
  };
  const double mx = 0.5 * (x0 + x1), my = 0.5 * (y0 + y1);
  const double whole = rule(x0, x1, y0, y1);
  const double parts =
      rule(x0, mx, y0, my) + rule(mx, x1, y0, my) + rule(x0, mx, my, y1) + rule(mx, x1, my, y1);
  if (depth == 0 || std::abs(whole - parts) <= tolerance) return parts;
  const double t = tolerance / 4;
  return integrate(f, x0, mx, y0, my, t, depth - 1) + integrate(f, mx, x1, y0, my, t, depth - 1) +
         integrate(f, x0, mx, my, y1, t, depth - 1) + integrate(f, mx, x1, my, y1, t, depth - 1);
}

/// Comparison of a direction sampler with its density.
struct DirectionTest {
  ChiSquareResult chi;
  double pdf_integral = 0;  ///< over the whole sphere
  double drawn = 0;         ///< share of draws that returned a direction
};

/// Draws `count` directions and compares them with the density over cells of (cos theta, phi).
///
/// Model:   lost draws form a cell with the expectation 1 - integral.
inline DirectionTest test_directions(
    const std::function<std::optional<Vec3>(const Vec2& u2, float u1)>& sample,
    const std::function<double(const Vec3&)>& pdf, int count, std::uint32_t seed,
    int cos_cells = 24, int phi_cells = 32) {
  const double pi = 3.14159265358979323846;
  const auto cells = static_cast<std::size_t>(cos_cells) * static_cast<std::size_t>(phi_cells);
  std::vector<double> expected(cells + 1), observed(cells + 1);
  const auto density = [&](double z, double phi) {
    const double r = std::sqrt(std::max(0.0, 1 - z * z));
    return pdf(Vec3(static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                    static_cast<float>(z)));
  };
  DirectionTest result;
  for (int i = 0; i < cos_cells; ++i)
    for (int j = 0; j < phi_cells; ++j) {
      const double e =
          integrate(density, -1 + 2.0 * i / cos_cells, -1 + 2.0 * (i + 1) / cos_cells,
                    -pi + 2 * pi * j / phi_cells, -pi + 2 * pi * (j + 1) / phi_cells, 2e-7);
      const int cell = i * phi_cells + j;
      expected[static_cast<std::size_t>(cell)] = e * count;
      result.pdf_integral += e;
    }
  const double rest = 1 - result.pdf_integral;
  for (int n = 0; n < count; ++n) {
    sampling::Sampler s(n, 0, 0, seed);
    const Vec2 u2 = s.next_2d();
    const auto wi = sample(u2, s.next_1d());
    if (!wi) {
      observed[cells] += 1;
      continue;
    }
    result.drawn += 1.0 / count;
    const int i = std::clamp(static_cast<int>((wi->z + 1) / 2 * static_cast<float>(cos_cells)), 0,
                             cos_cells - 1);
    const double phi = std::atan2(static_cast<double>(wi->y), static_cast<double>(wi->x));
    const int j = std::clamp(static_cast<int>((phi + pi) / (2 * pi) * phi_cells), 0, phi_cells - 1);
    const int cell = i * phi_cells + j;
    observed[static_cast<std::size_t>(cell)] += 1;
  }
  // A remainder within the error of the quadrature means that no draw is lost.
  const bool complete = observed[cells] == 0 && rest < 1e-3;
  expected[cells] = complete ? 0 : std::max(0.0, rest) * count;
  result.chi = chi_square(observed, expected);
  return result;
}

}  // namespace oriel::testing
