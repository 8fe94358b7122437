// SPDX-License-Identifier: Apache-2.0
// The camera: raster positions to rays.
#pragma once

#include <vector>

#include "base/vec.h"

namespace oriel {

// Conventions
//   Raster space: origin at the lower left corner of the image, first pixel centre at (.5, .5).
//   Camera space: at the origin, looking down -z, +y up, +x right.
struct Camera {
  int width = 640, height = 480;  ///< pixels of the full image
  bool orthographic = false;
  float focal = 1;     ///< unit of aperture
  float aperture = 1;  ///< film width; orthographic: width of view in scene units
  float aspect = 4.0f / 3.0f;
  Vec2 offset{0};                     ///< shift of the image plane in pixels
  float clip_near = 0, clip_far = 0;  ///< 0 0 = none
  int window[4] = {0, 0, 0, 0};       ///< x0 y0 x1 y1, half open, from the lower left
  Mat4 to_world, to_camera;           ///< of a moving camera: in the middle of the shutter interval
  std::vector<Mat4> path;             ///< to_world at equal steps of ray time; empty = static
  float middle = 0;                   ///< of the shutter, ray time

  struct Ray {
    Vec3 origin, direction;  ///< world, direction unit
    float cos_to_film;       ///< cosine to the optical axis; 1 when orthographic
    float spread;            ///< radians between the rays of neighbouring pixels
    float width;             ///< footprint at the origin, world units (orthographic)
    float time = 0;
  };
  /// At the middle of the shutter interval.
  Ray ray(Vec2 raster) const { return ray(raster, middle); }
  Ray ray(Vec2 raster, float time) const;
  /// Projects a point: raster x, y, and the distance along the axis. Not finite in the plane of the
  /// camera.
  Vec3 project(const Vec3& point, float time) const;
  /// Raster x and y of a point of camera space; z stays that of camera space. Points in the plane
  /// of the camera count as 1e-30 in front of it.
  /// Checked: Spaces.RasterIsThePixelOfTheEyeRay
  Vec3 raster_of(const Vec3& camera_point) const;
  /// Width and height of a pixel at a depth in front of the camera, in units of camera space.
  /// Checked: Spaces.RasterUnitIsOnePixelOnTheScreen
  Vec2 pixel_size(float depth) const;
  /// A static camera at the placement of that time.
  Camera at(float time) const;
};

}  // namespace oriel
