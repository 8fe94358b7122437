// SPDX-License-Identifier: Apache-2.0
// Subdivision surfaces become triangles whose corners lie on the limit surface.
#pragma once

#include "base/diagnostic.h"
#include "geom/mesh.h"
#include "geom/subdivision_cage.h"
#include "scene/approximation.h"

namespace oriel::geom {

/// Refinements of a surface for which no approximation says how many. [I]
inline constexpr int kSubdivisionLevel = 3;

/// How often a cage is refined so that an approximation is met; the whole surface alike, so that no
/// crack can open.
///
/// Model:   parametric N: N times. Criteria are measured at the cage: refining halves lengths and
///          the angles between neighbouring faces, and quarters the distance to the limit. All that
///          are asked for must be met, with `any` one of them. `max N` refines less often, so that
///          there are not more than N triangles.
/// Inputs:  approximation: null for kSubdivisionLevel. view: for lengths in pixels.
/// Checked: SubdivisionLevel.*
int subdivision_level(const SubdivisionCage& cage, const scene::Approximation* approximation,
                      const scene::TessellationView& view);

/// The surface refined `level` times, then moved to the limit; a level of 0 is the cage itself.
///
/// Model:   Catmull and Clark's or Loop's scheme with semi-sharp creases. Boundaries are creases,
///          corners of a single face stay. Normals are those of the limit surface; along creases
///          that stay sharp they are means of the facets on each side, and null (faceted) at points
///          that stay sharp alone. Texture spaces are smooth with sharp corners at their seams, or
///          linear in each base face where the scene says `face`. Trims cut parts away that shape
///          the rest all the same. `detail` and hierarchies of faces are not followed, second
///          derivatives neither; motion vectors are refined as the points are.
/// Inputs:  group: for names of materials; tagged: its faces have labels instead.
/// Errors:  OR-GEOM-020 details that are not followed, OR-GEOM-021 a lower level because of
///          kMostFaces, OR-GEOM-022 faces left out.
/// Source:  E. Catmull, J. Clark, "Recursively generated B-spline surfaces on arbitrary topological
///          meshes", CAD 1978; C. Loop, "Smooth subdivision surfaces based on triangles", 1987;
///          T. DeRose, M. Kass, T. Truong, "Subdivision surfaces in character animation", SIGGRAPH
///          1998, for sharpness.
/// Checked: Subdivide.*
Mesh subdivide(const scene::PolygonGroup& group, const scene::SubdivisionSurface& surface,
               bool tagged, const scene::Approximation* approximation,
               const scene::TessellationView& view, Diagnostics& diagnostics);

/// Faces of one refined surface: 8 M triangles or less than 2 GB with everything.
inline constexpr std::size_t kMostFaces = std::size_t{4} << 20;

/// That many refinements, or fewer so that there are not more than `most` faces.
int affordable_level(const SubdivisionCage& cage, int level, std::size_t most = kMostFaces);

}  // namespace oriel::geom
