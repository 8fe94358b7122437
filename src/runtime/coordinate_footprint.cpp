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

/// Evaluates a coordinate beside a point.
class Beside {
 public:
  /// Inputs:  here: the coordinate at the point.
  Beside(const ShaderNode& coordinate, const Vec3& here, const ShadingPoint& point)
      : coordinate_(coordinate), here_(here), point_(point), beside_(point) {}

  /// The coordinate at an offset, as a difference; empty across a seam.
  std::optional<Vec2> step(const Vec3& way, const Vec2& uv) {
    beside_.position = point_.position + way;
    beside_.normal = point_.normal;  // shaders may change it
    for (int i = 0; i < point_.texture_spaces; ++i)
      beside_.tex[i] = point_.tex[i] + Vec3(uv.x, uv.y, 0);
    const Vec3 d = coordinate_.vector(beside_) - here_;
    if (!(std::max(std::abs(d.x), std::abs(d.y)) <= kSeam)) return std::nullopt;
    return Vec2(d.x, d.y);
  }

 private:
  const ShaderNode& coordinate_;
  const Vec3& here_;
  const ShadingPoint& point_;
  ShadingPoint beside_;  // one copy for all steps, since points are large
};

}  // namespace

TextureFootprint coordinate_footprint(const ShaderNode& coordinate, const Vec3& here,
                                      ShadingPoint& point) {
  if (point.look_up != LookUp::Filtered) return {};
  const TextureFootprint plain = texture_footprint(point);
  Beside beside(coordinate, here, point);
  const auto along = [&](const Vec3& way, const Vec2& uv) {
    if (is_black(way)) return Vec2(0);
    if (const auto d = beside.step(way, uv)) return *d;
    if (const auto d = beside.step(-way, -uv)) return -*d;
    return uv;
  };
  return {along(point.dpdx, plain.dx), along(point.dpdy, plain.dy)};
}

}  // namespace oriel
