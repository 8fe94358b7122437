// SPDX-License-Identifier: Apache-2.0
// Highlights, Fresnel's shares and phase functions for shaders.
//
// A light of colour c shows rho * c on a Lambert surface that faces it, so values are those of
// bsdf/highlights.h times pi: shaders that copy the renderer's own illumination shaders look as
// these. Phong's, Blinn's and Cook and Torrance's include the light's cosine, since shaders take
// them as they come; Ward's leave it to the caller.
#include <algorithm>
#include <cmath>

#include "base/frame.h"
#include "base/math.h"
#include "bsdf/fresnel.h"
#include "bsdf/highlights.h"
#include "bsdf/phong.h"
#include "oriel/sdk/shader/brdf.h"
#include "sdk/context.h"
#include "sdk/ward_lobe.h"

namespace {

using oriel::cross;
using oriel::dot;
using oriel::Frame;
using oriel::kPi;
using oriel::normalize;
using oriel::Vec3;
using oriel::sdk::vec;
using oriel::sdk::WardLobe;

/// The two directions in the frame of the surface, both away from it.
struct Local {
  Vec3 wo, wi;
  Local(const miVector* di, const miVector* dr, const Vec3& n, const Vec3& along = Vec3(0)) {
    const Frame frame = Frame::along(n, along);
    wo = frame.to_local(-vec(*di));
    wi = frame.to_local(vec(*dr));
  }
};

float torrance(const Local& l, float roughness, float ior) {
  return kPi * oriel::bsdf::TorranceHighlight{roughness, ior}.eval(l.wo, l.wi);
}

float ward(const Local& l, const WardLobe& lobe) {
  const float value = oriel::bsdf::WardHighlight{lobe.alpha_x(), lobe.alpha_y()}.eval(l.wo, l.wi);
  return value > 0 ? kPi * value / l.wi.z : 0;
}

}  // namespace

miScalar mi_phong_specular(miScalar exponent, miState* state, const miVector* dir) {
  const Local l(&state->dir, dir, vec(state->normal));
  return kPi * oriel::bsdf::PhongHighlight{exponent}.eval(l.wo, l.wi);
}

miScalar mi_blinn_specular(const miVector* di, const miVector* dr, const miVector* n,
                           miScalar roughness, miScalar ior) {
  return torrance(Local(di, dr, vec(*n)), roughness, ior);
}

miScalar mi_blong_specular(miScalar exponent, miState* state, const miVector* dir) {
  const Local l(&state->dir, dir, vec(state->normal));
  if (l.wo.z <= 0 || l.wi.z <= 0) return 0;
  return oriel::math::pow(std::max(0.0f, normalize(l.wo + l.wi).z), exponent);
}

miBoolean mi_cooktorr_specular(miColor* result, const miVector* di, const miVector* dr,
                               const miVector* n, miScalar roughness, const miColor* ior) {
  const Local l(di, dr, vec(*n));
  result->r = torrance(l, roughness, ior->r);
  result->g = ior->g == ior->r ? result->r : torrance(l, roughness, ior->g);
  result->b = ior->b == ior->g ? result->g : torrance(l, roughness, ior->b);
  result->a = 1;
  return result->r > 0 || result->g > 0 || result->b > 0 ? miTRUE : miFALSE;
}

void mi_fresnel_specular(miScalar* ns, miScalar* ks, miScalar exponent, miState* state,
                         const miVector* dir, miScalar ior_in, miScalar ior_out) {
  *ns = mi_phong_specular(exponent, state, dir);
  *ks = mi_fresnel_reflection(state, ior_in, ior_out);
}

miScalar mi_ward_glossy(const miVector* di, const miVector* dr, const miVector* n, miScalar shiny) {
  return ward(Local(di, dr, vec(*n)), WardLobe(shiny, shiny));
}

miScalar mi_ward_anisglossy(const miVector* di, const miVector* dr, const miVector* n,
                            const miVector* u, const miVector* v, miScalar shiny_u,
                            miScalar shiny_v) {
  const Vec3 normal = vec(*n), along = vec(*u);
  const Vec3 axis = along == Vec3(0) ? cross(vec(*v), normal) : along;
  return ward(Local(di, dr, normal, axis), WardLobe(shiny_u, shiny_v));
}

// Fresnel's equations, from both cosines.
miScalar mi_fresnel(miScalar ior_in, miScalar ior_out, miScalar t1, miScalar t2) {
  const float s = ior_in * t1 + ior_out * t2, p = ior_out * t1 + ior_in * t2;
  if (s == 0 || p == 0) return 1;
  return 0.5f * (oriel::sqr((ior_in * t1 - ior_out * t2) / s) +
                 oriel::sqr((ior_out * t1 - ior_in * t2) / p));
}

miScalar mi_fresnel_reflection(miState* state, miScalar ior_in, miScalar ior_out) {
  if (!(ior_in > 0 && ior_out > 0)) return 0;
  return oriel::bsdf::fresnel_dielectric(std::abs(state->dot_nd), ior_out / ior_in);
}

// (1 - k^2) / (4 pi (1 - k cos)^2): Blasi, Le Saec, Schlick, "A Rendering Algorithm for Discrete
// Volume Density Objects", Eurographics 1993, with the sign that makes k > 0 scatter ahead.
miScalar mi_schlick_scatter(const miVector* di, const miVector* dr, miScalar directionality) {
  const float k = oriel::clamp(directionality, -0.9999f, 0.9999f);
  return (1 - k * k) / (4 * kPi * oriel::sqr(1 - k * dot(vec(*di), vec(*dr))));
}

int mi_choose_lobe(miState* state, miScalar r) { return oriel::sdk::next(state).x < r ? 1 : 0; }
