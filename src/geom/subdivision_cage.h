// SPDX-License-Identifier: Apache-2.0
// The control mesh of a subdivision surface: its topology, values and sharp places.
#pragma once

#include <vector>

#include "scene/object.h"

namespace oriel::geom {

/// What is refined. Corners of faces that name the same vector as their point are one point of the
/// cage, whatever else their vertices hold; so seams of texture coordinates do not cut the surface.
struct SubdivisionCage {
  /// A texture space: values and, for each corner of each face, which of them it has.
  struct Channel {
    std::vector<Vec3> coordinate, basis_u, basis_v;  ///< bases are empty or as many
    std::vector<int> corner;
  };
  std::vector<Vec3> points;
  std::vector<std::vector<Vec3>> motion;  ///< per step, one for each point
  std::vector<int> face_sizes, corners;
  std::vector<std::uint32_t> base_face;  ///< number of each face in the scene
  std::vector<Channel> channels;
  std::vector<int> crease_pairs, sharp_points;
  std::vector<float> crease_sharpness, point_sharpness;  ///< in refinements; 10 and more: for ever
  bool loop = false;  ///< triangles alone, refined by Loop's scheme; else by Catmull and Clark's
  std::size_t dropped = 0;  ///< faces with corners that coincide or are not finite

  bool empty() const { return face_sizes.empty(); }
};

/// The cage of a surface of that group.
///
/// Model:   a ccmesh, and a surface in which any face is no triangle, is Catmull and Clark's.
/// Crease
///          values 0 to 1 are spread over sharpness 0 to 10; cusps, conics and corners are sharp
///          points, for as many refinements as their level says; a dart is what the end of a crease
///          is anyway. A texture space of the rule `face` has its own values at each corner.
/// Checked: Subdivide.*
SubdivisionCage cage_of(const scene::PolygonGroup& group, const scene::SubdivisionSurface& surface);

}  // namespace oriel::geom
