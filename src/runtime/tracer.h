// SPDX-License-Identifier: Apache-2.0
// What a shader that is no material may ask of the scene around a point while it is rendered.
#pragma once

#include <optional>

#include "runtime/shading_point.h"

namespace oriel {

/// Conventions: world space. ShadingPoint::tracer is one while a surface is shaded for a path, and
/// null elsewhere (shadow rays, photons, displacement): shaders then answer without it. It must not
/// be kept. Implemented by transport/scene_tracer.h.
class Tracer {
 public:
  virtual ~Tracer() = default;

  struct Met {
    float distance = 0;
    Vec3 position{0};
    Vec3 normal{0, 0, 1};            ///< unit, interpolated, facing the ray's origin
    Vec3 geometric_normal{0, 0, 1};  ///< unit, of the triangle, facing the ray's origin
    bool back_side = false;          ///< met from behind
    const Material* material = nullptr;
    int instance = -1;  ///< index into World::instances
  };
  /// The first surface within `reach`, whatever rays see it; cut-outs stop a ray by chance, as
  /// often as they are opaque. Unshaded.
  virtual std::optional<Met> probe(const Vec3& origin, const Vec3& direction, float reach) = 0;
  /// The same along a ray that leaves a point of a surface.
  virtual std::optional<Met> probe_from(const ShadingPoint& point, const Vec3& direction,
                                        float reach) = 0;

  struct Arriving {
    Rgb colour{0};  ///< a white Lambert surface that faces the light shows it; after shadows
    Vec3 wi{0};     ///< unit, to the light
  };
  /// One sample of a light at a point; nothing where it does not reach.
  virtual std::optional<Arriving> light(int index, ShadingPoint& point) = 0;

  /// Two independent numbers in [0,1), evenly spread over the samples of a pixel.
  virtual Vec2 next() = 0;
};

}  // namespace oriel
