// SPDX-License-Identifier: Apache-2.0
#include "base/math.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

namespace oriel {
namespace math_test {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// Error in units of the last place of T. The reference is the C library's 64-bit arithmetic.
template <class T>
double ulps(T value, long double exact) {
  if (std::isnan(exact)) return std::isnan(value) ? 0 : 1e9;
  const long double largest = std::numeric_limits<T>::max();
  if (std::abs(exact) > largest)
    return std::abs(static_cast<long double>(value)) >= largest && (value > 0) == (exact > 0) ? 0
                                                                                              : 1e9;
  int exponent = 0;
  std::frexp(exact, &exponent);
  exponent = std::max(exponent, std::numeric_limits<T>::min_exponent);
  return static_cast<double>(std::abs(static_cast<long double>(value) - exact) /
                             std::ldexp(1.0L, exponent - std::numeric_limits<T>::digits));
}

/// Maximum error for random numbers, uniform in [a, b] or, with `scales`, over all exponents.
template <class T, class F, class G>
double worst(F ours, G exact, double a, double b, bool scales = true) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> even(a, b), exponent(-30, 5);
  double most = 0;
  for (int i = 0; i < 200'000; ++i) {
    double x = even(random);
    if (scales && i % 2 == 0) x = std::copysign(std::exp2(exponent(random)), x);
    if (x < a || x > b) continue;
    const auto rounded = static_cast<T>(x);
    most = std::max(most, ulps<T>(ours(rounded), exact(static_cast<long double>(rounded))));
  }
  return most;
}

#define ORIEL_WITHIN(T, limit, name, a, b)                              \
  EXPECT_LT(worst<T>([](T x) { return math::name(x); },                 \
                     [](long double x) { return std::name(x); }, a, b), \
            limit)                                                      \
      << #name << " of " #T

TEST(Math, FloatsAreRoundedFromTheExactValue) {
  ORIEL_WITHIN(float, 0.51, sin, -1e6, 1e6);
  ORIEL_WITHIN(float, 0.51, cos, -1e6, 1e6);
  ORIEL_WITHIN(float, 0.51, tan, -1e6, 1e6);
  ORIEL_WITHIN(float, 0.51, asin, -1, 1);
  ORIEL_WITHIN(float, 0.51, acos, -1, 1);
  ORIEL_WITHIN(float, 0.51, atan, -100, 100);
  ORIEL_WITHIN(float, 0.51, exp, -90, 90);
  ORIEL_WITHIN(float, 0.51, exp2, -130, 130);
  ORIEL_WITHIN(float, 0.51, expm1, -20, 90);
  ORIEL_WITHIN(float, 0.51, log, 0, 1e30);
  ORIEL_WITHIN(float, 0.51, log2, 0, 1e30);
  ORIEL_WITHIN(float, 0.51, log10, 0, 1e30);
  ORIEL_WITHIN(float, 0.51, log1p, -1, 1e10);
  ORIEL_WITHIN(float, 0.51, cbrt, -1e30, 1e30);
}

TEST(Math, DoublesAreWithinThreeUnitsOfTheLastPlace) {
  ORIEL_WITHIN(double, 2, sin, -1e6, 1e6);
  ORIEL_WITHIN(double, 2, cos, -1e6, 1e6);
  ORIEL_WITHIN(double, 3, tan, -1e6, 1e6);
  ORIEL_WITHIN(double, 3, asin, -1, 1);
  ORIEL_WITHIN(double, 2, acos, -1, 1);
  ORIEL_WITHIN(double, 2, atan, -100, 100);
  ORIEL_WITHIN(double, 2, exp, -745, 709);
  ORIEL_WITHIN(double, 2, exp2, -1074, 1023);
  ORIEL_WITHIN(double, 2, log, 0, 1e300);
  ORIEL_WITHIN(double, 2, log2, 0, 1e300);
  ORIEL_WITHIN(double, 2, log10, 0, 1e300);
}

TEST(Math, LargeAnglesAreReducedExactly) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> exponent(20, 62);  // long double reduces up to 2^63
  for (int i = 0; i < 20'000; ++i) {
    const auto x = static_cast<float>(std::exp2(exponent(random)) * (i % 2 ? 1 : -1));
    EXPECT_LT(ulps<float>(math::sin(x), std::sin(static_cast<long double>(x))), 0.51) << x;
    EXPECT_LT(ulps<float>(math::cos(x), std::cos(static_cast<long double>(x))), 0.51) << x;
  }
  // Ng, "Argument reduction for huge arguments: good to the last bit" (1992), and the table of
  // Muller, Elementary Functions: sin(1e22), and the double nearest to a multiple of pi/2.
  EXPECT_LT(ulps<double>(math::sin(1e22), -0.8522008497671888017727058937530293682618L), 1.5);
  EXPECT_LT(ulps<double>(math::cos(0x1.6ac5b262ca1ffp+849), -4.68716592425462761112e-19L), 1.5);
}

