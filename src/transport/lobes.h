// SPDX-License-Identifier: Apache-2.0
// Evaluates and samples the lobes of a closure with the functions of bsdf/.
#pragma once

#include <optional>
#include <utility>

#include "runtime/closure.h"
#include "runtime/shading_point.h"
#include "transport/direction_guide.h"

namespace oriel {

// Conventions
//   wo and wi are world space, unit, away from the surface. Values include |cos wi|. A
//   reflecting lobe is 0 except on the viewer's side of the geometric surface, a transmitting lobe
//   except on the other side, so that shading normals leak no light.

/// Groups of lobes whose rays see the same objects; each group is a separate integral.
enum class LobeGroup : std::uint8_t {
  Diffuse,     ///< and translucency: rays pass transparency straight, as shadow rays do
  Reflection,  ///< lights may show as highlights instead
  Refraction
};

LobeGroup group_of(LobeKind kind);

/// What a closure returns for one pair of directions, by group.
struct Response {
  struct Part {
    Rgb value{0};
    float pdf = 0;  ///< of sample_closure, per solid angle, among the lobes of the group
  };
  Part diffuse, reflection, refraction;
  Rgb highlight{0};  ///< reflecting lobes that show light sources only
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

/// The normal of the side of the surface that a lobe receives light on.
inline Vec3 lit_side(const Lobe& lobe) {
  return lobe.kind == LobeKind::Translucency ? -lobe.frame.n : lobe.frame.n;
}

/// The lobes that rays may follow at this vertex: their probabilities, or numbers of rays.
struct LobeChoice {
  float rays[Closure::kMaxLobes] = {};  ///< expected number
  bool any = false;
  /// If not empty, all diffuse lobes have its normal, and their samples follow it.
  LocalGuide guide;

  /// Scales the numbers of the lobes such that their sum is 1.
  void share_one_ray(int lobes) {
    float total = 0;
    for (int i = 0; i < lobes; ++i) total += rays[i];
    any = total > 0;
    if (any)
      for (int i = 0; i < lobes; ++i) rays[i] /= total;
  }
};

/// A sampled direction.
struct ClosureSample {
  Vec3 wi;
  int lobe = 0;
  bool delta = false;
  float pdf = 0;  ///< 0 for delta lobes
  Rgb weight{0};  ///< value of the lobe's group divided by pdf: factor of the throughput
};

/// Prepares the glossy lobes for the viewer; required before evaluation and sampling.
void make_ready(Closure& closure, const Vec3& wo);

/// Evaluates all non-delta lobes for wi; the density includes the lobes that `choice` allows.
/// Diffuse lobes darken smoothly where the shading normal faces light that the geometric surface
/// does not.
///
/// Inputs:  seen_in_mirrors: wi leads to a light that mirror rays see; highlights that
///          accompany a mirror are omitted.
Response evaluate_closure(const Closure& closure, const LobeChoice& choice,
                          const ShadingPoint& point, const Vec3& wo, const Vec3& wi,
                          bool seen_in_mirrors = false);

/// Chooses a lobe in proportion to its rays; -1 = none. Rescales u for further use.
int choose_lobe(const Closure& closure, const LobeChoice& choice, float& u);

/// Samples a direction of a lobe; empty if the sample is below the horizon.
std::optional<ClosureSample> sample_lobe(const Closure& closure, const LobeChoice& choice, int lobe,
                                         const ShadingPoint& point, const Vec3& wo, float u_rest,
                                         const Vec2& u);

inline bool is_delta(LobeKind kind) {
  return kind == LobeKind::Mirror || kind == LobeKind::ClearRefraction ||
         kind == LobeKind::ThinTransmission;
}

}  // namespace oriel
