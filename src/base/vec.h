// SPDX-License-Identifier: Apache-2.0
// Vectors, matrices and colours of Imath with Oriel's names.
#pragma once

#include <ImathColor.h>
#include <ImathMatrix.h>
#include <ImathVec.h>

#include <cmath>

namespace oriel {

// Conventions
//   Row vectors multiply from the left, p' = p * M; the translation is the last row. This is the
//   convention of Imath and mental ray.
//   World space is right-handed. Lengths are scene units. Angles are radians.
using Vec2 = Imath::V2f;
using Vec3 = Imath::V3f;
using Mat4 = Imath::M44f;

/// Linear colour. Components may exceed 1 and are not clamped.
using Rgb = Imath::C3f;
/// Linear colour with alpha; alpha is opacity (coverage), colours are premultiplied.
using Rgba = Imath::C4f;

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
