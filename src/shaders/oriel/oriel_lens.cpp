// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_lens.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "lens/projection.h"

namespace oriel {
namespace {

struct Panorama {
  int projection;
  float horizontal, vertical;
};
struct FisheyeLens {
  int mapping;
  float angle;
  bool full_frame;
};
struct CubeLens {
  int layout;
};
struct Shift {
  float horizontal, vertical;
  bool keep_verticals;
  Vec3 up;
};

constexpr ParamSpec kPanoramaRows[] = {
    {ORIEL_PARAM(Panorama, projection), .fallback = {0}, .min = 0, .max = 1,
     .doc = "Projection: 0 spherical (latitude-longitude), 1 cylindrical."},
    {ORIEL_PARAM(Panorama, horizontal), .fallback = {360}, .min = 0, .max = 360, .unit = "degrees",
     .doc = "Horizontal angle of view."},
    {ORIEL_PARAM(Panorama, vertical), .fallback = {0}, .min = 0, .max = 180, .unit = "degrees",
     .doc = "Vertical angle of view; 0 = square pixels at the centre."},
};
constexpr ParamSpec kFisheyeRows[] = {
    {ORIEL_PARAM(FisheyeLens, mapping), .fallback = {0}, .min = 0, .max = 3,
     .doc = "Projection: 0 equidistant, 1 equisolid, 2 stereographic, 3 orthographic."},
    {ORIEL_PARAM(FisheyeLens, angle), .fallback = {180}, .min = 0, .max = 360, .unit = "degrees",
     .doc = "Angle of view across the image circle; orthographic at most 180."},
    {ORIEL_PARAM(FisheyeLens, full_frame), .fallback = {0},
     .doc = "Whether the image circle encloses the frame, instead of lying inside it."},
};
constexpr ParamSpec kCubeRows[] = {
    {ORIEL_PARAM(CubeLens, layout), .fallback = {0}, .min = 0, .max = 2,
     .doc = "Order of the faces -x, x, -y, y, -z, z: 0 from the top down, 1 from the left, "
            "2 in two rows."},
};
constexpr ParamSpec kShiftRows[] = {
    {ORIEL_PARAM(Shift, horizontal), .fallback = {0}, .unit = "picture widths",
     .doc = "Horizontal lens shift, to the right."},
    {ORIEL_PARAM(Shift, vertical), .fallback = {0}, .unit = "picture heights",
     .doc = "Vertical lens shift, upwards."},
    {ORIEL_PARAM(Shift, keep_verticals), .fallback = {0},
     .doc = "Whether lines along `up` stay parallel when the camera is tilted."},
    {ORIEL_PARAM(Shift, up), .fallback = {0, 1, 0},
     .doc = "World direction of the lines to keep parallel."},
};

constexpr float kDegree = kPi / 180;
/// A stereographic fisheye cannot show the direction behind the camera, a cylinder not the zenith.
constexpr float kMaxStereographic = 179 * kDegree, kMaxCylindrical = 179 * kDegree;

Vec2 place_in_picture(const Call& call, const Camera& camera) {
  return {call.point.raster.x / static_cast<float>(camera.width),
          call.point.raster.y / static_cast<float>(camera.height)};
}

/// A ray from the camera position in a direction in camera space.
void look(const Camera& camera, const Vec3& direction, float spread, Camera::Ray& ray) {
  ray.origin = transform_point(Vec3(0), camera.to_world);
  ray.direction = normalize(transform_vector(direction, camera.to_world));
  ray.cos_to_film = 1;
  ray.spread = spread;
  ray.width = 0;
}

int one_ray(const ShaderNode&) { return 1; }

Rgb unroll(const Call& call, const Camera& camera, const Vec2&, Camera::Ray& ray) {
  const auto& p = call.as<Panorama>();
  const float horizontal = p.horizontal * kDegree, square = horizontal / camera.aspect;
  const Vec2 uv = place_in_picture(call, camera);
  const float spread = horizontal / static_cast<float>(camera.width);
  if (p.projection == 0) {
    const float vertical = p.vertical > 0 ? p.vertical * kDegree : std::min(square, kPi);
    look(camera, lens::spherical(uv, horizontal, vertical), spread, ray);
  } else {
    const float vertical = p.vertical > 0 ? p.vertical * kDegree : 2 * math::atan(square / 2);
    look(camera, lens::cylindrical(uv, horizontal, std::min(vertical, kMaxCylindrical)), spread,
         ray);
  }
  return Rgb(1);
}

Rgb bend_round(const Call& call, const Camera& camera, const Vec2&, Camera::Ray& ray) {
  const auto& p = call.as<FisheyeLens>();
  const auto mapping = static_cast<lens::Fisheye>(std::clamp(p.mapping, 0, 3));
  float half = p.angle / 2 * kDegree;
  if (mapping == lens::Fisheye::Orthographic) half = std::min(half, kPi / 2);
  if (mapping == lens::Fisheye::Stereographic) half = std::min(half, kMaxStereographic);
  const float width = 1, height = 1 / camera.aspect;
  const float rim = p.full_frame ? math::hypot(width, height) : std::min(width, height);
  const Vec2 uv = place_in_picture(call, camera);
  const auto direction = lens::fisheye(
      Vec2((2 * uv.x - 1) * width / rim, (2 * uv.y - 1) * height / rim), mapping, half);
  if (!direction) return Rgb(0);
  look(camera, *direction, 2 * half / (rim * static_cast<float>(camera.width)), ray);
  return Rgb(1);
}

Rgb unfold(const Call& call, const Camera& camera, const Vec2&, Camera::Ray& ray) {
  const int layout = std::clamp(call.as<CubeLens>().layout, 0, 2);
  const Vec2 uv = place_in_picture(call, camera);
  const float side = static_cast<float>(camera.width) / (layout == 0 ? 1.0f : layout == 1 ? 6 : 3);
  look(camera, lens::cube(uv, static_cast<lens::CubeLayout>(layout)), 2 / side, ray);
  return Rgb(1);
}

Rgb shift(const Call& call, const Camera& camera, const Vec2&, Camera::Ray& ray) {
  const auto& p = call.as<Shift>();
  const Vec2 raster = call.point.raster + Vec2(p.horizontal * static_cast<float>(camera.width),
                                               p.vertical * static_cast<float>(camera.height));
  ray = camera.ray(raster);
  const Vec3 forward = normalize(transform_vector(Vec3(0, 0, -1), camera.to_world));
  const Vec3 up = normalize(p.up);
  constexpr float kSteepest = 0.999f;  // no horizontal direction exists when looking straight down
  if (!p.keep_verticals || camera.orthographic || std::abs(dot(forward, up)) > kSteepest ||
      !(length(up) > 0))
    return Rgb(1);
  const Vec2 at = raster + camera.offset;
  const float half_width = camera.aperture / 2 / camera.focal;
  const Vec2 place((2 * at.x / static_cast<float>(camera.width) - 1) * half_width,
                   (2 * at.y / static_cast<float>(camera.height) - 1) * half_width / camera.aspect);
  const Vec3 way = lens::upright(place, forward, up);
  ray.direction = normalize(way);
  ray.cos_to_film = 1 / length(way);
  ray.spread = 2 * half_width / static_cast<float>(camera.width) * sqr(ray.cos_to_film);
  return Rgb(1);
}

}  // namespace

const ShaderSpec kOrielLensPanorama = {
    .name = "oriel_lens_panorama",
    .library = "oriel",
    .apply = kApplyLens,
    .doc = "Panoramic camera.",
    .params = kPanoramaRows,
    .params_size = sizeof(Panorama),
    .lens = {.bend_ray = unroll, .ray_count = one_ray},
};

const ShaderSpec kOrielLensFisheye = {
    .name = "oriel_lens_fisheye",
    .library = "oriel",
    .apply = kApplyLens,
    .doc = "Fisheye camera.",
    .params = kFisheyeRows,
    .params_size = sizeof(FisheyeLens),
    .lens = {.bend_ray = bend_round, .ray_count = one_ray},
};

const ShaderSpec kOrielLensCube = {
    .name = "oriel_lens_cube",
    .library = "oriel",
    .apply = kApplyLens,
    .doc = "Six square views of a cube environment.",
    .params = kCubeRows,
    .params_size = sizeof(CubeLens),
    .lens = {.bend_ray = unfold, .ray_count = one_ray},
};

const ShaderSpec kOrielLensShift = {
    .name = "oriel_lens_shift",
    .library = "oriel",
    .apply = kApplyLens,
    .doc = "Lens shift and two-point perspective.",
    .params = kShiftRows,
    .params_size = sizeof(Shift),
    .lens = {.bend_ray = shift, .ray_count = one_ray},
};

}  // namespace oriel
