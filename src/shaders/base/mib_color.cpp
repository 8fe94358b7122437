// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_color.h"

#include <algorithm>

#include "color/black_body.h"
#include "color/cie_daylight.h"
#include "color/luminance.h"
#include "runtime/shade_input.h"

namespace oriel {
namespace {

constexpr int kMax = 8;  ///< colours and layers

struct Grey {
  Rgba input;
  float factor;
};
struct Interpolate {
  float input;
  int num;
  float weight_1, weight_2, weight_3, weight_4, weight_5, weight_6;
  Rgba color_0, color_1, color_2, color_3, color_4, color_5, color_6, color_7;
};
struct Mix {
  int num;
  int mode_0, mode_1, mode_2, mode_3, mode_4, mode_5, mode_6, mode_7;
  float weight_0, weight_1, weight_2, weight_3, weight_4, weight_5, weight_6, weight_7;
  Rgba color_0, color_1, color_2, color_3, color_4, color_5, color_6, color_7;
  Rgba color_base;
};
struct Spread {
  Rgba input;
  int num;
  int mode_0, mode_1, mode_2, mode_3, mode_4, mode_5, mode_6, mode_7;
  Rgba weight_0, weight_1, weight_2, weight_3, weight_4, weight_5, weight_6, weight_7;
};
struct SpreadOut {
  Rgba out_0, out_1, out_2, out_3, out_4, out_5, out_6, out_7;
};
struct Temperature {
  float temperature, intensity;
};

constexpr ParamSpec kGreyRows[] = {
    {ORIEL_PARAM(Grey, input), .doc = "Input colour.", .declared_default = false},
    {ORIEL_PARAM(Grey, factor), .doc = "Factor; 0 = black.", .declared_default = false},
};
constexpr ParamSpec kInterpolateRows[] = {
    {ORIEL_PARAM(Interpolate, input), .doc = "Position of the look-up; clamped to 0..1.",
     .declared_default = false},
    {ORIEL_PARAM(Interpolate, num), .min = 1, .max = 8, .doc = "Number of colours in use.",
     .declared_default = false},
    {ORIEL_PARAM(Interpolate, weight_1), .doc = "Position of color_1 in 0..1; positions ascend.",
     .declared_default = false},
    {ORIEL_PARAM(Interpolate, weight_2), .doc = "Position of color_2 in 0..1; positions ascend.",
     .declared_default = false},
    {ORIEL_PARAM(Interpolate, weight_3), .doc = "Position of color_3 in 0..1; positions ascend.",
     .declared_default = false},
    {ORIEL_PARAM(Interpolate, weight_4), .doc = "Position of color_4 in 0..1; positions ascend.",
     .declared_default = false},
    {ORIEL_PARAM(Interpolate, weight_5), .doc = "Position of color_5 in 0..1; positions ascend.",
     .declared_default = false},
    {ORIEL_PARAM(Interpolate, weight_6), .doc = "Position of color_6 in 0..1; positions ascend.",
     .declared_default = false},
    {ORIEL_PARAM(Interpolate, color_0), .doc = "Colour at 0.", .declared_default = false},
    {ORIEL_PARAM(Interpolate, color_1),
     .doc = "Colour at weight_1; the last colour in use is at 1.", .declared_default = false},
    {ORIEL_PARAM(Interpolate, color_2),
     .doc = "Colour at weight_2; the last colour in use is at 1.", .declared_default = false},
    {ORIEL_PARAM(Interpolate, color_3),
     .doc = "Colour at weight_3; the last colour in use is at 1.", .declared_default = false},
    {ORIEL_PARAM(Interpolate, color_4),
     .doc = "Colour at weight_4; the last colour in use is at 1.", .declared_default = false},
    {ORIEL_PARAM(Interpolate, color_5),
     .doc = "Colour at weight_5; the last colour in use is at 1.", .declared_default = false},
    {ORIEL_PARAM(Interpolate, color_6),
     .doc = "Colour at weight_6; the last colour in use is at 1.", .declared_default = false},
    {ORIEL_PARAM(Interpolate, color_7), .doc = "Colour at 1.", .declared_default = false},
};
constexpr const char* kMixMode =
    "Layer operation: 0 blend, 1 mix, 2 add, 3 add and clamp, 4 multiply, 5 "
    "multiply and clamp, 6 replace alpha.";
constexpr const char* kSpreadMode =
    "Output mode: 0 the colour; as grey: 1 alpha, 2 mean, 3 intensity, 4 red "
    "channel.";
constexpr ParamSpec kMixRows[] = {
    {ORIEL_PARAM(Mix, num), .min = 0, .max = 8, .doc = "Number of layers in use.",
     .declared_default = false},
    {ORIEL_PARAM(Mix, mode_0), .min = 0, .max = 6, .doc = kMixMode, .declared_default = false},
    {ORIEL_PARAM(Mix, mode_1), .min = 0, .max = 6, .doc = kMixMode, .declared_default = false},
    {ORIEL_PARAM(Mix, mode_2), .min = 0, .max = 6, .doc = kMixMode, .declared_default = false},
    {ORIEL_PARAM(Mix, mode_3), .min = 0, .max = 6, .doc = kMixMode, .declared_default = false},
    {ORIEL_PARAM(Mix, mode_4), .min = 0, .max = 6, .doc = kMixMode, .declared_default = false},
    {ORIEL_PARAM(Mix, mode_5), .min = 0, .max = 6, .doc = kMixMode, .declared_default = false},
    {ORIEL_PARAM(Mix, mode_6), .min = 0, .max = 6, .doc = kMixMode, .declared_default = false},
    {ORIEL_PARAM(Mix, mode_7), .min = 0, .max = 6, .doc = kMixMode, .declared_default = false},
    {ORIEL_PARAM(Mix, weight_0), .doc = "Weight of the layer.", .declared_default = false},
    {ORIEL_PARAM(Mix, weight_1), .doc = "Weight of the layer.", .declared_default = false},
    {ORIEL_PARAM(Mix, weight_2), .doc = "Weight of the layer.", .declared_default = false},
    {ORIEL_PARAM(Mix, weight_3), .doc = "Weight of the layer.", .declared_default = false},
    {ORIEL_PARAM(Mix, weight_4), .doc = "Weight of the layer.", .declared_default = false},
    {ORIEL_PARAM(Mix, weight_5), .doc = "Weight of the layer.", .declared_default = false},
    {ORIEL_PARAM(Mix, weight_6), .doc = "Weight of the layer.", .declared_default = false},
    {ORIEL_PARAM(Mix, weight_7), .doc = "Weight of the layer.", .declared_default = false},
    {ORIEL_PARAM(Mix, color_0), .doc = "Colour of the layer.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Mix, color_1), .doc = "Colour of the layer.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Mix, color_2), .doc = "Colour of the layer.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Mix, color_3), .doc = "Colour of the layer.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Mix, color_4), .doc = "Colour of the layer.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Mix, color_5), .doc = "Colour of the layer.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Mix, color_6), .doc = "Colour of the layer.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Mix, color_7), .doc = "Colour of the layer.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Mix, color_base), .doc = "Colour below all layers; transparent black if omitted.",
     .declared_default = false, .takes_material = true},
};
constexpr ParamSpec kSpreadRows[] = {
    {ORIEL_PARAM(Spread, input), .doc = "Input colour.", .declared_default = false},
    {ORIEL_PARAM(Spread, num), .min = 1, .max = 8, .doc = "Number of outputs in use.",
     .declared_default = false},
    {ORIEL_PARAM(Spread, mode_0), .min = 0, .max = 4, .doc = kSpreadMode,
     .declared_default = false},
    {ORIEL_PARAM(Spread, mode_1), .min = 0, .max = 4, .doc = kSpreadMode,
     .declared_default = false},
    {ORIEL_PARAM(Spread, mode_2), .min = 0, .max = 4, .doc = kSpreadMode,
     .declared_default = false},
    {ORIEL_PARAM(Spread, mode_3), .min = 0, .max = 4, .doc = kSpreadMode,
     .declared_default = false},
    {ORIEL_PARAM(Spread, mode_4), .min = 0, .max = 4, .doc = kSpreadMode,
     .declared_default = false},
    {ORIEL_PARAM(Spread, mode_5), .min = 0, .max = 4, .doc = kSpreadMode,
     .declared_default = false},
    {ORIEL_PARAM(Spread, mode_6), .min = 0, .max = 4, .doc = kSpreadMode,
     .declared_default = false},
    {ORIEL_PARAM(Spread, mode_7), .min = 0, .max = 4, .doc = kSpreadMode,
     .declared_default = false},
    {ORIEL_PARAM(Spread, weight_0), .doc = "Factor of the output.", .declared_default = false},
    {ORIEL_PARAM(Spread, weight_1), .doc = "Factor of the output.", .declared_default = false},
    {ORIEL_PARAM(Spread, weight_2), .doc = "Factor of the output.", .declared_default = false},
    {ORIEL_PARAM(Spread, weight_3), .doc = "Factor of the output.", .declared_default = false},
    {ORIEL_PARAM(Spread, weight_4), .doc = "Factor of the output.", .declared_default = false},
    {ORIEL_PARAM(Spread, weight_5), .doc = "Factor of the output.", .declared_default = false},
    {ORIEL_PARAM(Spread, weight_6), .doc = "Factor of the output.", .declared_default = false},
    {ORIEL_PARAM(Spread, weight_7), .doc = "Factor of the output.", .declared_default = false},
};
constexpr ParamSpec kSpreadResults[] = {
    {ORIEL_PARAM(SpreadOut, out_0)}, {ORIEL_PARAM(SpreadOut, out_1)},
    {ORIEL_PARAM(SpreadOut, out_2)}, {ORIEL_PARAM(SpreadOut, out_3)},
    {ORIEL_PARAM(SpreadOut, out_4)}, {ORIEL_PARAM(SpreadOut, out_5)},
    {ORIEL_PARAM(SpreadOut, out_6)}, {ORIEL_PARAM(SpreadOut, out_7)},
};
constexpr ParamSpec kTemperatureRows[] = {
    {ORIEL_PARAM(Temperature, temperature), .unit = "K", .doc = "Colour temperature.",
     .declared_default = false},
    {ORIEL_PARAM(Temperature, intensity), .doc = "Luminance of the result.",
     .declared_default = false},
};

