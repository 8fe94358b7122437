// SPDX-License-Identifier: Apache-2.0
#include "geom/freeform/direction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace oriel::geom::freeform {
namespace direction_test {

using Kind = scene::Basis::Kind;

Direction make(scene::Basis basis, std::vector<float> parameters) {
  std::string fault;
  auto direction = Direction::make(&basis, {false, basis.name, std::move(parameters)}, fault);
  EXPECT_TRUE(direction) << fault;
  return direction.value();
}

double value(const Direction& d, const std::vector<double>& points, double t, int order = 0) {
  Blend b;
  d.blend(t, b);
  double sum = 0;
  for (int i = 0; i < b.count; ++i)
    sum += b.weight[order][i] * points.at(b.first + static_cast<std::size_t>(i));
  return sum;
}

/// The recursive definition: C. de Boor, "A Practical Guide to Splines", 1978, X(5).
double de_boor(const std::vector<float>& knots, std::size_t i, int p, double t) {
  if (p == 0) return knots[i] <= t && t < knots[i + 1] ? 1 : 0;
  const double left = knots[i + p] - knots[i], right = knots[i + p + 1] - knots[i + 1];
  return (left > 0 ? (t - knots[i]) / left * de_boor(knots, i, p - 1, t) : 0) +
         (right > 0 ? (knots[i + p + 1] - t) / right * de_boor(knots, i + 1, p - 1, t) : 0);
}

TEST(FreeFormDirection, SplinesFollowDeBoorsRecursion) {
  const std::vector<float> knots = {-1, 0, 0, 0, 1, 2, 2, 3.5f, 4, 4, 4, 9};
  for (const int degree : {1, 2, 3}) {
    const Direction d = make({"b", Kind::BSpline, false, degree, 1, {}}, knots);
    ASSERT_EQ(d.control_points(), knots.size() - static_cast<std::size_t>(degree) - 1);
    for (double t = d.begin(); t < d.end(); t += .03) {
      Blend b;
      d.blend(t, b);
      for (int i = 0; i < b.count; ++i)
        EXPECT_NEAR(b.weight[0][i],
                    de_boor(knots, b.first + static_cast<std::size_t>(i), degree, t), 1e-9)
            << degree << " " << t;
    }
  }
}

TEST(FreeFormDirection, DerivativesAreThoseOfTheValues) {
  const std::vector<float> clamped = {0, 0, 0, 0, 0, 0, 1, 2.5f, 2.5f, 3, 4, 4, 4, 4, 4, 4};
  const std::vector<std::pair<scene::Basis, std::vector<float>>> cases = {
      {{"b", Kind::BSpline, false, 5, 1, {}}, clamped},
      {{"b", Kind::Bezier, false, 1, 1, {}}, {0, 2, 3}},
      {{"b", Kind::Bezier, false, 2, 1, {}}, {0, 2, 3}},
      {{"b", Kind::Bezier, false, 7, 1, {}}, {0, 2}},
      {{"b", Kind::Taylor, false, 4, 1, {}}, {1, 3, 4}},
      {{"b", Kind::Cardinal, false, 3, 1, {}}, {0, 1, 3, 4}}};
  for (const auto& [basis, parameters] : cases) {
    const Direction d = make(basis, parameters);
    std::vector<double> points;
    for (std::size_t i = 0; i < d.control_points(); ++i)
      points.push_back(std::sin(2.0 * double(i)));
    const double h = 1e-4;
    for (double t = d.begin() + .123; t < d.end() - h; t += .19) {
      const double before = value(d, points, t - h), at = value(d, points, t),
                   after = value(d, points, t + h);
      EXPECT_NEAR(value(d, points, t, 1), (after - before) / (2 * h), 1e-5);
      EXPECT_NEAR(value(d, points, t, 2), (after - 2 * at + before) / (h * h), 1e-3);
    }
  }
}

// Example of the specification: cubic Bezier as a matrix with step 3.
TEST(FreeFormDirection, MatrixBasisReproducesBezier) {
  const Direction matrix =
      make({"m", Kind::Matrix, false, 3, 3, {1, -3, 3, -1, 0, 3, -6, 3, 0, 0, 3, -3, 0, 0, 0, 1}},
           {0, 1, 2});
  const Direction bezier = make({"b", Kind::Bezier, false, 3, 1, {}}, {0, 1, 2});
  const std::vector<double> points = {0, 3, 1, 4, 1, 5, 9};
  ASSERT_EQ(matrix.control_points(), 7u);
  for (double t = 0; t <= 2; t += .05)
    for (const int order : {0, 1, 2})
      EXPECT_NEAR(value(matrix, points, t, order), value(bezier, points, t, order), 1e-9);
}

TEST(FreeFormDirection, CardinalCurvesInterpolateWithNeighbourTangents) {
  const Direction d = make({"c", Kind::Cardinal, false, 3, 1, {}}, {0, 1, 2});
  const std::vector<double> points = {1, 2, 5, 3, 7};
  EXPECT_NEAR(value(d, points, 0), 2, 1e-12);
  EXPECT_NEAR(value(d, points, 1), 5, 1e-12);
  EXPECT_NEAR(value(d, points, 2), 3, 1e-12);
  EXPECT_NEAR(value(d, points, 1, 1), (3 - 2) / 2.0, 1e-12);
}

TEST(FreeFormDirection, TaylorPointsAreCoefficients) {
  const Direction d = make({"t", Kind::Taylor, false, 3, 1, {}}, {0, 1});
  EXPECT_NEAR(value(d, {1, 2, 3, 4}, .5), 1 + 2 * .5 + 3 * .25 + 4 * .125, 1e-12);
}

// Bernstein polynomials of any degree add up to 1, and their first moment is t.
TEST(FreeFormDirection, HighestDegreeIsAccurate) {
  const Direction d = make({"b", Kind::Bezier, false, kMaxDegree, 1, {}}, {0, 1});
  std::vector<double> ones(22, 1), ramp;
  for (int i = 0; i <= kMaxDegree; ++i) ramp.push_back(i / double{kMaxDegree});
  for (double t = 0; t <= 1; t += .01) {
    EXPECT_NEAR(value(d, ones, t), 1, 1e-13);
    EXPECT_NEAR(value(d, ramp, t), t, 1e-13);
    EXPECT_NEAR(value(d, ramp, t, 1), 1, 1e-11);
  }
}

TEST(FreeFormDirection, InvalidBasesAreRejectedWithAReason) {
  std::string fault;
  const auto refused = [&](scene::Basis basis, std::vector<float> parameters) {
    const bool made =
        Direction::make(&basis, {false, "b", std::move(parameters)}, fault).has_value();
    return !made && !fault.empty();
  };
  EXPECT_FALSE(Direction::make(nullptr, {false, "gone", {0, 1}}, fault));
  EXPECT_NE(fault.find("gone"), std::string::npos);
  EXPECT_TRUE(refused({"b", Kind::Bezier, false, 0, 1, {}}, {0, 1}));
  EXPECT_TRUE(refused({"b", Kind::Bezier, false, 22, 1, {}}, {0, 1}));
  EXPECT_TRUE(refused({"b", Kind::Bezier, false, -5, 1, {}}, {0, 1}));
  EXPECT_TRUE(refused({"b", Kind::Bezier, false, 3, 1, {}}, {1, 0}));
  EXPECT_TRUE(refused({"b", Kind::Bezier, false, 3, 1, {}}, {0}));
  EXPECT_TRUE(refused({"b", Kind::Bezier, false, 3, 1, {}}, {0, NAN}));
  EXPECT_TRUE(refused({"b", Kind::BSpline, false, 3, 1, {}}, {0, 0, 0, 1, 1, 1}));
  EXPECT_TRUE(refused({"b", Kind::BSpline, false, 1, 1, {}}, {0, 0, 0, 0}));
  EXPECT_TRUE(refused({"b", Kind::BSpline, false, 2, 1, {}}, {0, 0, 0, 2, 1, 1}));
  EXPECT_TRUE(refused({"m", Kind::Matrix, false, 3, 1, {1, 2, 3}}, {0, 1}));
  EXPECT_TRUE(refused({"m", Kind::Matrix, false, 1, 0, {1, 0, 0, 1}}, {0, 1}));
}

}  // namespace direction_test
}  // namespace oriel::geom::freeform
