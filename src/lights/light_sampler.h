// SPDX-License-Identifier: Apache-2.0
// The light sampler: which lights a vertex samples, how many samples each gets, and with which
// density each direction is found.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lights/environment_light.h"
#include "lights/light_chances.h"
#include "lights/light_tree.h"
#include "lights/mesh_lights.h"
#include "lights/openings.h"
#include "lights/sample_light.h"
#include "runtime/closure.h"
#include "runtime/world.h"

namespace oriel {

// Conventions
//   Light comes from three sources: elements (World::lights), the environment, and the triangles of
//   emissive surfaces (mesh lights). Each source has
//     sample...()   picks lights, or a direction to one
//     pdf...()      density per solid angle with which sample...() finds a direction
//   Densities are multiplied by the expected number of samples of the light at the vertex (at most
//   1), so they are what multiple importance sampling compares with the density of a BSDF sample.
//
// To add
//   - a shape of an element: an enumerator in LightShape and a case in each function of
//     light_shape.cpp.
//   - a kind of element that is chosen apart from others: a row in LightSampler::Set and
//     LightSampler::set_of.
//   - a source: a class with a sample and a pdf function like MeshLights, a member here, and its
//     pair of functions.

/// How the environment is sampled at a vertex.
struct EnvironmentChances {
  float samples = 0;   ///< expected number of samples, at most 1
  float plain = 1;     ///< share of the samples that ignores openings
  float openings = 0;  ///< Openings::total()
};

/// A vertex as the light sampler sees it: where it is, and which elements light it.
class LitVertex {
 public:
  /// No element lights it.
  LitVertex() = default;
  LitVertex(const World& world, const ShadingPoint& point, const Closure& closure);

  /// Whether no element lights it.
  bool empty() const { return !has_elements_; }

  EnvironmentChances environment;
  /// Learned probabilities of the lights with a position; optional.
  LightChances chances;

 private:
  friend class LightSampler;
  bool is_listed(int light) const;
  int listed_light(int i) const;
  bool allows(int light) const {
    return (!by_material_ && !instance_) || is_listed(light) != excluded_;
  }

  LitPoint lit_;
  const InstanceData* instance_ = nullptr;
  ArrayView<LightRef> listed_;
  int count_ = -1;       ///< length of the list if only the listed lights count, else -1
  bool placed_ = false;  ///< has a position
  bool has_elements_ = false;
  bool by_material_ = false;  ///< the list is the material's, else the instance's links
  bool excluded_ = false;     ///< the listed lights do not count
};

/// An element to sample, and its expected number of samples.
struct LightPick {
  int light = 0;  ///< index into World::lights
  float expected_samples = 1;
};

/// A direction in which a sample was placed.
struct LightDirection {
  Vec3 wi{0};
  float distance = 0;
  float pdf = 0;
};

struct EnvironmentDirection : LightDirection {
  std::size_t cell = 0;  ///< of the environment's table
};

struct TriangleSample : LightDirection {
  std::uint32_t instance = 0, primitive = 0;  ///< of the world's accel
};

/// Samples all lights of a scene.
///
/// Model:   elements without a position, elements with one, and portals are three sets. A small set
///          is sampled completely; one light of a large set is sampled, by a light tree. Sets are
///          apart because a window of many portals should cost as much as one, and should take no
///          samples from the sun.
/// Checked: LightSampler.* in light_sampler_test.cpp; tests/analytic
class LightSampler {
 public:
  /// Inputs:  world: with its lights bound, its geometry built and its portals opened; it must
  ///          outlive the sampler.
  LightSampler(const World& world, EnvironmentLight environment, MeshLights mesh_lights,
               Openings openings = {});

  // Elements

