// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_ray.h"

#include <algorithm>

#include "runtime/bump.h"
#include "runtime/shade_input.h"

namespace oriel {
namespace {

struct Reflect {
  Rgba input, reflect;
  bool notrace;
};
struct Refract {
  Rgba input, refract;
  float ior;
};
struct Transparency {
  Rgba input, transp;
};
struct Opacity {
  Rgba input, opacity;
};
struct Twosided {
  Rgba front, back;
};
struct Dielectric {
  Rgba input, absorb;
  float refract, ior;
};
struct Index {
  float mtl_ior;
};
struct IndexOut {
  float ior;
  bool enter;
};

constexpr const char* kInput = "Base colour or material.";
constexpr const char* kIorDoc =
    "Ratio of indices of refraction, entered side over left side; 0 = 1.";

constexpr ParamSpec kReflectRows[] = {
    {ORIEL_PARAM(Reflect, input), .doc = kInput, .declared_default = false, .takes_material = true},
    {ORIEL_PARAM(Reflect, reflect), .doc = "Reflection weight.", .declared_default = false},
    {ORIEL_PARAM(Reflect, notrace), .doc = "Whether only the environment is reflected.",
     .declared_default = false},
};
constexpr ParamSpec kRefractRows[] = {
    {ORIEL_PARAM(Refract, input), .doc = kInput, .declared_default = false, .takes_material = true},
    {ORIEL_PARAM(Refract, refract), .doc = "Refraction weight.", .declared_default = false},
    {ORIEL_PARAM(Refract, ior), .min = 0, .doc = kIorDoc, .declared_default = false},
};
constexpr ParamSpec kTransparencyRows[] = {
    {ORIEL_PARAM(Transparency, input), .doc = kInput, .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Transparency, transp), .doc = "Transparency weight.", .declared_default = false},
};
constexpr ParamSpec kOpacityRows[] = {
    {ORIEL_PARAM(Opacity, input), .doc = kInput, .declared_default = false, .takes_material = true},
    {ORIEL_PARAM(Opacity, opacity), .doc = "Opacity of the surface; 0 = removed for all rays.",
     .declared_default = false, .look_up = LookUp::Interpolated},
};
constexpr ParamSpec kTwosidedRows[] = {
    {ORIEL_PARAM(Twosided, front), .doc = "Front face colour or material.",
     .declared_default = false, .takes_material = true},
    {ORIEL_PARAM(Twosided, back), .doc = "Back face colour or material.", .declared_default = false,
     .takes_material = true},
};
constexpr ParamSpec kDielectricRows[] = {
    {ORIEL_PARAM(Dielectric, input), .doc = kInput, .declared_default = false,
     .takes_material = true},
    {ORIEL_PARAM(Dielectric, absorb), .unit = "per scene unit",
     .doc = "Absorption coefficient, used as that of the solid.", .support = Support::Approximated,
     .declared_default = false},
    {ORIEL_PARAM(Dielectric, refract), .min = 0, .max = 1, .doc = "Refraction weight.",
     .declared_default = false},
    {ORIEL_PARAM(Dielectric, ior), .min = 0, .doc = kIorDoc, .declared_default = false},
};
constexpr ParamSpec kIndexRows[] = {
    {ORIEL_PARAM(Index, mtl_ior), .min = 0, .doc = "Index of refraction of the material; 0 = 1.",
     .declared_default = false},
};
constexpr ParamSpec kIndexResults[] = {{ORIEL_PARAM(IndexOut, ior)},
                                       {ORIEL_PARAM(IndexOut, enter)}};

Rgb level_of(const Rgba& k) {
  return Rgb(std::max(0.0f, k.r), std::max(0.0f, k.g), std::max(0.0f, k.b));
}
Rgb rest_of(const Rgb& k) {
  return Rgb(std::max(0.0f, 1 - k.x), std::max(0.0f, 1 - k.y), std::max(0.0f, 1 - k.z));
}
Frame facing_frame(const ShadingPoint& point) { return Frame(facing_viewer(point.normal, point)); }

void reflect(const Call& call, Closure& closure) {
  const auto& p = call.as<Reflect>();
  const Rgb k = level_of(p.reflect);
  shade_input(call, offsetof(Reflect, input), p.input, rest_of(k), closure);
  if (is_black(k)) return;
  const Vec3 normal = facing_viewer(call.point.normal, call.point);
  Lobe& lobe = closure.add(LobeKind::Mirror, LobeType::Reflection, k,
                           Frame(reflecting_outward(normal, call.point)));
  if (p.notrace) {
    // A reflection with an immediate falloff to the environment.
    constexpr float kAtOnce = 1e-20f;
    lobe.controls.falloff_distance = kAtOnce;
  }
  closure.albedo += k;
}

void add_transmission(const Call& call, const Rgb& k, Closure& closure) {
  if (is_black(k)) return;
  closure.add(LobeKind::ThinTransmission, LobeType::Refraction, k, facing_frame(call.point));
  closure.albedo += k;
}

/// Refracts by the index, or continues straight if it is 1.
void add_refraction(const Call& call, const Rgb& k, float ior, Closure& closure) {
  /// Limits of the index: beyond, refracted directions degenerate.
  constexpr float kMin = 0.1f, kMax = 10;
  const float eta = clamp(ior != 0 ? ior : 1, kMin, kMax);
  if (eta == 1 || is_black(k)) return add_transmission(call, k, closure);
  closure.add(LobeKind::ClearRefraction, LobeType::Refraction, k, facing_frame(call.point)).eta =
      eta;
  closure.thin_walled = false;
  closure.albedo += k;
}

void refract(const Call& call, Closure& closure) {
  const auto& p = call.as<Refract>();
  const Rgb k = level_of(p.refract);
  shade_input(call, offsetof(Refract, input), p.input, rest_of(k), closure);
  add_refraction(call, k, p.ior, closure);
}

void transparency(const Call& call, Closure& closure) {
  const auto& p = call.as<Transparency>();
  const Rgb k = level_of(p.transp);
  shade_input(call, offsetof(Transparency, input), p.input, rest_of(k), closure);
  add_transmission(call, k, closure);
}

/// Opacity per channel, over the input.
void exist(const Call& call, std::size_t offset, const Rgba& input, const Rgb& opacity,
           Closure& closure) {
  const Rgb there(clamp01(opacity.x), clamp01(opacity.y), clamp01(opacity.z));
  const float most = max_component(there);
  const Rgb level = most > 0 ? there / most : Rgb(0);
  shade_input(call, offset, input, level, closure);
  closure.opacity *= most;
  if (most > 0) add_transmission(call, rest_of(level), closure);
}

void opacity(const Call& call, Closure& closure) {
  const auto& p = call.as<Opacity>();
  exist(call, offsetof(Opacity, input), p.input, rgb(p.opacity), closure);
}

void continue_behind(const Call& call, Closure& closure) {
  const auto& p = call.as<Transparency>();
  exist(call, offsetof(Transparency, input), p.input, Rgb(1) - rgb(p.transp), closure);
}

void twosided(const Call& call, Closure& closure) {
  const auto& p = call.as<Twosided>();
  if (call.point.back_side)
    shade_input(call, offsetof(Twosided, back), p.back, Rgb(1), closure);
  else
    shade_input(call, offsetof(Twosided, front), p.front, Rgb(1), closure);
}

void dielectric(const Call& call, Closure& closure) {
  const auto& p = call.as<Dielectric>();
  const Rgb k(clamp01(p.refract));
  shade_input(call, offsetof(Dielectric, input), p.input, rest_of(k), closure);
  add_refraction(call, k, p.ior, closure);
  if (!closure.thin_walled) closure.inside.absorption = level_of(p.absorb);
}

/// Whether light may pass: the share is not the constant 0, or the material below lets light pass.
template <class P, Rgba P::*kShare>
bool passes(const ShaderNode& node) {
  const P& p = node.constants<P>();
  const auto offset = static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&(p.*kShare)) -
                                               reinterpret_cast<const std::byte*>(&p));
  return !is_black(rgb(p.*kShare)) || node.connected(offset) || node.inputs_may_transmit();
}

