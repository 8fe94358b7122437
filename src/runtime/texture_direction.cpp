// SPDX-License-Identifier: Apache-2.0
#include "runtime/texture_direction.h"

#include "geom/motion.h"
#include "runtime/world.h"

namespace oriel {

TextureDirections texture_directions(const ShadingPoint& point, int space) {
  if (space < 0) return {};
  const TextureDirections own =
      space == 0 ? TextureDirections{point.dpdu, point.dpdv} : TextureDirections{};
  if (!point.world || !point.world->accel || point.instance < 0) return own;
  const geom::Accel& accel = *point.world->accel;
  const geom::InstanceDesc& desc = accel.instance(static_cast<std::uint32_t>(point.instance));
  const geom::Mesh& mesh = accel.mesh(desc.mesh);
  if (point.primitive >= mesh.triangles.size()) return own;
  const geom::Triangle& t = mesh.triangles[point.primitive];
  const auto corners = geom::corners_at(mesh, t, point.time);
  const geom::TextureDerivatives d = geom::texture_derivatives(
      mesh, t, static_cast<std::size_t>(space), corners[1] - corners[0], corners[2] - corners[0]);
  if (accel.is_baked(desc.mesh) || !point.to_world) return {d.by_u, d.by_v};
  return {transform_vector(d.by_u, *point.to_world), transform_vector(d.by_v, *point.to_world)};
}

Vec3 texture_direction(const ShadingPoint& point, int space) {
  return texture_directions(point, space).by_u;
}

}  // namespace oriel
