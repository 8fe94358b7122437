// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_lookup_cube.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/fraction.h"
#include "base/math.h"
#include "runtime/texture_node.h"

namespace oriel {
namespace {

struct Cube1 {
  Vec3 point, dir, size;
  ColorTextureRef tex;
};
struct Cube6 {
  Vec3 point, dir, size;
  ColorTextureRef tex_mx, tex_px, tex_my, tex_py, tex_mz, tex_pz;
};
struct Cylinder {
  Mat4 xform;
  float begin, end;
  ColorTextureRef tex;
};

constexpr const char* kPoint = "Centre of a box with a size.";
constexpr const char* kDir = "Look-up direction in world space; null = the ray direction.";
constexpr const char* kSize = "Edge lengths of the box; 0 = at infinity.";

constexpr ParamSpec kCube1Rows[] = {
    {ORIEL_PARAM(Cube1, point), .doc = kPoint, .declared_default = false},
    {ORIEL_PARAM(Cube1, dir), .doc = kDir, .declared_default = false},
    {ORIEL_PARAM(Cube1, size), .unit = "scene units", .doc = kSize, .declared_default = false},
    {ORIEL_PARAM(Cube1, tex), .doc = "Image of six faces from the top down: -x, x, -y, y, -z, z.",
     .declared_default = false},
};
constexpr ParamSpec kCube6Rows[] = {
    {ORIEL_PARAM(Cube6, point), .doc = kPoint, .declared_default = false},
    {ORIEL_PARAM(Cube6, dir), .doc = kDir, .declared_default = false},
    {ORIEL_PARAM(Cube6, size), .unit = "scene units", .doc = kSize, .declared_default = false},
    {ORIEL_PARAM(Cube6, tex_mx), .doc = "Image of the face at -x.", .declared_default = false},
    {ORIEL_PARAM(Cube6, tex_px), .doc = "Image of the face at x.", .declared_default = false},
    {ORIEL_PARAM(Cube6, tex_my), .doc = "Image of the face at -y.", .declared_default = false},
    {ORIEL_PARAM(Cube6, tex_py), .doc = "Image of the face at y.", .declared_default = false},
    {ORIEL_PARAM(Cube6, tex_mz), .doc = "Image of the face at -z.", .declared_default = false},
    {ORIEL_PARAM(Cube6, tex_pz), .doc = "Image of the face at z.", .declared_default = false},
};
constexpr ParamSpec kCylinderRows[] = {
    {ORIEL_PARAM(Cylinder, xform), .doc = "Matrix from world to cylinder space.",
     .declared_default = false},
    {ORIEL_PARAM(Cylinder, begin), .unit = "rad", .doc = "Start angle of the wall, from x.",
     .declared_default = false},
    {ORIEL_PARAM(Cylinder, end), .unit = "rad",
     .doc = "End angle of the wall; equal to begin = a full circle.", .declared_default = false},
    {ORIEL_PARAM(Cylinder, tex), .doc = "Image on the wall, u from x towards y, v along z.",
     .declared_default = false},
};

/// A position on the faces -x, x, -y, y, -z, z of a cube.
struct FacePlace {
  int face = 0;
  Vec2 uv{0.5f};
};

/// Exit point of the ray from a box around the centre; the direction itself if the box has no size.
template <class P>
Vec3 on_box(const P& p, const ShadingPoint& point) {
  const Vec3 d = p.dir == Vec3(0) ? point.ray_direction : p.dir;
  if (!(p.size.x > 0 && p.size.y > 0 && p.size.z > 0)) return d;
  const Vec3 half = p.size * 0.5f, o = (point.ray_origin - p.point) / half, way = d / half;
  float t = std::numeric_limits<float>::infinity();
  for (int k = 0; k < 3; ++k)
    if (way[k] != 0) t = std::min(t, (std::copysign(1.0f, way[k]) - o[k]) / way[k]);
  // Outside of the box and pointing away: treat the box as infinitely large.
  return t > 0 && std::isfinite(t) ? o + way * t : d;
}

FacePlace face_of(const Vec3& d) {
  const Vec3 a(std::abs(d.x), std::abs(d.y), std::abs(d.z));
  FacePlace out;
  float right = 0, up = 0, depth = 1;
  if (a.x >= a.y && a.x >= a.z) {
    out.face = d.x < 0 ? 0 : 1;
    depth = a.x;
    right = d.x < 0 ? -d.z : d.z;
    up = d.y;
  } else if (a.y >= a.z) {
    out.face = d.y < 0 ? 2 : 3;
    depth = a.y;
    right = d.x;
    up = d.y < 0 ? -d.z : d.z;
  } else {
    out.face = d.z < 0 ? 4 : 5;
    depth = a.z;
    right = d.z < 0 ? d.x : -d.x;
    up = d.y;
  }
  if (depth > 0) out.uv = Vec2(0.5f + 0.5f * right / depth, 0.5f + 0.5f * up / depth);
  return out;
}

constexpr TextureSampling kToTheBorder{.wrap_u = Wrap::Clamp, .wrap_v = Wrap::Clamp};

void cube1(const Call& call, void* result) {
  const auto& p = call.as<Cube1>();
  auto& out = *static_cast<Rgba*>(result);
  out = Rgba(0);
  if (!p.tex.texture) return;
  const FacePlace at = face_of(on_box(p, call.point));
  // Clamp to half a texel inside the strip, so that faces do not blend.
  const int rows = p.tex.texture->height() / 6;
  const float edge = rows > 0 ? 0.5f / static_cast<float>(rows) : 0;
  const float v = (static_cast<float>(5 - at.face) + clamp(at.uv.y, edge, 1 - edge)) / 6;
  out = p.tex.texture->lookup(Vec2(at.uv.x, v), call.point, kToTheBorder);
}

void cube6(const Call& call, void* result) {
  const auto& p = call.as<Cube6>();
  static constexpr ColorTextureRef Cube6::*kFaces[] = {&Cube6::tex_mx, &Cube6::tex_px,
                                                       &Cube6::tex_my, &Cube6::tex_py,
                                                       &Cube6::tex_mz, &Cube6::tex_pz};
  const FacePlace at = face_of(on_box(p, call.point));
  const TextureNode* face = (p.*kFaces[at.face]).texture;
  *static_cast<Rgba*>(result) = face ? face->lookup(at.uv, call.point, kToTheBorder) : Rgba(0);
}

/// Azimuth in [0, 2 pi) from x towards y.
float azimuth(const Vec3& p) {
  const float a = math::atan2(p.y, p.x);
  return a < 0 ? a + kTwoPi : a;
}

bool on_wall(const Cylinder& p, const Vec3& at) {
  if (std::abs(at.z) > 1) return false;
  if (p.begin == 0 && p.end == 0) return true;
  const float turn = (azimuth(at) - p.begin) / kTwoPi;
  return fraction(turn) * kTwoPi <= p.end - p.begin;
}

/// Nearest hit of the wall.
std::optional<Vec3> meet(const Cylinder& p, const ShadingPoint& point) {
  const Vec3 o = transform_point(point.ray_origin, p.xform);
  const Vec3 d = transform_vector(point.ray_direction, p.xform);
  const float a = sqr(d.x) + sqr(d.y), b = o.x * d.x + o.y * d.y;
  const float c = sqr(o.x) + sqr(o.y) - 1;
  const float root2 = b * b - a * c;
  if (!(a > 0) || root2 < 0) return std::nullopt;
  const float root = std::sqrt(root2);
  for (const float t : {(-b - root) / a, (-b + root) / a}) {
    const Vec3 at = o + d * t;
    if (t > 0 && on_wall(p, at)) return at;
  }
  return std::nullopt;
}

void cylindrical(const Call& call, void* result) {
  const auto& p = call.as<Cylinder>();
  auto& out = *static_cast<Rgba*>(result);
  out = Rgba(0);
  if (!p.tex.texture) return;
  const auto at = meet(p, call.point);
  if (!at) return;
  out = p.tex.texture->lookup(Vec2(azimuth(*at) / kTwoPi, (at->z + 1) / 2), call.point,
                              {.wrap_u = Wrap::Periodic, .wrap_v = Wrap::Clamp});
}

}  // namespace

const ShaderSpec kMibLookupCube1 = {
    .name = "mib_lookup_cube1",
    .library = "base",
    .apply = kApplyEnvironment | kApplyTexture,
    .doc = "Cube environment from one image of six faces.",
    .params = kCube1Rows,
    .params_size = sizeof(Cube1),
    .value = cube1,
};

const ShaderSpec kMibLookupCube6 = {
    .name = "mib_lookup_cube6",
    .library = "base",
    .apply = kApplyEnvironment | kApplyTexture,
    .doc = "Cube environment from six images.",
    .params = kCube6Rows,
    .params_size = sizeof(Cube6),
    .value = cube6,
};

const ShaderSpec kMibLookupCylindrical = {
    .name = "mib_lookup_cylindrical",
    .library = "base",
    .apply = kApplyEnvironment | kApplyTexture,
    .doc = "Cylindrical environment from an image.",
    .params = kCylinderRows,
    .params_size = sizeof(Cylinder),
    .value = cylindrical,
};

}  // namespace oriel