constexpr float Interpolate::*kInterpolateWeights[] = {
    &Interpolate::weight_1, &Interpolate::weight_2, &Interpolate::weight_3,
    &Interpolate::weight_4, &Interpolate::weight_5, &Interpolate::weight_6};
constexpr Rgba Interpolate::*kInterpolateColors[] = {
    &Interpolate::color_0, &Interpolate::color_1, &Interpolate::color_2, &Interpolate::color_3,
    &Interpolate::color_4, &Interpolate::color_5, &Interpolate::color_6, &Interpolate::color_7};
constexpr int Mix::*kMixModes[] = {&Mix::mode_0, &Mix::mode_1, &Mix::mode_2, &Mix::mode_3,
                                   &Mix::mode_4, &Mix::mode_5, &Mix::mode_6, &Mix::mode_7};
constexpr float Mix::*kMixWeights[] = {&Mix::weight_0, &Mix::weight_1, &Mix::weight_2,
                                       &Mix::weight_3, &Mix::weight_4, &Mix::weight_5,
                                       &Mix::weight_6, &Mix::weight_7};
constexpr Rgba Mix::*kMixColors[] = {&Mix::color_0, &Mix::color_1, &Mix::color_2, &Mix::color_3,
                                     &Mix::color_4, &Mix::color_5, &Mix::color_6, &Mix::color_7};
