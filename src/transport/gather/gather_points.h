// SPDX-License-Identifier: Apache-2.0
// Final gather points and the computation of their records.
#pragma once

#include <vector>

#include "transport/counts.h"
#include "transport/gather/bounce_reads.h"
#include "transport/indirect_caches.h"
#include "transport/path/path.h"

namespace oriel {

/// A surface point that is visible to the camera, directly or through mirrors and glass.
struct GatherPoint {
  ShadingPoint point;
  Vec3 normal{0, 0, 1};  ///< unit, on the lit side
  float quality = 1;     ///< factor of the number of rays
};

/// Appends the diffuse surfaces on the path of one camera sample.
void visit_gather_points(const World& world, Vec2 raster, const PathSettings& settings,
                         sampling::Sampler& sampler, RayCounts& counts,
                         std::vector<GatherPoint>& points);

/// Appends the diffuse surfaces on the path of a gather ray.
void visit_gather_ray(const World& world, const GatherPoint& from, const Vec3& direction,
                      const PathSettings& settings, sampling::Sampler& sampler, RayCounts& counts,
                      std::vector<GatherPoint>& points);

/// Settings of records.
struct GatherSettings {
  int rays = 400;
  int filter = 0;
  /// Surfaces fade to the environment from distance `fades_from` on; beyond `reach` only the
  /// environment is visible. Scene units; reach 0 = unlimited.
  float fades_from = 0, reach = 0;
  GatherRadii radii;  ///< in scene units or pixels
  PathSettings path;  ///< of the rays: bounces behind the first surface, photons
};

/// Default radii, from the diagonal of the scene, scene units.
GatherRadii default_gather_radii(float diagonal);

/// Settings from the options. The scene's box and trace depth supply defaults.
GatherSettings gather_settings(const scene::RenderOptions& options, const geom::Box3& scene);

/// Look-up settings from the options.
///
/// Model:   automatic: the "finalgather points" records of least error. Multiframe: as many of the
///          nearest records within the maximum radius, with a fade to black. 3.4: all records
///          within their radius. Strict 3.4: the same without gradients.
GatherQuery gather_query(const scene::FinalGatherOptions& options, const GatherRadii& radii);

/// The rays of one record. If their reads of coarse records were kept apart, the record can be made
/// again after those have changed.
struct GatherRays {
  struct Read {
    int stratum;
    BounceReads::Read of;
  };
  GatherHemisphere hemisphere;
  std::vector<GatherSample> samples;  ///< by stratum, without the reads
  std::vector<Rgb> by_light;          ///< the same by light layer: strata x layers
  std::vector<Read> reads;
  bool complete = true;  ///< see BounceReads
};

/// Traces the rays of a record. `keeps_reads`: coarse records are not added but kept as reads.
GatherRays trace_gather_rays(const World& world, const GatherPoint& at,
                             const GatherSettings& settings, const sampling::Sampler& sampler,
                             RayCounts& counts, bool keeps_reads);
/// The record of these rays, with what their reads find in `coarse` (null: there are none).
GatherRecord gathered_record(const World& world, const GatherPoint& at,
                             const GatherSettings& settings, const GatherRays& rays,
                             const GatherCache* coarse = nullptr);

/// Gathers light at one point. Rays see surfaces and environment, no light sources.
GatherRecord gather_at(const World& world, const GatherPoint& at, const GatherSettings& settings,
                       const sampling::Sampler& sampler, RayCounts& counts);

}  // namespace oriel
