// SPDX-License-Identifier: Apache-2.0
// Things at a time: between equal steps of a ray's time everything moves on straight lines.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "geom/mesh.h"

namespace oriel::geom {

/// Steps that one way may have: as many as the ray tracer takes.
inline constexpr std::size_t kMostKeys = 129;

/// The step before a time and the share of the way to the next, of what has so many keys, at least
/// two; as the ray tracer has them.
struct KeysAt {
  std::size_t step;
  float share;   ///< 0 at `step`, 1 at the next
  float pieces;  ///< between all keys
  KeysAt(std::size_t keys, float time);
};

/// Fills Mesh::keys and Curves::keys from the motion vectors: vector i of n leads from a vertex to
/// where it is at (i + 1) / n of the motion interval. `first`, `last`: the intervals that ray time
/// 0 to 1 covers, at most kMostKeys steps in all; outside of 0 to 1 vertices go on as they do at
/// its ends. Nothing for a mesh without motion vectors. Checked: Motion.*, Hair.*
void add_keys(Mesh& mesh, int first, int last);

/// Corners of a triangle at a time, of a mesh with keys.
std::array<Vec3, 3> moved_corners(const Mesh& mesh, const Triangle& t, float time);
/// The same of any mesh.
inline std::array<Vec3, 3> corners_at(const Mesh& mesh, const Triangle& t, float time) {
  if (!mesh.keys.empty()) return moved_corners(mesh, t, time);
  return {mesh.positions[t.a], mesh.positions[t.b], mesh.positions[t.c]};
}
/// How fast they move: lengths per unit of ray time. Null vectors for a mesh without keys.
std::array<Vec3, 3> speeds_at(const Mesh& mesh, const Triangle& t, float time);

/// A matrix of equal steps, at least one, and its change per unit of ray time.
Mat4 matrix_at(std::span<const Mat4> path, float time);
Mat4 change_at(std::span<const Mat4> path, float time);
/// Computed in double.
Mat4 inverse_of(const Mat4& m);

}  // namespace oriel::geom
