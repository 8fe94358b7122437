// SPDX-License-Identifier: Apache-2.0
// Parameters that the scattering shaders share.
#pragma once

#include "runtime/shader_node.h"
#include "shaders/maya/host_rows.h"

namespace oriel {

struct ScatterParams {
  ShaderRef bump;
  Rgba ambient, overall_color, diffuse_illum, diffuse_color;
  float diffuse_weight;
  Rgba front_sss_color, mid_sss_color, back_sss_color;
  float front_sss_weight, mid_sss_weight, back_sss_weight;
  float front_sss_radius, mid_sss_radius, back_sss_radius, back_sss_depth;
  Rgba specular_illum, specular;
  float exponent;
  float overall_weight, edge_factor;
  Rgba primary_spec_color, secondary_spec_color;
  float primary_weight, primary_edge_weight, primary_shinyness;
  float secondary_weight, secondary_edge_weight, secondary_shinyness;
  float reflect_weight, reflect_edge_weight, reflect_shinyness;
  bool reflect_environment_only, screen_composit, output_sss_only, indirect;
  float scale_conversion, lightmap_size, lightmap_gamma, scatter_bias, falloff;
  int samples, mode;
};

/// Rows of the highlights and reflection of skin.
inline constexpr auto kSkinSpecularRows = about({
    {ORIEL_PARAM(ScatterParams, overall_weight), .fallback = {1}, .min = 0,
     .doc = "Factor of highlights and reflection."},
    {ORIEL_PARAM(ScatterParams, edge_factor), .fallback = {5}, .min = 0,
     .doc = "Exponent of the edge weights: narrowness of the edge."},
    {ORIEL_PARAM(ScatterParams, primary_spec_color), .fallback = {1, 1, 1},
     .doc = "Colour of the first highlight."},
    {ORIEL_PARAM(ScatterParams, primary_weight), .min = 0, .doc = "Weight of the first highlight."},
    {ORIEL_PARAM(ScatterParams, primary_edge_weight), .min = 0,
     .doc = "Additional weight of the first highlight at the edge."},
    {ORIEL_PARAM(ScatterParams, primary_shinyness), .fallback = {20}, .min = 0,
     .doc = "Exponent of the first highlight."},
    {ORIEL_PARAM(ScatterParams, secondary_spec_color), .fallback = {1, 1, 1},
     .doc = "Colour of the second highlight."},
    {ORIEL_PARAM(ScatterParams, secondary_weight), .min = 0,
     .doc = "Weight of the second highlight."},
    {ORIEL_PARAM(ScatterParams, secondary_edge_weight), .min = 0,
     .doc = "Additional weight of the second highlight at the edge."},
    {ORIEL_PARAM(ScatterParams, secondary_shinyness), .fallback = {20}, .min = 0,
     .doc = "Exponent of the second highlight."},
    {ORIEL_PARAM(ScatterParams, reflect_weight), .min = 0, .max = 1, .doc = "Reflectivity."},
    {ORIEL_PARAM(ScatterParams, reflect_edge_weight), .min = 0, .max = 1,
     .doc = "Additional reflectivity at the edge."},
    {ORIEL_PARAM(ScatterParams, reflect_shinyness), .min = 0,
     .doc = "Exponent of the reflection; 0 = mirror."},
    {ORIEL_PARAM(ScatterParams, reflect_environment_only),
     .doc = "Whether only the environment is reflected.", .support = Support::Ignored},
});

/// Adds highlights and reflection of skin; returns the share of light that they leave.
Rgb add_skin_specular(const Call& call, const ScatterParams& p, const Vec3& normal,
                      Closure& closure);

/// Lobes that add_skin_specular() adds at most.
inline constexpr int kSkinSpecularLobes = 3;

}  // namespace oriel
