// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_lens.h"

#include <algorithm>
#include <cmath>

#include "color/luminance.h"
#include "runtime/shader_node.h"
#include "runtime/texture_node.h"
#include "runtime/world.h"

namespace oriel {
namespace {

struct Stencil {
  float floor, ceiling;
  Rgba floor_color, ceil_color;
  ScalarTextureRef stencil;
};
struct Clamp {
  float floor, ceiling;
  bool luminance;
  Rgba floor_color, ceil_color;
};
struct Volume {
  Rgba color;
  float max;
  bool lightrays;
};
struct Oversampling {
  int samples;
};

constexpr ParamSpec kStencilRows[] = {
    {ORIEL_PARAM(Stencil, floor), .doc = "Stencil value below which floor_color is used.",
     .declared_default = false},
    {ORIEL_PARAM(Stencil, ceiling), .doc = "Stencil value above which ceil_color is used.",
     .declared_default = false},
    {ORIEL_PARAM(Stencil, floor_color), .doc = "Colour below the floor.",
     .declared_default = false},
    {ORIEL_PARAM(Stencil, ceil_color), .doc = "Colour above the ceiling.",
     .declared_default = false},
    {ORIEL_PARAM(Stencil, stencil), .doc = "Stencil image over the whole frame.",
     .declared_default = false},
};
constexpr ParamSpec kClampRows[] = {
    {ORIEL_PARAM(Clamp, floor), .doc = "Value mapped to 0.", .declared_default = false},
    {ORIEL_PARAM(Clamp, ceiling), .doc = "Value mapped to 1; not above floor = floor + 1.",
     .declared_default = false},
    {ORIEL_PARAM(Clamp, luminance), .doc = "Whether luminance is clamped, instead of each channel.",
     .declared_default = false},
    {ORIEL_PARAM(Clamp, floor_color), .doc = "Colour below the floor, with luminance.",
     .declared_default = false},
    {ORIEL_PARAM(Clamp, ceil_color), .doc = "Colour above the ceiling, with luminance.",
     .declared_default = false},
};
constexpr ParamSpec kVolumeRows[] = {
    {ORIEL_PARAM(Volume, color), .doc = "Fog colour.", .declared_default = false},
    {ORIEL_PARAM(Volume, max), .unit = "scene units",
     .doc = "Distance of full density; 0 = no fog.", .declared_default = false},
    {ORIEL_PARAM(Volume, lightrays), .doc = "Whether light rays are attenuated too.",
     .declared_default = false},
};
constexpr ParamSpec kOversamplingRows[] = {
    {ORIEL_PARAM(Oversampling, samples), .doc = "Camera rays per sample.",
     .support = Support::Ignored, .declared_default = false},
};

template <class P>
float ceiling_of(const P& p) {
  return p.ceiling > p.floor ? p.ceiling : p.floor + 1;
}

/// Replaces NaN and negative values by 0, and bounds large ones.
Rgb shown(const Rgb& c) {
  constexpr float kBrightest = 1e30f;
  const auto channel = [&](float x) { return x > 0 ? std::min(x, kBrightest) : 0.0f; };
  return Rgb(channel(c.x), channel(c.y), channel(c.z));
}

Rgb stencil(const Call& call, const LensCall&, const Rgb& film) {
  const auto& p = call.as<Stencil>();
  const Rgb color = shown(film);
  if (!p.stencil.texture || !call.point.world) return color;
  const Camera& camera = call.point.world->camera;
  const Vec2 uv(call.point.raster.x / static_cast<float>(camera.width),
                call.point.raster.y / static_cast<float>(camera.height));
  const Rgba c =
      p.stencil.texture->lookup(uv, call.point, {.wrap_u = Wrap::Clamp, .wrap_v = Wrap::Clamp});
  const float value = (c.r + c.g + c.b) / 3, ceiling = ceiling_of(p);
  if (value < p.floor) return rgb(p.floor_color);
  if (value > ceiling) return rgb(p.ceil_color);
  const float share = (value - p.floor) / (ceiling - p.floor);
  return color * share + rgb(p.floor_color) * (1 - share);
}

Rgb clamp_lens(const Call& call, const LensCall&, const Rgb& film) {
  const auto& p = call.as<Clamp>();
  const Rgb color = shown(film);
  const float ceiling = ceiling_of(p), range = ceiling - p.floor;
  if (!p.luminance)
    return Rgb(clamp01((color.x - p.floor) / range), clamp01((color.y - p.floor) / range),
               clamp01((color.z - p.floor) / range));
  const float l = luminance(color);
  if (l < p.floor) return rgb(p.floor_color);
  if (l > ceiling) return rgb(p.ceil_color);
  return l > 0 ? color * ((l - p.floor) / range / l) : Rgb(0);
}

VolumeValue fog(const Call& call) {
  const auto& p = call.as<Volume>();
  if (!(p.max > 0)) return {};
  if (std::isinf(call.point.ray_length)) return {};
  const float dense = clamp01(call.point.ray_length / p.max);
  return {Rgb(1 - dense), rgb(p.color) * dense};
}

}  // namespace

const ShaderSpec kMibLensStencil = {
    .name = "mib_lens_stencil",
    .library = "base",
    .apply = kApplyLens,
    .doc = "Stencil that covers parts of the frame with colours.",
    .params = kStencilRows,
    .params_size = sizeof(Stencil),
    .lens = {.map_color = stencil},
};

const ShaderSpec kMibLensClamp = {
    .name = "mib_lens_clamp",
    .library = "base",
    .apply = kApplyLens,
    .doc = "Mapping of a brightness range to 0..1, clamped.",
    .params = kClampRows,
    .params_size = sizeof(Clamp),
    .lens = {.map_color = clamp_lens},
};

const ShaderSpec kMibVolume = {
    .name = "mib_volume",
    .library = "base",
    .apply = kApplyVolume,
    .doc = "Homogeneous fog.",
    .params = kVolumeRows,
    .params_size = sizeof(Volume),
    .volume =
        {
            .evaluate = fog,
            .dims_light =
                [](const ShaderNode& node) {
                  return node.constants<Volume>().lightrays ||
                         node.connected(offsetof(Volume, lightrays));
                },
        },
};

const ShaderSpec kOversamplingLens = {
    .name = "oversampling_lens",
    .library = "physics",
    .apply = kApplyLens,
    .doc = "Accepted and ignored; the sampler sets the number of rays per pixel.",
    .params = kOversamplingRows,
    .params_size = sizeof(Oversampling),
    .lens = {.map_color = [](const Call&, const LensCall&,
                             const Rgb& color) { return shown(color); }},
};

}  // namespace oriel
