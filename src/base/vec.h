// SPDX-License-Identifier: Apache-2.0
// Vectors and colours; matrices of Imath.
#pragma once

#include <ImathMatrix.h>
#include <ImathVec.h>

#include <cmath>

namespace oriel {

// Conventions
//   Row vectors multiply from the left, p' = p * M; the translation is the last row. This is the
//   convention of Imath and mental ray.
//   World space is right-handed. Lengths are scene units. Angles are radians.
//   Vectors and colours are Oriel's own and convert from and to those of Imath. Unlike these they
//   are trivially copyable: functions pass them in registers, and structures that contain them are
//   copied as a whole. Their members have the names of those of Imath.
using Mat4 = Imath::M44f;

struct Vec2 {
  float x, y;

  Vec2() = default;  // not initialised
  constexpr explicit Vec2(float a) : x(a), y(a) {}
  constexpr Vec2(float x_, float y_) : x(x_), y(y_) {}
  constexpr Vec2(const Imath::V2f& v) : x(v.x), y(v.y) {}
  constexpr operator Imath::V2f() const { return Imath::V2f(x, y); }

  float& operator[](int i) { return (&x)[i]; }
  const float& operator[](int i) const { return (&x)[i]; }

  constexpr bool operator==(const Vec2&) const = default;

  constexpr Vec2 operator-() const { return Vec2(-x, -y); }
  constexpr Vec2 operator+(const Vec2& v) const { return Vec2(x + v.x, y + v.y); }
  constexpr Vec2 operator-(const Vec2& v) const { return Vec2(x - v.x, y - v.y); }
  constexpr Vec2 operator*(const Vec2& v) const { return Vec2(x * v.x, y * v.y); }
  constexpr Vec2 operator/(const Vec2& v) const { return Vec2(x / v.x, y / v.y); }
  constexpr Vec2 operator*(float a) const { return Vec2(x * a, y * a); }
  constexpr Vec2 operator/(float a) const { return Vec2(x / a, y / a); }
  constexpr Vec2& operator+=(const Vec2& v) { return *this = *this + v; }
  constexpr Vec2& operator-=(const Vec2& v) { return *this = *this - v; }
  constexpr Vec2& operator*=(float a) { return *this = *this * a; }
  friend constexpr Vec2 operator*(float a, const Vec2& v) { return v * a; }

  constexpr float dot(const Vec2& v) const { return x * v.x + y * v.y; }
  constexpr float length2() const { return dot(*this); }
  float length() const { return Imath::V2f(*this).length(); }
};

struct Vec3 {
  float x, y, z;

  Vec3() = default;  // not initialised
  constexpr explicit Vec3(float a) : x(a), y(a), z(a) {}
  constexpr Vec3(float x_, float y_, float z_) : x(x_), y(y_), z(z_) {}
  template <class S>
  constexpr Vec3(const Imath::Vec3<S>& v)
      : x(static_cast<float>(v.x)), y(static_cast<float>(v.y)), z(static_cast<float>(v.z)) {}
  constexpr operator Imath::V3f() const { return Imath::V3f(x, y, z); }
  template <class S>
  constexpr explicit operator Imath::Vec3<S>() const {
    return Imath::Vec3<S>(x, y, z);
  }

  float& operator[](int i) { return (&x)[i]; }
  const float& operator[](int i) const { return (&x)[i]; }
  float* getValue() { return &x; }              // NOLINT(readability-identifier-naming)
  const float* getValue() const { return &x; }  // NOLINT(readability-identifier-naming)

  constexpr bool operator==(const Vec3&) const = default;

  constexpr Vec3 operator-() const { return Vec3(-x, -y, -z); }
  constexpr Vec3 operator+(const Vec3& v) const { return Vec3(x + v.x, y + v.y, z + v.z); }
  constexpr Vec3 operator-(const Vec3& v) const { return Vec3(x - v.x, y - v.y, z - v.z); }
  constexpr Vec3 operator*(const Vec3& v) const { return Vec3(x * v.x, y * v.y, z * v.z); }
  constexpr Vec3 operator/(const Vec3& v) const { return Vec3(x / v.x, y / v.y, z / v.z); }
  constexpr Vec3 operator*(float a) const { return Vec3(x * a, y * a, z * a); }
  constexpr Vec3 operator/(float a) const { return Vec3(x / a, y / a, z / a); }
  constexpr Vec3& operator+=(const Vec3& v) { return *this = *this + v; }
  constexpr Vec3& operator-=(const Vec3& v) { return *this = *this - v; }
  constexpr Vec3& operator*=(const Vec3& v) { return *this = *this * v; }
  constexpr Vec3& operator*=(float a) { return *this = *this * a; }
  constexpr Vec3& operator/=(float a) { return *this = *this / a; }
  friend constexpr Vec3 operator*(float a, const Vec3& v) { return v * a; }

