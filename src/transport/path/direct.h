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
#include "transport/path/path_observer.h"

namespace oriel {

/// Controls of direct light.
struct DirectRequest {
  bool environment_on_diffuse = true;  ///< false: what is gathered for them has it
  /// False where reflection rays end early or look up the environment their own way: they find it
  /// alone.
  bool environment_in_reflections = true;
  /// Rays of glossy lobes are bent by glass on their way: behind it they find the environment and
  /// visible lights, samples of these count only through holes. False after a diffuse bounce, where
  /// all rays go straight.
  bool rays_bend = false;
  bool for_the_eye = false;     ///< what glossy lobes show here is seen, not scattered on
  bool portals_mapped = false;  ///< see portals_on_way
  float falloff_distance = 0;   ///< visible lights fade out in reflections; 0 = they do not
  Estimator estimator = Estimator::Mis;
  PathObserver* observer = nullptr;  ///< optional observer of samples; may be null
  PathObserver::Place place = PathObserver::kEye;
};

/// Radiance toward wo, per unit throughput, by what it came through.
struct DirectLight {
  Rgb diffuse{0}, translucency{0}, specular{0}, reflection{0}, refraction{0};
  /// Of the environment: on the lit side, and through the surface.
  Rgb environment{0}, environment_translucency{0};
};

/// The same apart by samples, each of one layer of lights.
struct DirectShares {
  /// All lights that are sampled at one vertex (LightSampler), and the environment.
  static constexpr int kMost = 16;
  struct Share {
    std::size_t layer = 0;
    DirectLight light;
  };
  std::array<Share, kMost> of;
  int count = 0;

  DirectLight& next(std::size_t layer) {
    ORIEL_ASSERT(count < kMost);
    Share& share = of[static_cast<std::size_t>(count++)];
    share.layer = layer;
    return share.light;
  }
};

/// Everything direct at a vertex: lights and, when asked, the environment.
///
/// Model:   each light sample weighs against the directions sample_lobe would have chosen (power
///          heuristic), apart for the groups of lobes; lights without extent stand alone, and so do
///          lights without shadows, since rays would be blocked, and highlights, which no ray
///          finds.
/// Inputs:  lights: what lights the vertex; shares: where given, samples are left there and the sum
///          is black.
/// Checked: tests/analytic (one scene by three estimators, furnaces of rough glass).
DirectLight direct_light(const World& world, ShadingPoint& point, const Closure& closure,
                         const LobeChoice& lobes, const LitVertex& lights,
                         const DirectRequest& request, sampling::Sampler& sampler,
                         RayCounts& counts, DirectShares* shares = nullptr);

/// How a light shows in reflecting lobes, of which rays and highlights can both show it.
struct LightInReflection {
  float as_reflection = 0, as_highlight = 1;
  float sum() const { return as_reflection + as_highlight; }
};
/// `forced`: the light asks for its highlight all the same.
LightInReflection light_in_reflection(const Closure& closure, bool visible, bool forced = false);
/// Of a portal that rays pass: they find the environment behind it themselves.
LightInReflection hidden_portal_in_reflection(const Closure& closure);

}  // namespace oriel
