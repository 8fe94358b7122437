// SPDX-License-Identifier: Apache-2.0
#include "shaders/architectural/mia_material.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/math.h"
#include "bsdf/fresnel.h"
#include "bsdf/gloss.h"
#include "runtime/bump.h"
#include "runtime/closure.h"
#include "runtime/material_outputs.h"
#include "runtime/shader_node.h"
#include "runtime/texture_direction.h"
#include "runtime/world.h"

namespace oriel {
namespace {

Rgb clamped(const Rgba& c) { return Rgb(clamp01(c.r), clamp01(c.g), clamp01(c.b)); }

Rgb saturate(const Rgba& c, bool conserve) { return conserve ? clamped(c) : rgb(c); }

/// The object's x axis, or y if the surface faces along x.
Vec3 object_direction(const ShadingPoint& point) {
  const Vec3 x = point.to_world ? transform_vector(Vec3(1, 0, 0), *point.to_world) : Vec3(1, 0, 0);
  const Vec3 y = point.to_world ? transform_vector(Vec3(0, 1, 0), *point.to_world) : Vec3(0, 1, 0);
  return std::abs(dot(normalize(x), point.normal)) < 0.95f ? x : y;
}

/// Direction of highlight stretching before rotation; the object direction if the selected space
/// has none.
Vec3 stretch_direction(const MiaMaterialParams& p, const ShadingPoint& point) {
  const int space = p.anisotropy_channel;
  Vec3 along(0);
  if (space >= 0)
    along = texture_direction(point, space);
  else if (space == -2)
    along = point.texture_spaces > 0 && point.bump_u[0] != Vec3(0) ? point.bump_u[0]
                                                                   : texture_direction(point, 0);
  else if (space == -3)
    along = point.dpdu;
  else if (space == -4)
    along = point.tex_vector;
  const Vec3 across = cross(along, point.normal);
  constexpr float kMinSine = 1e-4f;
  const bool usable = dot(across, across) > kMinSine * kMinSine * dot(along, along);
  return usable ? along : object_direction(point);
}

Frame stretched_frame(const MiaMaterialParams& p, const ShadingPoint& point, const Vec3& normal) {
  if (p.anisotropy == 1) return Frame(normal);
  const Frame frame = Frame::along(normal, stretch_direction(p, point));
  const float angle = p.anisotropy_rotation * kTwoPi;
  if (angle == 0) return frame;
  const float c = math::cos(angle), s = math::sin(angle);
  return Frame(frame.s * c + frame.t * s, frame.t * c - frame.s * s, normal);
}

struct Normals {
  Vec3 diffuse, specular, base;
};

/// The normal after one bump input. The connected shader gets the normal of the previous bump
/// inputs, and may modify the normal instead of returning a vector.
Vec3 after_bump(const Call& call, std::size_t offset, Vec3 v, const Vec3& normal) {
  ShadingPoint moved = call.point;
  moved.normal = normal;
  if (call.node) call.node->ask(offset, moved, &v);
  if (v == Vec3(0)) return moved.normal;
  return bump_normal(call.point, normal, v, call.as<MiaMaterialParams>().bump_mode);
}

/// The normals after the bump inputs, on the viewer's side.
Normals bumped_normals(const Call& call, bool extended) {
  const MiaMaterialParams& p = call.as<MiaMaterialParams>();
  const ShadingPoint& point = call.point;
  Normals n{point.normal, point.normal, point.normal};
  const bool connected = call.node && call.node->has_connections();
  const auto is_still = [&](std::size_t offset, const Vec3& v) {
    return v == Vec3(0) && !(connected && call.node->source(offset));
  };
  if (extended && p.bump_mode != 0 &&
      is_still(offsetof(MiaMaterialParams, overall_bump), p.overall_bump) &&
      is_still(offsetof(MiaMaterialParams, standard_bump), p.standard_bump) &&
      is_still(offsetof(MiaMaterialParams, refl_base_bump), p.refl_base_bump)) {
    n.diffuse = n.specular = n.base = facing_viewer(point.normal, point);
    return n;
  }
  if (!extended || p.bump_mode == 0) {
    if (p.bump.node && p.bump.node->spec().value) {
      ShadingPoint bumped = point;
      p.bump.node->vector(bumped);
      n.specular = bumped.normal;
      if (!p.no_diffuse_bump) n.diffuse = n.specular;
    }
  } else {
    const Vec3 overall =
        after_bump(call, offsetof(MiaMaterialParams, overall_bump), p.overall_bump, point.normal);
    const Vec3 standard =
        after_bump(call, offsetof(MiaMaterialParams, standard_bump), p.standard_bump, overall);
    n.specular = standard;
    n.diffuse = p.no_diffuse_bump ? overall : standard;
    n.base =
        after_bump(call, offsetof(MiaMaterialParams, refl_base_bump), p.refl_base_bump, overall);
    n.base = facing_viewer(n.base, point);
  }
  n.diffuse = facing_viewer(n.diffuse, point);
  n.specular = facing_viewer(n.specular, point);
  return n;
}

void set_roughness(Lobe& lobe, const bsdf::Roughness& roughness) {
  lobe.alpha_x = roughness.ax;
  lobe.alpha_y = roughness.ay;
}

int grid_density(const MiaMaterialParams& p) { return std::clamp(p.intr_grid_density, 0, 5); }

/// One of the two reflecting layers.
struct ReflectingLayer {
  Rgb level;
  float gloss;
  int samples;
};

LobeControls reflection_controls(const MiaMaterialParams& p, int samples) {
  LobeControls controls;
  controls.samples = static_cast<float>(std::max(samples, 1));
  controls.depth = p.refl_depth;
  controls.cutoff = p.refl_cutoff;
  controls.emulated = p.refl_hl_only;
  controls.single_environment = p.single_env_sample;
  controls.interpolate = p.refl_interpolate;
  controls.grid_density = grid_density(p);
  controls.neighbours = p.intr_refl_samples;
  controls.detail_distance = p.intr_refl_ddist_on ? std::max(0.0f, p.intr_refl_ddist) : 0.0f;
  if (p.refl_falloff_on && p.refl_falloff_dist > 0) {
    controls.falloff_distance = p.refl_falloff_dist;
    controls.falloff_to_color = p.refl_falloff_color_on;
    controls.falloff_color = rgb(p.refl_falloff_color);
  }
  return controls;
}

void add_reflection(const MiaMaterialParams& p, const ReflectingLayer& layer, const Frame& frame,
                    Closure& closure) {
  const bsdf::Roughness roughness = bsdf::gloss_to_roughness(layer.gloss, p.anisotropy);
  const bool mirror = roughness.is_mirror();
  const bool mirror_rays = mirror || layer.samples == 0;
  const LobeControls controls = reflection_controls(p, layer.samples);
  if (mirror_rays) {
    Lobe& lobe = closure.add(LobeKind::Mirror, LobeType::Reflection, layer.level, frame);
    lobe.controls = controls;
    lobe.controls.highlights_only = p.refl_hl_only;
  }
  if (!mirror) {
    // With mirror rays the highlight still uses the glossiness.
    Lobe& lobe = closure.add(LobeKind::GlossyReflection, LobeType::Reflection, layer.level, frame);
    set_roughness(lobe, roughness);
    lobe.controls = controls;
    lobe.controls.highlights_only = p.refl_hl_only || mirror_rays;
    lobe.controls.mirrored = mirror_rays;
  }
}

bool refracts_clearly(const MiaMaterialParams& p, const bsdf::Roughness& roughness) {
  return p.refr_gloss_samples == 0 || roughness.is_mirror();
}

void add_refraction(const MiaMaterialParams& p, const ShadingPoint& point, const Vec3& normal,
                    const Rgb& level, float eta, Closure& closure) {
  if (is_black(level)) return;
  const bsdf::Roughness roughness = bsdf::gloss_to_roughness(p.refr_gloss, p.anisotropy);
  const bool clear = refracts_clearly(p, roughness);
  const LobeKind kind = p.thin_walled
                            ? (clear ? LobeKind::ThinTransmission : LobeKind::GlossyThin)
                            : (clear ? LobeKind::ClearRefraction : LobeKind::GlossyRefraction);
  Lobe& lobe = closure.add(kind, LobeType::Refraction, level, stretched_frame(p, point, normal));
  lobe.eta = eta;
  if (!clear) set_roughness(lobe, roughness);
  lobe.controls.samples = static_cast<float>(std::max(p.refr_gloss_samples, 1));
  lobe.controls.interpolate = p.refr_interpolate;
  lobe.controls.grid_density = grid_density(p);
  lobe.controls.neighbours = p.intr_refr_samples;
  lobe.controls.depth = p.refr_depth;
  lobe.controls.cutoff = p.refr_cutoff;
}

Medium inside_of(const MiaMaterialParams& p) {
  Medium medium;
  if (!p.refr_falloff_on || p.refr_falloff_dist <= 0) return medium;
  if (!p.refr_falloff_color_on) {
    medium.black_distance = p.refr_falloff_dist;
    return medium;
  }
  // falloff_color^(d / dist) = exp(-absorption d); a channel of 0 is opaque at that distance.
  constexpr float kDarkest = 1e-6f;
  for (int i = 0; i < 3; ++i) {
    const float c = (&p.refr_falloff_color.r)[i];
    medium.absorption[i] = -math::log(clamp(c, kDarkest, 1.0f)) / p.refr_falloff_dist;
  }
  return medium;
}

/// Multiplier of the scene's number of diffuse rays (manual 1.6.8.3).
float gather_quality(const MiaMaterialParams& p) {
  return p.fg_quality_w == 0 ? std::max(0.0f, p.fg_quality)
                             : std::max(1.0f, p.fg_quality * p.fg_quality_w);
}

void add_diffuse(const MiaMaterialParams& p, const Rgb& level, const Vec3& normal,
                 Closure& closure) {
  if (is_black(level)) return;
  Lobe& lobe = closure.add(LobeKind::Diffuse, LobeType::Diffuse, level, Frame(normal));
  // Larger values have no effect, but their square would overflow.
  lobe.roughness = clamp(p.diffuse_roughness, 0, 1e3f);
  lobe.controls.samples = gather_quality(p);
  if (!p.ao_on || p.ao_samples <= 0) return;
  closure.occlusion = {p.ao_samples, std::max(0.0f, p.ao_distance), clamped(p.ao_dark),
                       rgb(p.ao_ambient), p.ao_do_details};
}

/// Path-traced pictures have no need of photons behind thin walls and panes, which do not turn
/// light: their shadows stay transparent.
bool passes_straight(const World* world, int instance, bool thin_walled) {
  if (!world || !world->options.traces_paths()) return false;
  if (thin_walled) return true;
  return instance >= 0 && world->instances[static_cast<std::size_t>(instance)].flat_pane;
}

/// The face of a solid that decides about reflection. Rays that were not bent on the way in meet
/// its back at the angle outside of the solid, where nothing is reflected totally: as a front.
bool is_back_for_rays(const ShadingPoint& point, const Closure& closure, bool inside) {
  const bool bent = !point.unbent ||
                    (closure.refractive_caustics && point.world && point.world->options.caustic.on);
  return inside && bent;
}

void shade_mia(const Call& call, Closure& closure, bool extended) {
  const MiaMaterialParams& p = call.as<MiaMaterialParams>();
  ShadingPoint& point = call.point;
  closure.opacity = clamp01(p.cutout_opacity);
  closure.seen_from_back = !p.backface_cull;
  closure.thin_walled = p.thin_walled || p.transparency <= 0;
  closure.refractive_caustics = p.do_refractive_caustics &&
                                !passes_straight(point.world, point.instance, closure.thin_walled);
  closure.propagate_alpha = p.propagate_alpha;
  closure.highlight_scale = std::max(0.0f, p.hl_vs_refl_balance);
  closure.highlights_of_visible_lights = !p.no_visible_area_hl;
  closure.glossiness = clamp01(p.refl_gloss);
  closure.light_mode = p.mode;
  closure.lights = p.lights;
  closure.outputs = !extended || p.multiple_outputs;
  if (closure.opacity == 0) return;

  closure.emission += rgb(p.additional_color);
  closure.indirect_scale = std::max(0.0f, p.indirect_multiplier);
  const Normals n = bumped_normals(call, extended);
  const float cos_view = clamp01(dot(n.specular, point.wo()));
  // Opaque surfaces have no inside, regardless of the orientation of normals (manual 1.6.3).
  const bool inside = point.back_side && !p.thin_walled && p.transparency > 0;
  const MiaLevels levels = mia_levels(p, cos_view, is_back_for_rays(point, closure, inside));

  add_diffuse(p, levels.diffuse, n.diffuse, closure);
  /// Upper limit of a "weak" inner reflection: that of glass except close to total internal
  /// reflection. A guess; the manual gives no number.
  constexpr float kWeak = 0.1f;
  const bool weak_inner = inside && p.skip_inside_refl && !levels.total_reflection &&
                          max_component(levels.reflection) < kWeak;
  if (!weak_inner && !is_black(levels.reflection))
    add_reflection(p, {levels.reflection, p.refl_gloss, p.refl_gloss_samples},
                   stretched_frame(p, point, reflecting_outward(n.specular, point)), closure);
  if (!is_black(levels.base_reflection))
    add_reflection(p, {levels.base_reflection, p.refl_base_gloss, p.refl_base_gloss_samples},
                   stretched_frame(p, point, reflecting_outward(n.base, point)), closure);
  if (p.transparency > 0) {
    const float eta = inside ? 1 / std::max(p.refr_ior, 0.1f) : std::max(p.refr_ior, 0.1f);
    add_refraction(p, point, n.specular, levels.refraction, eta, closure);
    if (!is_black(levels.translucency))
      closure.add(LobeKind::Translucency, LobeType::Translucency, levels.translucency,
                  Frame(n.diffuse));
    closure.inside = inside_of(p);
  }
  closure.albedo = levels.sum();
}

bool mia_may_transmit(const ShaderNode& node) {
  const MiaMaterialParams& p = node.constants<MiaMaterialParams>();
  return p.transparency > 0 || p.cutout_opacity < 1 ||
         node.connected(offsetof(MiaMaterialParams, transparency)) ||
         node.connected(offsetof(MiaMaterialParams, cutout_opacity));
}

/// Without inputs and bumps.
bool mia_straight_by_angle(const ShaderNode& node) {
  const MiaMaterialParams& p = node.constants<MiaMaterialParams>();
  return !node.has_inputs() && !p.bump.node && p.overall_bump == Vec3(0) &&
         p.standard_bump == Vec3(0);
}

/// Of the closure for shadow rays, which were not bent.
StraightLight mia_straight(const ShaderNode& node, const World& world, int instance, float cosine) {
  const MiaMaterialParams& p = node.constants<MiaMaterialParams>();
  StraightLight light{.opacity = clamp01(p.cutout_opacity)};
  const bool thin_walled = p.thin_walled || p.transparency <= 0;
  const bool bends = p.do_refractive_caustics && world.options.caustic.on &&
                     !passes_straight(&world, instance, thin_walled);
  if (light.opacity == 0 || bends || !(p.transparency > 0)) return light;
  light.all = mia_levels(p, clamp01(cosine), false).refraction;
  if (refracts_clearly(p, bsdf::gloss_to_roughness(p.refr_gloss, p.anisotropy)))
    light.clear = light.all;
  light.bounds_medium = !thin_walled && !inside_of(p).clear();
  return light;
}

bool mia_may_emit(const ShaderNode& node) {
  return !is_black(rgb(node.constants<MiaMaterialParams>().additional_color)) ||
         node.connected(offsetof(MiaMaterialParams, additional_color)) ||
         !node.material_inputs().empty();
}

std::optional<Rgb> mia_even_emission(const ShaderNode& node) {
  const MiaMaterialParams& p = node.constants<MiaMaterialParams>();
  if (mia_may_transmit(node) || !node.material_inputs().empty() ||
      node.connected(offsetof(MiaMaterialParams, additional_color)))
    return std::nullopt;
  return rgb(p.additional_color);
}

bool mia_has_outputs(const ShaderNode& node) {
  return node.constants<MiaMaterialParams>().multiple_outputs ||
         node.connected(offsetof(MiaMaterialParams, multiple_outputs));
}

unsigned mia_grids(const ShaderNode& node) {
  const MiaMaterialParams& p = node.constants<MiaMaterialParams>();
  const bool interpolates = p.refl_interpolate || p.refr_interpolate ||
                            node.connected(offsetof(MiaMaterialParams, refl_interpolate)) ||
                            node.connected(offsetof(MiaMaterialParams, refr_interpolate));
  return interpolates ? 1u << grid_density(p) : 0u;
}

int mia_most_lobes(const ShaderNode& node) {
  const MiaMaterialParams& p = node.constants<MiaMaterialParams>();
  // Mirror rays have a separate lobe for the highlight.
  const auto reflects = [&](int samples, std::size_t offset) {
    return samples == 0 || node.connected(offset) ? 2 : 1;
  };
  int lobes = 1 + reflects(p.refl_gloss_samples, offsetof(MiaMaterialParams, refl_gloss_samples));
  if (p.refl_base > 0 || node.connected(offsetof(MiaMaterialParams, refl_base)))
    lobes +=
        reflects(p.refl_base_gloss_samples, offsetof(MiaMaterialParams, refl_base_gloss_samples));
  if (p.transparency > 0 || node.connected(offsetof(MiaMaterialParams, transparency)))
    lobes += p.refr_translucency || node.connected(offsetof(MiaMaterialParams, refr_translucency))
                 ? 2
                 : 1;
  return lobes;
}

/// Colours, followed by one scalar.
constexpr auto kResults = [] {
  std::array<ParamSpec, kMaterialResults> rows{};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ParamType type = i + 1 < rows.size() ? ParamType::Color : ParamType::Scalar;
    rows[i] = {
        .name = kMaterialOutputNames[i], .type = type, .element = type, .offset = i * sizeof(Rgba)};
  }
  return rows;
}();
constexpr std::size_t kResultSize = (kMaterialResults - 1) * sizeof(Rgba) + sizeof(float);

}  // namespace

