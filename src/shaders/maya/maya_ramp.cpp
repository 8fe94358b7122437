// SPDX-License-Identifier: Apache-2.0
// maya_ramp: see maya_texture.h.
#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "shaders/maya/maya_place.h"
#include "shaders/maya/maya_texture.h"
#include "shaders/maya/maya_utility.h"

namespace oriel {
namespace {

constexpr int kMaxEntries = 16;

struct Entry {
  float position;
  Rgba color;
};
struct Ramp {
  Vec3 uvCoord;
  int type, interpolation, count;
  Rgba colorGain, colorOffset, defaultColor;
  Entry entries[kMaxEntries];
};
struct Textured {
  Rgba outColor;
  float outAlpha;
};

/// The rows of one entry.
#define ORIEL_ENTRY(i)                                                                             \
  {.name = "colorEntryList[" #i "].position",                                                      \
   .type = ParamType::Scalar,                                                                      \
   .element = ParamType::Scalar,                                                                   \
   .offset = offsetof(Ramp, entries) + (i) * sizeof(Entry) + offsetof(Entry, position),            \
   .doc = "Position of the colour, 0..1."},                                                        \
  {                                                                                                \
    .name = "colorEntryList[" #i "].color", .type = ParamType::Color, .element = ParamType::Color, \
    .offset = offsetof(Ramp, entries) + (i) * sizeof(Entry) + offsetof(Entry, color),              \
    .doc = "Input colour."                                                                         \
  }
constexpr auto kRows = about({
    {ORIEL_PARAM(Ramp, uvCoord), .doc = "Texture coordinate, used if connected."},
    {ORIEL_PARAM(Ramp, type), .min = 0, .max = 8,
     .doc = "Ramp type: 0 along V, 1 along U, 2 diagonal, 3 radial, 4 circular, 5 box; "
            "other values as 0."},
    {ORIEL_PARAM(Ramp, interpolation), .fallback = {1}, .min = 0, .max = 6,
     .doc = "Interpolation: 0 none, 1 linear, 2 slow start, 3 slow end, 4 smooth; other "
            "values linear."},
    {ORIEL_PARAM(Ramp, colorGain), .fallback = {1, 1, 1}, .doc = "Colour factor."},
    {ORIEL_PARAM(Ramp, colorOffset), .doc = "Colour offset."},
    {ORIEL_PARAM(Ramp, defaultColor), .fallback = {.5f, .5f, .5f},
     .doc = "Colour outside the frame."},
    {.name = "colorEntryList[]",
     .type = ParamType::Integer,
     .element = ParamType::Integer,
     .offset = offsetof(Ramp, count),
     .doc = "Number of colours."},
    ORIEL_ENTRY(0),
    ORIEL_ENTRY(1),
    ORIEL_ENTRY(2),
    ORIEL_ENTRY(3),
    ORIEL_ENTRY(4),
    ORIEL_ENTRY(5),
    ORIEL_ENTRY(6),
    ORIEL_ENTRY(7),
    ORIEL_ENTRY(8),
    ORIEL_ENTRY(9),
    ORIEL_ENTRY(10),
    ORIEL_ENTRY(11),
    ORIEL_ENTRY(12),
    ORIEL_ENTRY(13),
    ORIEL_ENTRY(14),
    ORIEL_ENTRY(15),
});
#undef ORIEL_ENTRY
constexpr ParamSpec kResults[] = {
    {ORIEL_PARAM(Textured, outColor), .doc = "Colour."},
    {ORIEL_PARAM(Textured, outAlpha), .doc = "Alpha: the luminance of the colour."},
};

/// 0..1 in each tile; the end of the first tile is 1.
float in_tile(float x) {
  const float whole = std::floor(x);
  return x == whole && x > 0 ? 1 : x - whole;
}

float along(int type, const Vec3& uv) {
  const float u = in_tile(uv.x), v = in_tile(uv.y), x = u - .5f, y = v - .5f;
  switch (type) {
    case 1:
      return u;
    case 2:
      return (u + v) / 2;
    case 3:
      return .5f + math::atan2(y, x) / kTwoPi;
    case 4:
      return std::min(1.0f, std::sqrt(2 * (x * x + y * y)));
    case 5:
      return 2 * std::max(std::abs(x), std::abs(y));
    default:
      return v;
  }
}

float eased(int interpolation, float t) {
  switch (interpolation) {
    case 0:
      return 0;
    case 2:
      return t * t;
    case 3:
      return 1 - sqr(1 - t);
    case 4:
      return t * t * (3 - 2 * t);
    default:
      return t;
  }
}

/// Entries may be unsorted.
Rgb colour_at(const Ramp& p, float t) {
  const Entry *below = nullptr, *above = nullptr;
  for (int i = 0; i < std::min(p.count, kMaxEntries); ++i) {
    const Entry& e = p.entries[i];
    if (e.position <= t && (!below || e.position > below->position)) below = &e;
    if (e.position > t && (!above || e.position < above->position)) above = &e;
  }
  if (!below && !above) return rgb(p.defaultColor);
  if (!below) return rgb(above->color);
  if (!above) return rgb(below->color);
  const float share =
      eased(p.interpolation, (t - below->position) / (above->position - below->position));
  return rgb(below->color) * (1 - share) + rgb(above->color) * share;
}

}  // namespace

const ShaderSpec kMayaRamp = {
    .name = "maya_ramp",
    .library = "hosts",
    .apply = kApplyTexture,
    .doc = "Fallback for Maya's ramp.",
    .params = kRows,
    .params_size = sizeof(Ramp),
    .result = ParamType::Struct,
    .results = kResults,
    .result_size = sizeof(Textured),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<Ramp>();
          const Vec3 uv = coordinate(call, offsetof(Ramp, uvCoord), p.uvCoord);
          const Rgb found = is_nowhere(uv) ? rgb(p.defaultColor) : colour_at(p, along(p.type, uv));
          const Rgb c = found * rgb(p.colorGain) + rgb(p.colorOffset);
          const float alpha = maya_luminance(c);
          *static_cast<Textured*>(result) = {Rgba(c.x, c.y, c.z, 1), alpha};
        },
    .fallback = {.is_fallback = true},
};

}  // namespace oriel
