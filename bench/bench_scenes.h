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

/// A wall of `count` instances of shared_vertices(side), side by side, and the camera before it.
std::string wall_of_terrains(int side, int count);
/// Floor and wall of squares, each with a file of its own: "0.exr" to "<count - 1>.exr".
/// filter: of the textures; near 0, every look-up is one of the finest level.
std::string room_of_pictures(int count, float filter);

/// A closed white room of 34 triangles: red and green walls, two boxes (one glossy), a square lamp.
std::string small_room();
/// The same room with 27 wavy balls of 40,000 triangles with normals: 1.08 million; diffuse,
/// glossy and clear glass.
std::string big_room();

/// A closed room (y up) that the sky lights through a window: what FinalGather.* in
/// tests/cross_method/smoothness_test.cpp shows, 320 x 240 pixels, bounces not cut by any method.
///
/// Inputs:  portal: a portal light fills the window. floor, walls: parameters of mia_material_x
///          beside the diffuse colour.
std::string sky_lit_room(bool portal, const std::string& floor = "\"reflectivity\" 0",
                         const std::string& walls = "\"reflectivity\" 0");

}  // namespace oriel::bench
