// SPDX-License-Identifier: Apache-2.0
#include "lens/projection.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"

namespace oriel::lens {

Vec3 cylindrical(const Vec2& uv, float horizontal, float vertical) {
  const float longitude = (uv.x - 0.5f) * horizontal;
  const float height = (2 * uv.y - 1) * math::tan(vertical / 2);
  return normalize(Vec3(math::sin(longitude), height, -math::cos(longitude)));
}

Vec3 spherical(const Vec2& uv, float horizontal, float vertical) {
  const float longitude = (uv.x - 0.5f) * horizontal, latitude = (uv.y - 0.5f) * vertical;
  const float level = math::cos(latitude);
  return Vec3(math::sin(longitude) * level, math::sin(latitude), -math::cos(longitude) * level);
}

std::optional<Vec3> fisheye(const Vec2& place, Fisheye mapping, float half_angle) {
  const float r = place.length();
  if (!(r <= 1)) return std::nullopt;
  float angle = r * half_angle;
  switch (mapping) {
    case Fisheye::Equidistant:
      break;
    case Fisheye::Equisolid:
      angle = 2 * math::asin(r * math::sin(half_angle / 2));
      break;
    case Fisheye::Stereographic:
      angle = 2 * math::atan(r * math::tan(half_angle / 2));
      break;
    case Fisheye::Orthographic:
      angle = math::asin(r * math::sin(half_angle));
      break;
  }
  const float aside = r > 0 ? math::sin(angle) / r : 0;
  return Vec3(place.x * aside, place.y * aside, -math::cos(angle));
}

Vec3 cube(const Vec2& uv, CubeLayout layout) {
  const int columns = layout == CubeLayout::Column ? 1 : layout == CubeLayout::Row ? 6 : 3;
  const int rows = 6 / columns;
  // Faces are numbered from the top.
  const float x = clamp01(uv.x) * static_cast<float>(columns);
  const float y = (1 - clamp01(uv.y)) * static_cast<float>(rows);
  const int column = std::min(static_cast<int>(x), columns - 1);
  const int row = std::min(static_cast<int>(y), rows - 1);
  const float right = 2 * (x - static_cast<float>(column)) - 1;
  const float up = 1 - 2 * (y - static_cast<float>(row));
  switch (row * columns + column) {
    case 0:
      return normalize(Vec3(-1, up, -right));
    case 1:
      return normalize(Vec3(1, up, right));
    case 2:
      return normalize(Vec3(right, -1, -up));
    case 3:
      return normalize(Vec3(right, 1, up));
    case 4:
      return normalize(Vec3(right, up, -1));
    default:
      return normalize(Vec3(-right, up, 1));
  }
}

Vec3 upright(const Vec2& place, const Vec3& forward, const Vec3& up) {
  const float rise = dot(forward, up);
  const Vec3 along = forward - up * rise;
  const Vec3 axis = normalize(along);
  return axis + cross(axis, up) * place.x + up * (place.y + rise / length(along));
}

}  // namespace oriel::lens