constexpr int Spread::*kSpreadModes[] = {&Spread::mode_0, &Spread::mode_1, &Spread::mode_2,
                                         &Spread::mode_3, &Spread::mode_4, &Spread::mode_5,
                                         &Spread::mode_6, &Spread::mode_7};
constexpr Rgba Spread::*kSpreadWeights[] = {&Spread::weight_0, &Spread::weight_1, &Spread::weight_2,
                                            &Spread::weight_3, &Spread::weight_4, &Spread::weight_5,
                                            &Spread::weight_6, &Spread::weight_7};
constexpr Rgba SpreadOut::*kOuts[] = {&SpreadOut::out_0, &SpreadOut::out_1, &SpreadOut::out_2,
                                      &SpreadOut::out_3, &SpreadOut::out_4, &SpreadOut::out_5,
                                      &SpreadOut::out_6, &SpreadOut::out_7};

float mean(const Rgba& c) { return (c.r + c.g + c.b) / 3; }
float intensity(const Rgba& c) { return luminance(rgb(c), kNtscLuminance); }

template <float (*kValue)(const Rgba&)>
void grey(const Call& call, void* result) {
  const auto& p = call.as<Grey>();
  *static_cast<Rgba*>(result) = Rgba(p.factor == 0 ? 0.0f : kValue(p.input) * p.factor);
}

