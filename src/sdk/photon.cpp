// SPDX-License-Identifier: Apache-2.0
// Photon functions for user shaders.
#include <algorithm>

#include "sdk/call.h"
#include "sdk/once.h"

namespace oriel::sdk {
namespace {

bool send(RayKind kind, miColor* energy, miState* state, const Vec3& direction) {
  PhotonNext* photon = context(state).photon;
  return photon && state->options->trace && photon->send(kind, rgb(*energy), direction);
}

float sum(const miColor& c) { return c.r + c.g + c.b; }
void scale(miColor* c, float factor) { c->r *= factor, c->g *= factor, c->b *= factor; }

/// One of several scattering types, selected by Russian roulette.
struct Scatter {
  miRay_type type;
  miColor* color;
  float share;  ///< probability share of the scattered photons
};

/// Selects a type in proportion to the largest channel of its colour; the selected colour is
/// divided by the probability, which makes the estimate unbiased.
template <std::size_t N>
miRay_type choose(miState* state, const Scatter (&kinds)[N]) {
  float most = 0, all = 0;
  for (float miColor::*channel : {&miColor::r, &miColor::g, &miColor::b}) {
    float channel_sum = 0;
    for (const Scatter& k : kinds) channel_sum += k.color->*channel * k.share;
    most = std::max(most, channel_sum);
  }
  for (const Scatter& k : kinds) all += sum(*k.color) * k.share;
  if (all <= 0) return miPHOTON_ABSORB;
  most = std::min(most, 1.0f);
  float u = next(state).x;
  for (const Scatter& k : kinds) {
    const float chance = most * sum(*k.color) * k.share / all;
    if (u < chance) {
      scale(k.color, k.share / chance);
      return k.type;
    }
    u -= chance;
  }
  return miPHOTON_ABSORB;
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miBoolean mi_photon_light(miColor* energy, miState* state) {
  PhotonEmission* emission = context(state).emission;
  if (!emission) return miFALSE;
  emission->send(rgb(*energy), vec(state->org), normalize(vec(state->dir)));
  return miTRUE;
}

miBoolean mi_photon_reflection_specular(miColor* energy, miState* state, const miVector* dir) {
  return send(RayKind::PhotonReflectSpecular, energy, state, vec(*dir)) ? miTRUE : miFALSE;
}
miBoolean mi_photon_reflection_glossy(miColor* energy, miState* state, const miVector* dir) {
  return send(RayKind::PhotonReflectGlossy, energy, state, vec(*dir)) ? miTRUE : miFALSE;
}
miBoolean mi_photon_reflection_diffuse(miColor* energy, miState* state, const miVector* dir) {
  return send(RayKind::PhotonReflectDiffuse, energy, state, vec(*dir)) ? miTRUE : miFALSE;
}
miBoolean mi_photon_transmission_specular(miColor* energy, miState* state, const miVector* dir) {
  return send(RayKind::PhotonTransmitSpecular, energy, state, vec(*dir)) ? miTRUE : miFALSE;
}
miBoolean mi_photon_transmission_glossy(miColor* energy, miState* state, const miVector* dir) {
  return send(RayKind::PhotonTransmitGlossy, energy, state, vec(*dir)) ? miTRUE : miFALSE;
}
miBoolean mi_photon_transmission_diffuse(miColor* energy, miState* state, const miVector* dir) {
  return send(RayKind::PhotonTransmitDiffuse, energy, state, vec(*dir)) ? miTRUE : miFALSE;
}
miBoolean mi_photon_transparent(miColor* energy, miState* state) {
  return send(RayKind::PhotonTransparent, energy, state, vec(state->dir)) ? miTRUE : miFALSE;
}
// Photons in volumes are unsupported.
miBoolean mi_photon_volume_scattering(miColor*, miState*, const miVector*) {
  warn_no_effect("mi_photon_volume_scattering", "photons are not scattered in volumes");
  return miFALSE;
}
miBoolean mi_store_volume_photon(miColor*, miState*) {
  warn_no_effect("mi_store_volume_photon", "photons are not stored in volumes");
  return miFALSE;
}

miBoolean mi_store_photon(miColor* energy, miState* state) {
  PhotonNext* photon = context(state).photon;
  if (!photon) return miFALSE;
  photon->store(rgb(*energy));
  return miTRUE;
}

miRay_type mi_choose_scatter_type(miState* state, miScalar transp, miColor* diffuse,
                                  miColor* glossy, miColor* specular) {
  const float through = std::clamp(transp, 0.0f, 1.0f), back = 1 - through;
  const Scatter kinds[] = {
      {miPHOTON_REFLECT_DIFFUSE, diffuse, back},   {miPHOTON_REFLECT_GLOSSY, glossy, back},
      {miPHOTON_REFLECT_SPECULAR, specular, back}, {miPHOTON_TRANSMIT_DIFFUSE, diffuse, through},
      {miPHOTON_TRANSMIT_GLOSSY, glossy, through}, {miPHOTON_TRANSMIT_SPECULAR, specular, through}};
  return choose(state, kinds);
}

miRay_type mi_choose_simple_scatter_type(miState* state, miColor* rdiff, miColor* rspec,
                                         miColor* tdiff, miColor* tspec) {
  const Scatter kinds[] = {{miPHOTON_REFLECT_DIFFUSE, rdiff, 1},
                           {miPHOTON_REFLECT_SPECULAR, rspec, 1},
                           {miPHOTON_TRANSMIT_DIFFUSE, tdiff, 1},
                           {miPHOTON_TRANSMIT_SPECULAR, tspec, 1}};
  return choose(state, kinds);
}

}  // extern "C"
