// SPDX-License-Identifier: Apache-2.0
#include "runtime/fallback_shader.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/math.h"
#include "runtime/bump.h"
#include "runtime/closure.h"
#include "runtime/shade_input.h"
#include "runtime/texture_node.h"

namespace oriel {
namespace {

/// Magenta: it does not occur in daylight scenes.
const Rgb kMissingColor(0.8f, 0.0f, 0.5f);

struct FallbackParams {
  Rgba color;
  float weight;
  Rgba transparency, opacity, specular;
  float exponent, reflectivity;
  Rgba emission;
  float intensity;
  bool shadow;
  ColorTextureRef texture;
  Vec3 coord;
  Rgba surface;
};

constexpr ParamSpec kApproximationRows[] = {
    {ORIEL_PARAM(FallbackParams, color), .fallback = {1, 1, 1}},
    {ORIEL_PARAM(FallbackParams, weight), .fallback = {1}},
    {ORIEL_PARAM(FallbackParams, transparency)},
    {ORIEL_PARAM(FallbackParams, opacity), .fallback = {1, 1, 1}},
    {ORIEL_PARAM(FallbackParams, specular)},
    {ORIEL_PARAM(FallbackParams, exponent), .fallback = {20}},
    {ORIEL_PARAM(FallbackParams, reflectivity)},
    {ORIEL_PARAM(FallbackParams, emission)},
    {ORIEL_PARAM(FallbackParams, intensity), .fallback = {1}},
    {ORIEL_PARAM(FallbackParams, shadow), .fallback = {1}},
    {ORIEL_PARAM(FallbackParams, texture)},
    {ORIEL_PARAM(FallbackParams, coord)},
    {ORIEL_PARAM(FallbackParams, surface), .takes_material = true},
};

/// Names are compared in lower case without underscores.
struct Familiar {
  const char* meaning;
  const char* names;  ///< separated by spaces
  bool number;        ///< a number, otherwise a colour
};
constexpr Familiar kFamiliar[] = {
    {"weight", " diffuse diffuseweight diffuselevel kd basecolorweight baseweight ", true},
    {"color",
     " color colour diffuse diffusecolor diffusecolour diff diffcolor basecolor basecolour base "
     "albedo kd cd maincolor surfacecolor outcolor lightcolor tint ",
     false},
    {"transparency", " transparency transparencycolor transp ", false},
    {"opacity", " opacity opacitycolor cutoutopacity ", false},
    {"specular", " specular specularcolor specularcolour speccolor ks ", false},
    {"exponent", " exponent shininess shiny cosinepower specularexponent ", true},
    {"reflectivity", " reflectivity reflection kr ", true},
    {"emission",
     " emission emissioncolor emissive emissivecolor incandescence selfillumination "
     "additionalcolor ",
     false},
    {"intensity", " intensity multiplier brightness strength ", true},
    {"shadow", " shadow shadows castshadow castshadows useraytraceshadows ", true},
    {"texture",
     " texture tex map image file filename filetexturename bitmap colortexture diffusetexture ",
     false},
    {"coord", " coord coords uv uvcoord uvcoords coordinate coordinates st ", false},
    {"surface", " surface surfaceshader material basematerial beauty ", false},
};

Rgba looked_up(const FallbackParams& p, const Call& call) {
  if (!p.texture.texture) return p.color;
  const ShadingPoint& point = call.point;
  Vec3 at = point.tex[0];
  if (call.node && call.node->connected(offsetof(FallbackParams, coord))) {
    at = p.coord;
  } else if (point.environment) {
    const Vec3& d = point.ray_direction;
    at =
        Vec3(0.5f + math::atan2(d.x, -d.z) / kTwoPi, 0.5f + math::asin(clamp(d.y, -1, 1)) / kPi, 0);
  } else if (point.texture_spaces == 0) {
    at = Vec3(0);
  }
  const Rgba t = p.texture.texture->lookup(Vec2(at.x, at.y), call.point, {});
  return Rgba(t.r * p.color.r, t.g * p.color.g, t.b * p.color.b, t.a);
}

Rgb clamped(const Rgba& c) { return Rgb(clamp01(c.r), clamp01(c.g), clamp01(c.b)); }

void guess_material(const Call& call, Closure& closure) {
  const auto& p = call.as<FallbackParams>();
  if (call.node && call.node->material_input(offsetof(FallbackParams, surface)))
    return shade_input(call, offsetof(FallbackParams, surface), p.surface, Rgb(1), closure);
  const Vec3 normal = facing_viewer(call.point.normal, call.point);
  const auto add = [&](LobeKind kind, LobeType type, const Rgb& level) {
    if (is_black(level)) return;
    closure.add(kind, type, level, Frame(normal));
    closure.albedo += level;
  };
  const Rgb mirror(clamp01(p.reflectivity));
  const Rgb seen = Rgb(1) - (Rgb(1) - clamped(p.transparency)) * clamped(p.opacity);
  const Rgb through = seen * (Rgb(1) - mirror);
  const Rgb solid = Rgb(1) - mirror - through;
  closure.emission += rgb(p.emission) + rgb(p.surface);
  add(LobeKind::Diffuse, LobeType::Diffuse,
      clamped(looked_up(p, call)) * clamp01(p.weight) * solid);
  add(LobeKind::ThinTransmission, LobeType::Refraction, through);
  add(LobeKind::Mirror, LobeType::Reflection, mirror);
  if (is_black(rgb(p.specular))) return;
  Lobe& shine =
      closure.add(LobeKind::PhongHighlight, LobeType::Reflection, rgb(p.specular), Frame(normal));
  shine.controls.highlights_only = true;
  shine.roughness = std::max(1.0f, p.exponent);
}

}  // namespace

const char* familiar_parameter(std::string_view name, const scene::Value& value,
                               const ParamType* declared, bool names_texture) {
  using Kind = scene::Value::Kind;
  std::string plain = " ";
  for (const char c : name)
    if (c != '_' && c != ' ') plain += c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  plain += ' ';
  if (names_texture || (declared && *declared == ParamType::ColorTexture)) return "texture";
  const bool connected = value.kind == Kind::Connection || value.kind == Kind::Interface;
  const bool one = declared ? *declared == ParamType::Scalar || *declared == ParamType::Integer ||
                                  *declared == ParamType::Boolean
                            : value.kind == Kind::Boolean ||
                                  (value.kind == Kind::Numbers && value.numbers.size() == 1);
  for (const Familiar& f : kFamiliar) {
    if (std::string_view(f.names).find(plain) == std::string_view::npos) continue;
    const std::string_view meaning = f.meaning;
    if (meaning == "texture") {
      // A connection is the colour of another shader; otherwise only a texture's name identifies
      // one.
      if (connected) return "color";
      continue;
    }
    if (meaning == "surface" || meaning == "coord") {
      if (connected) return f.meaning;
      continue;
    }
    if (!connected && value.kind != Kind::Numbers && value.kind != Kind::Boolean) continue;
    if (value.kind == Kind::Boolean && meaning != "shadow") continue;
    const bool scalar_alone = f.number && !one && !(connected && !declared);
    if (scalar_alone || (connected && !declared && meaning == "weight")) continue;
    return f.meaning;
  }
  return nullptr;
}

const ShaderSpec kFallbackShader = {
    .name = "unavailable shader",
    .library = "oriel",
    .doc = "Takes the place of a shader that is not available.",
    .value =
        [](const Call&, void* result) {
          *static_cast<Rgba*>(result) = Rgba(kMissingColor.x, kMissingColor.y, kMissingColor.z, 1);
        },
    .material =
        {
            .fill =
                [](const Call& call, Closure& closure) {
                  closure.add(LobeKind::Diffuse, LobeType::Diffuse, kMissingColor,
                              Frame(call.point.normal));
                  closure.albedo = kMissingColor;
                },
        },
};

const ShaderSpec kApproximateMaterial = {
    .name = "guessed shader",
    .library = "oriel",
    .doc = "Takes the place of a shader that is not available, by what its parameters are called.",
    .params = kApproximationRows,
    .params_size = sizeof(FallbackParams),
    .value =
        [](const Call& call, void* result) {
          *static_cast<Rgba*>(result) = looked_up(call.as<FallbackParams>(), call);
        },
    .material = {
        .fill = guess_material,
        .may_transmit =
            [](const ShaderNode& node) {
              const auto& p = node.constants<FallbackParams>();
              return !is_black(rgb(p.transparency)) || !(rgb(p.opacity) == Rgb(1)) ||
                     node.connected(offsetof(FallbackParams, transparency)) ||
                     node.connected(offsetof(FallbackParams, opacity)) ||
                     node.inputs_may_transmit();
            },
        .max_lobes =
            [](const ShaderNode& node) {
              return node.material_input(offsetof(FallbackParams, surface)) ? 0 : 4;
            },
    },
    .light =
        {
            .evaluate =
                [](const Call& call, const LightCall&) {
                  const auto& p = call.as<FallbackParams>();
                  return LightValue{rgb(p.color) * p.intensity, p.shadow};
                },
        },
};

}  // namespace oriel