void interpolate(const Call& call, void* result) {
  const auto& p = call.as<Interpolate>();
  auto& out = *static_cast<Rgba*>(result);
  const int last = std::clamp(p.num, 1, kMax) - 1;
  const float x = clamp01(p.input);
  float from = 0;
  for (int i = 1; i <= last; ++i) {
    const float to = i == last ? 1.0f : p.*kInterpolateWeights[i - 1];
    if (x <= to) {
      const Rgba &a = p.*kInterpolateColors[i - 1], &b = p.*kInterpolateColors[i];
      out = a + (b - a) * (to > from ? clamp01((x - from) / (to - from)) : 1.0f);
      return;
    }
    from = to;
  }
  out = p.*kInterpolateColors[last];
}

Rgba bounded(const Rgba& c) { return Rgba(clamp01(c.r), clamp01(c.g), clamp01(c.b), clamp01(c.a)); }

Rgba with_layer(const Rgba& a, const Rgba& b, float w, int mode) {
  switch (mode) {
    case 0:
      return a * (1 - b.a * w) + b * w;
    case 1:
      return a * (1 - w) + b * w;
    case 2:
      return a + b * w;
    case 3:
      return bounded(a + b * w);
    case 4:
      return a * b * w;
    case 5:
      return bounded(a * b * w);
    case 6:
      return Rgba(a.r, a.g, a.b, b.a);
    default:
      return a;
  }
}

void mix(const Call& call, void* result) {
  const auto& p = call.as<Mix>();
  Rgba c = p.color_base;
  for (int i = 0; i < std::clamp(p.num, 0, kMax); ++i)
    c = with_layer(c, p.*kMixColors[i], p.*kMixWeights[i], p.*kMixModes[i]);
  *static_cast<Rgba*>(result) = c;
}

/// Same if some layers are materials, which are opaque. Closures cannot be multiplied with each
/// other or clamped: modes 3 and 5 act as 2 and 4, and multiplying by a material has no effect.
void mix_materials(const Call& call, Closure& closure) {
  const auto& p = call.as<Mix>();
  if (!call.node || call.node->material_inputs().empty()) {
    Rgba plain;
    mix(call, &plain);
    closure.emission += rgb(plain);
    return;
  }
  shade_input(call, offsetof(Mix, color_base), p.color_base, Rgb(1), closure);
  for (int i = 0; i < std::clamp(p.num, 0, kMax); ++i) {
    const std::size_t offset = offsetof(Mix, color_0) + static_cast<std::size_t>(i) * sizeof(Rgba);
    const Rgba& color = p.*kMixColors[i];
    const float w = std::max(0.0f, p.*kMixWeights[i]);
    const bool is_material = call.node->material_input(offset) != nullptr;
    const int mode = p.*kMixModes[i];
    if (mode == 0 || mode == 1) {
      const float covered = mode == 0 && !is_material ? color.a * w : w;
      scale(closure, Rgb(std::max(0.0f, 1 - covered)));
    }
    if (mode >= 0 && mode <= 3) shade_input(call, offset, color, Rgb(w), closure);
    if ((mode == 4 || mode == 5) && !is_material) scale(closure, rgb(color) * w);
  }
}

Rgba converted(const Rgba& c, int mode) {
  switch (mode) {
    case 1:
      return Rgba(c.a);
    case 2:
      return Rgba(mean(c));
    case 3:
      return Rgba(intensity(c));
    case 4:
      return Rgba(c.r);
    default:
      return c;
  }
}

void spread(const Call& call, void* result) {
  const auto& p = call.as<Spread>();
  auto& out = *static_cast<SpreadOut*>(result);
  for (int i = 0; i < kMax; ++i)
    out.*kOuts[i] =
        i < p.num ? converted(p.input, p.*kSpreadModes[i]) * (p.*kSpreadWeights[i]) : Rgba(0);
}