bool opacity_passes(const ShaderNode& node) {
  const Rgb o = rgb(node.constants<Opacity>().opacity);
  return std::min({o.x, o.y, o.z}) < 1 || node.connected(offsetof(Opacity, opacity)) ||
         node.inputs_may_transmit();
}

bool dielectric_passes(const ShaderNode& node) {
  return node.constants<Dielectric>().refract > 0 ||
         node.connected(offsetof(Dielectric, refract)) || node.inputs_may_transmit();
}

bool inputs_pass(const ShaderNode& node) { return node.inputs_may_transmit(); }

constexpr unsigned kApplySurface = kApplyMaterial | kApplyTexture | kApplyShadow | kApplyPhoton;

}  // namespace

const ShaderSpec kMibReflect = {
    .name = "mib_reflect",
    .library = "base",
    .version = 2,
    .apply = kApplySurface,
    .doc = "Mirror reflection blended over another material.",
    .params = kReflectRows,
    .params_size = sizeof(Reflect),
    .material = {.fill = reflect, .may_transmit = inputs_pass},
};

const ShaderSpec kMibRefract = {
    .name = "mib_refract",
    .library = "base",
    .version = 2,
    .apply = kApplySurface,
    .doc = "Refraction blended over another material.",
    .params = kRefractRows,
    .params_size = sizeof(Refract),
    .material = {.fill = refract, .may_transmit = passes<Refract, &Refract::refract>},
};

