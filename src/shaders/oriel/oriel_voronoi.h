// SPDX-License-Identifier: Apache-2.0
// oriel_voronoi: distances to random points, as Blender's Voronoi texture.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   Textures of modelling programs. Declared by `$include "oriel.mi"`.
// Model
//   Each unit cell of the coordinate times `scale` has a point, `randomness` times a random vector
//   from its corner. The features are the nearest point, the second nearest, all points with smooth
//   weights, the edge between nearest points, and half the distance between the nearest point and
//   its neighbour.
// Source:  Worley, "A Cellular Texture Basis Function", SIGGRAPH 1996; Quilez, "Voronoi Borders"
// and
//          "Smooth Voronoi", 2012 to 2014; Blender's manual, Voronoi Texture Node; random numbers
//          are those of Blender.
// Checked: tests/blender against Cycles; tests/effects
extern const ShaderSpec kOrielVoronoi;

}  // namespace oriel
