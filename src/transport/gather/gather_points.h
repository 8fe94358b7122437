// SPDX-License-Identifier: Apache-2.0
// Final gathering before the picture: where light is gathered, and gathering it.
#pragma once

#include <vector>

#include "transport/counts.h"
#include "transport/indirect_caches.h"
#include "transport/path/path.h"

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

/// The surfaces that a gather ray meets before anything diffuse.
void visit_gather_ray(const World& world, const GatherPoint& from, const Vec3& direction,
                      const PathSettings& settings, sampling::Sampler& sampler, RayCounts& counts,
                      std::vector<GatherPoint>& points);

/// How records are made.
struct GatherSettings {
  int rays = 400;
  int filter = 0;
  /// What rays meet from here on fades to the environment, which alone is there from `reach` on;
  /// scene units. Reach 0 = any.
  float fades_from = 0, reach = 0;
  GatherRadii radii;  ///< in scene units or pixels
  PathSettings path;  ///< of the rays: bounces behind the first surface, photons
};

/// Radii for options that write none, by the size of the scene.
GatherRadii default_gather_radii(const geom::Box3& scene);

/// What the options ask for. The scene's box and trace depth fill in what is not written.
GatherSettings gather_settings(const scene::RenderOptions& options, const geom::Box3& scene);

/// How the records are asked for.
///
/// Model:   automatic: as many as "finalgather points", those of least error. Multiframe: as many,
///          the nearest, within the maximum radius, where it fades to black. 3.4: all within their
///          radius. Strict 3.4: the same without gradients.
GatherQuery gather_query(const scene::FinalGatherOptions& options, const GatherRadii& radii);

/// Gathers light at one point. Rays meet surfaces and environment, no light sources.
GatherRecord gather_at(const World& world, const GatherPoint& at, const GatherSettings& settings,
                       const sampling::Sampler& sampler, RayCounts& counts);

}  // namespace oriel
