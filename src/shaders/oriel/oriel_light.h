// SPDX-License-Identifier: Apache-2.0
// oriel_light: a light that diffuse surfaces or reflections do not see.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   Lights of modelling programs with a visibility by kinds of rays. Declared by
//   `$include "oriel.mi"`.
// Model
//   Directional lights: `color`. With a profile: as mib_light_photometric. Others: as
//   physical_light. `diffuse` and `glossy` are factors of the light on diffuse lobes, and on
//   reflections, refractions and highlights.
// Source:  Blender's manual, Ray Visibility.
// Checked: tests/effects; tests/blender against Cycles
extern const ShaderSpec kOrielLight;

}  // namespace oriel
