// SPDX-License-Identifier: Apache-2.0
// mia_envblur: an environment that is looked up blurred.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   As the camera's or a material's environment, around another one that does not depend on place.
//   With mia_material_blur (the default) and single_env_sample in materials, one look-up stands for
//   a whole glossy reflection; `blur` then stays 0.
// What it does
//   Before rendering, `resolution` squared samples all around go into a pyramid (image/
//   sphere_blur.h). `blur` b blurs as a surface of glossiness 1 - b reflects when seen straight on;
//   0 asks the environment itself. mia_material_blur takes the roughness of the lobe that looks up
//   (isotropic); of many rays each takes its share of the lobe, so that nothing is blurred twice.
//   Both together add up. Lobes narrower than the samples fade to the environment itself.
//   Rays of diffuse surfaces see the environment itself: its light is the same, and its importance
//   is known. A sun's disc is left out of the pyramid as it is of glossy rays, since the sun's
//   light has a highlight of its own. Without `environment` the camera's is taken.
extern const ShaderSpec kMiaEnvBlur;

}  // namespace oriel