Rgba opaque(const Rgb& c) { return Rgba(c.x, c.y, c.z, 1); }

void cie_d(const Call& call, void* result) {
  const auto& p = call.as<Temperature>();
  *static_cast<Rgba*>(result) = opaque(cie_daylight_color(p.temperature) * p.intensity);
}

Rgb body_color(float kelvin) {
  // Below this temperature there is no visible emission, and the sums underflow.
  constexpr float kColdest = 500;
  const Rgb c = black_body_color(std::max(kelvin, kColdest));
  return c * (1 / luminance(c));
}

/// Precomputed colour of a constant temperature: an integral over the spectrum.
struct BodyState final : ShaderState {
  explicit BodyState(float t) : temperature(t), color(body_color(t)) {}
  float temperature;
  Rgb color;
};

void blackbody(const Call& call, void* result) {
  const auto& p = call.as<Temperature>();
  const auto* known = static_cast<const BodyState*>(call.state);
  const Rgb c =
      known && known->temperature == p.temperature ? known->color : body_color(p.temperature);
  *static_cast<Rgba*>(result) = opaque(c * p.intensity);
}

}  // namespace

const ShaderSpec kMibColorAlpha = {
    .name = "mib_color_alpha",
    .library = "base",
    .version = 2,
    .apply = kApplyTexture,
    .doc = "Alpha of a colour as grey.",
    .params = kGreyRows,
    .params_size = sizeof(Grey),
    .value = grey<[](const Rgba& c) { return c.a; }>,
};

const ShaderSpec kMibColorAverage = {
    .name = "mib_color_average",
    .library = "base",
    .version = 2,
    .apply = kApplyTexture,
    .doc = "Mean of the channels of a colour as grey.",
    .params = kGreyRows,
    .params_size = sizeof(Grey),
    .value = grey<mean>,
};

const ShaderSpec kMibColorIntensity = {
    .name = "mib_color_intensity",
    .library = "base",
    .version = 2,
    .apply = kApplyTexture,
    .doc = "NTSC luminance of a colour as grey.",
    .params = kGreyRows,
    .params_size = sizeof(Grey),
    .value = grey<intensity>,
};

const ShaderSpec kMibColorInterpolate = {
    .name = "mib_color_interpolate",
    .library = "base",
    .version = 1,
    .apply = kApplyTexture,
    .doc = "Colour gradient evaluated at a number.",
    .params = kInterpolateRows,
    .params_size = sizeof(Interpolate),
    .value = interpolate,
};

const ShaderSpec kMibColorMix = {
    .name = "mib_color_mix",
    .library = "base",
    .version = 2,
    .apply = kApplyTexture | kApplyMaterial,
    .doc = "Layered colours or materials.",
    .params = kMixRows,
    .params_size = sizeof(Mix),
    .value = mix,
    .material = {.fill = mix_materials,
                 .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); },
                 .max_lobes = [](const ShaderNode&) { return 0; }},
};

const ShaderSpec kMibColorSpread = {
    .name = "mib_color_spread",
    .library = "base",
    .version = 1,
    .apply = kApplyTexture,
    .doc = "Channels of a colour as separate outputs.",
    .params = kSpreadRows,
    .params_size = sizeof(Spread),
    .result = ParamType::Struct,
    .results = kSpreadResults,
    .result_size = sizeof(SpreadOut),
    .value = spread,
};

const ShaderSpec kMibCieD = {
    .name = "mib_cie_d",
    .library = "base",
    .version = 1,
    .apply = kApplyLight | kApplyTexture,
    .doc = "Colour of CIE D daylight of a given temperature.",
    .params = kTemperatureRows,
    .params_size = sizeof(Temperature),
    .value = cie_d,
};

const ShaderSpec kMibBlackbody = {
    .name = "mib_blackbody",
    .library = "base",
    .version = 1,
    .apply = kApplyLight | kApplyTexture,
    .doc = "Colour of a black body of a given temperature.",
    .params = kTemperatureRows,
    .params_size = sizeof(Temperature),
    .value = blackbody,
    .binding =
        {
            .prepare = [](const void* params, const World&) -> std::unique_ptr<ShaderState> {
              return std::make_unique<BodyState>(
                  static_cast<const Temperature*>(params)->temperature);
            },
        },
};

}  // namespace oriel
