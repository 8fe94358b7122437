// SPDX-License-Identifier: Apache-2.0
#include "geom/refine_hit.h"

#include <array>

#include "geom/motion.h"

namespace oriel::geom {

namespace {

using DVec3 = Imath::V3d;

void refine_triangle(const std::array<Vec3, 3>& corners, const Vec3& org, const Vec3& dir,
                     Hit& hit) {
  const DVec3 a(corners[0]), e1 = DVec3(corners[1]) - a, e2 = DVec3(corners[2]) - a;
  const DVec3 d(dir), normal = e1.cross(e2);
  const double cosine = -normal.dot(d);
  if (cosine == 0) return;
  const DVec3 from_a = DVec3(org) - a, moment = from_a.cross(d);
  const double inverse = 1 / cosine;
  hit.t = static_cast<float>(from_a.dot(normal) * inverse);
  hit.u = static_cast<float>(e2.dot(moment) * inverse);
  hit.v = static_cast<float>(-e1.dot(moment) * inverse);
  hit.ng = Vec3(normal);
}

/// A point on the axis of a curve, its derivatives by the parameter, and the radius.
struct Axis {
  DVec3 p, first, second;
  double radius, slope;
};

struct ControlPoint {
  DVec3 p;
  double radius;
};

ControlPoint control_point(const Curves& curves, std::size_t i, float time) {
  const auto wide = [](const Curves::Point& q) { return ControlPoint{DVec3(q.p), q.radius}; };
  if (curves.keys.empty()) return wide(curves.points[i]);
  const KeysAt at(curves.keys.size(), time);
  const ControlPoint from = wide(curves.keys[at.step][i]), to = wide(curves.keys[at.step + 1][i]);
  const double share = at.share;
  return {from.p * (1 - share) + to.p * share, from.radius * (1 - share) + to.radius * share};
}

Axis line_at(const std::array<ControlPoint, 4>& c, double u) {
  const DVec3 along = c[1].p - c[0].p;
  const double slope = c[1].radius - c[0].radius;
  return {c[0].p + along * u, along, DVec3(0), c[0].radius + slope * u, slope};
}

Axis bezier_at(const std::array<ControlPoint, 4>& c, double u) {
  const double w = 1 - u;
  const double b0 = w * w * w, b1 = 3 * w * w * u, b2 = 3 * w * u * u, b3 = u * u * u;
  const double d0 = 3 * w * w, d1 = 6 * w * u, d2 = 3 * u * u;
  Axis at;
  at.p = c[0].p * b0 + c[1].p * b1 + c[2].p * b2 + c[3].p * b3;
  at.first = (c[1].p - c[0].p) * d0 + (c[2].p - c[1].p) * d1 + (c[3].p - c[2].p) * d2;
  at.second =
      (c[2].p - c[1].p * 2.0 + c[0].p) * (6 * w) + (c[3].p - c[2].p * 2.0 + c[1].p) * (6 * u);
  at.radius = c[0].radius * b0 + c[1].radius * b1 + c[2].radius * b2 + c[3].radius * b3;
  at.slope = (c[1].radius - c[0].radius) * d0 + (c[2].radius - c[1].radius) * d1 +
             (c[3].radius - c[2].radius) * d2;
  return at;
}

/// On the surface, the distance to the axis equals the radius, and the axis is perpendicular to the
/// connection. This is Embree's definition of a swept Bezier curve; a line is a cone tangent to its
/// end spheres.
void refine_curve(const std::array<ControlPoint, 4>& c, bool is_line, const Vec3& org,
                  const Vec3& dir, Hit& hit) {
  const DVec3 o(org), d(dir);
  double t = hit.t, u = hit.u;
  constexpr int kSteps = 6;
  for (int step = 0; step < kSteps; ++step) {
    const Axis at = is_line ? line_at(c, u) : bezier_at(c, u);
    const DVec3 way = o + d * t - at.p;
    const double tilt = is_line ? at.slope : 0;
    // f = (|way|^2 - radius^2) / 2, g = way . first + tilt radius, and their derivatives.
    const double f = 0.5 * (way.dot(way) - at.radius * at.radius);
    const double g = way.dot(at.first) + tilt * at.radius;
    const double f_t = way.dot(d), f_u = -way.dot(at.first) - at.radius * at.slope;
    const double g_t = d.dot(at.first);
    const double g_u = way.dot(at.second) - at.first.dot(at.first) + tilt * at.slope;
    const double determinant = f_t * g_u - f_u * g_t;
    if (determinant == 0) return;
    const double change_t = (f * g_u - g * f_u) / determinant;
    const double change_u = (g * f_t - f * g_t) / determinant;
    t -= change_t;
    u -= change_u;
    if (!(u >= 0 && u <= 1)) return;
    const double reach = 1e-13 * (std::abs(t) + at.radius);
    if (step > 0 && std::abs(change_u) <= 1e-13 && std::abs(change_t) <= reach) break;
    if (step == kSteps - 1) return;
  }
  // Newton's method may converge to another sheet of the surface than the one that Embree hit.
  constexpr double kSameSheet = 0.05;
  const Axis at = is_line ? line_at(c, u) : bezier_at(c, u);
  if (std::abs(t - hit.t) * d.length() > kSameSheet * at.radius + 1e-5 * std::abs(t) * d.length())
    return;
  const DVec3 way = o + d * t - at.p;
  hit.t = static_cast<float>(t);
  hit.u = static_cast<float>(u);
  hit.v = 0;
  const double speed2 = at.first.dot(at.first);
  hit.ng =
      Vec3(is_line ? way : way * (speed2 - way.dot(at.second)) - at.first * (at.slope * at.radius));
}

}  // namespace

void refine_hit(const Mesh& mesh, const Vec3& org, const Vec3& dir, Hit& hit) {
  if (hit.primitive < mesh.triangles.size())
    return refine_triangle(corners_at(mesh, mesh.triangles[hit.primitive], hit.time), org, dir,
                           hit);
  const Curves& curves = mesh.curves;
  const std::size_t piece = hit.primitive - mesh.triangles.size();
  const bool is_line = piece < curves.lines.size();
  const std::size_t first =
      is_line ? curves.lines[piece] : curves.beziers[piece - curves.lines.size()];
  std::array<ControlPoint, 4> control{};
  for (std::size_t i = 0; i < (is_line ? 2 : 4); ++i)
    control[i] = control_point(curves, first + i, hit.time);
  refine_curve(control, is_line, org, dir, hit);
}

}  // namespace oriel::geom
