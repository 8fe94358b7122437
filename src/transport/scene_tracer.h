// SPDX-License-Identifier: Apache-2.0
// Answers what shaders ask of the scene: probes, lights, random numbers.
#pragma once

#include "runtime/tracer.h"
#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"

namespace oriel {

class Path;

/// The tracer of one vertex of a path. Draws from a stream of its own, which leaves those of the
/// path where they are. Rays, irradiance and materials that it is asked for are paths of their own
/// that go on from that vertex (path_for_shaders.cpp); without a path there are none.
/// Checked: RayNodes.*, RayKinds.*, OcclusionNodes.* in tests/analytic.
class SceneTracer final : public Tracer {
 public:
  SceneTracer(const World& world, const sampling::Sampler& sampler, RayCounts& counts,
              const Path* path = nullptr)
      : world_(world), sampler_(sampler), counts_(counts), path_(path) {}

  std::optional<Met> probe(const Vec3& origin, const Vec3& direction, float reach) override;
  std::optional<Met> probe_from(const ShadingPoint& point, const Vec3& direction,
                                float reach) override;
  std::optional<Arriving> light(int index, ShadingPoint& point) override;
  Vec2 next() override;
  Depth depth() const override;
  Seen trace(const ShadingPoint& from, const SubRay& ray) override;
  Rgb irradiance(const ShadingPoint& point, const Vec3& normal) override;
  Rgba shade(const NodeList& surface, ShadingPoint& point, MaterialOutputs* outputs) override;
  bool write_buffer(std::size_t slot, const Rgba& value) override;
  std::optional<Rgba> read_buffer(std::size_t slot) const override;

 private:
  std::optional<Met> follow(geom::Ray ray, float reach);
  sampling::Sampler next_stream();

  const World& world_;
  const sampling::Sampler& sampler_;
  std::optional<sampling::Sampler> own_;  // made when first asked
  RayCounts& counts_;
  const Path* path_;
  std::uint32_t streams_ = 0;
};

}  // namespace oriel
