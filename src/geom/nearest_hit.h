// SPDX-License-Identifier: Apache-2.0
// Selects the hit that Embree reports among surfaces at the same distance.
#pragma once

#include <embree3/rtcore.h>

#include <cstdint>
#include <limits>

namespace oriel::geom {

/// Hits whose relative distance is below this are equal: coincident surfaces, and triangles on both
/// sides of an edge. Differences of Embree between processors are smaller.
inline constexpr float kTie = 1e-6f;

struct NearestContext {
  RTCIntersectContext embree;  // first: Embree passes its address
  float t = std::numeric_limits<float>::infinity();
  std::uint64_t id = 0;
};

/// Intersection filter: among hits at the same distance, the smallest index is the nearest,
/// independent of rounding. Embree calls it for every hit nearer than tfar.
inline void keep_nearest(const RTCFilterFunctionNArguments* args) {
  auto& nearest = *reinterpret_cast<NearestContext*>(args->context);
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  const auto& found = *reinterpret_cast<const RTCHit*>(args->hit);
  const float t = ray.tfar;
  const unsigned instance =
      found.instID[0] == RTC_INVALID_GEOMETRY_ID ? found.geomID : found.instID[0];
  const std::uint64_t id = std::uint64_t{instance} << 32 | found.primID;
  if (t > nearest.t * (1 - kTie) && id > nearest.id) {
    args->valid[0] = 0;
    return;
  }
  nearest.t = t;
  nearest.id = id;
  ray.tfar = t * (1 + kTie);
}

}  // namespace oriel::geom
