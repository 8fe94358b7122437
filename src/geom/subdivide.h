// SPDX-License-Identifier: Apache-2.0
// Tessellates subdivision surfaces; vertices lie on the limit surface.
#pragma once

#include "base/diagnostic.h"
#include "geom/mesh.h"
#include "geom/subdivision_cage.h"
#include "scene/approximation.h"

namespace oriel::geom {

/// Default number of refinements of a surface without an approximation. [I]
inline constexpr int kSubdivisionLevel = 3;

/// Number of refinements that an approximation requires. The whole surface is refined uniformly, so
/// there are no cracks.
///
/// Model:   parametric N: N times. Criteria are measured at the cage: a refinement halves lengths
///          and the angles between adjacent faces, and quarters the distance to the limit. All
///          criteria have to be met, with `any` only one. `max N` limits the result to N triangles.
/// Inputs:  approximation: null for kSubdivisionLevel. view: for lengths in pixels.
/// Checked: SubdivisionLevel.*
int subdivision_level(const SubdivisionCage& cage, const scene::Approximation* approximation,
                      const scene::TessellationView& view);

/// The surface refined `level` times, with points moved to the limit surface; level 0 is the cage
/// itself.
///
/// Model:   Catmull-Clark or Loop subdivision with semi-sharp creases. Boundaries are creases;
///          corners of a single face are fixed. Normals are those of the limit surface. Along
///          infinitely sharp creases they are means of the facets on each side; at infinitely sharp
///          points they are null (faceted). Texture spaces are smooth with sharp corners at their
///          seams, or linear in each base face if the scene says `face`. Trims remove faces without
///          changing the shape of the rest. `detail`, hierarchies of faces and second derivatives
///          are ignored; motion vectors are refined like points.
/// Inputs:  group: for material names; tagged: faces have labels instead of materials. most_faces:
///          0: kMaxFaces; lower levels because of another value are not reported.
/// Errors:  OR-GEOM-020 details ignored, OR-GEOM-021 level reduced because of kMaxFaces,
///          OR-GEOM-022 faces skipped.
/// Source:  E. Catmull, J. Clark, "Recursively generated B-spline surfaces on arbitrary topological
///          meshes", CAD 1978; C. Loop, "Smooth subdivision surfaces based on triangles", 1987;
///          T. DeRose, M. Kass, T. Truong, "Subdivision surfaces in character animation", SIGGRAPH
///          1998, for sharpness.
/// Checked: Subdivide.*
Mesh subdivide(const scene::PolygonGroup& group, const scene::SubdivisionSurface& surface,
               bool tagged, const scene::Approximation* approximation,
               const scene::TessellationView& view, Diagnostics& diagnostics,
               std::size_t most_faces = 0);

/// Maximum number of faces of one refined surface: 8 M triangles, less than 2 GB in total.
inline constexpr std::size_t kMaxFaces = std::size_t{4} << 20;

/// Reduces the number of refinements until the surface has at most `most` faces.
int affordable_level(const SubdivisionCage& cage, int level, std::size_t most = kMaxFaces);
/// Triangles of a surface that is refined `level` times, at most kMaxFaces faces.
std::uint64_t triangles_at_level(const SubdivisionCage& cage, int level);

}  // namespace oriel::geom
