// SPDX-License-Identifier: Apache-2.0
// Highlights, Fresnel reflectance and phase functions.
#ifndef ORIEL_SDK_BRDF_H
#define ORIEL_SDK_BRDF_H

// Conventions
//   di points to the surface, dr and n away from it; all unit vectors in internal space. Ward's
//   values exclude the cosine: callers multiply by dot_nl. The others include the cosine of the
//   light.

#include "state.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Phong: cosine between the mirrored view and `dir` (to the light) to the power of exponent.
miScalar mi_phong_specular(miScalar exponent, miState* state, const miVector* dir);
/// Blinn's highlight with Torrance-Sparrow facets.
miScalar mi_blinn_specular(const miVector* di, const miVector* dr, const miVector* n,
                           miScalar roughness, miScalar ior);
/// Like mi_phong_specular, with the cosine between the normal and the half vector.
miScalar mi_blong_specular(miScalar exponent, miState* state, const miVector* dir);
/// Cook-Torrance; ior is relative and per channel, 1 or more. Returns miFALSE without a highlight.
miBoolean mi_cooktorr_specular(miColor* result, const miVector* di, const miVector* dr,
                               const miVector* n, miScalar roughness, const miColor* ior);
/// Phong value ns and Fresnel reflectance ks of a highlight towards `dir`.
void mi_fresnel_specular(miScalar* ns, miScalar* ks, miScalar exponent, miState* state,
                         const miVector* dir, miScalar ior_in, miScalar ior_out);
/// Ward's isotropic lobe.
miScalar mi_ward_glossy(const miVector* di, const miVector* dr, const miVector* n, miScalar shiny);
/// Ward's lobe with different widths along u and v.
miScalar mi_ward_anisglossy(const miVector* di, const miVector* dr, const miVector* n,
                            const miVector* u, const miVector* v, miScalar shiny_u,
                            miScalar shiny_v);
/// Reflectance for unpolarised light; t1, t2: cosines to the normal on both sides.
miScalar mi_fresnel(miScalar ior_in, miScalar ior_out, miScalar t1, miScalar t2);
/// Reflectance for unpolarised light for the ray of state (uses dot_nd).
miScalar mi_fresnel_reflection(miState* state, miScalar ior_in, miScalar ior_out);
/// Schlick's phase function, per solid angle.
miScalar mi_schlick_scatter(const miVector* di, const miVector* dr, miScalar directionality);
/// Returns 0 or 1: the first lobe with probability r.
int mi_choose_lobe(miState* state, miScalar r);
/// Sum of r, g, b weighted by the luminance weights of the options.
miScalar mi_luminance(const miState* state, const miColor* color);

#ifdef __cplusplus
}
#endif

#endif
