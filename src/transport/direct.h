// SPDX-License-Identifier: Apache-2.0
// Direct light: which lights to ask at a vertex, and what they bring.
#pragma once

#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/estimator.h"
#include "transport/lobes.h"

namespace oriel {

/// How the lights of a vertex are sampled: all of them when there are few, else one of them by its
/// estimated irradiance. Portals are a group of their own, of which always one is asked: a window
/// in many parts costs what one window costs, and keeps no samples from the sun.
class LightChoice {
 public:
  LightChoice() = default;
  LightChoice(const World& world, ShadingPoint& point, const Closure& closure);

  bool empty() const { return count_ == 0; }
  /// Whether sample() needs a random number: not when all lights are asked.
  bool draws() const { return !usual_.all || !portals_.all; }
  /// Expected number of samples of light i at this vertex, for multiple importance sampling; 0 =
  /// this vertex is not lit by it.
  float rate(int light) const;
  /// Calls f(light index, rate) for each light to sample.
  template <class F>
  void sample(float u, F&& f) const;

 private:
  static constexpr int kSampleAll = 4, kSampleAllPortals = 1;
  struct Group {
    bool all = true;
    float total = 0;
  };
  bool lit_by(int light) const;
  bool is_portal(int light) const {
    return world_->lights[static_cast<std::size_t>(light)].portal != nullptr;
  }
  const Group& group_of(int light) const { return is_portal(light) ? portals_ : usual_; }
  void weigh(Group& group, int count, bool portals, ShadingPoint& point);
  template <class F>
  void sample_group(const Group& group, bool portals, float& u, F&& f) const;

  const World* world_ = nullptr;
  const InstanceData* instance_ = nullptr;
  int mode_ = 4;
  ArrayView<LightRef> listed_;
  int count_ = 0;
  Group usual_, portals_;
  static constexpr int kMostWeighed = 64;
  float estimate_[kMostWeighed];  // the first count_ are set
};

/// What direct light is asked for.
struct DirectRequest {
  bool environment = false;
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
};

/// Radiance toward wo, per unit throughput, by what it came through.
struct DirectLight {
  Rgb diffuse{0}, translucency{0}, specular{0}, reflection{0}, refraction{0};
  /// Of the environment: on the lit side, and through the surface.
  Rgb environment{0}, environment_translucency{0};
};

/// Everything direct at a vertex: lights and, when asked, the environment.
///
/// Model:   each light sample weighs against the directions sample_lobe would have chosen (power
///          heuristic), apart for the groups of lobes; lights without extent stand alone, and so do
///          lights without shadows, since rays would be blocked, and highlights, which no ray
///          finds.
/// Checked: tests/analytic (one scene by three estimators, furnaces of rough glass).
DirectLight direct_light(const World& world, ShadingPoint& point, const Closure& closure,
                         const LobeChoice& lobes, const LightChoice& lights,
                         const DirectRequest& request, sampling::Sampler& sampler,
                         RayCounts& counts);

/// How a light shows in reflecting lobes, of which rays and highlights can both show it.
struct LightInReflection {
  float as_reflection = 0, as_highlight = 1;
  float sum() const { return as_reflection + as_highlight; }
};
LightInReflection light_in_reflection(const Closure& closure, bool visible);
/// Of a portal that rays pass: they find the environment behind it themselves.
LightInReflection hidden_portal_in_reflection(const Closure& closure);

template <class F>
void LightChoice::sample_group(const Group& group, bool portals, float& u, F&& f) const {
  const int lights = static_cast<int>(world_->lights.size());
  float target = u * group.total;
  int last = -1;
  float below = 0;  // of the target, in the last one
  for (int i = 0; i < lights; ++i) {
    if (estimate_[i] <= 0 || is_portal(i) != portals) continue;
    if (group.all) {
      f(i, 1.0f);
      continue;
    }
    last = i;
    below = target;
    if (target < estimate_[i]) break;
    target -= estimate_[i];
  }
  if (last < 0) return;
  u = clamp(below / estimate_[last], 0.0f, 0x1.fffffep-1f);
  f(last, estimate_[last] / group.total);
}

template <class F>
void LightChoice::sample(float u, F&& f) const {
  if (count_ == 0) return;
  const int lights = static_cast<int>(world_->lights.size());
  if (lights > kMostWeighed) {
    const int i = std::min(static_cast<int>(u * static_cast<float>(lights)), lights - 1);
    if (rate(i) > 0) f(i, rate(i));
    return;
  }
  sample_group(usual_, false, u, f);
  if (portals_.total > 0) sample_group(portals_, true, u, f);
}

}  // namespace oriel
