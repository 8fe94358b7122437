// SPDX-License-Identifier: Apache-2.0
#include "base/math.h"

#include "base/reduce_angle.h"

#include <bit>
#include <cstdint>
#include <limits>

namespace oriel::math {

namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
// Constants with more than 53 bits are sums of doubles. The leading ones have trailing zeros, so
// that their products with the integers of an argument reduction are exact.
constexpr double kLn2[2] = {0x1.62e42feep-1, 0x1.a39ef35793c76p-33};
constexpr double kLog2E[2] = {0x1.71547652b82fep+0, 0x1.777d0ffda0d24p-56};
constexpr double kLog10E = 0x1.bcb7b1526e50ep-2, kLog10Of2 = 0x1.34413509f79ffp-2;
constexpr double kPi = 2 * 0x1.921fb54442d18p+0, kPiLow = 2 * 0x1.1a62633145c07p-54;
double fma(double a, double b, double c) { return __builtin_fma(a, b, c); }
double abs(double x) { return __builtin_fabs(x); }
double sqrt(double x) { return __builtin_sqrt(x); }
double copy_sign(double x, double sign) { return __builtin_copysign(x, sign); }
bool is_nan(double x) { return x != x; }
double power_of_2(int k) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(k + 1023) << 52);
}

/// The first `terms` terms of c[0] + c[1] x + ...: even and odd terms by separate Horner schemes,
/// for instruction parallelism.
template <int terms>
double polynomial(double x, const double* c) {
  constexpr int last = terms - 1;
  const double z = x * x;
  double a = c[last], b = c[last - 1];
  for (int i = last - 2; i >= 0; i -= 2) a = fma(a, z, c[i]);
  for (int i = last - 3; i >= 0; i -= 2) b = fma(b, z, c[i]);
  return last % 2 == 0 ? fma(b, x, a) : fma(a, x, b);
}

// Coefficients of Taylor series. For |r| <= pi/4 and ln(2)/2 the first omitted term is below 2^-36
// (float) and 2^-58 (double) of the sum.

constexpr double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// sin(r) / r - 1 over r^2, in r^2.
constexpr double kSine[] = {-1 / factorial(3),  1 / factorial(5),   -1 / factorial(7),
                            1 / factorial(9),   -1 / factorial(11), 1 / factorial(13),
                            -1 / factorial(15), 1 / factorial(17)};
/// (cos(r) - 1 + r^2 / 2) / r^4, in r^2.
constexpr double kCosine[] = {1 / factorial(4),   -1 / factorial(6), 1 / factorial(8),
                              -1 / factorial(10), 1 / factorial(12), -1 / factorial(14),
                              1 / factorial(16),  -1 / factorial(18)};

double sine_of(const Reduced& a) {
  const double z = a.r * a.r;
  // sin(r + low) = sin r + low cos r
  return a.r + fma(a.r * z, polynomial<8>(z, kSine), a.low * fma(z, -0.5, 1.0));
}
double cosine_of(const Reduced& a) {
  const double z = a.r * a.r, half = 0.5 * z, w = 1 - half;
  return w + (((1 - w) - half) + fma(z * z, polynomial<8>(z, kCosine), -a.r * a.low));
}
double sine_of(double r) {
  const double z = r * r;
  return fma(r * z, polynomial<5>(z, kSine), r);
}
double cosine_of(double r) {
  const double z = r * r;
  return fma(z * z, polynomial<5>(z, kCosine), fma(z, -0.5, 1.0));
}

double turned_sine(const Reduced& a, std::uint32_t quarter) {
  const double value = quarter & 1 ? cosine_of(a) : sine_of(a);
  return quarter & 2 ? -value : value;
}

bool has_no_angle(double x) { return !(abs(x) < kInf); }

/// ln(x) as k ln 2 + ln(m), m in [sqrt(1/2), sqrt(2)); x positive and finite.
struct Split {
  double k, m;
};
Split split(double x) {
  auto bits = std::bit_cast<std::uint64_t>(x);
  double shift = 0;
  if (bits < (std::uint64_t{1} << 52)) {  // denormal
    bits = std::bit_cast<std::uint64_t>(x * 0x1p54);
    shift = -54;
  }
  constexpr std::uint64_t kSqrtHalf = std::bit_cast<std::uint64_t>(0x1.6a09e667f3bcdp-1);
  const auto up = static_cast<std::int64_t>(bits - kSqrtHalf) >> 52;
  return {static_cast<double>(up) + shift,
          std::bit_cast<double>(bits - (static_cast<std::uint64_t>(up) << 52))};
}

