// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/math.h"
#include "runtime/coordinate_footprint.h"
#include "runtime/texture_node.h"
#include "shaders/max/max_shaders.h"
#include "shaders/maya/host_rows.h"
#include "shaders/maya/maya_place.h"

namespace oriel {
namespace {

struct Generator {
  int MapChannel;
  float UOffset, UScale, VOffset, VScale, WAngle;
  bool UWrap, UMirror, VWrap, VMirror;
};
struct Output {
  float RGBAmount, RGBOffset, OutputAmount;
  bool Invert, Clamp;
};
struct Bitmap {
  ColorTextureRef Bitmap;
  ShaderRef Coords, Output;
};
/// Parameters of shaders that combine two colours or maps.
struct Pair {
  Rgba Color1, Color2;
  ShaderRef Map1, Map2, Mask, Coords;
  bool Map1Enabled, Map2Enabled;
  float MixAmount;
};
struct Environment {
  Rgba Color;
  ShaderRef Map, Sky;
};

constexpr auto kGeneratorRows = about({
    {ORIEL_PARAM(Generator, MapChannel), .fallback = {1}, .min = 1,
     .doc = "Texture space, from 1."},
    {ORIEL_PARAM(Generator, UOffset), .doc = "Move of the tile."},
    {ORIEL_PARAM(Generator, UScale), .fallback = {1}, .doc = "Tiles along u."},
    {ORIEL_PARAM(Generator, UWrap), .fallback = {1}, .doc = "The tile comes again."},
    {ORIEL_PARAM(Generator, UMirror), .doc = "Every tile has its mirrored twin beside it."},
    {ORIEL_PARAM(Generator, VOffset), .doc = "Move of the tile."},
    {ORIEL_PARAM(Generator, VScale), .fallback = {1}, .doc = "Tiles along v."},
    {ORIEL_PARAM(Generator, VWrap), .fallback = {1}, .doc = "The tile comes again."},
    {ORIEL_PARAM(Generator, VMirror), .doc = "Every tile has its mirrored twin beside it."},
    {ORIEL_PARAM(Generator, WAngle), .unit = "radians", .doc = "Turn of the tile."},
});
constexpr auto kOutputRows = about({
    {ORIEL_PARAM(Output, RGBAmount), .fallback = {1}, .doc = "Factor."},
    {ORIEL_PARAM(Output, RGBOffset), .doc = "Added."},
    {ORIEL_PARAM(Output, OutputAmount), .fallback = {1}, .doc = "Factor of the result."},
    {ORIEL_PARAM(Output, Invert), .doc = "1 - colour."},
    {ORIEL_PARAM(Output, Clamp), .doc = "Not more than 1."},
});
constexpr auto kBitmapRows = about({
    {ORIEL_PARAM(Bitmap, Bitmap), .doc = "The picture."},
    {ORIEL_PARAM(Bitmap, Coords), .doc = "Where: a generator of coordinates."},
    {ORIEL_PARAM(Bitmap, Output), .doc = "How values are adjusted."},
});
constexpr auto kPairRows = about({
    {ORIEL_PARAM(Pair, Color1), .doc = "First."},
    {ORIEL_PARAM(Pair, Color2), .fallback = {1, 1, 1}, .doc = "Second."},
    {ORIEL_PARAM(Pair, Map1), .doc = "In place of the first colour."},
    {ORIEL_PARAM(Pair, Map2), .doc = "In place of the second."},
    {ORIEL_PARAM(Pair, Map1Enabled), .fallback = {1}, .doc = "Use it."},
    {ORIEL_PARAM(Pair, Map2Enabled), .fallback = {1}, .doc = "Use it."},
});
constexpr auto kMixRows =
    joined(kPairRows, about({
                          {ORIEL_PARAM(Pair, MixAmount), .doc = "Share of the second."},
                          {ORIEL_PARAM(Pair, Mask), .doc = "In place of MixAmount."},
                      }));
constexpr auto kCheckerRows = joined(
    kPairRows, about({{ORIEL_PARAM(Pair, Coords), .doc = "Where: a generator of coordinates."}}));
constexpr auto kEnvironmentRows = about({
    {ORIEL_PARAM(Environment, Color), .doc = "Colour all around."},
    {ORIEL_PARAM(Environment, Map), .doc = "A map all around."},
    {ORIEL_PARAM(Environment, Sky), .doc = "A sky, where there is no map."},
});

Vec3 generated(const Generator& p, const ShadingPoint& point) {
  const int channel = std::max(p.MapChannel, 1) - 1;
  const Vec3 at = channel < point.texture_spaces ? point.tex[channel]
                  : point.texture_spaces > 0     ? point.tex[0]
                                                 : Vec3(0);
  const float angle = angle_of(p.WAngle), c = math::cos(angle), s = math::sin(angle);
  const float x = at.x - .5f - p.UOffset, y = at.y - .5f - p.VOffset;
  Vec3 uv((c * x - s * y) * p.UScale + .5f, (s * x + c * y) * p.VScale + .5f, 0);
  const auto tile = [](float& t, bool wrap, bool mirror) {
    if (mirror) {
      t = 2 * t - std::floor(2 * t / 2) * 2;
      t = t > 1 ? 2 - t : t;
      return true;
    }
    return wrap || (t >= 0 && t <= 1);
  };
  if (!tile(uv.x, p.UWrap, p.UMirror) || !tile(uv.y, p.VWrap, p.VMirror)) return kMayaNowhere;
  return uv;
}

Vec3 place_of(ShaderRef coords, ShadingPoint& point) {
  if (coords.node && coords.node->spec().value) return coords.node->vector(point);
  return point.texture_spaces > 0 ? point.tex[0] : Vec3(0);
}

Rgba adjusted(const Output& p, const Rgba& from) {
  Rgb c = rgb(from);
  if (p.Invert) c = Rgb(1) - c;
  c = (c * p.RGBAmount + Rgb(p.RGBOffset)) * p.OutputAmount;
  if (p.Clamp) c = Rgb(clamp01(c.x), clamp01(c.y), clamp01(c.z));
  return Rgba(c.x, c.y, c.z, from.a);
}

/// A shader that only stores parameters for other shaders.
constexpr ShaderSpec kOutput = {
    .name = "max_base_Output",
    .library = "hosts",
    .apply = kApplyTexture,
    .doc = "Stand-in for the adjustment of the host's maps.",
    .params = kOutputRows,
    .params_size = sizeof(Output),
    .value = [](const Call&, void* result) { *static_cast<Rgba*>(result) = Rgba(0); },
    .fallback = {.is_fallback = true}};

void bitmap(const Call& call, void* result) {
  const auto& p = call.as<Bitmap>();
  auto& out = *static_cast<Rgba*>(result);
  out = Rgba(0);
  const Vec3 uv = place_of(p.Coords, call.point);
  if (p.Bitmap.texture && !is_nowhere(uv))
    out = p.Bitmap.texture->lookup(Vec2(uv.x, uv.y),
                                   p.Coords.node
                                       ? coordinate_footprint(*p.Coords.node, uv, call.point)
                                       : texture_footprint(call.point),
                                   call.point, {});
  const ShaderNode* output = p.Output.node;
  if (output && output->spec().params.data() == kOutput.params.data())
    output->with_params(call.point, [&](const Call& c) { out = adjusted(c.as<Output>(), out); });
}

Rgb one_of(const Rgba& color, ShaderRef map, bool on, ShadingPoint& point) {
  return rgb(on && map.node && map.node->spec().value ? map.node->color(point) : color);
}

void show(const Rgb& c, void* result) { *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, 1); }

void multiply(const Call& call, void* result) {
  const auto& p = call.as<Pair>();
  show(one_of(p.Color1, p.Map1, p.Map1Enabled, call.point) *
           one_of(p.Color2, p.Map2, p.Map2Enabled, call.point),
       result);
}

void mix(const Call& call, void* result) {
  const auto& p = call.as<Pair>();
  float t = p.MixAmount > 1 ? p.MixAmount / 100 : p.MixAmount;
  if (p.Mask.node && p.Mask.node->spec().value) t = p.Mask.node->scalar(call.point);
  show(one_of(p.Color1, p.Map1, p.Map1Enabled, call.point) * (1 - t) +
           one_of(p.Color2, p.Map2, p.Map2Enabled, call.point) * t,
       result);
}

void checker(const Call& call, void* result) {
  const auto& p = call.as<Pair>();
  const Vec3 uv = place_of(p.Coords, call.point);
  const bool first = (uv.x - std::floor(uv.x) < .5f) == (uv.y - std::floor(uv.y) < .5f);
  show(first ? one_of(p.Color1, p.Map1, p.Map1Enabled, call.point)
             : one_of(p.Color2, p.Map2, p.Map2Enabled, call.point),
       result);
}

void environment(const Call& call, void* result) {
  const auto& p = call.as<Environment>();
  const ShaderRef map = p.Map.node ? p.Map : p.Sky;
  *static_cast<Rgba*>(result) =
      map.node && map.node->spec().value ? map.node->color(call.point) : p.Color;
}

constexpr ShaderSpec map(const char* name, const char* doc, std::span<const ParamSpec> rows,
                         std::size_t size, void (*value)(const Call&, void*)) {
  return {.name = name,
          .library = "hosts",
          .apply = kApplyTexture | kApplyEnvironment,
          .doc = doc,
          .params = rows,
          .params_size = size,
          .value = value,
          .fallback = {.is_fallback = true}};
}

constexpr ShaderSpec kGenerator = [] {
  ShaderSpec spec = map("max_base_UVGenerator", "Stand-in for the coordinates of the host's maps.",
                        kGeneratorRows, sizeof(Generator), [](const Call& call, void* result) {
                          *static_cast<Vec3*>(result) = generated(call.as<Generator>(), call.point);
                        });
  spec.result = ParamType::Vector;
  spec.result_size = sizeof(Vec3);
  return spec;
}();
constexpr ShaderSpec kBitmap =
    map("max_Bitmap", "Stand-in for the host's bitmap.", kBitmapRows, sizeof(Bitmap), bitmap);
constexpr ShaderSpec kEnvironment = map("max_Environment", "Stand-in for the host's environment.",
                                        kEnvironmentRows, sizeof(Environment), environment);
constexpr ShaderSpec kBuffer = {
    .name = "max_base_GBuffer_lens",
    .library = "hosts",
    .apply = kApplyLens,
    .doc = "The host's buffers beside the picture: without effect.",
    .lens = {
        // A lens shader without rays is disabled.
        .bend_ray = [](const Call&, const Camera&, const Vec2&, Camera::Ray&) { return Rgb(1); },
        .ray_count = [](const ShaderNode&) { return 0; },
    },
    .fallback = {.is_fallback = true}};

constexpr ShaderSpec kNodes[] = {
    kBitmap,
    renamed(kBitmap, "adsk_bitmap"),
    kGenerator,
    renamed(kGenerator, "adsk_base_UVGenerator"),
    kOutput,
    map("max_Checker", "Stand-in for the host's checker.", kCheckerRows, sizeof(Pair), checker),
    map("max_Mix", "Stand-in for the host's mix.", kMixRows, sizeof(Pair), mix),
    map("max_RGBMultiplier", "Stand-in for the host's product of colours.", kPairRows, sizeof(Pair),
        multiply),
    kEnvironment,
    renamed(kEnvironment, "adsk_environment"),
    kBuffer,
    renamed(kBuffer, "max_base_GBuffer"),
};

}  // namespace

std::span<const ShaderSpec> max_textures() { return kNodes; }

}  // namespace oriel
