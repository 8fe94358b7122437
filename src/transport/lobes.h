// SPDX-License-Identifier: Apache-2.0
// Evaluating and sampling the lobes of a closure: the bridge from what a material says to bsdf/.
#pragma once

#include <optional>
#include <utility>

#include "runtime/closure.h"
#include "runtime/shading_point.h"

namespace oriel {

// Conventions
//   wo and wi are world space, unit, away from the surface. Values include |cos wi|. A lobe that
//   reflects answers only on the viewer's side of the geometric surface, one that transmits only on
//   the other side, so that no shading normal leaks light.

/// Lobes whose rays meet the same things; each group is an integral of its own.
enum class LobeGroup : std::uint8_t {
  Diffuse,     ///< and translucency: rays go straight on, as shadow rays do
  Reflection,  ///< lights may be seen as highlights instead
  Refraction
};

LobeGroup group_of(LobeKind kind);

/// What a closure returns for one pair of directions, by group.
struct Response {
  struct Part {
    Rgb value{0};
    float pdf = 0;  ///< density of sample_closure, per solid angle, among the group's lobes
  };
  Part diffuse, reflection, refraction;
  Rgb highlight{0};  ///< reflecting lobes of light sources only, rays do not see them
  const Part& of(LobeKind kind) const {
    const LobeGroup group = group_of(kind);
    return group == LobeGroup::Diffuse      ? diffuse
           : group == LobeGroup::Reflection ? reflection
                                            : refraction;
  }
  Part& of(LobeKind kind) { return const_cast<Part&>(std::as_const(*this).of(kind)); }
};

inline bool is_diffuse(LobeKind kind) {
  return kind == LobeKind::Diffuse || kind == LobeKind::Translucency;
}

/// Which lobes rays may follow at this vertex: how likely each is, or how many rays it gets.
struct LobeChoice {
  float rays[Closure::kMostLobes] = {};  ///< expected number
  bool any = false;

  /// Makes shares of the numbers of the closure's lobes, so that one ray in all is expected.
  void share_one_ray(int lobes) {
    float total = 0;
    for (int i = 0; i < lobes; ++i) total += rays[i];
    any = total > 0;
    if (any)
      for (int i = 0; i < lobes; ++i) rays[i] /= total;
  }
};

/// A direction to go on in.
struct ClosureSample {
  Vec3 wi;
  int lobe = 0;
  bool delta = false;
  float pdf = 0;  ///< 0 for delta lobes
  Rgb weight{0};  ///< response of the lobe's group over the density: throughput factor
};

/// Looks up once what the glossy lobes need for their viewer; before evaluating or sampling.
void make_ready(Closure& closure, const Vec3& wo);

/// All non-delta lobes for wi; the density counts the lobes that `choice` allows.
/// Diffuse lobes darken softly where a shading normal faces light that the surface hardly does.
///
/// Inputs:  seen_in_mirrors: wi leads to a light that mirror rays see; highlights that stand beside
///          a mirror are left out.
Response evaluate_closure(const Closure& closure, const LobeChoice& choice,
                          const ShadingPoint& point, const Vec3& wo, const Vec3& wi,
                          bool seen_in_mirrors = false);

/// Chooses a lobe by its share of the rays; -1 when there is none. Leaves in u what is left of it.
int choose_lobe(const Closure& closure, const LobeChoice& choice, float& u);

/// Draws a direction of a lobe; nothing where the draw is lost (below the horizon).
std::optional<ClosureSample> sample_lobe(const Closure& closure, const LobeChoice& choice, int lobe,
                                         const ShadingPoint& point, const Vec3& wo, float u_rest,
                                         const Vec2& u);

inline bool is_delta(LobeKind kind) {
  return kind == LobeKind::Mirror || kind == LobeKind::ClearRefraction ||
         kind == LobeKind::ThinTransmission;
}

}  // namespace oriel
