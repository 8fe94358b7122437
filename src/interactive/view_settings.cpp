// SPDX-License-Identifier: Apache-2.0
#include "interactive/view_settings.h"

#include <algorithm>
#include <cmath>

namespace oriel::interactive {

std::optional<Mat4> camera_matrix(const Look& look) {
  const auto is_usable = [](const Vec3& v) {
    const float l = length(v);
    return std::isfinite(l) && l > 0;
  };
  const Vec3 back = look.from - look.to;
  if (!is_usable(back) || !is_usable(look.up)) return std::nullopt;
  const Vec3 z = normalize(back);
  const Vec3 side = cross(normalize(look.up), z);
  if (!(length(side) > 1e-6f)) return std::nullopt;
  const Vec3 x = normalize(side), y = cross(z, x);
  const Mat4 to_world(x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, look.from.x,
                      look.from.y, look.from.z, 1);
  return to_world.inverse();
}

namespace {

/// The vertical axis of the scene if the camera is upright with respect to it, so that navigation
/// keeps it upright; otherwise the camera's own.
Vec3 up_of(const Vec3& right, const Vec3& camera_up) {
  constexpr float kUpright = 1e-3f;
  Vec3 up = camera_up;
  float most = 0;
  for (const Vec3& axis : {Vec3(0, 0, 1), Vec3(0, 1, 0)})
    if (std::abs(dot(right, axis)) < kUpright && dot(camera_up, axis) > most) {
      most = dot(camera_up, axis);
      up = axis;
    }
  return up;
}

}  // namespace

Look look_of(const Camera& camera, float distance) {
  const Mat4& m = camera.to_world;
  const Vec3 from = transform_point(Vec3(0), m);
  return {from, from - normalize(transform_vector(Vec3(0, 0, 1), m)) * distance,
          up_of(normalize(transform_vector(Vec3(1, 0, 0), m)),
                normalize(transform_vector(Vec3(0, 1, 0), m)))};
}

std::array<int, 2> reduced_size(int width, int height, int divider) {
  const int d = std::max(divider, 1);
  return {(width + d - 1) / d, (height + d - 1) / d};
}

Window reduced_window(const std::optional<std::array<int, 4>>& region, int divider, int width,
                      int height) {
  if (!region) return {0, 0, width, height};
  const auto& r = *region;
  const auto low = [&](int v, int most) { return std::clamp(v / divider, 0, most - 1); };
  const auto high = [&](int v, int least, int most) {
    return std::clamp((v + divider - 1) / divider, least + 1, most);
  };
  const int x0 = low(std::max(r[0], 0), width), y0 = low(std::max(r[1], 0), height);
  const int x1 = high(std::max(r[2], 0), x0, width), y1 = high(std::max(r[3], 0), y0, height);
  return {x0, height - y1, x1, height - y0};
}

}  // namespace oriel::interactive
