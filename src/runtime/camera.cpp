// SPDX-License-Identifier: Apache-2.0
#include "runtime/camera.h"

namespace oriel {

Camera::Ray Camera::ray(Vec2 raster) const {
  const float half_width = aperture / 2;
  const float x = (2 * (raster.x + offset.x) / static_cast<float>(width) - 1) * half_width;
  const float y =
      (2 * (raster.y + offset.y) / static_cast<float>(height) - 1) * half_width / aspect;
  const float pixel = aperture / static_cast<float>(width);
  if (orthographic) {
    return {transform_point(Vec3(x, y, 0), to_world),
            normalize(transform_vector(Vec3(0, 0, -1), to_world)), 1, 0,
            pixel * length(transform_vector(Vec3(1, 0, 0), to_world))};
  }
  const Vec3 local = normalize(Vec3(x, y, -focal));
  return {transform_point(Vec3(0), to_world), normalize(transform_vector(local, to_world)),
          -local.z, pixel / focal * sqr(local.z), 0};
}

}  // namespace oriel
