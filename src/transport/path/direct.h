// SPDX-License-Identifier: Apache-2.0
// Direct light: which lights to ask at a vertex, and what they bring.
#pragma once

#include <array>

#include "base/assert.h"
#include "runtime/world.h"
#include "sampling/sampler.h"
#include "transport/counts.h"
#include "transport/estimator.h"
#include "transport/lobes.h"
#include "transport/path/path_observer.h"

namespace oriel {

/// How the lights of a vertex are sampled: those infinitely far, the lamps and the portals each all
/// when they are few, else one of them. Groups of their own since a window in many parts shall cost
/// what one window costs, and keep no samples from the sun.
class LightChoice {
 public:
  LightChoice() = default;
  LightChoice(const World& world, const ShadingPoint& point, const Closure& closure);

  bool empty() const { return !world_ || world_->lights.empty(); }
  /// Whether sample() needs a random number: not when all lights are asked.
  bool draws() const;
  /// Expected number of samples of light i at this vertex, for multiple importance sampling; 0 =
  /// this vertex is not lit by it.
  float rate(int light) const;
  /// Calls f(light index, rate) for each light to sample.
  template <class F>
  void sample(float u, F&& f) const;

 private:
  static constexpr int kSampleAll = 4, kSampleAllPortals = 1;
  bool lit_by(int light) const;
  bool is_listed(int light) const;
  int listed_light(int i) const;
  template <class F>
  void sample_listed(float u, F&& f) const;
  template <class F>
  void sample_tree(const LightTree& tree, int most, float& u, F&& f) const;

  const World* world_ = nullptr;
  LitPoint lit_;
  const InstanceData* instance_ = nullptr;
  ArrayView<LightRef> listed_;
  /// How many the material's list or the instance's links name, when only these count.
  int named_ = -1;
  bool by_material_ = false;  ///< the material's list decides, else the instance's links
  bool excluded_ = false;     ///< it names those that do not count
};

/// What direct light is asked for.
struct DirectRequest {
  float environment_rate = 0;          ///< how often it is asked, in the mean; at most 1
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
  /// All lights that may be asked at a vertex (LightChoice), and the environment.
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
/// Inputs:  shares: where given, samples are left there and the sum is black.
/// Checked: tests/analytic (one scene by three estimators, furnaces of rough glass).
DirectLight direct_light(const World& world, ShadingPoint& point, const Closure& closure,
                         const LobeChoice& lobes, const LightChoice& lights,
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

template <class F>
void LightChoice::sample_listed(float u, F&& f) const {
  if (named_ == 0) return;
  if (named_ > kSampleAll) {
    const int i = std::min(static_cast<int>(u * static_cast<float>(named_)), named_ - 1);
    const int light = listed_light(i);
    if (lit_by(light)) f(light, 1 / static_cast<float>(named_));
    return;
  }
  for (int i = 0; i < named_; ++i)
    if (lit_by(listed_light(i))) f(listed_light(i), 1.0f);
}

template <class F>
void LightChoice::sample_tree(const LightTree& tree, int most, float& u, F&& f) const {
  if (tree.size() <= most) {
    for (const int light : tree.names())
      if (lit_by(light)) f(light, 1.0f);
  } else if (const auto choice = tree.choose(lit_, u)) {
    if (lit_by(choice->light)) f(choice->light, choice->probability);
  }
}

template <class F>
void LightChoice::sample(float u, F&& f) const {
  if (empty()) return;
  if (named_ >= 0) return sample_listed(u, f);
  const LightGroups& groups = world_->light_groups;
  const int infinite = static_cast<int>(groups.infinite.size());
  if (infinite <= kSampleAll) {
    for (const int light : groups.infinite)
      if (lit_by(light)) f(light, 1.0f);
  } else {
    const float scaled = u * static_cast<float>(infinite);
    const int i = std::min(static_cast<int>(scaled), infinite - 1);
    u = std::min(scaled - static_cast<float>(i), 0x1.fffffep-1f);
    const int light = groups.infinite[static_cast<std::size_t>(i)];
    if (lit_by(light)) f(light, 1 / static_cast<float>(infinite));
  }
  sample_tree(groups.finite, kSampleAll, u, f);
  sample_tree(groups.portals, kSampleAllPortals, u, f);
}

}  // namespace oriel
