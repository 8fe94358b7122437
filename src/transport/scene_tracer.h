// SPDX-License-Identifier: Apache-2.0
// Answers what shaders ask of the scene: probes, lights, random numbers.
#pragma once

#include "runtime/tracer.h"
#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"

namespace oriel {

/// The tracer of one vertex of a path. Draws from a stream of its own, which leaves those of the
/// path where they are.
/// Checked: Tracer.* in tests/analytic.
class SceneTracer final : public Tracer {
 public:
  SceneTracer(const World& world, const sampling::Sampler& sampler, RayCounts& counts)
      : world_(world), sampler_(sampler), counts_(counts) {}

  std::optional<Met> probe(const Vec3& origin, const Vec3& direction, float reach) override;
  std::optional<Met> probe_from(const ShadingPoint& point, const Vec3& direction,
                                float reach) override;
  std::optional<Arriving> light(int index, ShadingPoint& point) override;
  Vec2 next() override;

 private:
  std::optional<Met> follow(geom::Ray ray, float reach);

  const World& world_;
  const sampling::Sampler& sampler_;
  std::optional<sampling::Sampler> own_;  // made when first asked
  RayCounts& counts_;
};

}  // namespace oriel
