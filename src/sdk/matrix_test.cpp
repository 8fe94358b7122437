// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "oriel/sdk/shader/texture.h"
#include "oriel/sdk/shader/vector.h"
#include "support/expect_near.h"

namespace matrix_test {

using oriel::testing::expect_near;

constexpr miMatrix kPlaced = {2, 0, 0, 0, 0, .5f, .25f, 0, .5f, -1, 3, 0, 7, -2, 1, 1};

TEST(Matrix, TimesItsInverseIsTheIdentity) {
  miMatrix inverse, product;
  ASSERT_TRUE(mi_matrix_invert(inverse, kPlaced));
  mi_matrix_prod(product, kPlaced, inverse);
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(product[i], i % 5 == 0 ? 1 : 0, 1e-6f) << i;
}

TEST(Matrix, OperationsWorkInPlace) {
  miMatrix m, there_and_back;
  mi_matrix_copy(m, kPlaced);
  ASSERT_TRUE(mi_matrix_invert(m, m));
  mi_matrix_prod(m, m, kPlaced);
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(m[i], i % 5 == 0 ? 1 : 0, 1e-6f) << i;
  mi_matrix_ident(there_and_back);
  EXPECT_TRUE(mi_matrix_isident(there_and_back));
  mi_matrix_null(there_and_back);
  EXPECT_TRUE(mi_matrix_isnull(there_and_back));
  EXPECT_FALSE(mi_matrix_isident(kPlaced));
}

TEST(Matrix, SmallScalesAreInvertible) {
  miMatrix m = {1e-6f, 0, 0, 0, 0, 1e-6f, 0, 0, 0, 0, 1e-6f, 0, 1e6f, 0, 0, 1}, inverse;
  ASSERT_TRUE(mi_matrix_invert(inverse, m));
  EXPECT_NEAR(inverse[0], 1e6f, 1);
}

TEST(Matrix, SingularMatrixHasNoInverse) {
  const miMatrix flat = {1, 0, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 1};
  miMatrix inverse;
  EXPECT_FALSE(mi_matrix_invert(inverse, flat));
  EXPECT_EQ(mi_matrix_rot_det(flat), 0);
  // 2 (1.5 + .25) by hand.
  EXPECT_NEAR(mi_matrix_rot_det(kPlaced), 3.5f, 1e-6f);
}

TEST(Matrix, RotatesRowVectorsRightHanded) {
  miMatrix m;
  const miVector x = {1, 0, 0}, y = {0, 1, 0}, z = {0, 0, 3};
  miVector r;
  mi_matrix_rotate_axis(m, &z, static_cast<float>(M_PI_2));
  mi_vector_transform(&r, &x, m);
  expect_near(r, {0, 1, 0}, 1e-6f);
  mi_matrix_rotate(m, static_cast<float>(M_PI_2), 0, static_cast<float>(M_PI_2));
  // rotated to z by the first rotation, which the last one leaves unchanged
  mi_vector_transform(&r, &y, m);
  expect_near(r, {0, 0, 1}, 1e-6f);
}

TEST(Matrix, RotatesByAnglesAboutTheAxes) {
  constexpr float kAngle = .7f;
  const float s = std::sin(kAngle), c = std::cos(kAngle);
  const miVector v = {1, 2, 3};
  miMatrix m;
  miVector r;
  mi_matrix_rotate(m, kAngle, 0, 0);
  mi_vector_transform(&r, &v, m);
  expect_near(r, {1, 2 * c - 3 * s, 2 * s + 3 * c}, 1e-6f);
  mi_matrix_rotate(m, 0, kAngle, 0);
  mi_vector_transform(&r, &v, m);
  expect_near(r, {c + 3 * s, 2, 3 * c - s}, 1e-6f);
  mi_matrix_rotate(m, 0, 0, kAngle);
  mi_vector_transform(&r, &v, m);
  expect_near(r, {c - 2 * s, s + 2 * c, 3}, 1e-6f);
}

TEST(Matrix, MovesPointsNotVectors) {
  const miVector v = {1, 2, 3};
  miVector p = v;
  mi_point_transform(&p, &p, kPlaced);
  expect_near(p, {10.5f, -4, 10.5f}, 1e-6f);
  mi_vector_transform(&p, &v, kPlaced);
  expect_near(p, {3.5f, -2, 9.5f}, 1e-6f);
}

TEST(Matrix, ProjectionsDivideByW) {
  const miMatrix projection = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, -1, 0, 0, 0, 0};
  const miVector p = {2, 4, -2};
  miVector r;
  mi_point_transform(&r, &p, projection);
  expect_near(r, {1, 2, -1}, 1e-6f);
}

