// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/fraction.h"
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
     .doc = "Number of the texture space, from 1."},
    {ORIEL_PARAM(Generator, UOffset), .doc = "Offset of the tile."},
    {ORIEL_PARAM(Generator, UScale), .fallback = {1}, .doc = "Tiles along u."},
    {ORIEL_PARAM(Generator, UWrap), .fallback = {1}, .doc = "Whether the tile repeats."},
    {ORIEL_PARAM(Generator, UMirror), .doc = "Whether every other tile is mirrored."},
    {ORIEL_PARAM(Generator, VOffset), .doc = "Offset of the tile."},
    {ORIEL_PARAM(Generator, VScale), .fallback = {1}, .doc = "Tiles along v."},
    {ORIEL_PARAM(Generator, VWrap), .fallback = {1}, .doc = "Whether the tile repeats."},
    {ORIEL_PARAM(Generator, VMirror), .doc = "Whether every other tile is mirrored."},
    {ORIEL_PARAM(Generator, WAngle), .unit = "radians", .doc = "Rotation of the tile."},
});
constexpr auto kOutputRows = about({
    {ORIEL_PARAM(Output, RGBAmount), .fallback = {1}, .doc = "Factor."},
    {ORIEL_PARAM(Output, RGBOffset), .doc = "Offset."},
    {ORIEL_PARAM(Output, OutputAmount), .fallback = {1}, .doc = "Factor of the result."},
    {ORIEL_PARAM(Output, Invert), .doc = "Whether the colour is inverted."},
    {ORIEL_PARAM(Output, Clamp), .doc = "Whether the result is clamped to 1."},
});
constexpr auto kBitmapRows = about({
    {ORIEL_PARAM(Bitmap, Bitmap), .doc = "Texture image."},
    {ORIEL_PARAM(Bitmap, Coords), .doc = "Coordinate generator."},
    {ORIEL_PARAM(Bitmap, Output), .doc = "Output adjustment."},
});
constexpr auto kPairRows = about({
    {ORIEL_PARAM(Pair, Color1), .doc = "First colour."},
    {ORIEL_PARAM(Pair, Color2), .fallback = {1, 1, 1}, .doc = "Second colour."},
    {ORIEL_PARAM(Pair, Map1), .doc = "Map of the first colour."},
    {ORIEL_PARAM(Pair, Map2), .doc = "Map of the second colour."},
    {ORIEL_PARAM(Pair, Map1Enabled), .fallback = {1},
     .doc = "Whether `preview` is mapped instead of rendering."},
    {ORIEL_PARAM(Pair, Map2Enabled), .fallback = {1},
     .doc = "Whether `preview` is mapped instead of rendering."},
});
constexpr auto kMixRows =
    joined(kPairRows, about({
                          {ORIEL_PARAM(Pair, MixAmount), .doc = "Weight of the second colour."},
                          {ORIEL_PARAM(Pair, Mask), .doc = "Map of MixAmount."},
                      }));
constexpr auto kCheckerRows =
    joined(kPairRows, about({{ORIEL_PARAM(Pair, Coords), .doc = "Coordinate generator."}}));
constexpr auto kEnvironmentRows = about({
    {ORIEL_PARAM(Environment, Color), .doc = "Environment colour."},
    {ORIEL_PARAM(Environment, Map), .doc = "Environment map."},
    {ORIEL_PARAM(Environment, Sky), .doc = "Sky shader, used without a map."},
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
    .doc = "Fallback for the output adjustment of 3ds Max maps.",
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
  const bool first = (fraction(uv.x) < .5f) == (fraction(uv.y) < .5f);
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
  ShaderSpec spec = map("max_base_UVGenerator", "Fallback for the coordinates of 3ds Max maps.",
                        kGeneratorRows, sizeof(Generator), [](const Call& call, void* result) {
                          *static_cast<Vec3*>(result) = generated(call.as<Generator>(), call.point);
                        });
  spec.result = ParamType::Vector;
  spec.result_size = sizeof(Vec3);
  return spec;
}();
constexpr ShaderSpec kBitmap =
    map("max_Bitmap", "Fallback for the bitmap of 3ds Max.", kBitmapRows, sizeof(Bitmap), bitmap);
constexpr ShaderSpec kEnvironment =
    map("max_Environment", "Fallback for the environment of 3ds Max.", kEnvironmentRows,
        sizeof(Environment), environment);
constexpr ShaderSpec kBuffer = {
    .name = "max_base_GBuffer_lens",
    .library = "hosts",
    .apply = kApplyLens,
    .doc = "Frame buffer shader of 3ds Max; no effect.",
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
    map("max_Checker", "Fallback for the checker map of 3ds Max.", kCheckerRows, sizeof(Pair),
        checker),
    map("max_Mix", "Fallback for the mix map of 3ds Max.", kMixRows, sizeof(Pair), mix),
    map("max_RGBMultiplier", "Fallback for the RGB multiply map of 3ds Max.", kPairRows,
        sizeof(Pair), multiply),
    kEnvironment,
    renamed(kEnvironment, "adsk_environment"),
    kBuffer,
    renamed(kBuffer, "max_base_GBuffer"),
};

}  // namespace

std::span<const ShaderSpec> max_textures() { return kNodes; }

}  // namespace oriel