MiaLevels mia_levels(const MiaMaterialParams& p, float cos_view, bool back_side) {
  MiaLevels out;
  const bool conserve = p.brdf_conserve_energy;
  const auto weight = [&](float w) { return conserve ? clamp01(w) : w; };
  const Rgb diffuse = saturate(p.diffuse, conserve);
  const float ior = std::max(p.refr_ior, 0.1f);

  if (p.reflectivity <= 0 && p.transparency <= 0) {
    // The curve is unused.
  } else if (p.brdf_fresnel) {
    out.curve = bsdf::fresnel_dielectric(cos_view, back_side ? 1 / ior : ior);
    out.total_reflection = out.curve >= 1;
    if (p.thin_walled) out.curve = bsdf::pane_reflectance(out.curve);
  } else {
    out.curve = bsdf::ReflectivityCurve{p.brdf_0_degree_refl, p.brdf_90_degree_refl,
                                        p.brdf_curve}(cos_view);
    const float ratio = back_side ? ior : 1 / ior;
    out.total_reflection = !p.thin_walled && ratio * ratio * (1 - cos_view * cos_view) >= 1;
  }

  // Reflection first. The part it removes is not tinted by the metal colour; otherwise a red metal
  // would leave its complement to the diffuse component.
  Rgb left(1);
  if (p.reflectivity > 0) {
    const Rgb taken =
        saturate(p.refl_color, conserve) * (weight(p.reflectivity) * weight(out.curve));
    out.reflection = p.refl_is_metal ? taken * diffuse : taken;
    if (conserve) left -= taken;
  }
  if (p.refl_base > 0) {
    const Rgb base = saturate(p.refl_base_color, conserve) * weight(p.refl_base);
    out.base_reflection = left * base;
    if (conserve) left *= Rgb(1) - base;
  }

  const float transparency = weight(p.transparency);
  if (transparency > 0) {
    const float translucent = p.refr_translucency ? weight(p.refr_trans_weight) : 0;
    out.refraction = left * saturate(p.refr_color, conserve) * (transparency * (1 - translucent));
    out.translucency = left * saturate(p.refr_trans_color, conserve) * (transparency * translucent);
  }
  out.diffuse = left * diffuse * (weight(p.diffuse_weight) * (conserve ? 1 - transparency : 1));
  return out;
}

