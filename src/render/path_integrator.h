// SPDX-License-Identifier: Apache-2.0
// Path tracing without caches.
#pragma once

#include "render/integrator.h"
#include "transport/path/path.h"

namespace oriel {

/// Traces all light by paths of the given settings.
class PathIntegrator final : public Integrator {
 public:
  explicit PathIntegrator(const World& world, const PathSettings& settings = {})
      : world_(world), settings_(settings) {}

  void trace(const Camera::Ray& eye, Vec2 raster, float paths_of_pixel, PathRecord& record,
             sampling::Sampler& sampler, RayCounts& counts) const override {
    PathSettings settings = settings_;
    settings.paths_of_pixel = paths_of_pixel;
    trace_path(world_, eye, raster, settings, record, sampler, counts);
  }

 private:
  const World& world_;
  PathSettings settings_;
};

}  // namespace oriel
