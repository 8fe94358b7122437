// SPDX-License-Identifier: Apache-2.0
// Direct light at a vertex: samples of lights and of the environment, shadowed and weighted.
#pragma once

#include <array>

#include "base/assert.h"
#include "lights/light_sampler.h"
#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/estimator.h"
#include "transport/lobes.h"
#include "transport/path/lit_surfaces.h"
#include "transport/path/path_observer.h"

namespace oriel {

struct IndirectCaches;

/// What light samples at a surface know of the vertex that found it by a ray of a lobe, if that
/// vertex sampled the surfaces that directional lights illuminate.
struct BesideLitSurfaces {
  const LitSurfaces* surfaces = nullptr;  ///< null: it did not
  float pdf = 0;                          ///< of the ray, per solid angle
  float area_per_angle = 0;               ///< of the surface, seen from there
};

/// Controls of direct light.
struct DirectRequest {
  bool environment_on_diffuse = true;  ///< false: gathered light includes it
  /// False: reflection rays have a maximum distance or their own look-up of the environment, so
  /// only they bring it.
  bool environment_in_reflections = true;
  /// Glass bends rays of glossy lobes, so behind glass only these rays bring the environment and
  /// visible lights; light samples count only through cut-outs. False after a diffuse bounce, where
  /// all rays pass straight.
  bool rays_bend = false;
  bool for_the_eye = false;     ///< the camera sees the reflections of glossy lobes here
  bool portals_mapped = false;  ///< see portals_on_way
  float falloff_distance = 0;   ///< at which visible lights have faded out in reflections; 0 = none
  Estimator estimator = Estimator::Mis;
  PathObserver* observer = nullptr;  ///< optional observer of samples; may be null
  PathObserver::Place place = PathObserver::kEye;
  BesideLitSurfaces beside = {};
  /// Maps whose caustics reflecting lobes do not bring; may be null.
  const IndirectCaches* mapped = nullptr;
  /// Only light that opaque objects would block, at a point where none does.
  bool unblocked_only = false;
};

/// Radiance toward wo, per unit throughput, by the lobe that it came through.
struct DirectLight {
  Rgb diffuse{0}, translucency{0}, specular{0}, reflection{0}, refraction{0};
  /// Of the environment: on the viewer's side, and through the surface.
  Rgb environment{0}, environment_translucency{0};
};

/// The same split by samples, each of one light layer.
struct DirectShares {
  /// Maximum number of samples at a vertex: those of LightSampler, and the environment.
  static constexpr int kMax = 16;
  struct Share {
    std::size_t layer = 0;
    DirectLight light;
  };
  std::array<Share, kMax> of;
  int count = 0;

  DirectLight& next(std::size_t layer) {
    ORIEL_ASSERT(count < kMax);
    Share& share = of[static_cast<std::size_t>(count++)];
    share.layer = layer;
    return share.light;
  }
};

/// Direct light at a vertex: lights and, if requested, the environment.
///
/// Model:   each light sample has a MIS weight against sample_lobe (power heuristic), separately
///          for the groups of lobes. Lights without extent have weight 1, and so have lights
///          without shadows, since rays would be blocked, and highlights, which no ray hits.
/// Inputs:  lights: the lights of the vertex; shares: if not null, receives the samples, and the
///          sum is black.
/// Checked: tests/analytic (one scene by three estimators, furnaces of rough glass).
DirectLight direct_light(const World& world, ShadingPoint& point, const Closure& closure,
                         const LobeChoice& lobes, const LitVertex& lights,
                         const DirectRequest& request, sampling::Sampler& sampler,
                         RayCounts& counts, DirectShares* shares = nullptr);

/// Light of one directional light alone, as direct_light() computes it, with expected values.
///
/// Inputs:  point: where no opaque object is between it and the light; u: of sample_light();
///          rays_bend, mapped: as DirectRequest. The closure is ready for the viewer.
/// Returns: radiance toward wo; black if the light would pass opaque objects.
Rgb light_of(const World& world, ShadingPoint& point, const Closure& closure, int light, Vec2 u,
             bool rays_bend, const IndirectCaches* mapped, RayCounts& counts);

/// Weights of a light in reflecting lobes, where both rays and highlights can show it.
struct LightInReflection {
  float as_reflection = 0, as_highlight = 1;
  float sum() const { return as_reflection + as_highlight; }
};
/// `forced`: the light requires its highlight in any case.
inline LightInReflection light_in_reflection(const Closure& closure, bool visible,
                                             bool forced = false) {
  if (!visible) return {0, closure.highlight_scale};
  // Rays reflect visible lights; a highlight is added only if the material requests it.
  return {1, forced || closure.highlights_of_visible_lights ? closure.highlight_scale : 0};
}
/// For a portal that rays pass: they bring the environment behind it.
inline LightInReflection hidden_portal_in_reflection(const Closure& closure) {
  return {0, light_in_reflection(closure, true).as_highlight};
}

}  // namespace oriel
