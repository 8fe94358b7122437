// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_texture_filter.h"

#include <algorithm>
#include <cmath>

#include "base/frame.h"
#include "base/math.h"
#include "runtime/coordinate_footprint.h"
#include "runtime/texture_node.h"

namespace oriel {
namespace {

struct Lookup2 {
  ColorTextureRef tex;
  float factor;
};
struct Filter {
  ColorTextureRef tex;
  Vec3 coord;
  float eccmax, maxminor, disc_r;
  bool bilinear;
  int space;
  ShaderRef remap;
};
struct Rotate {
  Vec3 input;
  float angle, min, max;
};
struct Tangents {
  Vec3 u, v;
};

constexpr ParamSpec kLookup2Rows[] = {
    {ORIEL_PARAM(Lookup2, tex), .doc = "Texture to look up.", .declared_default = false},
    {ORIEL_PARAM(Lookup2, factor), .doc = "Scale of the first texture space; 0 = 1.",
     .declared_default = false},
};
constexpr ParamSpec kFilterRows[] = {
    {ORIEL_PARAM(Filter, tex), .doc = "Texture to look up.", .declared_default = false},
    {ORIEL_PARAM(Filter, coord),
     .doc = "Texture coordinate; outside 0..1 the result is transparent black.",
     .declared_default = false},
    {ORIEL_PARAM(Filter, eccmax), .doc = "Maximum ratio of the ellipse axes; 0 = 16.",
     .declared_default = false},
    {ORIEL_PARAM(Filter, maxminor), .unit = "texels",
     .doc = "Number of texels read along the short axis; ignored, affected only speed.",
     .support = Support::Ignored, .declared_default = false},
    {ORIEL_PARAM(Filter, disc_r), .unit = "pixels", .doc = "Radius of the projected disc; 0 = 0.3.",
     .declared_default = false},
    {ORIEL_PARAM(Filter, bilinear), .doc = "Whether magnified texels are interpolated.",
     .declared_default = false},
    {ORIEL_PARAM(Filter, space),
     .doc = "Texture space of the footprint; ignored, the first one is used because only "
            "its scale on the surface is known.",
     .support = Support::Ignored, .declared_default = false},
    {ORIEL_PARAM(Filter, remap), .doc = "Shader that transforms the coordinate.",
     .support = Support::Approximated, .declared_default = false},
};
constexpr ParamSpec kRotateRows[] = {
    {ORIEL_PARAM(Rotate, input), .doc = "Direction to rotate; null = along u.",
     .declared_default = false},
    {ORIEL_PARAM(Rotate, angle), .doc = "Blend of the angles: 0 = min, 1 = max.",
     .declared_default = false},
    {ORIEL_PARAM(Rotate, min), .unit = "turns", .doc = "Rotation at `angle` 0.",
     .declared_default = false},
    {ORIEL_PARAM(Rotate, max), .unit = "turns",
     .doc = "Rotation at `angle` 1; 0, with min equal, = 0.25.", .declared_default = false},
};
constexpr ParamSpec kRotateResults[] = {{ORIEL_PARAM(Tangents, u)}, {ORIEL_PARAM(Tangents, v)}};

void lookup2(const Call& call, void* result) {
  const auto& p = call.as<Lookup2>();
  auto& out = *static_cast<Rgba*>(result);
  out = Rgba(0);
  if (!p.tex.texture || call.point.texture_spaces == 0) return;
  const float factor = p.factor != 0 ? p.factor : 1;
  const Vec3 uv = call.point.tex[0] * factor;
  const TextureFootprint own = texture_footprint(call.point);
  out = p.tex.texture->lookup(Vec2(uv.x, uv.y), {own.dx * factor, own.dy * factor}, call.point, {});
}

/// Whether no filtering is necessary.
bool within_a_texel(const TextureFootprint& footprint, const TextureNode& texture) {
  const auto texels = [&](const Vec2& d) {
    return std::max(std::abs(d.x) * static_cast<float>(texture.width()),
                    std::abs(d.y) * static_cast<float>(texture.height()));
  };
  return std::max(texels(footprint.dx), texels(footprint.dy)) <= 1;
}

void filter_lookup(const Call& call, void* result) {
  const auto& p = call.as<Filter>();
  auto& out = *static_cast<Rgba*>(result);
  out = Rgba(0);
  if (!p.tex.texture) return;
  TextureSampling how{.wrap_u = Wrap::Black, .wrap_v = Wrap::Black};
  if (p.eccmax > 0) how.anisotropy = std::max(1.0f, p.eccmax);
  const ShaderNode* remap = p.remap.node && p.remap.node->spec().value ? p.remap.node : nullptr;
  TextureFootprint footprint =
      remap ? coordinate_footprint(*remap, remap->vector(call.point), call.point)
            : texture_footprint(call.point);
  // The semi-axes of the footprint are half a pixel.
  const float wider = (p.disc_r > 0 ? p.disc_r : 0.3f) / 0.5f;
  footprint.dx *= wider;
  footprint.dy *= wider;
  if (!p.bilinear && within_a_texel(footprint, *p.tex.texture))
    how.interpolation = Interpolation::Nearest;
  out = p.tex.texture->lookup(Vec2(p.coord.x, p.coord.y), footprint, call.point, how);
}

void rotate(const Call& call, void* result) {
  const auto& p = call.as<Rotate>();
  const bool unset = p.min == 0 && p.max == 0;
  const float turn = p.angle * ((unset ? 0.25f : p.max) - p.min) + p.min;
  const Vec3 along = p.input == Vec3(0) ? call.point.dpdu : p.input;
  const Frame frame = Frame::along(call.point.normal, along);
  const float c = math::cos(turn * kTwoPi), s = math::sin(turn * kTwoPi);
  *static_cast<Tangents*>(result) = {frame.s * c + frame.t * s, frame.t * c - frame.s * s};
}

}  // namespace

const ShaderSpec kMibTextureLookup2 = {
    .name = "mib_texture_lookup2",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Texture look-up at the first texture space, scaled and repeated.",
    .params = kLookup2Rows,
    .params_size = sizeof(Lookup2),
    .value = lookup2,
};

const ShaderSpec kMibTextureFilterLookup = {
    .name = "mib_texture_filter_lookup",
    .library = "base",
    .version = 3,
    .apply = kApplyTexture,
    .doc = "Texture look-up with an elliptical filter.",
    .params = kFilterRows,
    .params_size = sizeof(Filter),
    .value = filter_lookup,
};

const ShaderSpec kMibTextureRotate = {
    .name = "mib_texture_rotate",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Tangent directions rotated by an angle.",
    .params = kRotateRows,
    .params_size = sizeof(Rotate),
    .result = ParamType::Struct,
    .results = kRotateResults,
    .result_size = sizeof(Tangents),
    .value = rotate,
};

}  // namespace oriel
