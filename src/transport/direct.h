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
/// estimated irradiance.
class LightChoice {
 public:
  LightChoice() = default;
  LightChoice(const World& world, ShadingPoint& point, const Closure& closure);

  bool empty() const { return count_ == 0; }
  /// Whether sample() needs a random number: not when all lights are asked.
  bool draws() const { return !all_; }
  /// Expected number of samples of light i at this vertex, for multiple importance sampling; 0 =
  /// this vertex is not lit by it.
  float rate(int light) const;
  /// Calls f(light index, rate) for each light to sample.
  template <class F>
  void sample(float u, F&& f) const;

 private:
  static constexpr int kSampleAll = 4;
  bool lit_by(int light) const;

  const World* world_ = nullptr;
  const InstanceData* instance_ = nullptr;
  int mode_ = 4;
  ArrayView<LightRef> listed_;
  int count_ = 0;
  bool all_ = true;
  float total_ = 0;
  static constexpr int kMostWeighed = 64;
  float estimate_[kMostWeighed];  // the first count_ are set
};

/// What direct light is asked for.
struct DirectRequest {
  bool environment = false;
  /// Rays of glossy lobes are bent by glass on their way: behind it they find the environment and
  /// visible lights, samples of these count only through holes. False after a diffuse bounce, where
  /// all rays go straight.
  bool rays_bend = false;
  Estimator estimator = Estimator::Mis;
};

/// Everything direct at a vertex: lights and, when asked, the environment.
///
/// Returns: radiance toward wo, per unit throughput.
/// Model:   each light sample weighs against the directions sample_closure would have chosen (power
///          heuristic), apart for the parts of the response; lights without extent stand alone, and
///          so do lights without shadows, since rays would be blocked.
/// Checked: tests/analytic (one scene by three estimators, furnaces of rough glass).
Rgb direct_light(const World& world, ShadingPoint& point, const Closure& closure,
                 const LobeChoice& lobes, const LightChoice& lights, const DirectRequest& request,
                 sampling::Sampler& sampler, RayCounts& counts);

/// Factor on reflecting lobes when the source is this light (highlight against reflection).
float highlight_scale(const Closure& closure, const Light& light);

template <class F>
void LightChoice::sample(float u, F&& f) const {
  if (count_ == 0) return;
  const int lights = static_cast<int>(world_->lights.size());
  if (all_) {
    for (int i = 0; i < lights; ++i)
      if (rate(i) > 0) f(i, 1.0f);
    return;
  }
  if (lights > kMostWeighed) {
    const int i = std::min(static_cast<int>(u * static_cast<float>(lights)), lights - 1);
    if (rate(i) > 0) f(i, rate(i));
    return;
  }
  float target = u * total_;
  int last = -1;
  for (int i = 0; i < lights; ++i) {
    if (estimate_[i] <= 0) continue;
    last = i;
    if (target < estimate_[i]) break;
    target -= estimate_[i];
  }
  if (last >= 0) f(last, estimate_[last] / total_);
}

}  // namespace oriel
