// SPDX-License-Identifier: Apache-2.0
// Displacement shaders of materials: they move the vertices of a mesh before it is traced.
#pragma once

#include <span>
#include <vector>

#include "base/diagnostic.h"
#include "geom/mesh.h"
#include "runtime/world.h"
#include "scene/hierarchy.h"

namespace oriel {

/// Per slot of a mesh the displacement shaders of its material; empty where no slot has any.
using Displacement = std::vector<NodeList>;

/// What moves a mesh whose slots have these materials (indices into World::materials); empty when
/// the options switch displacement off.
Displacement displacement_of(std::span<const int> materials, const World& world);

/// Moves each vertex along its normal by the sum of what the shaders return, in object units.
///
/// Model:   the mesh is displaced as it is (refine_displacement.h makes it finer before), and a
///          shader is asked at each vertex once, unfiltered. Vertices at one place move together,
///          along the mean of their corners' normals by the mean of their amounts, so that no crack
///          opens at edges where normals, coordinates or slots differ; only corners of slots that
///          are displaced count. Normals turn as the facets around them turn: they stay smooth
///          where they were and split where they were split, and bump bases and derivatives turn
///          with them (their lengths stay). A mesh without vertex normals moves along the mean of
///          its facets' and stays faceted. Amounts that are not finite count as 0.
/// Inputs:  leaf: the placement the shaders see, that of the first instance that uses the mesh.
/// Errors:  OR-RN-031 once when `max displace` of the object (or else of the options; 0 = no
///          limit) clamps an amount.
/// Source:  reference of the language, Material and Object; shader interface, displacement shaders.
/// Checked: Displacement.* in tests/analytic
void displace(geom::Mesh& mesh, const Displacement& displacement, const scene::Leaf& leaf,
              const World& world, Diagnostics& diagnostics);

}  // namespace oriel
