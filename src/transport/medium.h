// SPDX-License-Identifier: Apache-2.0
// The medium that a ray is in, known from the surfaces that it passed.
#pragma once

#include <limits>

#include "runtime/closure.h"
#include "runtime/shading_point.h"

namespace oriel {

/// The current medium of a path, shadow ray or photon. Interfaces as in the manual: a solid begins
/// at its front side and ends at its back side; another solid may follow directly. Source:
/// manual 1.7.2.6. Checked: NestedMedia.*, Glass.Absorbs* in tests/analytic,
/// PhotonTrace.NestedMedia*.
struct MediumOnWay {
  Medium medium;
  bool known = false;                ///< false: the next back side determines it
  const NodeList* volume = nullptr;  ///< of the object that the ray is in
  bool volume_known = false;

  /// Starts in a volume that is not known from a surface: that of volume_around().
  void begin_in(const NodeList* around) {
    volume = around;
    volume_known = true;
  }
  /// At a surface, before it is passed: determines the medium in front of it.
  void meet_surface(const Closure& closure, const ShadingPoint& point) {
    if (!known && point.back_side && !closure.thin_walled) medium = closure.inside;
    if (!volume_known && point.back_side && closure.volume) volume = closure.volume;
  }
  /// Updates the volume only. Hulls of volumes may be thin or entirely cut out.
  void leave_volume(const Closure& closure, const ShadingPoint& point, const Vec3& direction) {
    if (!closure.volume) return;
    const bool crosses = dot(direction, point.geometric_normal) < 0;
    volume = crosses == point.back_side ? nullptr : closure.volume;
    volume_known = true;
  }
  /// Leaves a surface in a direction, on either side.
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
  /// Passes a surface without bending.
  /// Inputs:  by: the closure whose medium follows: the surface's or that of the slot `shadow`.
  ///          fades: straight_rays_fade().
  void pass_straight(const Closure& by, const Closure& surface, const ShadingPoint& point,
                     const Vec3& direction, bool fades) {
    if (fades && !by.thin_walled)
      leave(by, point, direction);
    else if (!surface.thin_walled)
      ignore();
  }
  /// Continues without a medium.
  void ignore() {
    medium = {};
    known = true;
  }
  /// The distance after which all light is absorbed.
  float reach() const {
    return known && medium.black_distance > 0 ? medium.black_distance
                                              : std::numeric_limits<float>::infinity();
  }
};

}  // namespace oriel
