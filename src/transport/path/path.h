// SPDX-License-Identifier: Apache-2.0
// The path tracer, the reference for all other methods.
#pragma once

#include <optional>

#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/estimator.h"
#include "transport/path/path_record.h"

namespace oriel {

class DirectionGuide;
class GlossyGrid;
class LearnedLights;
class LitSurfaces;
struct IndirectCaches;

/// Settings of paths.
struct PathSettings {
  static constexpr int kAllBounces = 1 << 20;
  /// False: no diffuse bounces and no environment light on diffuse lobes, as in scenes without
  /// final gathering and photons.
  bool indirect = true;
  int diffuse_bounces = kAllBounces;  ///< maximum; environment light counts as the last one
  Rgb further_bounces{1};             ///< factor of each diffuse bounce after the first
  /// Trace depth behind a diffuse bounce; unset = that of the options.
  std::optional<scene::TraceDepth> depth_behind = std::nullopt;
  bool finite_lights = true;  ///< false: only the environment and emissive surfaces give light
  Estimator estimator = Estimator::Mis;
  /// Rays of a large diffuse lobe at the first surface, for every path; the material may ask for
  /// more.
  int diffuse_rays = 1;
  bool mesh_lights = true;  ///< false: emissive triangles are not sampled; the mean is the same
  /// Number of paths of the pixel in all. Sample counts of materials are per pixel, so with more
  /// paths each splits into fewer rays at its first surface.
  float paths_of_pixel = 1e6f;
  const IndirectCaches* maps = nullptr;   ///< caches of indirect light; null = all light is traced
  const LitSurfaces* lit = nullptr;       ///< sampled as lights; null = only rays find them
  const DirectionGuide* guide = nullptr;  ///< of diffuse directions; null = by the cosine
  /// For the choice of lights, and of parts of the mesh lights; null = by the light tree.
  const LearnedLights *lights = nullptr, *emitters = nullptr;
  const GlossyGrid* grid = nullptr;  ///< for materials that interpolate reflections; null = none
};

/// Traces one path; it is a tree if the first surface needs several rays.
///
/// Model:   unidirectional, multiple importance sampling of lights and environment against the
///          lobes, Russian roulette after kRouletteDepth diffuse or glossy vertices. Trace depths
///          are those of the options and restart after each diffuse bounce. After a diffuse bounce
///          rays pass straight through transparent materials with transparent shadows, as photons
///          do and as the shadow rays do that the MIS weights refer to: refracted light there is a
///          caustic. Cut-offs and occlusion apply before the first diffuse bounce. An object whose
///          flags disable gather rays has no indirect light except that of photon maps; one without
///          reflection rays shows highlights only; one without refraction rays is black behind,
///          except where rays pass straight.
/// Checked: tests/analytic (furnace, skies, form factors, shapes of lights, mirrors, glass, three
///          estimators, outputs).
void trace_path(const World& world, const Camera::Ray& eye, Vec2 raster,
                const PathSettings& settings, PathRecord& record, sampling::Sampler& sampler,
                RayCounts& counts);
/// The same without optional values.
PathResult trace_path(const World& world, const Camera::Ray& eye, Vec2 raster,
                      const PathSettings& settings, sampling::Sampler& sampler, RayCounts& counts);
/// Whether such a path would meet an object; lamps and the environment are none.
bool meets_object(const World& world, const Camera::Ray& eye);

/// Traces a final gather ray from a surface; it sees surfaces and environment, no light sources.
///
/// Inputs:  direction: unit, on the viewer's side; settings.diffuse_bounces: after the first
///          hit, 0 = its direct light only; reach: scene units, beyond it only the environment is
///          visible.
/// Returns: radiance; depth = distance to the surface, 0 = none.
void trace_gather_ray(const World& world, const ShadingPoint& point, const Vec3& direction,
                      float reach, const PathSettings& settings, PathRecord& record,
                      sampling::Sampler& sampler, RayCounts& counts);
PathResult trace_gather_ray(const World& world, const ShadingPoint& point, const Vec3& direction,
                            float reach, const PathSettings& settings, sampling::Sampler& sampler,
                            RayCounts& counts);

}  // namespace oriel
