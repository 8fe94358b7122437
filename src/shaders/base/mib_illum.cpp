// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_illum.h"

#include <algorithm>

#include "bsdf/ward_lobe.h"
#include "runtime/bump.h"
#include "runtime/closure.h"

namespace oriel {
namespace {

struct Lambert {
  Rgba ambience, ambient, diffuse;
  int mode;
  ArrayView<LightRef> lights;
};
struct Phong {
  Rgba ambience, ambient, diffuse, specular;
  float exponent;
  int mode;
  ArrayView<LightRef> lights;
};
struct Blinn {
  Rgba ambience, ambient, diffuse, specular;
  float roughness, ior;
  int mode;
  ArrayView<LightRef> lights;
};
struct Cooktorr {
  Rgba ambience, ambient, diffuse, specular;
  float roughness;
  Rgba ior;
  int mode;
  ArrayView<LightRef> lights;
};
struct Ward {
  Rgba ambience, ambient, diffuse, glossy;
  float shiny_u, shiny_v;
  Vec3 u, v;
  int mode;
  ArrayView<LightRef> lights;
};
struct WardDeriv {
  Rgba ambience, ambient, diffuse, glossy;
  float shiny_u, shiny_v;
  int mode;
  ArrayView<LightRef> lights;
};

constexpr const char* kAmbience = "Ambient light colour.";
constexpr const char* kAmbient = "Ambient reflectance, multiplied by ambience.";
constexpr const char* kMode =
    "Light selection: 0 list or linked or all, 1 the list, 2 all but the list, 4 "
    "linked or all.";

constexpr const char* kDiffuse = "Diffuse colour.";
constexpr const char* kSpecular = "Highlight colour.";
constexpr const char* kSlope = "Mean slope of the microfacets; sets the highlight width.";
constexpr const char* kIor = "Index of refraction; minimum 1.";
constexpr const char* kList = "Light list.";

constexpr ParamSpec kLambertRows[] = {
    {ORIEL_PARAM(Lambert, ambience), .doc = kAmbience, .declared_default = false},
    {ORIEL_PARAM(Lambert, ambient), .doc = kAmbient, .declared_default = false},
    {ORIEL_PARAM(Lambert, diffuse), .doc = "Diffuse colour.", .declared_default = false},
    {ORIEL_PARAM(Lambert, mode), .doc = kMode, .declared_default = false},
    {ORIEL_PARAM(Lambert, lights), .doc = "Light list.", .declared_default = false},
};
constexpr ParamSpec kPhongRows[] = {
    {ORIEL_PARAM(Phong, ambience), .doc = kAmbience, .declared_default = false},
    {ORIEL_PARAM(Phong, ambient), .doc = kAmbient, .declared_default = false},
    {ORIEL_PARAM(Phong, diffuse), .doc = "Diffuse colour.", .declared_default = false},
    {ORIEL_PARAM(Phong, specular), .doc = "Highlight colour.", .declared_default = false},
    {ORIEL_PARAM(Phong, exponent), .doc = "Highlight exponent.", .declared_default = false},
    {ORIEL_PARAM(Phong, mode), .doc = kMode, .declared_default = false},
    {ORIEL_PARAM(Phong, lights), .doc = "Light list.", .declared_default = false},
};

constexpr ParamSpec kBlinnRows[] = {
    {ORIEL_PARAM(Blinn, ambience), .doc = kAmbience, .declared_default = false},
    {ORIEL_PARAM(Blinn, ambient), .doc = kAmbient, .declared_default = false},
    {ORIEL_PARAM(Blinn, diffuse), .doc = kDiffuse, .declared_default = false},
    {ORIEL_PARAM(Blinn, specular), .doc = kSpecular, .declared_default = false},
    {ORIEL_PARAM(Blinn, roughness), .min = 0, .doc = kSlope, .declared_default = false},
    {ORIEL_PARAM(Blinn, ior), .min = 0, .doc = kIor, .declared_default = false},
    {ORIEL_PARAM(Blinn, mode), .doc = kMode, .declared_default = false},
    {ORIEL_PARAM(Blinn, lights), .doc = kList, .declared_default = false},
};
constexpr ParamSpec kCooktorrRows[] = {
    {ORIEL_PARAM(Cooktorr, ambience), .doc = kAmbience, .declared_default = false},
    {ORIEL_PARAM(Cooktorr, ambient), .doc = kAmbient, .declared_default = false},
    {ORIEL_PARAM(Cooktorr, diffuse), .doc = kDiffuse, .declared_default = false},
    {ORIEL_PARAM(Cooktorr, specular), .doc = kSpecular, .declared_default = false},
    {ORIEL_PARAM(Cooktorr, roughness), .min = 0, .doc = kSlope, .declared_default = false},
    {ORIEL_PARAM(Cooktorr, ior), .doc = kIor, .declared_default = false},
    {ORIEL_PARAM(Cooktorr, mode), .doc = kMode, .declared_default = false},
    {ORIEL_PARAM(Cooktorr, lights), .doc = kList, .declared_default = false},
};
constexpr ParamSpec kWardRows[] = {
    {ORIEL_PARAM(Ward, ambience), .doc = kAmbience, .declared_default = false},
    {ORIEL_PARAM(Ward, ambient), .doc = kAmbient, .declared_default = false},
    {ORIEL_PARAM(Ward, diffuse), .doc = kDiffuse, .declared_default = false},
    {ORIEL_PARAM(Ward, glossy), .doc = kSpecular, .declared_default = false},
    {ORIEL_PARAM(Ward, shiny_u), .min = 0, .doc = "Highlight narrowness along u.",
     .declared_default = false},
    {ORIEL_PARAM(Ward, shiny_v), .min = 0, .doc = "Highlight narrowness along v.",
     .declared_default = false},
    {ORIEL_PARAM(Ward, u), .doc = "Tangent direction u; null = along the texture.",
     .declared_default = false},
    {ORIEL_PARAM(Ward, v), .doc = "Direction perpendicular to u; used if u is null.",
     .declared_default = false},
    {ORIEL_PARAM(Ward, mode), .doc = kMode, .declared_default = false},
    {ORIEL_PARAM(Ward, lights), .doc = kList, .declared_default = false},
};
constexpr ParamSpec kWardDerivRows[] = {
    {ORIEL_PARAM(WardDeriv, ambience), .doc = kAmbience, .declared_default = false},
    {ORIEL_PARAM(WardDeriv, ambient), .doc = kAmbient, .declared_default = false},
    {ORIEL_PARAM(WardDeriv, diffuse), .doc = kDiffuse, .declared_default = false},
    {ORIEL_PARAM(WardDeriv, glossy), .doc = kSpecular, .declared_default = false},
    {ORIEL_PARAM(WardDeriv, shiny_u), .min = 0,
     .doc = "Highlight narrowness along the u derivative of the surface.",
     .declared_default = false},
    {ORIEL_PARAM(WardDeriv, shiny_v), .min = 0,
     .doc = "Highlight narrowness perpendicular to that.", .declared_default = false},
    {ORIEL_PARAM(WardDeriv, mode), .doc = kMode, .declared_default = false},
    {ORIEL_PARAM(WardDeriv, lights), .doc = kList, .declared_default = false},
};

/// Limits for facet slopes and lobe widths.
constexpr float kMaxSlope = 10;

template <class P>
Frame shade_diffuse(const P& p, const ShadingPoint& point, Closure& closure) {
  const Frame frame(facing_viewer(point.normal, point));
  closure.emission += rgb(p.ambience) * rgb(p.ambient);
  closure.light_mode = p.mode;
  closure.lights = p.lights;
  closure.albedo = rgb(p.diffuse);
  if (!is_black(closure.albedo))
    closure.add(LobeKind::Diffuse, LobeType::Diffuse, closure.albedo, frame);
  return frame;
}

Lobe& add_highlight(LobeKind kind, const Rgb& level, const Frame& frame, Closure& closure) {
  Lobe& lobe = closure.add(kind, LobeType::Reflection, level, frame);
  lobe.controls.highlights_only = true;
  return lobe;
}

void add_facets(const Rgb& level, float slope, float ior, const Frame& frame, Closure& closure) {
  if (is_black(level)) return;
  Lobe& lobe = add_highlight(LobeKind::TorranceHighlight, level, frame, closure);
  lobe.roughness = clamp(slope, 0, kMaxSlope);
  lobe.eta = std::max(1.0f, ior);
}

void blinn(const Call& call, Closure& closure) {
  const auto& p = call.as<Blinn>();
  const Frame frame = shade_diffuse(p, call.point, closure);
  add_facets(rgb(p.specular), p.roughness, p.ior, frame, closure);
}

void cooktorr(const Call& call, Closure& closure) {
  const auto& p = call.as<Cooktorr>();
  const Frame frame = shade_diffuse(p, call.point, closure);
  const Rgb specular = rgb(p.specular), ior = rgb(p.ior);
  if (ior.x == ior.y && ior.y == ior.z)
    return add_facets(specular, p.roughness, ior.x, frame, closure);
  for (int k = 0; k < 3; ++k) {
    Rgb channel(0);
    channel[k] = specular[k];
    add_facets(channel, p.roughness, ior[k], frame, closure);
  }
}

/// Slopes of Ward's lobe; shininess 0 has the maximum width.
template <class P>
void ward(const P& p, const Vec3& along, const ShadingPoint& point, Closure& closure) {
  const Frame frame = shade_diffuse(p, point, closure);
  const Rgb glossy = rgb(p.glossy);
  if (is_black(glossy)) return;
  Lobe& lobe =
      add_highlight(LobeKind::WardHighlight, glossy, Frame::along(frame.n, along), closure);
  lobe.alpha_x = bsdf::ward_slope(p.shiny_u);
  lobe.alpha_y = bsdf::ward_slope(p.shiny_v);
}

/// The direction u, computed from v if only v is given, else from the texture space.
Vec3 brushed(const Ward& p, const ShadingPoint& point) {
  if (p.u != Vec3(0)) return p.u;
  return p.v != Vec3(0) ? cross(p.v, point.normal) : point.dpdu;
}

void hair(const Call& call, Closure& closure) {
  const auto& p = call.as<Phong>();
  const Frame frame = shade_diffuse(p, call.point, closure);
  const Rgb specular = rgb(p.specular);
  if (is_black(specular)) return;
  Lobe& lobe = add_highlight(LobeKind::HairHighlight, specular,
                             Frame::along(frame.n, call.point.dpdv), closure);
  lobe.roughness = std::max(0.0f, p.exponent);
}

int two_lobes(const ShaderNode&) { return 2; }

}  // namespace

const ShaderSpec kMibIllumLambert = {
    .name = "mib_illum_lambert",
    .library = "base",
    .version = 2,
    .apply = kApplyMaterial,
    .doc = "Lambertian diffuse material.",
    .params = kLambertRows,
    .params_size = sizeof(Lambert),
    .material =
        {
            .fill =
                [](const Call& call, Closure& closure) {
                  shade_diffuse(call.as<Lambert>(), call.point, closure);
                },
        },
};

const ShaderSpec kMibIllumPhong = {
    .name = "mib_illum_phong",
    .library = "base",
    .version = 2,
    .apply = kApplyMaterial,
    .doc = "Diffuse material with Phong highlights of lights.",
    .params = kPhongRows,
    .params_size = sizeof(Phong),
    .material =
        {
            .fill =
                [](const Call& call, Closure& closure) {
                  const auto& p = call.as<Phong>();
                  const Frame frame = shade_diffuse(p, call.point, closure);
                  const Rgb specular = rgb(p.specular);
                  if (is_black(specular)) return;
                  add_highlight(LobeKind::PhongHighlight, specular, frame, closure).roughness =
                      std::max(0.0f, p.exponent);
                },
            .max_lobes = two_lobes,
        },
};

const ShaderSpec kMibIllumBlinn = {
    .name = "mib_illum_blinn",
    .library = "base",
    .version = 2,
    .apply = kApplyMaterial,
    .doc = "Diffuse material with a microfacet highlight of a single index of refraction.",
    .params = kBlinnRows,
    .params_size = sizeof(Blinn),
    .material = {.fill = blinn, .max_lobes = two_lobes},
};

const ShaderSpec kMibIllumCooktorr = {
    .name = "mib_illum_cooktorr",
    .library = "base",
    .version = 2,
    .apply = kApplyMaterial,
    .doc = "Diffuse material with a Cook-Torrance highlight, which shifts in colour.",
    .params = kCooktorrRows,
    .params_size = sizeof(Cooktorr),
    .material = {.fill = cooktorr, .max_lobes = [](const ShaderNode&) { return 4; }},
};

const ShaderSpec kMibIllumWard = {
    .name = "mib_illum_ward",
    .library = "base",
    .version = 1,
    .apply = kApplyMaterial,
    .doc = "Diffuse material with an anisotropic Ward highlight along given directions.",
    .params = kWardRows,
    .params_size = sizeof(Ward),
    .material =
        {
            .fill =
                [](const Call& call, Closure& closure) {
                  const auto& p = call.as<Ward>();
                  ward(p, brushed(p, call.point), call.point, closure);
                },
            .max_lobes = two_lobes,
        },
};

const ShaderSpec kMibIllumWardDeriv = {
    .name = "mib_illum_ward_deriv",
    .library = "base",
    .version = 1,
    .apply = kApplyMaterial,
    .doc =
        "Diffuse material with an anisotropic Ward highlight along the u derivative of "
        "the surface.",
    .params = kWardDerivRows,
    .params_size = sizeof(WardDeriv),
    .material =
        {
            .fill =
                [](const Call& call, Closure& closure) {
                  ward(call.as<WardDeriv>(), call.point.dpdu, call.point, closure);
                },
            .max_lobes = two_lobes,
        },
};

const ShaderSpec kMibIllumHair = {
    .name = "mib_illum_hair",
    .library = "base",
    .version = 1,
    .apply = kApplyMaterial,
    .doc = "Diffuse hair with the highlight of a fibre.",
    .params = kPhongRows,
    .params_size = sizeof(Phong),
    .material = {.fill = hair, .max_lobes = two_lobes},
};

}  // namespace oriel
