// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_lookup.h"

#include "base/fraction.h"
#include "base/math.h"
#include "runtime/texture_node.h"
#include "runtime/world.h"

namespace oriel {
namespace {

struct Spherical {
  Vec3 dir;
  float rotate;
  ColorTextureRef tex;
};
struct Background {
  Vec3 zoom, pan;
  bool torus_u, torus_v;
  ColorTextureRef tex;
};

constexpr ParamSpec kSphericalRows[] = {
    {ORIEL_PARAM(Spherical, dir),
     .doc = "Look-up direction in world space; null = the ray direction.",
     .declared_default = false},
    {ORIEL_PARAM(Spherical, rotate), .unit = "rad", .doc = "Rotation of the image about y.",
     .declared_default = false},
    {ORIEL_PARAM(Spherical, tex), .doc = "Latitude-longitude image.", .declared_default = false},
};
constexpr ParamSpec kBackgroundRows[] = {
    {ORIEL_PARAM(Background, zoom), .doc = "Scale of the image; 0 = 1.", .declared_default = false},
    {ORIEL_PARAM(Background, pan), .doc = "Offset in image sizes.", .declared_default = false},
    {ORIEL_PARAM(Background, torus_u), .doc = "Whether the image repeats horizontally.",
     .declared_default = false},
    {ORIEL_PARAM(Background, torus_v), .doc = "Whether the image repeats vertically.",
     .declared_default = false},
    {ORIEL_PARAM(Background, tex), .doc = "Texture image.", .declared_default = false},
};

void spherical(const Call& call, void* result) {
  const auto& p = call.as<Spherical>();
  auto& out = *static_cast<Rgba*>(result);
  out = Rgba(0);
  if (!p.tex.texture) return;
  const Vec3 d = normalize(p.dir == Vec3(0) ? call.point.ray_direction : p.dir);
  // The centre of the picture is at -z, u increases to the right seen from inside, y is up.
  const float u = 0.5f + (math::atan2(d.x, -d.z) + p.rotate) / kTwoPi;
  const float v = 0.5f + math::asin(clamp(d.y, -1, 1)) / kPi;
  out = p.tex.texture->lookup(Vec2(fraction(u), v), call.point,
                              {.wrap_u = Wrap::Periodic, .wrap_v = Wrap::Clamp});
}

void background(const Call& call, void* result) {
  const auto& p = call.as<Background>();
  auto& out = *static_cast<Rgba*>(result);
  out = Rgba(0);
  if (!p.tex.texture || !call.point.world) return;
  const Camera& camera = call.point.world->camera;
  const Vec3 d = transform_vector(call.point.ray_direction, camera.to_camera);
  if (!(d.z < 0)) return;
  Vec2 uv(0.5f);
  if (camera.orthographic) {
    const Vec3 o = transform_point(call.point.ray_origin, camera.to_camera);
    uv += Vec2(o.x / camera.aperture, o.y / camera.aperture * camera.aspect);
  } else {
    const float scale = camera.focal / (-d.z * camera.aperture);
    uv += Vec2(d.x * scale, d.y * scale * camera.aspect);
  }
  const auto zoomed = [](float x, float zoom, float pan) {
    return (x - 0.5f) / (zoom != 0 ? zoom : 1) + 0.5f + pan;
  };
  uv = Vec2(zoomed(uv.x, p.zoom.x, p.pan.x), zoomed(uv.y, p.zoom.y, p.pan.y));
  out = p.tex.texture->lookup(uv, call.point,
                              {.wrap_u = p.torus_u ? Wrap::Periodic : Wrap::Black,
                               .wrap_v = p.torus_v ? Wrap::Periodic : Wrap::Black});
}

}  // namespace

const ShaderSpec kMibLookupSpherical = {
    .name = "mib_lookup_spherical",
    .library = "base",
    .apply = kApplyEnvironment | kApplyTexture,
    .doc = "Environment by a latitude-longitude image.",
    .params = kSphericalRows,
    .params_size = sizeof(Spherical),
    .value = spherical,
};

const ShaderSpec kMibLookupBackground = {
    .name = "mib_lookup_background",
    .library = "base",
    .apply = kApplyTexture | kApplyEnvironment | kApplyLens,
    .doc = "Background image fixed to the camera frame.",
    .params = kBackgroundRows,
    .params_size = sizeof(Background),
    .value = background,
};

}  // namespace oriel
