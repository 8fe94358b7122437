// SPDX-License-Identifier: Apache-2.0
// Directions of scattered rays.
#ifndef ORIEL_SDK_DIRECTION_H
#define ORIEL_SDK_DIRECTION_H

// Conventions
//   dir is the unit result in internal space; state->dir and state->normal are read. ior_in is the
//   index of the medium of the incoming ray. shiny: about 5 is wide, 100 narrow. Functions with _x
//   take the sample, two numbers in [0,1). miFALSE: total internal reflection.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Mirror direction.
void mi_reflection_dir(miVector* dir, miState* state);
/// Mirror direction.
void mi_reflection_dir_specular(miVector* dir, miState* state);
/// A direction about the mirror direction.
void mi_reflection_dir_glossy(miVector* dir, miState* state, miScalar shiny);
/// Like mi_reflection_dir_glossy with the caller's sample.
void mi_reflection_dir_glossy_x(miVector* dir, miState* state, miScalar shiny,
                                const double sample[2]);
/// A direction about the mirror direction, with different widths along u and v.
void mi_reflection_dir_anisglossy(miVector* dir, miState* state, const miVector* u,
                                  const miVector* v, miScalar shiny_u, miScalar shiny_v);
/// Like mi_reflection_dir_anisglossy with the caller's sample.
void mi_reflection_dir_anisglossy_x(miVector* dir, miState* state, const miVector* u,
                                    const miVector* v, miScalar shiny_u, miScalar shiny_v,
                                    const double sample[2]);
/// A direction about the normal, density cosine / pi.
void mi_reflection_dir_diffuse(miVector* dir, miState* state);
/// Like mi_reflection_dir_diffuse with the caller's sample.
void mi_reflection_dir_diffuse_x(miVector* dir, miState* state, const double sample[2]);
/// Refracted direction by Snell's law.
miBoolean mi_refraction_dir(miVector* dir, miState* state, miScalar ior_in, miScalar ior_out);
/// Refracted direction by Snell's law.
miBoolean mi_transmission_dir_specular(miVector* dir, miState* state, miScalar ior_in,
                                       miScalar ior_out);
/// A direction about the refracted direction.
miBoolean mi_transmission_dir_glossy(miVector* dir, miState* state, miScalar ior_in,
                                     miScalar ior_out, miScalar shiny);
/// Like mi_transmission_dir_glossy with the caller's sample.
miBoolean mi_transmission_dir_glossy_x(miVector* dir, miState* state, miScalar ior_in,
                                       miScalar ior_out, miScalar shiny, const double sample[2]);
/// A direction about the refracted direction, with different widths along u and v.
miBoolean mi_transmission_dir_anisglossy(miVector* dir, miState* state, miScalar ior_in,
                                         miScalar ior_out, const miVector* u, const miVector* v,
                                         miScalar shiny_u, miScalar shiny_v);
/// Like mi_transmission_dir_anisglossy with the caller's sample.
miBoolean mi_transmission_dir_anisglossy_x(miVector* dir, miState* state, miScalar ior_in,
                                           miScalar ior_out, const miVector* u, const miVector* v,
                                           miScalar shiny_u, miScalar shiny_v,
                                           const double sample[2]);
/// A direction about the reversed normal, density cosine / pi.
void mi_transmission_dir_diffuse(miVector* dir, miState* state);
/// Like mi_transmission_dir_diffuse with the caller's sample.
void mi_transmission_dir_diffuse_x(miVector* dir, miState* state, const double sample[2]);
/// A uniformly distributed direction.
void mi_scattering_dir_diffuse(miVector* dir, miState* state);
/// A direction about state->dir; directionality -1 backward, 0 isotropic, 1 forward.
void mi_scattering_dir_directional(miVector* dir, miState* state, miScalar directionality);
/// Distance to the next event in a medium with extinction k per unit of length.
miScalar mi_scattering_pathlength(miState* state, miScalar k);

#ifdef __cplusplus
}
#endif

#endif
