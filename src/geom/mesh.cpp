// SPDX-License-Identifier: Apache-2.0
#include "geom/mesh.h"

namespace oriel::geom {

namespace {

template <typename T>
std::size_t bytes_of(const std::vector<T>& column) {
  return column.capacity() * sizeof(T);
}

}  // namespace

Box3 Mesh::bounds() const {
  Box3 box;
  for (const Triangle& t : triangles) {
    box.extendBy(positions[t.a]);
    box.extendBy(positions[t.b]);
    box.extendBy(positions[t.c]);
  }
  for (const Curves::Point& point : curves.points) {
    box.extendBy(point.p - Vec3(point.radius));
    box.extendBy(point.p + Vec3(point.radius));
  }
  return box;
}

std::size_t Mesh::bytes() const {
  std::size_t sum = sizeof(Mesh) + bytes_of(positions) + bytes_of(triangles) + bytes_of(normals) +
                    bytes_of(textures) + bytes_of(dpdu) + bytes_of(dpdv) + bytes_of(motion) +
                    bytes_of(keys) + bytes_of(slot) + bytes_of(slots);
  for (const TextureSpace& space : textures)
    sum += bytes_of(space.coordinate) + bytes_of(space.basis_u) + bytes_of(space.basis_v);
  for (const std::vector<Vec3>& step : motion) sum += bytes_of(step);
  sum += bytes_of(curves.points) + bytes_of(curves.lines) + bytes_of(curves.beziers) +
         bytes_of(curves.normals);
  sum += bytes_of(curves.textures) + bytes_of(curves.motion) + bytes_of(curves.keys);
  for (const std::vector<Vec3>& column : curves.textures) sum += bytes_of(column);
  for (const std::vector<Vec3>& step : curves.motion) sum += bytes_of(step);
  for (const std::vector<Curves::Point>& key : curves.keys) sum += bytes_of(key);
  for (const std::vector<Vec3>& key : keys) sum += bytes_of(key);
  return sum;
}

}  // namespace oriel::geom