TEST(Matrix, TransposedInverseKeepsNormalsSquare) {
  const miVector tangent = {1, 2, -1}, normal = {1, 0, 1};
  miMatrix inverse;
  ASSERT_TRUE(mi_matrix_invert(inverse, kPlaced));
  miVector t, n;
  mi_vector_transform(&t, &tangent, kPlaced);
  mi_vector_transform_T(&n, &normal, inverse);
  EXPECT_NEAR(mi_vector_dot(&t, &n), 0, 1e-5f);
}

TEST(MatrixSolve, SolutionSatisfiesTheSystem) {
  const miMatrix a = {0, 2, 1, 0, 1, -1, 0, 3, 2, 0, 5, 1, 1, 1, 1, 1};
  const miScalar expected[4] = {1, -2, 3, .5f};
  miScalar b[4], x[4];
  for (int i = 0; i < 4; ++i) {
    b[i] = 0;
    for (int j = 0; j < 4; ++j) b[i] += a[i * 4 + j] * expected[j];
  }
  ASSERT_TRUE(mi_matrix_solve(x, a, b, 1));
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(x[i], expected[i], 1e-5f);
}

TEST(MatrixSolve, TakesAnyNumberOfColumns) {
  const miMatrix a = {0, 2, 1, 0, 1, -1, 0, 3, 2, 0, 5, 1, 1, 1, 1, 1};
  constexpr int kColumns = 37;
  const auto expected = [](int row, int column) { return static_cast<float>(row - column % 7); };
  miScalar b[4 * kColumns] = {}, x[4 * kColumns];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < kColumns; ++j)
      for (int k = 0; k < 4; ++k) b[i * kColumns + j] += a[i * 4 + k] * expected(k, j);
  ASSERT_TRUE(mi_matrix_solve(x, a, b, kColumns));
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < kColumns; ++j)
      EXPECT_NEAR(x[i * kColumns + j], expected(i, j), 1e-4f) << i << ' ' << j;
}

TEST(MatrixSolve, OfTheIdentityIsTheInverse) {
  miMatrix identity, inverse, solved;
  mi_matrix_ident(identity);
  ASSERT_TRUE(mi_matrix_invert(inverse, kPlaced));
  ASSERT_TRUE(mi_matrix_solve(solved, kPlaced, identity, 4));
  for (int i = 0; i < 16; ++i) EXPECT_NEAR(solved[i], inverse[i], 1e-6f);
}

TEST(TextureFilter, TransformTakesThreePointsToTheirCoordinates) {
  miVector p[3] = {{100, 50, 0}, {101, 50, 0}, {100, 51.5f, 0}};
  miVector t[3] = {{.2f, .4f, 0}, {.21f, .405f, 0}, {.19f, .43f, 0}};
  miMatrix st;
  ASSERT_TRUE(mi_texture_filter_transform(st, p, t));
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(p[i].x * st[0] + p[i].y * st[4] + st[8], t[i].x, 1e-5f);
    EXPECT_NEAR(p[i].x * st[1] + p[i].y * st[5] + st[9], t[i].y, 1e-5f);
    EXPECT_NEAR(p[i].x * st[2] + p[i].y * st[6] + st[10], 1, 1e-5f);
  }
  p[2] = {102, 50, 0};
  EXPECT_FALSE(mi_texture_filter_transform(st, p, t));
}

}  // namespace matrix_test
