// SPDX-License-Identifier: Apache-2.0
// Services for shaders: probe rays, lights, random numbers.
#pragma once

#include "runtime/tracer.h"
#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"

namespace oriel {

class Path;

/// The Tracer of one vertex of a path. It has its own random stream, so that the path's stream does
/// not change. Rays, irradiance and other materials are computed by separate paths from that vertex
/// (path_for_shaders.cpp); without a path they are not available.
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
  PickedLights pick_lights(const Vec3& place) override;
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
  std::optional<sampling::Sampler> own_;  // created at the first use
  RayCounts& counts_;
  const Path* path_;
  std::uint32_t streams_ = 0;
};

}  // namespace oriel