/// Coefficients of ln(m) = 2 (s + s^3/3 + s^5/5 ...), s = (m - 1) / (m + 1), |s| <= 0.1716, after
/// the first term, divided by s^3, as powers of s^2. Truncation error: below 2^-44 (float) and
/// 2^-60 (double).
constexpr double kAtanh[] = {2.0 / 3,  2.0 / 5,  2.0 / 7,  2.0 / 9,  2.0 / 11,
                             2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21};

/// Special cases of the logarithm: zero, negative, infinite or NaN.
bool has_no_logarithm(double x) { return !(x > 0 && x < kInf); }
double special_logarithm(double x) { return x == 0 ? -kInf : (x == kInf ? kInf : kNaN); }

double log_of_float(double x) {
  const Split a = split(x);
  const double s = (a.m - 1) / (a.m + 1), z = s * s;
  return fma(a.k, kLn2[0] + kLn2[1], fma(s * z, polynomial<7>(z, kAtanh), 2 * s));
}

struct Sum {
  double high, low;
};
/// a + b exactly, for |a| >= |b|.
Sum sum_of(double a, double b) {
  const double high = a + b;
  return {high, b - (high - a)};
}

/// ln(x) with a relative error below 2^-59.
Sum log_in_two(double x) {
  const Split a = split(x);
  const double f = a.m - 1, g = a.m + 1;
  const double g_low = (1 - (g - a.m));  // exact: the rounding error of m + 1
  const double s = f / g;
  const double s_low = (fma(-s, g, f) - s * g_low) / g;
  const double z = s * s;
  const double series = s * z * polynomial<10>(z, kAtanh);
  Sum sum = sum_of(2 * s, series);
  sum.low += 2 * s_low * (1 + z);
  const Sum whole = sum_of(a.k * kLn2[0], sum.high);  // |k ln 2| >= |ln m| unless k = 0
  if (a.k == 0) return sum_of(sum.high, sum.low);
  return sum_of(whole.high, whole.low + fma(a.k, kLn2[1], sum.low));
}

/// 1/n!: e^r for |r| <= ln(2)/2.
constexpr double kExp[] = {1,
                           1,
                           1 / factorial(2),
                           1 / factorial(3),
                           1 / factorial(4),
                           1 / factorial(5),
                           1 / factorial(6),
                           1 / factorial(7),
                           1 / factorial(8),
                           1 / factorial(9),
                           1 / factorial(10),
                           1 / factorial(11),
                           1 / factorial(12),
                           1 / factorial(13),
                           1 / factorial(14)};

/// value 2^k, also if the result is denormal.
double scaled(double value, int k) {
  if (k > 1023) return value * 0x1p1023 * power_of_2(k - 1023 > 1023 ? 1023 : k - 1023);
  if (k < -1022) return value * power_of_2(k + 200 < -1022 ? -1022 : k + 200) * 0x1p-200;
  return value * power_of_2(k);
}

/// e^x in float precision, |x| < 200.
double exp_of_float(double x) {
  const double k = round_to_int(x * kLog2E[0]);
  const double r = fma(-k, kLn2[0] + kLn2[1], x);
  return polynomial<9>(r, kExp) * power_of_2(static_cast<int>(k));
}

/// e^(x + low), |low| much smaller than |x|.
double exp_of(double x, double low) {
  if (x > 710) return kInf;
  if (x < -746) return 0;
  const double k = round_to_int(x * kLog2E[0]);
  const double high = fma(-k, kLn2[0], x);
  const double tail = fma(-k, kLn2[1], low);
  const double r = high + tail, lost = (high - r) + tail;
  const double above = r * r * polynomial<13>(r, kExp + 2);
  return scaled(1 + (r + (above + lost)), static_cast<int>(k));
}

/// atan of a quotient in [0, 1], using the nearest angle i pi/16: atan(y/x) = atan(t) + atan((y - t
/// x) / (x + t y)), where the second argument is at most tan(pi/32) = 0.0985. Taylor series with a
/// truncation error below 2^-41 (float) and 2^-62 (double).
constexpr double kTangents[] = {0, 0x1.975f5e0553158p-3, 0x1.a827999fcef32p-2, 0x1.561b82ab7f990p-1,
                                1};
constexpr double kTangentsBetween[] = {0.09849140335716425, 0.30334668360734240,
                                       0.53451113595079160, 0.82067879082866040};
constexpr double kAtan[] = {-1.0 / 3,  1.0 / 5,  -1.0 / 7,  1.0 / 9,
                            -1.0 / 11, 1.0 / 13, -1.0 / 15, 1.0 / 17};

constexpr int kFloat = 5, kDouble = 8;  // terms

template <int terms>
double atan_of_quotient(double y, double x) {
  int i = 0;
  for (const double between : kTangentsBetween) i += y > between * x ? 1 : 0;
  const double t = kTangents[i];
  const double q = fma(-t, x, y) / fma(t, y, x);
  const double z = q * q;
  constexpr double kStep = kPi / 16, kStepLow = kPiLow / 16;
  return fma(i, kStep, q + fma(q * z, polynomial<terms>(z, kAtan), i * kStepLow));
}

