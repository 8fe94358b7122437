// SPDX-License-Identifier: Apache-2.0
// The path tracer: the reference every other transport must agree with.
#pragma once

#include <optional>
#include <vector>

#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/estimator.h"
#include "transport/path/aov.h"

namespace oriel {

/// What a path through the camera met first.
struct FirstSurface {
  int instance = -1;                   ///< index into World::instances; -1 = nothing
  const Material* material = nullptr;  ///< one of World::materials
};

/// What one path through the camera brings to the film.
struct PathResult {
  Rgb radiance{0};  ///< pixel units, linear
  float alpha = 0;
  float depth = 0;  ///< distance to the first surface, scene units; 0 = none
  /// World, shading normal, and sum of the material's levels: of the first surface that is not only
  /// a mirror or clear glass, seen through those; else of the first surface.
  Vec3 normal{0};
  Rgb albedo{0};
  Rgb irradiance{0};  ///< of the first surface, where PathSettings::irradiance; see light_meter.h
  FirstSurface first;
};

class GlossyGrid;
class PathObserver;
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
  AovValues* outputs = nullptr;  ///< where to leave the parts of the radiance; null = nowhere
  /// Where to add the radiance by layers of lights, World::light_layers.count() of them; null =
  /// nowhere.
  Rgb* by_light = nullptr;
  Rgba* buffers = nullptr;  ///< World::user_buffers.size() values that shaders leave; null = none
  /// Where to leave the way of the first surface on the picture, as raster_motion() has it.
  Rgba* motion = nullptr;
  /// Where each path through the camera adds what it met first; null = nowhere.
  std::vector<FirstSurface>* firsts = nullptr;
  PathObserver* observer = nullptr;  ///< optional observer of path events; may be null
  bool irradiance = false;  ///< the irradiance of the first surface is wanted: a second path
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
PathResult trace_path(const World& world, const Camera::Ray& eye, Vec2 raster,
                      const PathSettings& settings, sampling::Sampler& sampler, RayCounts& counts);

/// What a final gather ray from a surface sees: surfaces and environment, no light sources.
///
/// Inputs:  direction: unit, on the viewer's side; settings.diffuse_bounces: those behind the first
///          surface met, 0 = its direct light alone; reach: scene units, beyond it there is
///          nothing but the environment.
/// Returns: radiance; depth = distance to the surface, 0 = none.
PathResult trace_gather_ray(const World& world, const ShadingPoint& point, const Vec3& direction,
                            float reach, const PathSettings& settings, sampling::Sampler& sampler,
                            RayCounts& counts);

}  // namespace oriel
