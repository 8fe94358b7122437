// SPDX-License-Identifier: Apache-2.0
#include "shaders/maya/maya_layers.h"

#include "runtime/bump.h"
#include "runtime/shade_input.h"
#include "shaders/maya/host_rows.h"
#include "shaders/maya/shadow_catcher.h"

namespace oriel {
namespace {

constexpr int kMostLayers = 8;

struct Layer {
  Rgba color, transparency;
};
struct Layers {
  Layer inputs[kMostLayers];
  int count;
};
struct Engine {
  Rgba surfaceShader;
  float cutAwayOpacity;
  int alphaMode;
};
struct Background {
  Rgba specularColor;
  float reflectivity, shadowMask;
};
struct Shadow {
  Rgba transparency;
};

constexpr auto kEngineRows = about({
    {ORIEL_PARAM(Engine, surfaceShader), .doc = "The surface.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Engine, cutAwayOpacity), .doc = "Alpha of what is transparent.",
     .support = Support::Ignored},
    {ORIEL_PARAM(Engine, alphaMode), .doc = "What alpha is.", .support = Support::Ignored},
});
constexpr auto kBackgroundRows = about({
    {ORIEL_PARAM(Background, specularColor), .fallback = {.8f, .8f, .8f},
     .doc = "Colour of the mirror."},
    {ORIEL_PARAM(Background, reflectivity), .fallback = {.8f}, .min = 0, .max = 1,
     .doc = "Share of the mirror."},
    {ORIEL_PARAM(Background, shadowMask), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Darkness of shadows; in the alpha channel their opacity."},
});
constexpr auto kShadowRows = about({
    {ORIEL_PARAM(Shadow, transparency), .doc = "Share of the light that passes."},
});

/// The rows of one layer.
#define ORIEL_LAYER(i)                                                                            \
  {.name = "inputs[" #i "].color",                                                                \
   .type = ParamType::Color,                                                                      \
   .element = ParamType::Color,                                                                   \
   .offset = offsetof(Layers, inputs) + (i) * sizeof(Layer) + offsetof(Layer, color),             \
   .doc = "The layer's colour or surface.",                                                       \
   .takes_material = true},                                                                       \
  {                                                                                               \
    .name = "inputs[" #i "].transparency", .type = ParamType::Color, .element = ParamType::Color, \
    .offset = offsetof(Layers, inputs) + (i) * sizeof(Layer) + offsetof(Layer, transparency),     \
    .doc = "Share that the layers below show."                                                    \
  }
constexpr auto kLayerRows = about({
    {.name = "inputs[]",
     .type = ParamType::Integer,
     .element = ParamType::Integer,
     .offset = offsetof(Layers, count),
     .doc = "How many layers there are."},
    ORIEL_LAYER(0),
    ORIEL_LAYER(1),
    ORIEL_LAYER(2),
    ORIEL_LAYER(3),
    ORIEL_LAYER(4),
    ORIEL_LAYER(5),
    ORIEL_LAYER(6),
    ORIEL_LAYER(7),
});
#undef ORIEL_LAYER

/// Removes the transmitting lobes from index `first` on.
void close(int first, Closure& closure) {
  int kept = first;
  for (int i = first; i < closure.count; ++i) {
    if (transmits(closure.lobes[i].kind)) {
      closure.albedo = closure.albedo - closure.lobes[i].level;
      continue;
    }
    if (kept != i) closure.lobes[kept] = closure.lobes[i];
    ++kept;
  }
  closure.count = kept;
}

void transmit(const Call& call, const Rgb& level, Closure& closure) {
  if (is_black(level)) return;
  closure.add(LobeKind::ThinTransmission, LobeType::Refraction, level,
              Frame(facing_viewer(call.point.normal, call.point)));
  closure.albedo += level;
}

void layered(const Call& call, Closure& closure) {
  const auto& p = call.as<Layers>();
  Rgb left(1);
  for (int i = 0; i < std::min(p.count, kMostLayers) && !is_black(left); ++i) {
    const Layer& layer = p.inputs[i];
    const std::size_t at = offsetof(Layers, inputs) + static_cast<std::size_t>(i) * sizeof(Layer);
    const int first = closure.count;
    shade_input(call, at + offsetof(Layer, color), layer.color, left, closure);
    close(first, closure);
    left *= clamped(layer.transparency);
  }
  closure.thin_walled = true;
  transmit(call, left, closure);
}

bool layers_pass(const ShaderNode& node) {
  const auto& p = node.constants<Layers>();
  for (int i = 0; i < std::min(p.count, kMostLayers); ++i) {
    const std::size_t at = offsetof(Layers, inputs) + static_cast<std::size_t>(i) * sizeof(Layer);
    if (is_black(rgb(p.inputs[i].transparency)) &&
        !node.connected(at + offsetof(Layer, transparency)))
      return false;
  }
  return true;
}

constexpr unsigned kApplySurface = kApplyMaterial | kApplyShadow | kApplyPhoton;

}  // namespace

const ShaderSpec kMayaShadingengine = {
    .name = "maya_shadingengine",
    .library = "hosts",
    .apply = kApplySurface,
    .doc = "Stand-in for the host's shading engine: the surface it is connected to.",
    .params = kEngineRows,
    .params_size = sizeof(Engine),
    .material = {
        .fill =
            [](const Call& call, Closure& closure) {
              const auto& p = call.as<Engine>();
              shade_input(call, offsetof(Engine, surfaceShader), p.surfaceShader, Rgb(1), closure);
            },
        .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); },
        .max_lobes = [](const ShaderNode&) { return 0; },
    },
    .fallback = {.is_fallback = true},
};

