// SPDX-License-Identifier: Apache-2.0
#include "shaders/oriel/oriel_layers.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "bsdf/sheen.h"
#include "bsdf/thin_film.h"
#include "runtime/bump.h"
#include "runtime/shade_input.h"

namespace oriel {
namespace {

struct SheenLayer {
  ShaderRef base_material;
  Rgba color;
  float roughness;
};
struct ThinFilm {
  Rgba reflectance;
  float factor, ior, thickness;
};

constexpr ParamSpec kOrielSheenRows[] = {
    {ORIEL_PARAM(SheenLayer, base_material), .doc = "Material below.", .takes_material = true},
    {ORIEL_PARAM(SheenLayer, color), .fallback = {1, 1, 1, 1}, .doc = "Colour of the sheen."},
    {ORIEL_PARAM(SheenLayer, roughness), .fallback = {.5f}, .min = 0, .max = 1,
     .doc = "Width of the sheen; near 0 it is at the edges only."},
};
constexpr ParamSpec kOrielThinFilmRows[] = {
    {ORIEL_PARAM(ThinFilm, reflectance), .fallback = {.04f, .04f, .04f, 1},
     .doc = "Reflectance of the surface below at normal incidence."},
    {ORIEL_PARAM(ThinFilm, factor), .fallback = {1}, .min = 0, .max = 1,
     .doc = "Covered part of the surface."},
    {ORIEL_PARAM(ThinFilm, ior), .fallback = {1.3f}, .min = 1, .max = 10,
     .doc = "Index of refraction of the film."},
    {ORIEL_PARAM(ThinFilm, thickness), .fallback = {400}, .min = 0, .unit = "nm",
     .doc = "Thickness of the film."},
};

Rgb limited(const Rgba& c) { return Rgb(clamp01(c.r), clamp01(c.g), clamp01(c.b)); }

void add_sheen(const Call& call, Closure& closure) {
  const auto& p = call.as<SheenLayer>();
  const Vec3 normal = facing_viewer(call.point.normal, call.point);
  const Rgb color = limited(p.color);
  const float alpha = std::max(sqr(clamp01(p.roughness)), bsdf::kMinSheenAlpha);
  const float whole = bsdf::sheen_albedo(alpha, dot(normal, call.point.wo()));
  const float albedo = std::min(whole, 1.0f);
  shade_input(call, offsetof(SheenLayer, base_material), p.base_material,
              Rgb(1 - max_component(color) * albedo), closure);
  if (is_black(color)) return;
  // At grazing angles narrow sheen would reflect more than it receives.
  Lobe& lobe = closure.add(LobeKind::Sheen, LobeType::Reflection,
                           color * (whole > 1 ? 1 / whole : 1.0f), Frame(normal));
  lobe.roughness = alpha;
  lobe.alpha_x = lobe.alpha_y = 1;  // its rays spread as those of the roughest reflection
  closure.albedo += color * albedo;
}

void give_film(const Call& call, void* result) {
  const auto& p = call.as<ThinFilm>();
  const Rgb base = limited(p.reflectance);
  const float cosine = clamp01(dot(facing_viewer(call.point.normal, call.point), call.point.wo()));
  const Rgb bare = base + (Rgb(1) - base) * math::pow(1 - cosine, 5);
  const Rgb film =
      bsdf::thin_film_color(cosine, std::max(p.ior, 1.0f), base, std::max(p.thickness, 0.0f));
  const Rgb color = bare + (film - bare) * clamp01(p.factor);
  *static_cast<Rgba*>(result) = {color.x, color.y, color.z, p.reflectance.a};
}

}  // namespace

const ShaderSpec kOrielSheen = {
    .name = "oriel_sheen",
    .library = "oriel",
    .apply = kApplyMaterial | kApplyTexture,
    .doc = "Sheen of cloth over another material.",
    .params = kOrielSheenRows,
    .params_size = sizeof(SheenLayer),
    .material = {.fill = add_sheen,
                 .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); }},
};

const ShaderSpec kOrielThinFilm = {
    .name = "oriel_thin_film",
    .library = "oriel",
    .apply = kApplyTexture,
    .doc = "Reflectance of a surface with a thin film, whose colour changes with the angle.",
    .params = kOrielThinFilmRows,
    .params_size = sizeof(ThinFilm),
    .value = give_film,
};

}  // namespace oriel