const ShaderSpec kMibTransparency = {
    .name = "mib_transparency",
    .library = "base",
    .version = 2,
    .apply = kApplySurface,
    .doc = "Transparency without refraction, blended over another material.",
    .params = kTransparencyRows,
    .params_size = sizeof(Transparency),
    .material = {.fill = transparency, .may_transmit = passes<Transparency, &Transparency::transp>},
};

const ShaderSpec kMibOpacity = {
    .name = "mib_opacity",
    .library = "base",
    .version = 2,
    .apply = kApplySurface,
    .doc = "Opacity of a material.",
    .params = kOpacityRows,
    .params_size = sizeof(Opacity),
    .material = {.fill = opacity, .may_transmit = opacity_passes},
};

const ShaderSpec kMibContinue = {
    .name = "mib_continue",
    .library = "base",
    .apply = kApplySurface,
    .doc = "Continued ray without a surface, for cut-outs.",
    .params = kTransparencyRows,
    .params_size = sizeof(Transparency),
    .material = {.fill = continue_behind,
                 .may_transmit = passes<Transparency, &Transparency::transp>},
};

const ShaderSpec kMibTwosided = {
    .name = "mib_twosided",
    .library = "base",
    .apply = kApplySurface,
    .doc = "Separate materials for front and back faces.",
    .params = kTwosidedRows,
    .params_size = sizeof(Twosided),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<Twosided>();
          *static_cast<Rgba*>(result) = call.point.back_side ? p.back : p.front;
        },
    .material = {.fill = twosided,
                 .may_transmit = inputs_pass,
                 .max_lobes = [](const ShaderNode&) { return 0; },
                 .one_material = true},
};

const ShaderSpec kMibDielectric = {
    .name = "mib_dielectric",
    .library = "base",
    .apply = kApplySurface,
    .doc = "Dielectric refraction blended over another material.",
    .params = kDielectricRows,
    .params_size = sizeof(Dielectric),
    .material = {.fill = dielectric, .may_transmit = dielectric_passes},
};

const ShaderSpec kMibRefractionIndex = {
    .name = "mib_refraction_index",
    .library = "base",
    .apply = kApplyTexture,
    .doc = "Ratio of the indices of refraction at the surface, in or out of the material.",
    .params = kIndexRows,
    .params_size = sizeof(Index),
    .result = ParamType::Struct,
    .results = kIndexResults,
    .result_size = sizeof(IndexOut),
    .value =
        [](const Call& call, void* result) {
          const float ior = call.as<Index>().mtl_ior;
          const bool enter = !call.point.back_side;
          const float ratio = ior > 0 ? (enter ? ior : 1 / ior) : 1;
          *static_cast<IndexOut*>(result) = {ratio, enter};
        },
};

}  // namespace oriel