TEST(Math, FunctionsOfTwoArguments) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<float> even(-10, 10), exponent(-40, 40);
  for (int i = 0; i < 200'000; ++i) {
    const float y = even(random), x = even(random) * std::exp2(exponent(random));
    const long double wide_y = y, wide_x = x;
    EXPECT_LT(ulps<float>(math::atan2(y, x), std::atan2(wide_y, wide_x)), 0.51) << y << ' ' << x;
    EXPECT_LT(ulps<float>(math::hypot(y, x), std::hypot(wide_y, wide_x)), 0.51) << y << ' ' << x;
    const float base = std::abs(x);
    EXPECT_LT(ulps<float>(math::pow(base, y), std::pow(wide_x < 0 ? -wide_x : wide_x, wide_y)),
              0.52)
        << base << ' ' << y;
    const double double_base = base, double_y = y * 10.0;
    EXPECT_LT(ulps<double>(math::pow(double_base, double_y),
                           std::pow(static_cast<long double>(base), double_y * 1.0L)),
              16)
        << base << ' ' << double_y;
    EXPECT_LT(ulps<double>(math::atan2(double_y, double_base),
                           std::atan2(double_y * 1.0L, double_base * 1.0L)),
              2);
  }
}

/// Equal bits; all NaN are equal.
template <class T>
void expect_same(T ours, T standard, const char* what, T x, T y) {
  if (std::isnan(standard)) {
    EXPECT_TRUE(std::isnan(ours)) << what << ' ' << x << ' ' << y;
    return;
  }
  EXPECT_EQ(ours, standard) << what << ' ' << x << ' ' << y;
  EXPECT_EQ(std::signbit(ours), std::signbit(standard)) << what << ' ' << x << ' ' << y;
}

template <class T>
void check_special_values() {
  const T values[] = {0, T(-0.0), 1, -1, 2, -2, 3, -3, T(kInf), -T(kInf), T(kNaN)};
#define ORIEL_SAME(name) expect_same<T>(math::name(x), std::name(x), #name, x, 0)
  for (const T x : values) {
    if (std::isnan(x) || std::isinf(x) || x == 0) {
      ORIEL_SAME(sin);
      ORIEL_SAME(cos);
      ORIEL_SAME(tan);
      ORIEL_SAME(atan);
      ORIEL_SAME(exp);
      ORIEL_SAME(exp2);
    }
    if (!(x > 0) || std::isinf(x) || x == 1) {
      ORIEL_SAME(log);
      ORIEL_SAME(log2);
      ORIEL_SAME(log10);
    }
    if (!(std::abs(x) < 1)) continue;
    ORIEL_SAME(asin);
    if (x > 1 || x < -1) ORIEL_SAME(acos);
  }
#undef ORIEL_SAME
  for (const T x : values)
    for (const T y : values) {
      expect_same<T>(math::pow(x, y), std::pow(x, y), "pow", x, y);
      expect_same<T>(math::hypot(x, y), std::hypot(x, y), "hypot", x, y);
      if (x == 0 || y == 0 || std::isinf(x) || std::isinf(y) || std::isnan(x) || std::isnan(y))
        expect_same<T>(math::atan2(y, x), std::atan2(y, x), "atan2", y, x);
    }
}

TEST(Math, SpecialValuesFollowTheStandardLibrary) {
  check_special_values<float>();
  check_special_values<double>();
  for (const float x : {0.0f, -0.0f, kInf, -kInf, kNaN, -1.0f, -2.0f}) {
    expect_same(math::expm1(x), std::expm1(x), "expm1", x, 0.0f);
    expect_same(math::log1p(x), std::log1p(x), "log1p", x, 0.0f);
    expect_same(math::cbrt(x), std::cbrt(x), "cbrt", x, 0.0f);
  }
}

}  // namespace math_test
}  // namespace oriel