const ShaderSpec kMayaLayeredshader = {
    .name = "maya_layeredshader",
    .library = "hosts",
    .apply = kApplySurface,
    .doc = "Stand-in for the host's layered shader.",
    .params = kLayerRows,
    .params_size = sizeof(Layers),
    .material = {.fill = layered, .may_transmit = layers_pass},
    .fallback = {.is_fallback = true},
};

const ShaderSpec kMayaUsebackground = {
    .name = "maya_usebackground",
    .library = "hosts",
    .apply = kApplySurface,
    .doc =
        "Stand-in for the host's use-background: what lies behind with shadows on it, and a "
        "mirror.",
    .params = kBackgroundRows,
    .params_size = sizeof(Background),
    .material = {
        .fill =
            [](const Call& call, Closure& closure) {
              const auto& p = call.as<Background>();
              const Rgb mirror = clamped(p.specularColor) * clamp01(p.reflectivity);
              if (!is_black(mirror)) {
                const Vec3 normal = facing_viewer(call.point.normal, call.point);
                closure.add(LobeKind::Mirror, LobeType::Reflection, mirror,
                            Frame(reflecting_outward(normal, call.point)));
              }
              const Rgb lit = Rgb(1) - (Rgb(1) - lit_share(call.point)) * clamp01(p.shadowMask);
              transmit(call, (Rgb(1) - mirror) * lit, closure);
              closure.propagate_alpha = true;
            },
        .may_transmit = [](const ShaderNode&) { return true; },
        .max_lobes = [](const ShaderNode&) { return 2; },
    },
    .fallback = {.is_fallback = true},
};

const ShaderSpec kMayaShadow = {
    .name = "maya_shadow",
    .library = "hosts",
    .apply = kApplyShadow,
    .doc = "Stand-in for the host's shadows.",
    .params = kShadowRows,
    .params_size = sizeof(Shadow),
    .material = {
        .shadow = [](const Call& call,
                     const Rgb& light) { return light * clamped(call.as<Shadow>().transparency); },
        .may_transmit =
            [](const ShaderNode& node) {
              return !is_black(rgb(node.constants<Shadow>().transparency)) ||
                     node.connected(offsetof(Shadow, transparency));
            },
    },
    .fallback = {.is_fallback = true},
};

const ShaderSpec kMayaTransparent = {
    .name = "maya_transparent",
    .library = "hosts",
    .apply = kApplyShadow,
    .doc = "Stand-in for the host's shadow shader of what casts none.",
    .material = {.shadow = [](const Call&, const Rgb& light) { return light; },
                 .may_transmit = [](const ShaderNode&) { return true; }},
    .fallback = {.is_fallback = true},
};

const ShaderSpec kMayaPhotonsurface = {
    .name = "maya_photonsurface",
    .library = "hosts",
    .apply = kApplyPhoton,
    .doc = "Stand-in for the host's photon shader: photons are scattered by the surface.",
    .fallback = {.is_fallback = true},
};

}  // namespace oriel
