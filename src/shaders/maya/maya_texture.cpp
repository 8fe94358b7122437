// SPDX-License-Identifier: Apache-2.0
#include "shaders/maya/maya_texture.h"

#include <algorithm>
#include <cmath>

#include "base/fraction.h"
#include "base/math.h"
#include "runtime/bump.h"
#include "runtime/texture_node.h"
#include "sampling/gradient_noise.h"
#include "shaders/maya/maya_place.h"
#include "shaders/maya/maya_utility.h"

namespace oriel {
namespace {

struct Placed {
  Vec3 outUV, outUvFilterSize;
  MayaPlace place;
};
/// Colour adjustment common to all textures.
struct Balance {
  bool invert, alphaIsLuminance;
  Rgba colorGain, colorOffset;
  float alphaGain, alphaOffset;
  Rgba defaultColor;
};
struct File {
  MayaPlace place;  // first, because its rows are shared
  ColorTextureRef fileTextureName;
  Balance balance;
};
struct Pattern {
  Vec3 uvCoord;
  Balance balance;
  Rgba color1, color2;
  float contrast;
  float threshold, amplitude, ratio, frequencyRatio, frequency;
  int depthMax, levelMax;
};
struct Textured {
  Rgba outColor;
  float outAlpha;
  Rgba outTransparency;
};
struct Bump {
  float bumpValue, bumpDepth;
  Vec3 normalCamera;
};

constexpr ParamSpec kTexturedResults[] = {
    {ORIEL_PARAM(Textured, outColor), .doc = "Colour."},
    {ORIEL_PARAM(Textured, outAlpha), .doc = "Alpha."},
    {ORIEL_PARAM(Textured, outTransparency), .doc = "Whether alpha is inverted."},
};

/// The rows of `balance` in S.
#define ORIEL_BALANCE_ROW(S, member)                                              \
  .name = #member, .type = detail::ParamTypeOf<decltype(Balance::member)>::value, \
  .element = detail::element_type<decltype(Balance::member)>(),                   \
  .offset = offsetof(S, balance) + offsetof(Balance, member)
#define ORIEL_BALANCE_ROWS(S)                                                            \
  {ORIEL_BALANCE_ROW(S, invert), .doc = "Whether the colour is inverted."},              \
      {ORIEL_BALANCE_ROW(S, alphaIsLuminance),                                           \
       .doc = "Whether alpha is the luminance of the colour."},                          \
      {ORIEL_BALANCE_ROW(S, colorGain), .fallback = {1, 1, 1}, .doc = "Colour factor."}, \
      {ORIEL_BALANCE_ROW(S, colorOffset), .doc = "Colour offset."},                      \
      {ORIEL_BALANCE_ROW(S, alphaGain), .fallback = {1}, .doc = "Alpha factor."},        \
      {ORIEL_BALANCE_ROW(S, alphaOffset), .doc = "Alpha offset."}, {                     \
    ORIEL_BALANCE_ROW(S, defaultColor), .fallback = {.5f, .5f, .5f},                     \
                                        .doc = "Colour outside the frame."               \
  }

constexpr ParamSpec kPlacedResults[] = {
    {ORIEL_PARAM(Placed, outUV), .doc = "Texture coordinate."},
    {ORIEL_PARAM(Placed, outUvFilterSize),
     .doc = "Filter size; ignored, textures compute their footprint."},
};
/// Results with the names of the parameters.
constexpr auto kAllPlacedResults = [] {
  auto own = kMayaPlaceRows;
  for (ParamSpec& row : own) row.offset += offsetof(Placed, place);
  return joined(std::array{kPlacedResults[0], kPlacedResults[1]}, own);
}();
constexpr auto kFileRows =
    joined(kMayaPlaceRows, about({
                               {ORIEL_PARAM(File, fileTextureName), .doc = "Texture image."},
                               ORIEL_BALANCE_ROWS(File),
                           }));
constexpr auto kPatternRows = about({
    {ORIEL_PARAM(Pattern, uvCoord), .doc = "Texture coordinate, used if connected."},
    ORIEL_BALANCE_ROWS(Pattern),
});
constexpr auto kCheckerRows =
    joined(kPatternRows, about({
                             {ORIEL_PARAM(Pattern, color1), .fallback = {1, 1, 1},
                              .doc = "Colour of the lower left and upper right fields."},
                             {ORIEL_PARAM(Pattern, color2), .doc = "Colour of the other fields."},
                             {ORIEL_PARAM(Pattern, contrast), .fallback = {1}, .min = 0, .max = 1,
                              .doc = "Contrast; 0 = the mean of the colours."},
                         }));
constexpr auto kGrainRows = joined(
    kPatternRows,
    about({
        {ORIEL_PARAM(Pattern, threshold), .doc = "Noise offset."},
        {ORIEL_PARAM(Pattern, ratio), .fallback = {.707f}, .doc = "Amplitude ratio per octave."},
        {ORIEL_PARAM(Pattern, frequencyRatio), .fallback = {2},
         .doc = "Frequency ratio per octave."},
        {ORIEL_PARAM(Pattern, frequency), .fallback = {8}, .doc = "Noise frequency."},
    }));
constexpr auto kNoiseRows =
    joined(kGrainRows, about({
                           {ORIEL_PARAM(Pattern, amplitude), .fallback = {1},
                            .doc = "Contrast of the noise about its mean."},
                           {ORIEL_PARAM(Pattern, depthMax), .fallback = {3}, .min = 1, .max = 9,
                            .doc = "Number of octaves."},
                       }));
constexpr auto kFractalRows = joined(
    kGrainRows, about({
                    {ORIEL_PARAM(Pattern, amplitude), .fallback = {1}, .doc = "Noise amplitude."},
                    {ORIEL_PARAM(Pattern, levelMax), .fallback = {9}, .min = 1, .max = 9,
                     .doc = "Number of octaves."},
                }));
#undef ORIEL_BALANCE_ROW
#undef ORIEL_BALANCE_ROWS
constexpr auto kBumpRows = about({
    {ORIEL_PARAM(Bump, bumpValue), .doc = "Displacement height."},
    {ORIEL_PARAM(Bump, bumpDepth), .fallback = {1}, .unit = "scene units", .doc = "Height factor."},
    {ORIEL_PARAM(Bump, normalCamera),
     .doc = "Normal of another connected bump node, in camera space; a constant value is "
            "ignored."},
});

Vec3 turned(const Vec3& uv, float angle) {
  const float c = math::cos(angle), s = math::sin(angle), x = uv.x - .5f, y = uv.y - .5f;
  return Vec3(.5f + c * x - s * y, .5f + s * x + c * y, uv.z);
}

Textured balanced(const Balance& b, const Rgba& texel) {
  Rgb c = b.invert ? Rgb(1) - rgb(texel) : rgb(texel);
  c = c * rgb(b.colorGain) + rgb(b.colorOffset);
  const float alpha =
      (b.alphaIsLuminance ? maya_luminance(c) : texel.a) * b.alphaGain + b.alphaOffset;
  return {Rgba(c.x, c.y, c.z, alpha), alpha, Rgba(1 - alpha, 1 - alpha, 1 - alpha, 1)};
}

Textured outside(const Balance& b) {
  const Rgba& c = b.defaultColor;
  return {c, 0, Rgba(1, 1, 1, 1)};
}

void file(const Call& call, void* result) {
  const auto& p = call.as<File>();
  auto& out = *static_cast<Textured*>(result);
  constexpr std::size_t kCoord = offsetof(MayaPlace, uvCoord);
  const Vec3 surface = coordinate(call, kCoord, p.place.uvCoord);
  const ShaderNode* source = call.node ? call.node->source(kCoord) : nullptr;
  const Vec3 uv = source ? surface : placed(p.place, surface);
  if (is_nowhere(uv)) {
    out = outside(p.balance);
    return;
  }
  Rgba texel(.5f, .5f, .5f, 1);
  if (p.fileTextureName.texture) {
    Vec2 tiles(1, 1);
    if (!source)
      tiles = tiles_of(p.place);
    else if (&source->spec() == &kMayaPlace2dtex)
      tiles = tiles_of(source->constants<MayaPlace>());
    TextureFootprint print = texture_footprint(call.point);
    print.dx = Vec2(print.dx.x * tiles.x, print.dx.y * tiles.y);
    print.dy = Vec2(print.dy.x * tiles.x, print.dy.y * tiles.y);
    texel = p.fileTextureName.texture->lookup(Vec2(uv.x, uv.y), print, call.point, {});
  }
  out = balanced(p.balance, texel);
}

void checker(const Call& call, void* result) {
  const auto& p = call.as<Pattern>();
  const Vec3 uv = coordinate(call, offsetof(Pattern, uvCoord), p.uvCoord);
  auto& out = *static_cast<Textured*>(result);
  if (is_nowhere(uv)) {
    out = outside(p.balance);
    return;
  }
  const bool first = (fraction(uv.x) < .5f) == (fraction(uv.y) < .5f);
  const float share = .5f + (first ? .5f : -.5f) * clamp01(p.contrast);
  const Rgb c = rgb(p.color1) * share + rgb(p.color2) * (1 - share);
  // Alpha is the mask of the fields.
  out = balanced(p.balance, Rgba(c.x, c.y, c.z, share));
}

/// `about_mean`: the amplitude scales the deviation from the mean instead of the value.
void noise(const Call& call, void* result, int sizes, bool about_mean) {
  const auto& p = call.as<Pattern>();
  const Vec3 uv = coordinate(call, offsetof(Pattern, uvCoord), p.uvCoord);
  auto& out = *static_cast<Textured*>(result);
  if (is_nowhere(uv)) {
    out = outside(p.balance);
    return;
  }
  float sum = 0, weights = 0, weight = 1;
  Vec3 at(uv.x * p.frequency, uv.y * p.frequency, .5f);
  for (int k = 0; k < std::clamp(sizes, 1, 9); ++k) {
    sum += weight * sampling::gradient_noise(at);
    weights += weight;
    weight *= clamp(p.ratio, 0, 1);
    at *= clamp(p.frequencyRatio, 1, 16);
  }
  const float mean = about_mean ? .5f : .5f * p.amplitude;
  const float value = clamp01(p.threshold + mean + p.amplitude * sum / weights);
  out = balanced(p.balance, Rgba(value, value, value, value));
}

/// Height difference per step of uv; the point moves with uv.
float slope(const Call& call, const Vec2& step) {
  const auto height = [&](float way) {
    ShadingPoint at = call.point;
    for (int i = 0; i < at.texture_spaces; ++i) at.tex[i] += Vec3(step.x * way, step.y * way, 0);
    at.position += (at.dpdu * step.x + at.dpdv * step.y) * way;
    return call.node->with_params(at, [](const Call& c) { return c.as<Bump>().bumpValue; });
  };
  return (height(.5f) - height(-.5f)) / (step.x + step.y);
}

void bump(const Call& call, void* result) {
  /// Limits of the uv step: finer than a texel, coarser than rounding errors.
  constexpr float kMinStep = 5e-4f, kMaxStep = 1e-2f;
  constexpr int kSetInCameraSpace = 8;
  const auto& p = call.as<Bump>();
  const ShadingPoint& point = call.point;
  const bool on_another = call.node && call.node->connected(offsetof(Bump, normalCamera));
  const Vec3 from = on_another ? bump_normal(point, point.normal, p.normalCamera, kSetInCameraSpace)
                               : point.normal;
  Vec3 to = from;
  const Vec3 front = point.back_side ? -from : from;
  const float volume = dot(front, cross(point.dpdu, point.dpdv));
  const bool varies = call.node && call.node->connected(offsetof(Bump, bumpValue));
  if (varies && volume != 0 && p.bumpDepth != 0) {
    const TextureFootprint print = texture_footprint(point);
    const float step =
        clamp(std::max(math::hypot(print.dx.x, print.dx.y), math::hypot(print.dy.x, print.dy.y)),
              kMinStep, kMaxStep);
    const float u = slope(call, Vec2(step, 0)), v = slope(call, Vec2(0, step));
    const Vec3 gradient =
        (cross(point.dpdv, front) * u + cross(front, point.dpdu) * v) * (p.bumpDepth / volume);
    to = normalize(front - gradient);
    if (point.back_side) to = -to;
  }
  *static_cast<Vec3*>(result) = bump_vector(point, point.normal, to, kSetInCameraSpace);
}

constexpr ShaderSpec texture(const char* name, const char* doc, std::span<const ParamSpec> rows,
                             std::size_t size, void (*value)(const Call&, void*)) {
  return {
      .name = name,
      .library = "hosts",
      .apply = kApplyTexture,
      .doc = doc,
      .params = rows,
      .params_size = size,
      .result = ParamType::Struct,
      .results = kTexturedResults,
      .result_size = sizeof(Textured),
      .value = value,
      .fallback = {.is_fallback = true},
  };
}

}  // namespace

Vec3 placed(const MayaPlace& p, const Vec3& surface) {
  Vec3 uv = surface;
  if (p.noiseUV.x != 0 || p.noiseUV.y != 0) {
    /// Periods of the wobble along the texture: a guess.
    constexpr float kWobbles = 18;
    const Vec3 at(surface.x * kWobbles, surface.y * kWobbles, 0);
    uv.x += p.noiseUV.x * sampling::gradient_noise(at + Vec3(0, 0, .5f));
    uv.y += p.noiseUV.y * sampling::gradient_noise(at + Vec3(0, 0, 1.5f));
  }
  if (p.rotateFrame != 0) uv = turned(uv, angle_of(p.rotateFrame));
  uv = uv - p.translateFrame;
  const auto in_frame = [](float& x, float coverage, bool wrap) {
    // Includes the border of the frame in spite of rounding.
    constexpr float kRim = 1e-5f;
    if (!wrap) return x >= -kRim && x <= coverage + kRim;
    if (coverage >= 1) return true;
    x = fraction(x);
    return x <= coverage + kRim;
  };
  if (!in_frame(uv.x, p.coverage.x, p.wrapU) || !in_frame(uv.y, p.coverage.y, p.wrapV))
    return kMayaNowhere;
  if (p.coverage.x > 0) uv.x /= p.coverage.x;
  if (p.coverage.y > 0) uv.y /= p.coverage.y;
  uv.x = uv.x * p.repeatUV.x + p.offset.x;
  uv.y = uv.y * p.repeatUV.y + p.offset.y;
  const auto odd = [](float x) { return std::fmod(std::floor(x), 2.0f) != 0; };
  const auto mirror = [](float& x) { x = 2 * std::floor(x) + 1 - x; };
  if (odd(uv.y)) {
    if (p.stagger) uv.x += .5f;
    if (p.mirrorV) mirror(uv.y);
  }
  if (p.mirrorU && odd(uv.x)) mirror(uv.x);
  if (p.rotateUV != 0) uv = turned(uv, angle_of(p.rotateUV));
  return uv;
}

const ShaderSpec kMayaPlace2dtex = {
    .name = "maya_place2dtex",
    .library = "hosts",
    .apply = kApplyTexture,
    .doc = "Fallback for Maya's place2dTexture.",
    .params = kMayaPlaceRows,
    .params_size = sizeof(MayaPlace),
    .result = ParamType::Struct,
    .results = kAllPlacedResults,
    .result_size = sizeof(Placed),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<MayaPlace>();
          const Vec3 uv = coordinate(call, offsetof(MayaPlace, uvCoord), p.uvCoord);
          *static_cast<Placed*>(result) = {placed(p, uv), Vec3(0), p};
        },
    .fallback = {.is_fallback = true, .aliases = "maya_place2dtexture"},
};