  constexpr float dot(const Vec3& v) const { return x * v.x + y * v.y + z * v.z; }
  constexpr Vec3 cross(const Vec3& v) const {
    return Vec3(y * v.z - z * v.y, z * v.x - x * v.z, x * v.y - y * v.x);
  }
  constexpr float length2() const { return dot(*this); }
  float length() const { return Imath::V3f(*this).length(); }
  /// Unit vector; a null vector is returned unchanged.
  Vec3 normalized() const { return Imath::V3f(*this).normalized(); }
  Vec3& normalize() { return *this = normalized(); }
  bool equalWithAbsError(const Vec3& v, float e) const {  // NOLINT(readability-identifier-naming)
    return Imath::V3f(*this).equalWithAbsError(v, e);
  }
};

/// Linear colour. Components may exceed 1 and are not clamped.
struct Rgb : Vec3 {
  Rgb() = default;  // not initialised
  constexpr explicit Rgb(float a) : Vec3(a) {}
  constexpr Rgb(float r, float g, float b) : Vec3(r, g, b) {}
  constexpr Rgb(const Vec3& v) : Vec3(v) {}
  template <class S>
  constexpr Rgb(const Imath::Vec3<S>& v) : Vec3(v) {}

  constexpr Rgb operator-() const { return Rgb(-x, -y, -z); }
  constexpr Rgb operator+(const Rgb& v) const { return Rgb(x + v.x, y + v.y, z + v.z); }
  constexpr Rgb operator-(const Rgb& v) const { return Rgb(x - v.x, y - v.y, z - v.z); }
  constexpr Rgb operator*(const Rgb& v) const { return Rgb(x * v.x, y * v.y, z * v.z); }
  constexpr Rgb operator/(const Rgb& v) const { return Rgb(x / v.x, y / v.y, z / v.z); }
  constexpr Rgb operator*(float a) const { return Rgb(x * a, y * a, z * a); }
  constexpr Rgb operator/(float a) const { return Rgb(x / a, y / a, z / a); }
  constexpr Rgb& operator+=(const Rgb& v) { return *this = *this + v; }
  constexpr Rgb& operator-=(const Rgb& v) { return *this = *this - v; }
  constexpr Rgb& operator*=(const Rgb& v) { return *this = *this * v; }
  constexpr Rgb& operator*=(float a) { return *this = *this * a; }
  constexpr Rgb& operator/=(const Rgb& v) { return *this = *this / v; }
  constexpr Rgb& operator/=(float a) { return *this = *this / a; }
  friend constexpr Rgb operator*(float a, const Rgb& v) { return v * a; }
};

/// Linear colour with alpha; alpha is opacity (coverage), colours are premultiplied.
struct Rgba {
  float r, g, b, a;

  Rgba() = default;  // not initialised
  constexpr explicit Rgba(float v) : r(v), g(v), b(v), a(v) {}
  constexpr Rgba(float r_, float g_, float b_, float a_) : r(r_), g(g_), b(b_), a(a_) {}

  float& operator[](int i) { return (&r)[i]; }
  const float& operator[](int i) const { return (&r)[i]; }

  constexpr bool operator==(const Rgba&) const = default;