template <int terms>
double atan2_of(double y, double x) {
  if (is_nan(x) || is_nan(y)) return kNaN;
  double ay = abs(y), ax = abs(x);
  if (ay == kInf || ax == kInf) {
    ay = ay == kInf ? 1 : 0;
    ax = ax == kInf ? 1 : 0;
  }
  const bool backward = __builtin_signbit(x) != 0;
  double angle = 0;
  if (ay > ax) {
    const double beyond = atan_of_quotient<terms>(ax, ay);  // complement to a right angle
    angle = backward ? kPi / 2 + (beyond + kPiLow / 2) : kPi / 2 - (beyond - kPiLow / 2);
  } else {
    if (ay != 0) angle = atan_of_quotient<terms>(ay, ax);
    if (backward) angle = kPi - (angle - kPiLow);
  }
  return copy_sign(angle, y);
}

/// Whether y is an integer, and whether it is odd. All doubles above 2^53 are even.
bool is_integer(double y) { return abs(y) >= 0x1p52 || round_to_int(y) == y; }
bool is_odd(double y) {
  return abs(y) < 0x1p53 && is_integer(y) && (static_cast<std::int64_t>(y) & 1) != 0;
}

/// Special cases of pow; returns true and sets the value.
bool special_power(double x, double y, double& value) {
  if (y == 0 || x == 1) {
    value = 1;
    return true;
  }
  if (is_nan(x) || is_nan(y)) {
    value = kNaN;
    return true;
  }
  if (abs(y) == kInf) {
    value = abs(x) == 1 ? 1 : ((abs(x) > 1) == (y > 0) ? kInf : 0);
    return true;
  }
  if (x == 0 || abs(x) == kInf) {
    const double size = (x == 0) == (y < 0) ? kInf : 0;
    value = is_odd(y) ? copy_sign(size, x) : size;
    return true;
  }
  if (x < 0 && !is_integer(y)) {
    value = kNaN;
    return true;
  }
  return false;
}

}  // namespace

// ---- float ----

float sin(float x) {
  if (x == 0) return x;
  if (has_no_angle(x)) return static_cast<float>(kNaN);
  const Reduced a = reduce_angle(x);
  const double value = a.quarter & 1 ? cosine_of(a.r) : sine_of(a.r);
  return static_cast<float>(a.quarter & 2 ? -value : value);
}

float cos(float x) {
  if (has_no_angle(x)) return static_cast<float>(kNaN);
  const Reduced a = reduce_angle(x);
  const double value = a.quarter & 1 ? sine_of(a.r) : cosine_of(a.r);
  return static_cast<float>((a.quarter + 1) & 2 ? -value : value);
}

float tan(float x) {
  if (x == 0) return x;
  if (has_no_angle(x)) return static_cast<float>(kNaN);
  const Reduced a = reduce_angle(x);
  const double s = sine_of(a.r), c = cosine_of(a.r);
  return static_cast<float>(a.quarter & 1 ? -c / s : s / c);
}

float asin(float x) {
  const double wide = x;
  return static_cast<float>(atan2_of<kFloat>(wide, sqrt((1 - wide) * (1 + wide))));
}
float acos(float x) {
  const double wide = x;
  return static_cast<float>(atan2_of<kFloat>(sqrt((1 - wide) * (1 + wide)), wide));
}
float atan(float x) { return static_cast<float>(atan2_of<kFloat>(x, 1)); }
float atan2(float y, float x) { return static_cast<float>(atan2_of<kFloat>(y, x)); }

float exp(float x) {
  if (!(x < 150)) return x > 0 ? static_cast<float>(kInf) : x;
  if (x < -150) return 0;
  return static_cast<float>(exp_of_float(x));
}
float exp2(float x) {
  if (!(x < 200)) return x > 0 ? static_cast<float>(kInf) : x;
  if (x < -200) return 0;
  const double k = round_to_int(x);
  const double r = (x - k) * (kLn2[0] + kLn2[1]);
  return static_cast<float>(polynomial<9>(r, kExp) * power_of_2(static_cast<int>(k)));
}
float expm1(float x) {
  const double wide = x;
  if (!(abs(wide) < 0.35)) return static_cast<float>(exp(wide) - 1);
  return static_cast<float>(wide * polynomial<9>(wide, kExp + 1));
}

