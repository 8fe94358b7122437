// SPDX-License-Identifier: Apache-2.0
// Highlights, Fresnel reflectance and phase functions for shaders.
//
// A light of colour c has the value rho * c on a facing Lambert surface, so values are those of
// bsdf/highlights.h times pi, as in the built-in illumination shaders. Phong's, Blinn's and Cook
// and Torrance's include the cosine of the light, because shaders use them without further factors;
// for Ward's the caller applies it.
#include <cmath>

#include "base/frame.h"
#include "bsdf/fresnel.h"
#include "bsdf/highlights.h"
#include "bsdf/phase.h"
#include "bsdf/phong.h"
#include "bsdf/ward_lobe.h"
#include "oriel/sdk/shader/brdf.h"
#include "sdk/context.h"

namespace {

using oriel::cross;
using oriel::dot;
using oriel::Frame;
using oriel::kPi;
using oriel::Vec3;
using oriel::bsdf::WardLobe;
using oriel::sdk::vec;

/// The two directions in the local frame of the surface, both away from it.
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

float ward(const Local& l, const WardLobe& lobe) { return lobe.relative_to_lambert(l.wo, l.wi); }

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
  return oriel::bsdf::blinn_phong(l.wo, l.wi, exponent);
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

miScalar mi_fresnel(miScalar ior_in, miScalar ior_out, miScalar t1, miScalar t2) {
  return oriel::bsdf::fresnel_from_cosines(ior_in, ior_out, t1, t2);
}

miScalar mi_fresnel_reflection(miState* state, miScalar ior_in, miScalar ior_out) {
  if (!(ior_in > 0 && ior_out > 0)) return 0;
  return oriel::bsdf::fresnel_dielectric(std::abs(state->dot_nd), ior_out / ior_in);
}

miScalar mi_schlick_scatter(const miVector* di, const miVector* dr, miScalar directionality) {
  return oriel::bsdf::SchlickPhase(directionality).eval(dot(vec(*di), vec(*dr)));
}

int mi_choose_lobe(miState* state, miScalar r) { return oriel::sdk::next(state).x < r ? 1 : 0; }
