// SPDX-License-Identifier: Apache-2.0
// Records and look-ups of the tests of the irradiance cache.
#pragma once

#include <cstdint>
#include <vector>

#include "sampling/sampler.h"
#include "transport/gather/gather_cache.h"

namespace oriel::gather_records {

inline const Vec3 kUp(0, 0, 1);

inline GatherRecord record(const Vec3& position, float e, float radius = 1,
                           const Vec3& normal = kUp) {
  GatherRecord r;
  r.position = position;
  r.normal = normal;
  r.irradiance = Rgb(e);
  r.radius = radius;
  r.mean_distance = radius;
  r.min_distance = 0;
  r.incoming.mean = Rgb(e / kPi);
  return r;
}

/// Records strewn over the square [0, 1]^2 of the floor with a field's values and gradients.
template <class Field>
std::vector<GatherRecord> strewn(int count, float radius, const Field& field,
                                 const Vec3& gradient = Vec3(0)) {
  std::vector<GatherRecord> records;
  for (int i = 0; i < count; ++i) {
    const Vec2 u = sampling::Sampler(0, 0, static_cast<std::uint32_t>(i)).next_2d();
    records.push_back(record(Vec3(u.x, u.y, 0), field(u), radius));
    records.back().by_position = {gradient, gradient, gradient};
  }
  return records;
}

inline GatherQuery at(const Vec3& position, int points = 0, const Vec3& normal = kUp) {
  GatherQuery q;
  q.position = position;
  q.normal = normal;
  q.points = points;
  return q;
}

}  // namespace oriel::gather_records
