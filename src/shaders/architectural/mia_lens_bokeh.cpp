// SPDX-License-Identifier: Apache-2.0
#include "shaders/architectural/mia_lens_bokeh.h"

#include <algorithm>

#include "lens/aperture.h"
#include "runtime/shader_node.h"
#include "runtime/texture_node.h"

namespace oriel {
namespace {

struct Bokeh {
  bool on;
  float plane, radius;
  int samples;
  float bias;
  int blade_count;
  float blade_angle;
  bool use_bokeh;
  ColorTextureRef bokeh;
};

constexpr ParamSpec kMiaLensBokehRows[] = {
    {ORIEL_PARAM(Bokeh, on), .fallback = {1}, .doc = "Whether depth of field is on."},
    {ORIEL_PARAM(Bokeh, plane), .fallback = {100}, .unit = "scene units",
     .doc = "Distance of the plane of focus."},
    {ORIEL_PARAM(Bokeh, radius), .fallback = {1}, .min = 0, .unit = "scene units",
     .doc = "Radius of the aperture."},
    {ORIEL_PARAM(Bokeh, samples), .fallback = {4}, .min = 1, .max = 65536,
     .doc = "Rays per camera sample."},
    {ORIEL_PARAM(Bokeh, bias), .fallback = {1}, .min = 0,
     .doc = "Distribution of light over the disc: 1 uniform, below 1 towards the centre, "
            "above 1 towards the rim."},
    {ORIEL_PARAM(Bokeh, blade_count), .fallback = {0}, .min = 0,
     .doc = "Number of aperture blades; below 3 the aperture is round."},
    {ORIEL_PARAM(Bokeh, blade_angle), .fallback = {0}, .unit = "turns",
     .doc = "Rotation of the blades; 1 = 360 degrees."},
    {ORIEL_PARAM(Bokeh, use_bokeh), .fallback = {0},
     .doc = "Whether an image defines the aperture; bias and blades are then ignored."},
    {ORIEL_PARAM(Bokeh, bokeh), .doc = "Image of the aperture.", .declared_default = false},
};

/// Maximum lookups per side for pictures, and the number for procedural textures.
constexpr int kMaxTexels = 1024, kProcedural = 256;

lens::Aperture kernel_of(const TextureNode& texture) {
  const auto side = [](int texels) {
    return texels > 0 ? std::min(texels, kMaxTexels) : kProcedural;
  };
  const int width = side(texture.width()), height = side(texture.height());
  std::vector<Rgb> texels;
  texels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      texels.push_back(
          rgb(texture.texel(Vec2((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                                 (static_cast<float>(y) + 0.5f) / static_cast<float>(height)))));
  return lens::Aperture(texels, static_cast<std::size_t>(width), static_cast<std::size_t>(height));
}

lens::Aperture aperture_of(const Bokeh& p) {
  const TextureNode* picture = p.use_bokeh ? p.bokeh.texture : nullptr;
  if (picture && !picture->missing()) return kernel_of(*picture);
  return lens::Aperture(p.blade_count, p.blade_angle, p.bias);
}

struct BokehState final : ShaderState {
  explicit BokehState(const Bokeh& p) : aperture(aperture_of(p)) {}
  lens::Aperture aperture;
};

/// Moves the ray origin to a point of the lens (unit disc) and aims at its intersection with the
/// focal plane.
void bend(const Camera& camera, float plane, float radius, const Vec2& point, Camera::Ray& ray) {
  const auto axis = [&](float x, float y, float z) {
    return normalize(transform_vector(Vec3(x, y, z), camera.to_world));
  };
  const Vec3 ahead = axis(0, 0, -1);
  const float cosine = dot(ray.direction, ahead);
  // Exporters write the distance with either sign.
  plane = std::abs(plane), radius = std::max(radius, 0.0f);
  if (!(cosine > 0) || !(plane > 0) || !std::isfinite(plane) || !std::isfinite(radius)) return;
  const Vec3 focus = ray.origin + ray.direction * (plane / cosine);
  ray.origin += (axis(1, 0, 0) * point.x + axis(0, 1, 0) * point.y) * radius;
  ray.direction = normalize(focus - ray.origin);
  ray.cos_to_film = dot(ray.direction, ahead);
}

struct LensDof {
  float plane, radius;
};

constexpr ParamSpec kDofRows[] = {
    {ORIEL_PARAM(LensDof, plane), .unit = "scene units",
     .doc = "Distance of the plane of focus; the sign is ignored.", .declared_default = false},
    {ORIEL_PARAM(LensDof, radius), .unit = "scene units", .doc = "Radius of the aperture.",
     .declared_default = false},
};

/// The default ray count mentioned in the manual of mia_lens_bokeh.
constexpr int kDofRays = 4;

}  // namespace

const ShaderSpec kMiaLensBokeh = {
    .name = "mia_lens_bokeh",
    .library = "architectural",
    .version = 4,
    .apply = kApplyLens,
    .doc = "Depth of field with a configurable aperture shape.",
    .params = kMiaLensBokehRows,
    .params_size = sizeof(Bokeh),
    .lens = {
        .bend_ray =
            [](const Call& call, const Camera& camera, const Vec2& u, Camera::Ray& ray) {
              const auto& p = call.as<Bokeh>();
              const auto s = static_cast<const BokehState*>(call.state)->aperture.sample(u);
              bend(camera, p.plane, p.radius, s.point, ray);
              return s.weight;
            },
        .ray_count =
            [](const ShaderNode& node) {
              const auto& p = node.constants<Bokeh>();
              return p.on ? std::max(p.samples, 1) : 0;
            },
    },
    .binding =
        {
            .prepare = [](const void* params, const World&) -> std::unique_ptr<ShaderState> {
              return std::make_unique<BokehState>(*static_cast<const Bokeh*>(params));
            },
        },
};

const ShaderSpec kPhysicalLensDof = {
    .name = "physical_lens_dof",
    .library = "physics",
    .apply = kApplyLens,
    .doc = "Depth of field of a round aperture.",
    .params = kDofRows,
    .params_size = sizeof(LensDof),
    .lens = {
        .bend_ray =
            [](const Call& call, const Camera& camera, const Vec2& u, Camera::Ray& ray) {
              const auto& p = call.as<LensDof>();
              bend(camera, p.plane, p.radius, lens::Aperture(0, 0, 1).sample(u).point, ray);
              return Rgb(1);
            },
        .ray_count = [](const ShaderNode&) { return kDofRays; },
    },
};

}  // namespace oriel
