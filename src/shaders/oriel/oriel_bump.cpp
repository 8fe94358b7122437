// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_bump.h"

#include <algorithm>

#include "base/frame.h"
#include "runtime/bump.h"
#include "runtime/shader_node.h"

namespace oriel {
namespace {

struct BumpNode {
  float height, distance, strength;
  int bump_mode;
  Vec3 normal;
};

/// Texture coordinates of an offset in the tangent plane, by the derivatives of the first space.
Vec3 texture_step(const ShadingPoint& point, const Vec3& front, const Vec3& offset) {
  const float volume = dot(front, cross(point.dpdu, point.dpdv));
  if (volume == 0) return Vec3(0);
  return Vec3(dot(offset, cross(point.dpdv, front)), dot(offset, cross(front, point.dpdu)), 0) /
         volume;
}

/// The height at a point of the tangent plane.
float height_at(const Call& call, const Vec3& front, const Vec3& offset) {
  ShadingPoint at = call.point;
  at.position += offset;
  if (at.texture_spaces > 0) at.tex[0] += texture_step(at, front, offset);
  return call.node->with_params(at, [](const Call& c) { return c.as<BumpNode>().height; });
}

/// The bumped normal of a surface with that normal; both face the viewer.
Vec3 normal_of_height(const Call& call, const BumpNode& p, const Vec3& from) {
  if (!call.node || !call.node->connected(offsetof(BumpNode, height))) return from;
  /// Minimum step relative to the distance from the viewer: coarser than rounding errors.
  constexpr float kMinStep = 2e-4f;
  const ShadingPoint& point = call.point;
  const float step = std::max(pixel_width(point), kMinStep * std::max(point.ray_length, 1e-3f));
  const Vec3 front = point.back_side ? -from : from;
  const Frame frame(front);
  const auto slope = [&](const Vec3& axis) {
    return (height_at(call, front, axis * (step / 2)) -
            height_at(call, front, axis * (-step / 2))) /
           step;
  };
  const Vec3 gradient = frame.s * slope(frame.s) + frame.t * slope(frame.t);
  const Vec3 bumped = normalize(front - gradient * p.distance);
  const Vec3 mixed = bumped * p.strength + front * (1 - p.strength);
  if (!(dot(mixed, mixed) > 0)) return from;
  return point.back_side ? -normalize(mixed) : normalize(mixed);
}

void give_bump(const Call& call, void* result) {
  const auto& p = call.as<BumpNode>();
  const ShadingPoint& point = call.point;
  const Vec3 from = bump_normal(point, point.normal, p.normal, p.bump_mode);
  *static_cast<Vec3*>(result) =
      bump_vector(point, point.normal, normal_of_height(call, p, from), p.bump_mode);
}

constexpr ParamSpec kBumpNodeRows[] = {
    {ORIEL_PARAM(BumpNode, height), .doc = "Height; its connection is evaluated at five points."},
    {ORIEL_PARAM(BumpNode, distance), .fallback = {1}, .unit = "scene units",
     .doc = "Height of 1; negative values invert the bump."},
    {ORIEL_PARAM(BumpNode, strength), .fallback = {1},
     .doc = "Weight of the bumped normal; the rest is the smooth one."},
    {ORIEL_PARAM(BumpNode, bump_mode), .fallback = {5}, .min = 1, .max = 8,
     .doc = "bump_mode of mia_material_x, which defines the vectors."},
    {ORIEL_PARAM(BumpNode, normal),
     .doc = "Normal that is bumped, such as a normal map; null = that of the surface."},
};

}  // namespace

const ShaderSpec kOrielBump = {
    .name = "oriel_bump",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Normal of a height.",
    .params = kBumpNodeRows,
    .params_size = sizeof(BumpNode),
    .result = ParamType::Vector,
    .result_size = sizeof(Vec3),
    .value = give_bump,
    .binding = {.evaluations = 5},
};

}  // namespace oriel
