// SPDX-License-Identifier: Apache-2.0
// mia_envblur: blurred environment lookups.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   An environment of the camera or of a material; wraps another one that does not depend on
//   position.
//   With mia_material_blur (the default) and single_env_sample in materials, one lookup replaces a
//   whole glossy reflection; `blur` is then 0.
// Model
//   Before rendering, `resolution` squared samples over the sphere are stored in a pyramid (image/
//   sphere_blur.h). `blur` b blurs like the reflection of glossiness 1 - b at normal incidence; 0
//   evaluates the environment itself. mia_material_blur applies the (isotropic) roughness of the
//   lobe of the lookup; each of several rays applies its share of the lobe, so nothing is blurred
//   twice.
//   Both add up. Lobes narrower than the samples blend to the environment itself. Diffuse rays
//   evaluate the environment itself: the irradiance is the same, and it is importance sampled. As
//   for glossy rays, the disc of a sun is excluded from the pyramid, because the sun light has its
//   own highlight. Without `environment` that of the camera is used.
extern const ShaderSpec kMiaEnvBlur;

}  // namespace oriel