  /// Whether sample() uses its random number at that vertex.
  bool needs_random(const LitVertex& at) const;
  /// Calls f(LightPick) for each element to sample. Inputs:  u: uniform in [0,1).
  template <class F>
  void sample(const LitVertex& at, float u, F&& f) const;
  /// The same at a point in a volume, without links and lists of lights. Each element has a
  /// probability above 0 even if it does not light this point, since the caller may sample its
  /// light at another point of the ray.
  template <class F>
  void sample_in_volume(const Vec3& place, float u, F&& f) const;
  /// Whether one light of some set is chosen at random, so that these use their random number.
  bool chooses() const {
    return std::any_of(sets_.begin(), sets_.end(),
                       [](const Set& set) { return set.size() > set.sample_all; });
  }
  /// Expected number of samples of an element; 0 = it does not light the vertex.
  float expected_samples(const LitVertex& at, int light) const;
  /// One sample of a picked element: irradiance and pdf are those of all its samples.
  std::optional<LightSample> sample_picked(const LightPick& pick, ShadingPoint& point,
                                           Vec2 u) const {
    auto sample = sample_light(world_.lights[static_cast<std::size_t>(pick.light)], point, u);
    if (sample && pick.expected_samples != 1) {
      sample->irradiance /= pick.expected_samples;
      sample->pdf *= pick.expected_samples;
    }
    return sample;
  }
  /// Calls f(index) for each element whose bounds a ray hits within (0, t_most). Elements without a
  /// position are left out.
  template <class F>
  void for_each_on_way(const Vec3& from, const Vec3& direction, float t_most, F&& f) const;
  const LightTree& portals() const { return sets_[kPortals].tree; }
  /// Probability with which the light tree chooses one of chosen_lights().
  float probability_by_tree(const LitPoint& lit, int light) const {
    return sets_[kFinite].tree.probability(lit, light);
  }
  /// The lights with a position of which one is chosen for each vertex, in ascending order; empty
  /// where all are sampled.
  std::span<const int> chosen_lights() const {
    const Set& set = sets_[kFinite];
    return set.size() > set.sample_all ? std::span<const int>(set.lights) : std::span<const int>();
  }

  // The environment

  const EnvironmentLight& environment() const { return environment_; }
  /// At a vertex. `alone`: no BSDF sample is combined with its samples. Otherwise BSDF samples find
  /// an even environment, which then gets no samples of its own, except through openings.
  EnvironmentChances environment_chances(const LitVertex& at, bool after_diffuse, bool alone) const;
  /// A direction, or by chance none.
  std::optional<EnvironmentDirection> sample_environment(const LitVertex& at, Vec2 u,
                                                         bool alone) const;
  /// What a ray of kind FinalGather that hits nothing finds.
  struct EnvironmentFound {
    Rgb radiance{0};
    float pdf = 0;  ///< of sample_environment
  };
  /// Inputs:  sampled: the vertex that the ray left; null = it did not sample the environment.
  EnvironmentFound find_environment(const LitVertex* sampled, const EnvironmentRay& ray) const;
  /// The same radiance alone.
  Rgb environment_radiance(const EnvironmentRay& ray) const {
    return environment_.table().radiance(world_, ray);
  }
  Rgb environment_radiance(const EnvironmentRay& ray, const EnvironmentDirection& sampled) const {
    return environment_.table().radiance(world_, ray, sampled.cell);
  }

  const Openings& openings() const { return openings_; }

  // Emissive triangles

  const MeshLights& mesh_lights() const { return mesh_lights_; }
  /// A point of a triangle; nothing where that is seen edge-on. Inputs:  chances: of the parts of
  /// the mesh lights, or none; u_choice, u_place: uniform in [0,1)^2.
  std::optional<TriangleSample> sample_triangle(const LitPoint& at, const LightChances& chances,
                                                float time, Vec2 u_choice, Vec2 u_place) const;
  /// Inputs:  found: where a ray along `direction` hit the primitive. Returns 0 for primitives that
  /// are not sampled.
  float triangle_pdf(const LitPoint& at, const LightChances& chances, float time,
                     std::uint32_t instance, std::uint32_t primitive, const Vec3& found,
                     const Vec3& direction) const;
  /// A point of a triangle of one part of the mesh lights, likewise.
  std::optional<TriangleSample> sample_part(std::size_t part, const LitPoint& at, float time,
                                            Vec2 u_choice, Vec2 u_place) const;

 private:
  std::optional<TriangleSample> place_on(const std::optional<MeshLights::Choice>& chosen,
                                         const LitPoint& at, float time, Vec2 u) const;
  enum : std::size_t { kInfinite, kFinite, kPortals, kSets };
  static constexpr int kSampleAll = 4, kSampleAllPortals = 1;
  /// Share of the choices in volumes that are uniform over the lights. The light tree never chooses
  /// a spot that misses the point, which may light other points of the ray.
  static constexpr float kEvenlyInVolume = 0.25f;
  /// Lights of which all are sampled if they are few, else one.
  struct Set {
    std::vector<int> lights;
    LightTree tree;               ///< over the lights; empty: they are picked uniformly
    int sample_all = kSampleAll;  ///< largest number of lights that are all sampled

