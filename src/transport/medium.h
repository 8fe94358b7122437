// SPDX-License-Identifier: Apache-2.0
// Which medium a ray is in, as far as the surfaces on its way have told.
#pragma once

#include <limits>

#include "runtime/closure.h"
#include "runtime/shading_point.h"

namespace oriel {

/// Paths, shadow rays and photons keep one each. Interfaces as the manual has them: a solid begins
/// where its front is passed and ends where its back is; what then follows may be another solid.
/// Source:  manual 1.7.2.6.
/// Checked: NestedMedia.*, Glass.Absorbs* in tests/analytic, PhotonTrace.NestedMedia*.
struct MediumOnWay {
  Medium medium;
  bool known = false;                ///< false: the next wall met from its inside tells
  const NodeList* volume = nullptr;  ///< of the object that the ray is in
  bool volume_known = false;

  /// Where a way begins of which no surface has told: volume_around().
  void begin_in(const NodeList* around) {
    volume = around;
    volume_known = true;
  }
  /// At a surface, before it is passed: the medium of the way to it.
  void meet_surface(const Closure& closure, const ShadingPoint& point) {
    if (!known && point.back_side && !closure.thin_walled) medium = closure.inside;
    if (!volume_known && point.back_side && closure.volume) volume = closure.volume;
  }
  /// The same of volumes alone, whose hulls may have no thickness or be holes as a whole.
  void leave_volume(const Closure& closure, const ShadingPoint& point, const Vec3& direction) {
    if (!closure.volume) return;
    const bool crosses = dot(direction, point.geometric_normal) < 0;
    volume = crosses == point.back_side ? nullptr : closure.volume;
    volume_known = true;
  }
  /// From a surface on in a direction, through it or back.
  void leave(const Closure& closure, const ShadingPoint& point, const Vec3& direction) {
    leave_volume(closure, point, direction);
    if (closure.thin_walled) return;
    if (dot(direction, point.geometric_normal) < 0) {
      medium = point.back_side ? Medium{} : closure.inside;
      known = !point.back_side;
    } else if (point.back_side && !known) {
      medium = closure.inside;
      known = true;
    }
  }
  /// Straight through a surface.
  /// Inputs:  by: whose medium follows: the surface, or what stands for it in the slot `shadow`.
  ///          fades: straight_rays_fade().
  void pass_straight(const Closure& by, const Closure& surface, const ShadingPoint& point,
                     const Vec3& direction, bool fades) {
    if (fades && !by.thin_walled)
      leave(by, point, direction);
    else if (!surface.thin_walled)
      ignore();
  }
  /// The ray goes on as if there were none.
  void ignore() {
    medium = {};
    known = true;
  }
  /// How far the ray may go until all is black.
  float reach() const {
    return known && medium.black_distance > 0 ? medium.black_distance
                                              : std::numeric_limits<float>::infinity();
  }
};

}  // namespace oriel
