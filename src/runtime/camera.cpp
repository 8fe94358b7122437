// SPDX-License-Identifier: Apache-2.0
#include "runtime/camera.h"

#include "geom/motion.h"

namespace oriel {

Camera Camera::at(float time) const {
  Camera camera = *this;
  if (path.empty()) return camera;
  camera.path.clear();
  camera.to_world = geom::matrix_at(path, time);
  camera.to_camera = geom::inverse_of(camera.to_world);
  return camera;
}

Vec3 Camera::project(const Vec3& point, float time) const {
  const Vec3 p = transform_point(
      point, path.empty() ? to_camera : geom::inverse_of(geom::matrix_at(path, time)));
  const float film = orthographic ? 1 : focal / -p.z;
  const float half_width = aperture / 2;
  return {(p.x * film / half_width + 1) / 2 * static_cast<float>(width) - offset.x,
          (p.y * film * aspect / half_width + 1) / 2 * static_cast<float>(height) - offset.y, -p.z};
}

Vec3 Camera::raster_of(const Vec3& p) const {
  /// Depth below which a point counts as in the camera's own plane.
  constexpr float kMinDepth = 1e-30f;
  float x = p.x, y = p.y;
  if (!orthographic) {
    const float depth = std::abs(p.z) > kMinDepth ? -p.z : kMinDepth;
    x *= focal / depth;
    y *= focal / depth;
  }
  const float half_width = aperture / 2, half_height = half_width / aspect;
  return Vec3((x / half_width + 1) / 2 * static_cast<float>(width) - offset.x,
              (y / half_height + 1) / 2 * static_cast<float>(height) - offset.y, p.z);
}

Vec2 Camera::pixel_size(float depth) const {
  const float scale = orthographic ? 1 : depth / focal;
  return {aperture / static_cast<float>(width) * scale,
          aperture / aspect / static_cast<float>(height) * scale};
}

Camera::Ray Camera::ray(Vec2 raster, float time) const {
  // Not by at(): a copy of the camera per ray would copy its path.
  Mat4 moved{Imath::UNINITIALIZED};
  if (!path.empty()) moved = geom::matrix_at(path, time);
  const Mat4& placed = path.empty() ? to_world : moved;
  const float half_width = aperture / 2;
  const float x = (2 * (raster.x + offset.x) / static_cast<float>(width) - 1) * half_width;
  const float y =
      (2 * (raster.y + offset.y) / static_cast<float>(height) - 1) * half_width / aspect;
  const float pixel = aperture / static_cast<float>(width);
  if (orthographic) {
    return {transform_point(Vec3(x, y, 0), placed),
            normalize(transform_vector(Vec3(0, 0, -1), placed)),
            1,
            0,
            pixel * length(transform_vector(Vec3(1, 0, 0), placed)),
            time};
  }
  const Vec3 local = normalize(Vec3(x, y, -focal));
  return {transform_point(Vec3(0), placed),
          normalize(transform_vector(local, placed)),
          -local.z,
          pixel / focal * sqr(local.z),
          0,
          time};
}

}  // namespace oriel
