// SPDX-License-Identifier: Apache-2.0
// The shaders that a position of the sun turns.
#pragma once

#include <string>

#include "scene/scene.h"

namespace oriel::scene {

/// Whether a shader of that type has a `sun_direction`.
bool is_sky_shader(const std::string& type);
/// The argument `y_is_up` of a sun or sky.
bool is_y_up(const ShaderUse& use);
/// The first call of mia_physicalsun in a light's list; named shaders are followed. Null: none.
const ShaderUse* find_sun(const Scene& scene, const ShaderList& list);

}  // namespace oriel::scene