const ShaderSpec kMiaMaterial = {
    .name = "mia_material",
    .library = "architectural",
    .version = 4,
    .apply = kApplyMaterial | kApplyPhoton | kApplyShadow,
    .doc =
        "Architectural material: energy-conserving diffuse, glossy reflection, "
        "refraction and translucency.",
    .params = mia_material_rows().first(kMiaMaterialRows),
    .params_size = sizeof(MiaMaterialParams),
    .material = {.fill = [](const Call& call,
                            Closure& closure) { shade_mia(call, closure, false); },
                 .may_transmit = mia_may_transmit,
                 .straight_by_angle = mia_straight_by_angle,
                 .straight = mia_straight,
                 .may_emit = mia_may_emit,
                 .even_emission = mia_even_emission,
                 .max_lobes = mia_most_lobes,
                 .grids = mia_grids},
};

const ShaderSpec kMiaMaterialX = {
    .name = "mia_material_x",
    .library = "architectural",
    .version = 15,
    .apply = kApplyMaterial | kApplyPhoton | kApplyShadow,
    .doc = "Architectural material with vector bump inputs.",
    .params = mia_material_rows(),
    .params_size = sizeof(MiaMaterialParams),
    .result = ParamType::Struct,
    .results = kResults,
    .result_size = kResultSize,
    .material = {.fill = [](const Call& call, Closure& closure) { shade_mia(call, closure, true); },
                 .may_transmit = mia_may_transmit,
                 .straight_by_angle = mia_straight_by_angle,
                 .straight = mia_straight,
                 .may_emit = mia_may_emit,
                 .even_emission = mia_even_emission,
                 .max_lobes = mia_most_lobes,
                 .has_outputs = mia_has_outputs,
                 .grids = mia_grids},
};

const ShaderSpec kMiaMaterialXPasses = [] {
  ShaderSpec spec = kMiaMaterialX;
  spec.name = "mia_material_x_passes";
  spec.version = 1;
  spec.doc = "mia_material_x under the name that hosts with render passes write.";
  return spec;
}();

}  // namespace oriel
