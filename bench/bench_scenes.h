// SPDX-License-Identifier: Apache-2.0
// Scenes that benches write themselves: .mi text of any number of triangles.
#pragma once

#include <string>

namespace oriel::bench {

// Conventions
//   Metres, z up. Objects without an outer scene have no header, so that texts can be joined.

/// A terrain of 2 * side^2 triangles as one object "o"; vertices shared, as modellers write them.
std::string shared_vertices(int side);
/// The same with one vertex per corner, each with normal and texture coordinate, and a material by
/// name for each triangle, as many exporters write it.
std::string vertex_per_corner(int side);

/// Options, camera, a light and a render statement around an instance of object "o".
std::string around_object(const std::string& object);

/// A closed white room of 34 triangles: red and green walls, two boxes (one glossy), a square lamp.
std::string small_room();
/// The same room with 27 wavy balls of 40,000 triangles with normals: 1.08 million; diffuse,
/// glossy and clear glass.
std::string big_room();

}  // namespace oriel::bench
