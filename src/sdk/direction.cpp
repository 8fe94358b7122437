// SPDX-License-Identifier: Apache-2.0
// Directions of scattered rays and photons: mirror, refraction, glossy and diffuse sampling, phase
// functions.
#include <cmath>

#include "base/frame.h"
#include "bsdf/fresnel.h"
#include "bsdf/phase.h"
#include "bsdf/ward_lobe.h"
#include "oriel/sdk/shader/direction.h"
#include "sampling/warp.h"
#include "sdk/context.h"

namespace {

using oriel::cross;
using oriel::dot;
using oriel::Frame;
using oriel::normalize;
using oriel::Vec2;
using oriel::Vec3;
using oriel::bsdf::WardLobe;
using oriel::sdk::vec;

/// The sample of the shader as floats below 1, since a double just below 1 rounds to 1.
Vec2 pair(const double sample[2]) {
  constexpr double kMax = 0x1.fffffep-1;
  return Vec2(static_cast<float>(std::fmin(std::fmax(sample[0], 0.0), kMax)),
              static_cast<float>(std::fmin(std::fmax(sample[1], 0.0), kMax)));
}

/// The normal on the side of the incoming ray.
Vec3 facing_normal(const miState* state) {
  const Vec3 n = vec(state->normal);
  return dot(n, vec(state->dir)) > 0 ? -n : n;
}

Vec3 mirrored(const miState* state) {
  const Vec3 d = vec(state->dir), n = vec(state->normal);
  return normalize(d - n * (2 * dot(d, n)));
}

/// The axis of u, or the one perpendicular to v; null if both are equal.
Vec3 brushed(const miVector* u, const miVector* v, const Vec3& normal) {
  const Vec3 along = u ? vec(*u) : Vec3(0);
  return along == Vec3(0) && v ? cross(vec(*v), normal) : along;
}

/// Samples a direction about the mirror direction of a ray along `incoming`.
Vec3 spread(const Vec3& incoming, const Vec3& normal, const Vec3& along, const WardLobe& lobe,
            Vec2 u) {
  const Frame frame = Frame::along(normal, along);
  return normalize(frame.to_world(lobe.sample(frame.to_local(-incoming), u)));
}

/// Like spread(), about the refracted direction: uses the reflection lobe whose mirror direction is
/// the image of the refracted direction, mirrored to the far side. Its width does not shrink for
/// equal indices, unlike refraction at microfacets.
miBoolean spread_through(miVector* dir, miState* state, miScalar ior_in, miScalar ior_out,
                         const Vec3& along, const WardLobe& lobe, Vec2 u) {
  if (!mi_refraction_dir(dir, state, ior_in, ior_out)) return miFALSE;
  const Vec3 n = facing_normal(state);
  const Vec3 image = spread(vec(*dir), n, along, lobe, u);
  *dir = oriel::sdk::as_c(normalize(image - n * (2 * dot(image, n))));
  return miTRUE;
}

}  // namespace

void mi_reflection_dir(miVector* dir, miState* state) { *dir = oriel::sdk::as_c(mirrored(state)); }

void mi_reflection_dir_specular(miVector* dir, miState* state) { mi_reflection_dir(dir, state); }

void mi_reflection_dir_glossy_x(miVector* dir, miState* state, miScalar shiny,
                                const double sample[2]) {
  *dir = oriel::sdk::as_c(
      spread(vec(state->dir), facing_normal(state), Vec3(0), WardLobe(shiny, shiny), pair(sample)));
}

void mi_reflection_dir_glossy(miVector* dir, miState* state, miScalar shiny) {
  const Vec2 u = oriel::sdk::next(state);
  const double sample[2] = {u.x, u.y};
  mi_reflection_dir_glossy_x(dir, state, shiny, sample);
}

void mi_reflection_dir_anisglossy_x(miVector* dir, miState* state, const miVector* u,
                                    const miVector* v, miScalar shiny_u, miScalar shiny_v,
                                    const double sample[2]) {
  const Vec3 n = facing_normal(state);
  *dir = oriel::sdk::as_c(
      spread(vec(state->dir), n, brushed(u, v, n), WardLobe(shiny_u, shiny_v), pair(sample)));
}

