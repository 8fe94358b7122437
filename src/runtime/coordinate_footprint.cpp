// SPDX-License-Identifier: Apache-2.0
#include "runtime/coordinate_footprint.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/texture_node.h"

namespace oriel {
namespace {

/// Steps longer than half a picture are seams between copies of a texture; an estimate.
constexpr float kSeam = 0.5f;

/// The coordinate at an offset, as a difference; empty across a seam.
std::optional<Vec2> step(const ShaderNode& coordinate, const Vec3& here, const ShadingPoint& point,
                         const Vec3& way, const Vec2& uv) {
  ShadingPoint beside = point;
  beside.position += way;
  for (int i = 0; i < beside.texture_spaces; ++i) beside.tex[i] += Vec3(uv.x, uv.y, 0);
  const Vec3 d = coordinate.vector(beside) - here;
  if (!(std::max(std::abs(d.x), std::abs(d.y)) <= kSeam)) return std::nullopt;
  return Vec2(d.x, d.y);
}

}  // namespace

TextureFootprint coordinate_footprint(const ShaderNode& coordinate, const Vec3& here,
                                      ShadingPoint& point) {
  if (point.nearest_texels) return {};
  const TextureFootprint plain = texture_footprint(point);
  const auto along = [&](const Vec3& way, const Vec2& uv) {
    if (is_black(way)) return Vec2(0);
    if (const auto d = step(coordinate, here, point, way, uv)) return *d;
    if (const auto d = step(coordinate, here, point, -way, -uv)) return -*d;
    return uv;
  };
  return {along(point.dpdx, plain.dx), along(point.dpdy, plain.dy)};
}

}  // namespace oriel
