// SPDX-License-Identifier: Apache-2.0
// The path tracer: the reference every other transport must agree with.
#pragma once

#include <optional>

#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/estimator.h"
#include "transport/path/path_record.h"

namespace oriel {

class GlossyGrid;
struct IndirectCaches;

/// How paths are traced.
struct PathSettings {
  static constexpr int kAllBounces = 1 << 20;
  /// False: no diffuse bounces and no light from the environment on diffuse lobes, as a scene
  /// without final gathering and photons is rendered.
  bool indirect = true;
  int diffuse_bounces = kAllBounces;  ///< most of them; light from the environment is the last one
  Rgb further_bounces{1};             ///< factor of each diffuse bounce behind the first
  /// Trace depth behind a diffuse bounce; unset = that of the options.
  std::optional<scene::TraceDepth> depth_behind = std::nullopt;
  bool finite_lights =
      true;  ///< false: light elements give nothing, the sky and what glows are left
  Estimator estimator = Estimator::Mis;
  bool mesh_lights = true;  ///< false: what glows is found by rays alone; the mean is the same
  /// Paths that the pixel gets in all. The more, the fewer rays each splits into at its first
  /// surface: a material's sample counts are for the pixel.
  float paths_of_pixel = 1e6f;
  const IndirectCaches* maps = nullptr;  ///< indirect light made before; null = rays find it all
  const GlossyGrid* grid = nullptr;      ///< for materials that interpolate; null = they do not
};

/// Traces one path, a tree where the first surface asks for more rays.
///
/// Model:   unidirectional, multiple importance sampling of lights and environment against the
///          lobes, Russian roulette after kRouletteDepth diffuse or glossy vertices. Trace depths
///          as the options say, counted anew after each diffuse bounce. Through transparent
///          materials whose shadows are transparent, rays that follow a diffuse bounce go on
///          straight, as the shadow rays they are weighed against do (photons do the same): bent
///          light is caustics. Cut-offs, occlusion and its neighbours act before the first diffuse
///          bounce. An object that its flags keep from sending gather rays has no indirect light
///          but that of photon maps; one that sends no reflection rays shows highlights alone, one
///          that sends no refraction rays is black behind, except where rays go on straight.
/// Checked: tests/analytic (furnace, skies, form factors, shapes of lights, mirrors, glass, three
///          estimators, outputs).
void trace_path(const World& world, const Camera::Ray& eye, Vec2 raster,
                const PathSettings& settings, PathRecord& record, sampling::Sampler& sampler,
                RayCounts& counts);
/// The same without optional values.
PathResult trace_path(const World& world, const Camera::Ray& eye, Vec2 raster,
                      const PathSettings& settings, sampling::Sampler& sampler, RayCounts& counts);

/// What a final gather ray from a surface sees: surfaces and environment, no light sources.
///
/// Inputs:  direction: unit, on the viewer's side; settings.diffuse_bounces: those behind the first
///          surface met, 0 = its direct light alone; reach: scene units, beyond it there is
///          nothing but the environment.
/// Returns: radiance; depth = distance to the surface, 0 = none.
void trace_gather_ray(const World& world, const ShadingPoint& point, const Vec3& direction,
                      float reach, const PathSettings& settings, PathRecord& record,
                      sampling::Sampler& sampler, RayCounts& counts);
PathResult trace_gather_ray(const World& world, const ShadingPoint& point, const Vec3& direction,
                            float reach, const PathSettings& settings, sampling::Sampler& sampler,
                            RayCounts& counts);

}  // namespace oriel