void mi_reflection_dir_anisglossy(miVector* dir, miState* state, const miVector* u,
                                  const miVector* v, miScalar shiny_u, miScalar shiny_v) {
  const Vec2 s = oriel::sdk::next(state);
  const double sample[2] = {s.x, s.y};
  mi_reflection_dir_anisglossy_x(dir, state, u, v, shiny_u, shiny_v, sample);
}

void mi_reflection_dir_diffuse_x(miVector* dir, miState* state, const double sample[2]) {
  const Frame frame(facing_normal(state));
  *dir = oriel::sdk::as_c(
      normalize(frame.to_world(oriel::sampling::sample_cosine_hemisphere(pair(sample)))));
}

void mi_reflection_dir_diffuse(miVector* dir, miState* state) {
  const Vec2 u = oriel::sdk::next(state);
  const double sample[2] = {u.x, u.y};
  mi_reflection_dir_diffuse_x(dir, state, sample);
}

miBoolean mi_refraction_dir(miVector* dir, miState* state, miScalar ior_in, miScalar ior_out) {
  // Unset indices mean no refraction.
  const bool sensible = ior_in > 0 && ior_out > 0;
  const auto through = oriel::bsdf::refract(-vec(state->dir), facing_normal(state),
                                            sensible ? ior_out / ior_in : 1.0f);
  // For shaders that ignore the return value.
  *dir = oriel::sdk::as_c(through ? normalize(*through) : mirrored(state));
  return through ? miTRUE : miFALSE;
}

miBoolean mi_transmission_dir_specular(miVector* dir, miState* state, miScalar ior_in,
                                       miScalar ior_out) {
  return mi_refraction_dir(dir, state, ior_in, ior_out);
}

miBoolean mi_transmission_dir_glossy_x(miVector* dir, miState* state, miScalar ior_in,
                                       miScalar ior_out, miScalar shiny, const double sample[2]) {
  return spread_through(dir, state, ior_in, ior_out, Vec3(0), WardLobe(shiny, shiny), pair(sample));
}

miBoolean mi_transmission_dir_glossy(miVector* dir, miState* state, miScalar ior_in,
                                     miScalar ior_out, miScalar shiny) {
  return spread_through(dir, state, ior_in, ior_out, Vec3(0), WardLobe(shiny, shiny),
                        oriel::sdk::next(state));
}

miBoolean mi_transmission_dir_anisglossy_x(miVector* dir, miState* state, miScalar ior_in,
                                           miScalar ior_out, const miVector* u, const miVector* v,
                                           miScalar shiny_u, miScalar shiny_v,
                                           const double sample[2]) {
  return spread_through(dir, state, ior_in, ior_out, brushed(u, v, facing_normal(state)),
                        WardLobe(shiny_u, shiny_v), pair(sample));
}

miBoolean mi_transmission_dir_anisglossy(miVector* dir, miState* state, miScalar ior_in,
                                         miScalar ior_out, const miVector* u, const miVector* v,
                                         miScalar shiny_u, miScalar shiny_v) {
  return spread_through(dir, state, ior_in, ior_out, brushed(u, v, facing_normal(state)),
                        WardLobe(shiny_u, shiny_v), oriel::sdk::next(state));
}

void mi_transmission_dir_diffuse_x(miVector* dir, miState* state, const double sample[2]) {
  const Frame frame(-facing_normal(state));
  *dir = oriel::sdk::as_c(
      normalize(frame.to_world(oriel::sampling::sample_cosine_hemisphere(pair(sample)))));
}

void mi_transmission_dir_diffuse(miVector* dir, miState* state) {
  const Vec2 u = oriel::sdk::next(state);
  const double sample[2] = {u.x, u.y};
  mi_transmission_dir_diffuse_x(dir, state, sample);
}

void mi_scattering_dir_diffuse(miVector* dir, miState* state) {
  *dir = oriel::sdk::as_c(oriel::sampling::sample_uniform_sphere(oriel::sdk::next(state)));
}

void mi_scattering_dir_directional(miVector* dir, miState* state, miScalar directionality) {
  const Vec3 local = oriel::bsdf::SchlickPhase(directionality).sample(oriel::sdk::next(state));
  *dir = oriel::sdk::as_c(normalize(Frame(normalize(vec(state->dir))).to_world(local)));
}

miScalar mi_scattering_pathlength(miState* state, miScalar k) {
  if (!(k > 0)) return miHUGE_SCALAR;
  return oriel::bsdf::sample_free_path(oriel::sdk::next(state).x, k);
}
