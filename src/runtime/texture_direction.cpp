// SPDX-License-Identifier: Apache-2.0
#include "runtime/texture_direction.h"

#include "geom/motion.h"
#include "runtime/world.h"

namespace oriel {

Vec3 texture_direction(const ShadingPoint& point, int space) {
  if (space < 0) return Vec3(0);
  if (!point.world || !point.world->accel || point.instance < 0)
    return space == 0 ? point.dpdu : Vec3(0);
  const geom::Accel& accel = *point.world->accel;
  const geom::InstanceDesc& desc = accel.instance(static_cast<std::uint32_t>(point.instance));
  const geom::Mesh& mesh = accel.mesh(desc.mesh);
  if (point.primitive >= mesh.triangles.size()) return space == 0 ? point.dpdu : Vec3(0);
  const geom::Triangle& t = mesh.triangles[point.primitive];
  const auto corners = geom::corners_at(mesh, t, point.time);
  const Vec3 by_u = geom::texture_derivatives(mesh, t, static_cast<std::size_t>(space),
                                              corners[1] - corners[0], corners[2] - corners[0])
                        .by_u;
  return accel.is_baked(desc.mesh) || !point.to_world ? by_u
                                                      : transform_vector(by_u, *point.to_world);
}

}  // namespace oriel
