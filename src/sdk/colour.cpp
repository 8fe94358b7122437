// SPDX-License-Identifier: Apache-2.0
// Luminance, and conversion between colour spaces that shaders name. The rendering and picture
// colour spaces are both linear Rec. 709 with white D65.
#include "color/luminance.h"
#include "color/srgb.h"
#include "oriel/sdk/shader/brdf.h"
#include "oriel/sdk/shader/call.h"

namespace {

oriel::Rgb channels(const miColor& c) { return oriel::Rgb(c.r, c.g, c.b); }

void set(miColor* color, float r, float g, float b) {
  color->r = r;
  color->g = g;
  color->b = b;
}

}  // namespace

miScalar mi_luminance(const miState* state, const miColor* color) {
  const oriel::Rgb weights = state && state->options ? channels(state->options->luminance_weight)
                                                     : oriel::kRec709Luminance;
  return oriel::luminance(channels(*color), weights);
}

void mi_colorprofile_ciexyz_to_internal(miColor* color) {
  const oriel::Rgb c = oriel::xyz_to_linear_srgb(oriel::Vec3(color->r, color->g, color->b));
  set(color, c.x, c.y, c.z);
}

void mi_colorprofile_internal_to_ciexyz(miColor* color) {
  const oriel::Vec3 xyz = oriel::linear_srgb_to_xyz(channels(*color));
  set(color, xyz.x, xyz.y, xyz.z);
}

void mi_colorprofile_ciexyz_to_render(miColor* color) { mi_colorprofile_ciexyz_to_internal(color); }
void mi_colorprofile_render_to_ciexyz(miColor* color) { mi_colorprofile_internal_to_ciexyz(color); }
void mi_colorprofile_internal_to_render(miColor* /*color*/) {}
void mi_colorprofile_render_to_internal(miColor* /*color*/) {}
