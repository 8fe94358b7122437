// SPDX-License-Identifier: Apache-2.0
#include "prepare/flat_panes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "runtime/world.h"

namespace oriel {
namespace {

/// Cosine between the normals of a pane from which on they are parallel: half a degree.
constexpr double kParallel = 0.99996;
/// Share of the surface that faces the two directions; the rest are narrow sides.
constexpr double kFacing = 0.8;
/// Thickness as a share of the square root of the area of one side.
constexpr double kThin = 0.1;

using Vec3d = Imath::V3d;

Vec3d area_of(const geom::Mesh& mesh, const geom::Triangle& t) {
  const Vec3d a(mesh.positions[t.a]), b(mesh.positions[t.b]), c(mesh.positions[t.c]);
  return (b - a).cross(c - a) * 0.5;
}

}  // namespace

bool is_flat_pane(const geom::Mesh& mesh) {
  if (mesh.triangles.empty() || !mesh.curves.empty() || !mesh.keys.empty()) return false;
  Vec3d largest(0.0);
  for (const geom::Triangle& t : mesh.triangles)
    if (const Vec3d area = area_of(mesh, t); area.length2() > largest.length2()) largest = area;
  const double length = largest.length();
  if (!(length > 0)) return false;
  const Vec3d normal = largest / length;
  double all = 0, front = 0, back = 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const geom::Triangle& t : mesh.triangles) {
    const Vec3d area = area_of(mesh, t);
    const double size = area.length(), along = area.dot(normal);
    all += size;
    if (along > kParallel * size) front += size;
    if (along < -kParallel * size) back += size;
    for (const std::uint32_t vertex : {t.a, t.b, t.c}) {
      const double height = Vec3d(mesh.positions[vertex]).dot(normal);
      low = std::min(low, height);
      high = std::max(high, height);
    }
  }
  // Two panes in one mesh, one behind the other, count as a thick box, although light passes them
  // straight as well.
  return front + back >= kFacing * all && std::abs(front - back) <= (1 - kFacing) * all &&
         high - low <= kThin * std::sqrt(front);
}

void mark_flat_panes(World& world) {
  if (!world.options.caustic.on || !world.options.traces_paths()) return;
  std::unordered_map<std::uint32_t, bool> known;
  for (std::uint32_t i = 0; i < world.accel->instance_count(); ++i) {
    const geom::MeshId id = world.accel->instance(i).mesh;
    const auto [entry, is_new] = known.try_emplace(static_cast<std::uint32_t>(id), false);
    if (is_new) entry->second = is_flat_pane(world.accel->mesh(id));
    world.instances[i].flat_pane = entry->second;
  }
}

}  // namespace oriel