    int size() const { return static_cast<int>(lights.size()); }
    template <class F>
    void sample(const LitPoint& lit, const LightChances& chances, float& u, F&& f) const;
    /// One light evenly. Inputs:  u: uniform in [0,1); returns a new uniform number.
    int pick_evenly(float& u) const {
      const float scaled = u * static_cast<float>(size());
      const int i = std::min(static_cast<int>(scaled), size() - 1);
      u = std::min(scaled - static_cast<float>(i), 0x1.fffffep-1f);
      return lights[static_cast<std::size_t>(i)];
    }
    float expected_samples(const LitPoint& lit, const LightChances& chances, int light) const;
    /// Place of a light of the set in `lights`.
    std::size_t place_of(int light) const {
      return static_cast<std::size_t>(std::lower_bound(lights.begin(), lights.end(), light) -
                                      lights.begin());
    }
  };
  /// The learned probabilities that a vertex has for a set.
  static const LightChances& chances_of(const LitVertex& at, std::size_t set) {
    static constexpr LightChances kUnknown;
    return set == kFinite ? at.chances : kUnknown;
  }
  static std::size_t set_of(const Light& light);
  /// Expected number of samples without openings, beside samples of lobes.
  float plain_samples(bool after_diffuse) const;
  bool is_lit_by(const LitVertex& at, int light) const {
    return light >= 0 && gives_direct_light(world_.lights[static_cast<std::size_t>(light)]) &&
           at.allows(light);
  }

  const World& world_;
  std::array<Set, kSets> sets_;
  EnvironmentLight environment_;
  MeshLights mesh_lights_;
  Openings openings_;
};

template <class F>
void LightSampler::Set::sample(const LitPoint& lit, const LightChances& chances, float& u,
                               F&& f) const {
  if (size() <= sample_all) {
    for (const int light : lights) f(light, 1.0f);
  } else if (chances) {
    int light = -1;
    if (!chances.ignored(u))
      light = lights[chances.choose(u)];
    else if (const auto choice = tree.choose(lit, u))
      light = choice->light;
    if (light >= 0) f(light, expected_samples(lit, chances, light));
  } else if (tree.empty()) {
    f(pick_evenly(u), 1 / static_cast<float>(size()));
  } else if (const auto choice = tree.choose(lit, u)) {
    f(choice->light, choice->probability);
  }
}

template <class F>
void LightSampler::sample(const LitVertex& at, float u, F&& f) const {
  if (at.empty()) return;
  const auto pick = [&](int light, float expected_samples) {
    if (is_lit_by(at, light)) f(LightPick{light, expected_samples});
  };
  if (at.count_ < 0) {
    for (std::size_t k = 0; k < kSets; ++k)
      if (sets_[k].size() > 0) sets_[k].sample(at.lit_, chances_of(at, k), u, pick);
  } else if (at.count_ > kSampleAll) {
    const int i = std::min(static_cast<int>(u * static_cast<float>(at.count_)), at.count_ - 1);
    pick(at.listed_light(i), 1 / static_cast<float>(at.count_));
  } else {
    for (int i = 0; i < at.count_; ++i) pick(at.listed_light(i), 1.0f);
  }
}

template <class F>
void LightSampler::sample_in_volume(const Vec3& place, float u, F&& f) const {
  const LitPoint lit{place, Vec3(0)};
  for (const Set& set : sets_) {
    if (set.size() <= set.sample_all) {
      for (const int light : set.lights) f(LightPick{light, 1});
      continue;
    }
    const float evenly = set.tree.empty() ? 1 : kEvenlyInVolume;
    int light = -1;
    if (u < evenly) {
      u = std::min(u / evenly, 0x1.fffffep-1f);
      light = set.pick_evenly(u);
    } else {
      u = std::min((u - evenly) / (1 - evenly), 0x1.fffffep-1f);
      if (const auto choice = set.tree.choose(lit, u)) light = choice->light;
    }
    if (light < 0) continue;
    const float by_tree = evenly < 1 ? set.tree.probability(lit, light) : 0;
    f(LightPick{light, lerp(by_tree, 1 / static_cast<float>(set.size()), evenly)});
  }
}

template <class F>
void LightSampler::for_each_on_way(const Vec3& from, const Vec3& direction, float t_most,
                                   F&& f) const {
  sets_[kFinite].tree.for_each_on_way(from, direction, t_most, f);
  sets_[kPortals].tree.for_each_on_way(from, direction, t_most, f);
}

}  // namespace oriel