const ShaderSpec kMayaFile =
    texture("maya_file", "Fallback for Maya's file texture.", kFileRows, sizeof(File), file);
const ShaderSpec kMayaChecker = texture("maya_checker", "Fallback for the checker map of 3ds Max.",
                                        kCheckerRows, sizeof(Pattern), checker);
const ShaderSpec kMayaNoise = texture(
    "maya_noise", "Fallback for Maya's noise, with a different pattern.", kNoiseRows,
    sizeof(Pattern),
    [](const Call& call, void* result) { noise(call, result, call.as<Pattern>().depthMax, true); });
const ShaderSpec kMayaFractal =
    texture("maya_fractal", "Fallback for Maya's fractal, with a different pattern.", kFractalRows,
            sizeof(Pattern), [](const Call& call, void* result) {
              noise(call, result, call.as<Pattern>().levelMax, false);
            });

const ShaderSpec kMayaBump2d = {
    .name = "maya_bump2d",
    .library = "hosts",
    .apply = kApplyTexture,
    .doc = "Fallback for Maya's bump2d.",
    .params = kBumpRows,
    .params_size = sizeof(Bump),
    .result = ParamType::Vector,
    .result_size = sizeof(Vec3),
    .value = bump,
    .binding = {.evaluations = 5},
    .fallback = {.is_fallback = true},
};

}  // namespace oriel
