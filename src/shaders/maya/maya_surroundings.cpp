// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "color/srgb.h"
#include "runtime/world.h"
#include "shaders/maya/host_rows.h"
#include "shaders/maya/maya_utility.h"

namespace oriel {
namespace {

struct Displacement {
  float displacement, scale;
};
struct Background {
  Rgba color;
};
struct Display {
  float gamma;
};

constexpr auto kDisplacementRows = about({
    {ORIEL_PARAM(Displacement, displacement), .unit = "scene units", .doc = "Displacement height."},
    {ORIEL_PARAM(Displacement, scale), .fallback = {1}, .doc = "Height factor."},
});
constexpr auto kBackgroundRows =
    about({{ORIEL_PARAM(Background, color), .doc = "Environment colour."}});

constexpr auto kDisplayRows = about({
    {ORIEL_PARAM(Display, gamma), .min = 0, .doc = "Display gamma; 0 = the sRGB curve."},
});

/// Whether the options or a lens shader already encode colours for a display.
bool encoded_elsewhere(const World& world) {
  if (world.options.gamma != 1) return true;
  return std::any_of(world.lens.begin(), world.lens.end(), [](const ShaderNode* node) {
    return node->spec().lens.traits && node->spec().lens.traits(*node).gamma > 1;
  });
}

Rgb encode(const Call& call, const LensCall&, const Rgb& colour) {
  if (call.point.world && encoded_elsewhere(*call.point.world)) return colour;
  const float gamma = call.as<Display>().gamma;
  const Rgb light(usable_light(colour.x), usable_light(colour.y), usable_light(colour.z));
  if (gamma <= 0) return srgb_encode(light);
  const auto channel = [&](float v) { return math::pow(v, 1 / gamma); };
  return Rgb(channel(light.x), channel(light.y), channel(light.z));
}

constexpr ShaderSpec displacing(const char* name) {
  return {.name = name,
          .library = "hosts",
          .apply = kApplyTexture,
          .doc = "Fallback for Maya's displacement.",
          .params = kDisplacementRows,
          .params_size = sizeof(Displacement),
          .result = ParamType::Scalar,
          .result_size = sizeof(float),
          .value =
              [](const Call& call, void* result) {
                const auto& p = call.as<Displacement>();
                *static_cast<float*>(result) = p.displacement * p.scale;
              },
          .fallback = {.is_fallback = true}};
}

/// A shader without effect in Oriel. As a lens shader it has no rays, which disables it.
constexpr ShaderSpec passed_over(const char* name, unsigned apply, const char* doc) {
  return {
      .name = name,
      .library = "hosts",
      .apply = apply,
      .doc = doc,
      .lens = {
          .bend_ray = [](const Call&, const Camera&, const Vec2&, Camera::Ray&) { return Rgb(1); },
          .ray_count = [](const ShaderNode&) { return 0; }},
      .fallback = {.is_fallback = true},
  };
}

constexpr ShaderSpec kNodes[] = {
    displacing("maya_displace"),
    displacing("maya_material_displace"),
    {.name = "maya_envcolor",
     .library = "hosts",
     .apply = kApplyEnvironment,
     .doc = "Fallback for Maya's background colour.",
     .params = kBackgroundRows,
     .params_size = sizeof(Background),
     .value = [](const Call& call,
                 void* result) { *static_cast<Rgba*>(result) = call.as<Background>().color; },
     .fallback = {.is_fallback = true}},
    passed_over("maya_shaderglow", kApplyOutput, "Maya's shader glow; no effect."),
    passed_over("maya_volumesampler", kApplyVolume, "Maya's volume shaders; no effect."),
    passed_over("maya_volumeengine", kApplyVolume, "Maya's volume shaders; no effect."),
    {.name = "maya_colormanagement",
     .library = "hosts",
     .apply = kApplyLens | kApplyOutput,
     .doc = "Fallback for Maya's colour management: encodes the image for a display.",
     .params = kDisplayRows,
     .params_size = sizeof(Display),
     .lens = {.map_color = encode},
     .fallback = {.is_fallback = true,
                  .aliases = "maya_colormgt maya_colormanager maya_colourmanagement"}},
    passed_over("maya_options", kApplyOutput, "Maya's options; no effect."),
    passed_over("maya_state", kApplyOutput, "Maya's state; no effect."),
    passed_over("maya_lightlink", kApplyLight, "Maya's light links; no effect."),
};

}  // namespace

std::span<const ShaderSpec> maya_surroundings() { return kNodes; }

}  // namespace oriel
