// SPDX-License-Identifier: Apache-2.0
// Motion blur: positions and matrices at a time, interpolated linearly between equal steps.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geom/mesh.h"

namespace oriel::geom {

/// Maximum number of motion keys, a limit of Embree.
inline constexpr std::size_t kMaxKeys = 129;

/// The key before a time and the interpolation weight of the next, for at least two keys; computed
/// like in Embree.
struct KeysAt {
  std::size_t step;
  float share;   ///< 0 at `step`, 1 at the next key
  float pieces;  ///< number of intervals between keys
  KeysAt(std::size_t keys, float time);
};

/// Fills Mesh::keys and Curves::keys from the motion vectors: vector i of n is the displacement of
/// a vertex at (i + 1) / n of the motion interval. `first`, `last`: the intervals that ray time 0
/// to 1 covers, at most kMaxKeys steps; outside of 0 to 1 the motion is extrapolated. Does nothing
/// for a mesh without motion vectors. Checked: Motion.*, Hair.*
void add_keys(Mesh& mesh, int first, int last);

/// Corners of a triangle at a time; requires a mesh with keys.
std::array<Vec3, 3> moved_corners(const Mesh& mesh, const Triangle& t, float time);
/// Corners of a triangle at a time, with or without keys.
inline std::array<Vec3, 3> corners_at(const Mesh& mesh, const Triangle& t, float time) {
  if (!mesh.keys.empty()) return moved_corners(mesh, t, time);
  return {mesh.positions[t.a], mesh.positions[t.b], mesh.positions[t.c]};
}
/// Velocities of the corners per unit of ray time; null vectors for a mesh without keys.
std::array<Vec3, 3> speeds_at(const Mesh& mesh, const Triangle& t, float time);

/// Interpolates matrices at equal steps (at least one); change_at() is the derivative by ray time.
Mat4 matrix_at(std::span<const Mat4> path, float time);
Mat4 change_at(std::span<const Mat4> path, float time);
/// Inverse, computed in double.
Mat4 inverse_of(const Mat4& m);

}  // namespace oriel::geom
