// SPDX-License-Identifier: Apache-2.0
#include "geom/motion.h"

#include <algorithm>
#include <cmath>

namespace oriel::geom {

namespace {

using Columns = std::vector<std::vector<Vec3>>;

/// Position of a vertex at a step of the motion interval.
Vec3 displaced(const Columns& motion, std::size_t vertex, int step) {
  const int steps = static_cast<int>(motion.size());
  const auto at = [&](int i) {
    if (i == 0) return Vec3(0);
    const std::vector<Vec3>& column = motion[static_cast<std::size_t>(i - 1)];
    return column.empty() ? Vec3(0) : column[vertex];
  };
  if (step < 0) return at(1) * static_cast<float>(step);
  if (step <= steps) return at(step);
  return at(steps) + (at(steps) - at(steps - 1)) * static_cast<float>(step - steps);
}

/// Calls `add_key(step)` for each step; does nothing if all motion vectors are null.
template <class F>
void for_each_key(Columns& motion, int first, int last, F&& add_key) {
  const bool moves = std::any_of(motion.begin(), motion.end(), [](const auto& column) {
    return std::any_of(column.begin(), column.end(), [](const Vec3& v) { return v != Vec3(0); });
  });
  if (!moves) return;
  // A long time range leaves fewer motion vectors per interval.
  const auto most = (kMaxKeys - 1) / static_cast<std::size_t>(last - first);
  if (motion.size() > most) motion.resize(most);
  const int steps = static_cast<int>(motion.size());
  for (int i = first * steps; i <= last * steps; ++i) add_key(i);
}

}  // namespace

KeysAt::KeysAt(std::size_t keys, float time) : pieces(static_cast<float>(keys - 1)) {
  const float at = std::clamp(time, 0.0f, 1.0f) * pieces;
  const float begin = std::min(std::floor(at), pieces - 1);
  step = static_cast<std::size_t>(begin);
  share = at - begin;
}

void add_keys(Mesh& mesh, int first, int last) {
  mesh.keys.clear();
  for_each_key(mesh.motion, first, last, [&mesh](int step) {
    std::vector<Vec3>& key = mesh.keys.emplace_back(mesh.positions);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) key[v] += displaced(mesh.motion, v, step);
  });
  Curves& curves = mesh.curves;
  curves.keys.clear();
  for_each_key(curves.motion, first, last, [&curves](int step) {
    std::vector<Curves::Point>& key = curves.keys.emplace_back(curves.points);
    for (std::size_t i = 0; i < key.size(); ++i) key[i].p += displaced(curves.motion, i, step);
  });
}

std::array<Vec3, 3> moved_corners(const Mesh& mesh, const Triangle& t, float time) {
  const KeysAt at(mesh.keys.size(), time);
  const std::vector<Vec3>&from = mesh.keys[at.step], &to = mesh.keys[at.step + 1];
  const auto corner = [&](std::uint32_t i) { return from[i] * (1 - at.share) + to[i] * at.share; };
  return {corner(t.a), corner(t.b), corner(t.c)};
}

std::array<Vec3, 3> speeds_at(const Mesh& mesh, const Triangle& t, float time) {
  if (mesh.keys.empty()) return {Vec3(0), Vec3(0), Vec3(0)};
  const KeysAt at(mesh.keys.size(), time);
  const std::vector<Vec3>&from = mesh.keys[at.step], &to = mesh.keys[at.step + 1];
  const auto speed = [&](std::uint32_t i) { return (to[i] - from[i]) * at.pieces; };
  return {speed(t.a), speed(t.b), speed(t.c)};
}

Mat4 matrix_at(std::span<const Mat4> path, float time) {
  if (path.size() == 1) return path[0];
  const KeysAt at(path.size(), time);
  return path[at.step] * (1 - at.share) + path[at.step + 1] * at.share;
}

Mat4 change_at(std::span<const Mat4> path, float time) {
  if (path.size() == 1) return Mat4(0.0f);
  const KeysAt at(path.size(), time);
  return (path[at.step + 1] - path[at.step]) * at.pieces;
}

Mat4 inverse_of(const Mat4& m) { return Mat4(Imath::M44d(m).inverse()); }

}  // namespace oriel::geom
