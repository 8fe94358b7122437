// SPDX-License-Identifier: Apache-2.0
// Geometry of the shapes of lights: samples, ray hits, bounds, points that emit photons. A new
// shape has a case in each function here.
#pragma once

#include <optional>

#include "runtime/light.h"

namespace oriel {

// Lights with an extent only. World space; a moving light is at its written placement.

/// A sample of a shape as seen from a point.
struct ShapeSample {
  Vec3 position, wi;
  float distance;
  float cosine;  ///< at the shape of flat lights, 1 for others
  float pdf;     ///< per solid angle
};

/// Inputs:  u: uniform in [0,1)^2. Returns nothing where the point sees no lit side.
std::optional<ShapeSample> sample_shape(const Light& light, const Vec3& from, Vec2 u);

/// A ray's hit on a lit side.
struct LightShapeHit {
  float t = 0;
  float facing = 1;  ///< cosine at the shape; 1 for spheres
};
std::optional<LightShapeHit> intersect_shape(const Light& light, const Vec3& from,
                                             const Vec3& direction, float t_most);
/// Density per solid angle with which sample_shape finds the direction of a hit.
float shape_pdf(const Light& light, const Vec3& from, const Vec3& direction,
                const LightShapeHit& hit);

/// Half the size of the bounding box, slightly enlarged; also for points.
Vec3 half_size(const Light& light);

/// A point of the surface, uniform in area, and the area. Inputs:  u: uniform in [0,1)^2.
struct ShapePoint {
  Vec3 position, normal;
  float area;
};
ShapePoint point_on_shape(const Light& light, Vec2 u);

/// A point of the surface, uniform in the area that is seen from a direction, and that area.
/// Inputs:  direction: unit, away from the light. Points have area 1; nothing where the area is 0.
struct SeenPoint {
  Vec3 position;
  float area;
};
std::optional<SeenPoint> point_seen_along(const Light& light, const Vec3& direction, Vec2 u);

}  // namespace oriel
