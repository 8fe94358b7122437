// SPDX-License-Identifier: Apache-2.0
// The control mesh of a subdivision surface: topology, values and creases.
#pragma once

#include <vector>

#include "scene/object.h"

namespace oriel::geom {

/// Input of the refinement. Corners of faces that refer to the same point vector are one point of
/// the cage, independent of other vertex data; seams of texture coordinates therefore do not split
/// the surface.
struct SubdivisionCage {
  /// A texture space: values, and the index of the value for each corner of each face.
  struct Channel {
    std::vector<Vec3> coordinate, basis_u, basis_v;  ///< bases are empty or have the same size
    std::vector<int> corner;
  };
  std::vector<Vec3> points;
  std::vector<std::vector<Vec3>> motion;  ///< per step, one vector per point
  std::vector<int> face_sizes, corners;
  std::vector<std::uint32_t> base_face;  ///< index of each face in the scene
  std::vector<Channel> channels;
  std::vector<int> crease_pairs, sharp_points;
  /// number of refinements; 10 or more is infinitely sharp
  std::vector<float> crease_sharpness, point_sharpness;
  bool loop = false;        ///< all faces are triangles: Loop's scheme; else Catmull-Clark
  std::size_t dropped = 0;  ///< faces with coincident or non-finite corners

  bool empty() const { return face_sizes.empty(); }
};

/// Makes the cage of a surface of the group.
///
/// Model:   a ccmesh, and a surface with any face that is not a triangle, uses Catmull-Clark.
///          Crease values 0 to 1 are mapped to sharpness 0 to 10. Cusps, conics and corners are
///          sharp points, for the number of refinements of their level. Darts need no treatment:
///          the end of a crease already is one. A texture space with the rule `face` has its own
///          values at each corner.
/// Checked: Subdivide.*
SubdivisionCage cage_of(const scene::PolygonGroup& group, const scene::SubdivisionSurface& surface);

}  // namespace oriel::geom