float log(float x) {
  return static_cast<float>(has_no_logarithm(x) ? special_logarithm(x) : log_of_float(x));
}
float log2(float x) {
  if (has_no_logarithm(x)) return static_cast<float>(special_logarithm(x));
  const Split a = split(x);
  return static_cast<float>(fma(log_of_float(a.m), kLog2E[0], a.k));
}
float log10(float x) {
  if (has_no_logarithm(x)) return static_cast<float>(special_logarithm(x));
  return static_cast<float>(log_of_float(x) * kLog10E);
}
float log1p(float x) {
  const double wide = x, u = 1 + wide;
  if (u == 1 || !(u > 0 && u < kInf)) return u == 1 ? x : static_cast<float>(special_logarithm(u));
  // Kahan: the quotient compensates the rounding error of 1 + x.
  return static_cast<float>(log_of_float(u) * (wide / (u - 1)));
}

float pow(float x, float y) {
  double value = 0;
  const bool ordinary = x > 0 && x < kInf && abs(y) < kInf;
  if (!ordinary && special_power(x, y, value)) return static_cast<float>(value);
  const double exponent = y * log_of_float(abs(x));
  if (exponent > 150)
    value = kInf;
  else if (exponent > -150)
    value = exp_of_float(exponent);
  return static_cast<float>(!ordinary && is_odd(y) ? -value : value);
}

float cbrt(float x) {
  const double size = abs(x);
  if (size == 0 || has_no_logarithm(size)) return x;
  double root = exp_of_float(log_of_float(size) * (1.0 / 3));
  root -= (root * root * root - size) / (3 * root * root);
  return static_cast<float>(copy_sign(root, x));
}

float hypot(float x, float y) {
  const double wx = x, wy = y;
  if (abs(wx) == kInf || abs(wy) == kInf) return static_cast<float>(kInf);
  return static_cast<float>(sqrt(fma(wx, wx, wy * wy)));
}

// ---- double ----

double sin(double x) {
  if (has_no_angle(x)) return kNaN;
  if (abs(x) < 0x1p-27) return x;
  const Reduced a = reduce_angle(x);
  return turned_sine(a, a.quarter);
}
double cos(double x) {
  if (has_no_angle(x)) return kNaN;
  const Reduced a = reduce_angle(x);
  return turned_sine(a, a.quarter + 1);
}
double tan(double x) {
  if (x == 0) return x;
  if (has_no_angle(x)) return kNaN;
  const Reduced a = reduce_angle(x);
  return a.quarter & 1 ? -cosine_of(a) / sine_of(a) : sine_of(a) / cosine_of(a);
}
double asin(double x) { return atan2_of<kDouble>(x, sqrt((1 - x) * (1 + x))); }
double acos(double x) { return atan2_of<kDouble>(sqrt((1 - x) * (1 + x)), x); }
double atan(double x) { return atan2_of<kDouble>(x, 1); }
double atan2(double y, double x) { return atan2_of<kDouble>(y, x); }

double exp(double x) { return is_nan(x) ? x : exp_of(x, 0); }
double exp2(double x) {
  if (is_nan(x)) return x;
  if (x > 1024) return kInf;
  if (x < -1076) return 0;
  const double k = round_to_int(x), f = x - k;
  const double r = f * (kLn2[0] + kLn2[1]);
  return scaled(polynomial<15>(r, kExp), static_cast<int>(k));
}
double log(double x) { return has_no_logarithm(x) ? special_logarithm(x) : log_in_two(x).high; }
double log2(double x) {
  if (has_no_logarithm(x)) return special_logarithm(x);
  const Split a = split(x);
  const Sum m = log_in_two(a.m);
  return a.k + fma(m.high, kLog2E[0], m.low * kLog2E[0] + m.high * kLog2E[1]);
}
double log10(double x) {
  if (has_no_logarithm(x)) return special_logarithm(x);
  const Split a = split(x);
  return fma(a.k, kLog10Of2, log_in_two(a.m).high * kLog10E);
}

double pow(double x, double y) {
  double value = 0;
  if (special_power(x, y, value)) return value;
  const Sum l = log_in_two(abs(x));
  const double exponent = y * l.high;
  value = abs(exponent) < 800 ? exp_of(exponent, fma(y, l.high, -exponent) + y * l.low)
                              : (exponent > 0 ? kInf : 0);
  return x < 0 && is_odd(y) ? -value : value;
}

double hypot(double x, double y) {
  x = abs(x);
  y = abs(y);
  if (x == kInf || y == kInf) return kInf;
  const double most = x > y ? x : y;
  if (!(most > 0)) return x + y;  // zero or NaN
  // Scale by a power of two, so that squares neither overflow nor underflow.
  const int k = static_cast<int>((std::bit_cast<std::uint64_t>(most) >> 52)) - 1023;
  const double down = scaled(1, -(k > 1000 ? 1000 : k));
  const double a = x * down, b = y * down;
  return sqrt(fma(a, a, b * b)) / down;
}

}  // namespace oriel::math