  constexpr Rgba operator-() const { return Rgba(-r, -g, -b, -a); }
  constexpr Rgba operator+(const Rgba& c) const { return Rgba(r + c.r, g + c.g, b + c.b, a + c.a); }
  constexpr Rgba operator-(const Rgba& c) const { return Rgba(r - c.r, g - c.g, b - c.b, a - c.a); }
  constexpr Rgba operator*(const Rgba& c) const { return Rgba(r * c.r, g * c.g, b * c.b, a * c.a); }
  constexpr Rgba operator/(const Rgba& c) const { return Rgba(r / c.r, g / c.g, b / c.b, a / c.a); }
  constexpr Rgba operator*(float f) const { return Rgba(r * f, g * f, b * f, a * f); }
  constexpr Rgba operator/(float f) const { return Rgba(r / f, g / f, b / f, a / f); }
  constexpr Rgba& operator+=(const Rgba& c) { return *this = *this + c; }
  constexpr Rgba& operator-=(const Rgba& c) { return *this = *this - c; }
  constexpr Rgba& operator*=(const Rgba& c) { return *this = *this * c; }
  constexpr Rgba& operator*=(float f) { return *this = *this * f; }
  constexpr Rgba& operator/=(const Rgba& c) { return *this = *this / c; }
  constexpr Rgba& operator/=(float f) { return *this = *this / f; }
  friend constexpr Rgba operator*(float f, const Rgba& c) { return c * f; }
};

// Text of vectors, for messages of tests.
template <class Stream>
Stream& operator<<(Stream& out, const Vec3& v) {
  out << '(' << v.x << ' ' << v.y << ' ' << v.z << ')';
  return out;
}

/// Point times matrix with perspective division.
inline Vec3 operator*(const Vec3& v, const Mat4& m) { return Imath::V3f(v) * m; }

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 0.31830988618379067154f;
inline constexpr float kTwoPi = 2 * kPi;

/// a * b + c, rounded once; the compiler does not contract such expressions
/// (cmake/OrielBuild.cmake).
inline float fma(float a, float b, float c) { return __builtin_fmaf(a, b, c); }

inline float dot(const Vec3& a, const Vec3& b) { return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x)); }
inline Vec3 cross(const Vec3& a, const Vec3& b) { return a.cross(b); }
inline float length(const Vec3& v) { return std::sqrt(dot(v, v)); }
/// Unit vector of v; a null vector is returned unchanged.
inline Vec3 normalize(const Vec3& v) {
  const float len = length(v);
  return len > 0 ? v * (1 / len) : v;
}
inline float sqr(float x) { return x * x; }
inline float lerp(float a, float b, float t) { return fma(t, b - a, a); }
inline float clamp(float x, float lo, float hi) { return x < lo ? lo : (x > hi ? hi : x); }
inline float clamp01(float x) { return clamp(x, 0.0f, 1.0f); }
/// Hermite interpolation from 0 at a to 1 at b.
inline float smoothstep(float a, float b, float x) {
  const float t = clamp01((x - a) / (b - a));
  return t * t * (3 - 2 * t);
}

inline Rgb rgb(const Rgba& c) { return Rgb(c.r, c.g, c.b); }
inline float max_component(const Rgb& c) { return std::max(c.x, std::max(c.y, c.z)); }
inline bool is_black(const Rgb& c) { return c.x == 0 && c.y == 0 && c.z == 0; }
inline bool is_finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// Transforms a point by an affine matrix (no perspective division).
inline Vec3 transform_point(const Vec3& p, const Mat4& m) {
  return Vec3(fma(p.x, m[0][0], fma(p.y, m[1][0], fma(p.z, m[2][0], m[3][0]))),
              fma(p.x, m[0][1], fma(p.y, m[1][1], fma(p.z, m[2][1], m[3][1]))),
              fma(p.x, m[0][2], fma(p.y, m[1][2], fma(p.z, m[2][2], m[3][2]))));
}
/// Transforms a direction or displacement by the upper 3x3 of m.
inline Vec3 transform_vector(const Vec3& v, const Mat4& m) {
  return Vec3(fma(v.x, m[0][0], fma(v.y, m[1][0], v.z * m[2][0])),
              fma(v.x, m[0][1], fma(v.y, m[1][1], v.z * m[2][1])),
              fma(v.x, m[0][2], fma(v.y, m[1][2], v.z * m[2][2])));
}
/// Transforms a normal, given the *inverse* of the transform (multiplies with its transpose).
inline Vec3 transform_normal(const Vec3& n, const Mat4& inverse) {
  return Vec3(fma(n.x, inverse[0][0], fma(n.y, inverse[0][1], n.z * inverse[0][2])),
              fma(n.x, inverse[1][0], fma(n.y, inverse[1][1], n.z * inverse[1][2])),
              fma(n.x, inverse[2][0], fma(n.y, inverse[2][1], n.z * inverse[2][2])));
}

}  // namespace oriel
