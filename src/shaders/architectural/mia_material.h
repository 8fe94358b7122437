// SPDX-License-Identifier: Apache-2.0
// mia_material, mia_material_x, mia_material_x_passes: the architectural material.
//
// Diffuse (Oren-Nayar), glossy anisotropic reflection and refraction, translucency. Energy is
// distributed in the order of the manual: reflection first, then transparency, the rest is diffuse.
// The shader converts parameters to a Closure; it traces no rays.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

struct MiaMaterialParams {
  float diffuse_weight;
  Rgba diffuse;
  float diffuse_roughness;
  float reflectivity;
  Rgba refl_color;
  float refl_gloss;
  int refl_gloss_samples;
  bool refl_interpolate;
  bool refl_hl_only;
  bool refl_is_metal;
  float transparency;
  Rgba refr_color;
  float refr_gloss;
  float refr_ior;
  int refr_gloss_samples;
  bool refr_interpolate;
  bool refr_translucency;
  Rgba refr_trans_color;
  float refr_trans_weight;
  float anisotropy;
  float anisotropy_rotation;
  int anisotropy_channel;
  bool brdf_fresnel;
  float brdf_0_degree_refl;
  float brdf_90_degree_refl;
  float brdf_curve;
  bool brdf_conserve_energy;
  int intr_grid_density;
  int intr_refl_samples;
  bool intr_refl_ddist_on;
  float intr_refl_ddist;
  int intr_refr_samples;
  bool single_env_sample;
  bool refl_falloff_on;
  float refl_falloff_dist;
  bool refl_falloff_color_on;
  Rgba refl_falloff_color;
  int refl_depth;
  float refl_cutoff;
  bool refr_falloff_on;
  float refr_falloff_dist;
  bool refr_falloff_color_on;
  Rgba refr_falloff_color;
  int refr_depth;
  float refr_cutoff;
  float indirect_multiplier;
  float fg_quality;
  float fg_quality_w;
  bool ao_on;
  int ao_samples;
  float ao_distance;
  Rgba ao_dark;
  Rgba ao_ambient;
  int ao_do_details;
  bool thin_walled;
  bool no_visible_area_hl;
  bool skip_inside_refl;
  bool do_refractive_caustics;
  bool backface_cull;
  bool propagate_alpha;
  float hl_vs_refl_balance;
  float cutout_opacity;
  Rgba additional_color;
  ShaderRef bump;
  bool no_diffuse_bump;
  int mode;
  ArrayView<LightRef> lights;
  // Parameters of the extended interface.
  int bump_mode;
  Vec3 overall_bump;
  Vec3 standard_bump;
  bool multiple_outputs;
  // Parameters of later editions.
  float refl_base;
  Rgba refl_base_color;
  float refl_base_gloss;
  int refl_base_gloss_samples;
  Vec3 refl_base_bump;
};

/// All rows in the order of declaration; mia_material has the first kMiaMaterialRows of them.
std::span<const ParamSpec> mia_material_rows();
inline constexpr std::size_t kMiaMaterialRows = 67;

/// Weights of the components at one angle, per colour channel.
struct MiaLevels {
  Rgb reflection{0}, base_reflection{0}, refraction{0}, translucency{0}, diffuse{0};
  float curve = 0;  ///< reflectivity of the angle curve only
  bool total_reflection = false;
  Rgb sum() const { return reflection + base_reflection + refraction + translucency + diffuse; }
};

/// The energy rules of the manual's sections 1.4.2 and 1.4.3.
///
/// Inputs:  cos_view: cosine between shading normal and view, 0..1; back_side: seen from inside.
/// Returns: the weights of all components; their sum is at most 1 if brdf_conserve_energy is on.
///          The base layer reflects light that passes the first layer, before transparency.
/// Source:  manual 1.4.2, written as equations. Thin walls in Fresnel mode reflect like a pane with
///          two faces, R = 2r/(1+r), because one sheet represents both. The position of the base
///          layer is a guess, since its parameters are undocumented.
/// Checked: MiaLevels.*, MaterialContract.ConservesEnergy.
MiaLevels mia_levels(const MiaMaterialParams& p, float cos_view, bool back_side);

extern const ShaderSpec kMiaMaterial;
extern const ShaderSpec kMiaMaterialX;
extern const ShaderSpec kMiaMaterialXPasses;

}  // namespace oriel
