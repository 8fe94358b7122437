// SPDX-License-Identifier: Apache-2.0
#include "shaders/maya/maya_layers.h"

#include "runtime/bump.h"
#include "runtime/shade_input.h"
#include "shaders/maya/host_rows.h"
#include "shaders/maya/shadow_catcher.h"

namespace oriel {
namespace {

constexpr int kMaxLayers = 8;

struct Layer {
  Rgba color, transparency;
};
struct Layers {
  Layer inputs[kMaxLayers];
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
    {ORIEL_PARAM(Engine, surfaceShader), .doc = "Surface shader.", .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Engine, cutAwayOpacity), .doc = "Alpha of transparent areas.",
     .support = Support::Ignored},
    {ORIEL_PARAM(Engine, alphaMode), .doc = "Meaning of alpha.", .support = Support::Ignored},
});
constexpr auto kBackgroundRows = about({
    {ORIEL_PARAM(Background, specularColor), .fallback = {.8f, .8f, .8f},
     .doc = "Reflection colour."},
    {ORIEL_PARAM(Background, reflectivity), .fallback = {.8f}, .min = 0, .max = 1,
     .doc = "Reflectivity."},
    {ORIEL_PARAM(Background, shadowMask), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Density of shadows; their opacity in the alpha channel."},
});
constexpr auto kShadowRows = about({
    {ORIEL_PARAM(Shadow, transparency), .doc = "Fraction of the light transmitted."},
});

/// The rows of one layer.
#define ORIEL_LAYER(i)                                                                            \
  {.name = "inputs[" #i "].color",                                                                \
   .type = ParamType::Color,                                                                      \
   .element = ParamType::Color,                                                                   \
   .offset = offsetof(Layers, inputs) + (i) * sizeof(Layer) + offsetof(Layer, color),             \
   .doc = "Colour or surface of the layer.",                                                      \
   .takes_material = true},                                                                       \
  {                                                                                               \
    .name = "inputs[" #i "].transparency", .type = ParamType::Color, .element = ParamType::Color, \
    .offset = offsetof(Layers, inputs) + (i) * sizeof(Layer) + offsetof(Layer, transparency),     \
    .doc = "Transparency of the layer."                                                           \
  }
constexpr auto kLayerRows = about({
    {.name = "inputs[]",
     .type = ParamType::Integer,
     .element = ParamType::Integer,
     .offset = offsetof(Layers, count),
     .doc = "Number of layers."},
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
      closure.albedo = closure.albedo - closure.lobes[i].weight;
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
  for (int i = 0; i < std::min(p.count, kMaxLayers) && !is_black(left); ++i) {
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
  for (int i = 0; i < std::min(p.count, kMaxLayers); ++i) {
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
    .doc = "Fallback for Maya's shadingEngine: evaluates the connected surface.",
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
    .doc = "Fallback for Maya's layeredShader.",
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
        "Fallback for Maya's useBackground: the background with shadows and "
        "reflections.",
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
    .doc = "Fallback for Maya's shadow shader.",
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
    .doc = "Fallback for Maya's shadow shader of objects that cast no shadow.",
    .material = {.shadow = [](const Call&, const Rgb& light) { return light; },
                 .may_transmit = [](const ShaderNode&) { return true; }},
    .fallback = {.is_fallback = true},
};

const ShaderSpec kMayaPhotonsurface = {
    .name = "maya_photonsurface",
    .library = "hosts",
    .apply = kApplyPhoton,
    .doc = "Fallback for Maya's photon shader: the surface scatters photons.",
    .fallback = {.is_fallback = true},
};

}  // namespace oriel
