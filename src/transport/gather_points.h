// SPDX-License-Identifier: Apache-2.0
// Final gathering before the picture: where light is gathered, and gathering it.
#pragma once

#include <vector>

#include "transport/counts.h"
#include "transport/indirect_maps.h"
#include "transport/path.h"

namespace oriel {

/// A surface seen by the eye, directly or by mirrors and glass.
struct GatherPoint {
  ShadingPoint point;
  Vec3 normal{0, 0, 1};  ///< unit, on the side that is lit
  float quality = 1;     ///< of the rays that the options ask for
};

/// The surfaces that the path of one sample meets before anything diffuse.
void visit_gather_points(const World& world, Vec2 raster, const PathSettings& settings,
                         sampling::Sampler& sampler, RayCounts& counts,
                         std::vector<GatherPoint>& points);

/// How records are made.
struct GatherSettings {
  int rays = 100;
  int filter = 0;
  float reach = 0;    ///< scene units, 0 = any
  GatherRadii radii;  ///< in scene units or pixels
  PathSettings path;  ///< of the rays: bounces behind the first surface, photons
};

/// What the options ask for. `diagonal`: of the scene's box, for radii that are not written.
GatherSettings gather_settings(const scene::FinalGatherOptions& options, float diagonal);

/// Gathers light at one point. Rays meet surfaces and environment, no light sources.
GatherRecord gather_at(const World& world, const GatherPoint& at, const GatherSettings& settings,
                       const sampling::Sampler& sampler, RayCounts& counts);

}  // namespace oriel
