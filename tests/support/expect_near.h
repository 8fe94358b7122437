// SPDX-License-Identifier: Apache-2.0
// Compares vectors and colours component by component.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <type_traits>
#include <vector>

namespace oriel::testing {

/// Components of a vector or colour, the renderer's or the C interface's.
template <class T>
std::vector<float> components_of(const T& v) {
  if constexpr (requires { v.r; })
    return {v.r, v.g, v.b, v.a};
  else if constexpr (requires { v.z; })
    return {v.x, v.y, v.z};
  else
    return {v.x, v.y};
}

/// Every component is within `tolerance` of the expected one.
template <class T>
void expect_near(const T& actual, const std::type_identity_t<T>& expected, float tolerance = 1e-5f,
                 std::string_view what = {}) {
  const std::vector<float> a = components_of(actual), b = components_of(expected);
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_NEAR(a[k], b[k], tolerance) << what << " component " << k;
}

/// Every component is within a share of the expected one, or within `floor` where that is more.
template <class T>
void expect_near_relative(const T& actual, const std::type_identity_t<T>& expected, float relative,
                          std::string_view what, float floor) {
  const std::vector<float> a = components_of(actual), b = components_of(expected);
  for (std::size_t k = 0; k < a.size(); ++k)
    EXPECT_NEAR(a[k], b[k], std::max(relative * std::abs(b[k]), floor))
        << what << " component " << k;
}
/// The same, as if components below 1 were 1.
template <class T>
void expect_near_relative(const T& actual, const std::type_identity_t<T>& expected,
                          float relative = 1e-6f) {
  expect_near_relative(actual, expected, relative, {}, relative);
}

}  // namespace oriel::testing
