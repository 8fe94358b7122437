// SPDX-License-Identifier: Apache-2.0
// The share of light that a rough dielectric boundary reflects.
#pragma once

namespace oriel::bsdf {

/// Directional albedo of FacetReflection(alpha, alpha, eta).
///
/// Model:   a table over the roots of cosine and alpha and the cube root of (eta - 1) / (eta + 1),
///          sampled at the first call.
/// Inputs:  eta: 1 to 10.
/// Checked: FacetReflection.AlbedoIsTheIntegral: error at most .01; .02 nearer the horizon than 8
/// degrees.
float facet_albedo(float alpha, float eta, float cosine);

}  // namespace oriel::bsdf
