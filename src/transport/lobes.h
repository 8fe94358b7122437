// SPDX-License-Identifier: Apache-2.0
// Evaluating and sampling the lobes of a closure: the bridge from what a material says to bsdf/.
#pragma once

#include <optional>

#include "runtime/closure.h"
#include "runtime/shading_point.h"

namespace oriel {

// Conventions
//   wo and wi are world space, unit, away from the surface. Values include |cos wi|. A lobe that
//   reflects answers only on the viewer's side of the geometric surface, one that transmits only on
//   the other side, so that no shading normal leaks light.

/// What a closure returns for one pair of directions, apart by how lights see it.
struct Response {
  struct Part {
    Rgb plain{0};       ///< lobes that lights and rays see alike
    Rgb reflective{0};  ///< reflecting lobes; highlight_scale applies when the source is a light
    Rgb highlight{0};   ///< lobes of light sources only, rays do not see them
    float pdf = 0;      ///< density of sample_closure, per solid angle, among this part's lobes

    Rgb for_rays() const { return plain + reflective; }
    Rgb for_lights(float scale) const { return plain + (reflective + highlight) * scale; }
  };
  /// Apart as well by how their rays meet glass: those of diffuse and translucent lobes go straight
  /// on, as shadow rays do, those of the others are bent. Each part is an integral of its own.
  Part diffuse, glossy;
};

inline bool is_diffuse(LobeKind kind) {
  return kind == LobeKind::Diffuse || kind == LobeKind::Translucency;
}

/// Which lobes rays may follow at this vertex and how likely each is chosen.
struct LobeChoice {
  float probability[Closure::kMostLobes] = {};
  float total = 0;  ///< 0: none
};

/// A direction to go on in.
struct ClosureSample {
  Vec3 wi;
  int lobe = 0;
  bool delta = false;
  float pdf = 0;            ///< 0 for delta lobes
  Response::Part response;  ///< of the lobe's part, divided by the density: throughput factors
};

/// Looks up once what the glossy lobes need for their viewer; before evaluating or sampling.
void make_ready(Closure& closure, const Vec3& wo);

/// All non-delta lobes for wi; the density counts the lobes that `choice` allows.
///
/// Inputs:  seen_in_mirrors: wi leads to a light that mirror rays see; highlights that stand beside
///          a mirror are left out.
Response evaluate_closure(const Closure& closure, const LobeChoice& choice,
                          const ShadingPoint& point, const Vec3& wo, const Vec3& wi,
                          bool seen_in_mirrors = false);

/// Draws a lobe and a direction; nothing where the draw is lost (below the horizon).
std::optional<ClosureSample> sample_closure(const Closure& closure, const LobeChoice& choice,
                                            const ShadingPoint& point, const Vec3& wo, float u_lobe,
                                            const Vec2& u);

inline bool is_delta(LobeKind kind) {
  return kind == LobeKind::Mirror || kind == LobeKind::ClearRefraction ||
         kind == LobeKind::ThinTransmission;
}

}  // namespace oriel
