// SPDX-License-Identifier: Apache-2.0
// Points on surfaces that directional lights illuminate, for indirect light that rays rarely find.
#pragma once

#include <optional>
#include <vector>

#include "base/checkpoint_file.h"
#include "base/frame.h"
#include "runtime/window.h"
#include "runtime/world.h"
#include "sampling/distribution.h"
#include "transport/counts.h"

namespace oriel {

/// Samples points on surfaces that directional lights illuminate: the patches of sun in a room.
///
/// Model:   a point is the first opaque surface along a ray of a directional light. The rays pass
///          through the cells of a rectangle perpendicular to the light, in proportion to how often
///          rays from surfaces that the camera sees ended at a point that the light reaches through
///          the cell. These rays are traced once, before the picture. Points outside of the cells
///          are left to rays. Empty if the lights reach many of the surfaces, as outdoors: rays
///          find them as well.
/// Source:  E. Veach, "Robust Monte Carlo Methods for Light Transport Simulation", 1997, chapter
///          10: paths with one vertex from the light; the choice of cells as in J. Vorba et al.,
///          "On-line Learning of Parametric Mixture Models for Light Transport Simulation", 2014,
///          for the emission of lights.
/// Checked: LitSurfaces.* in tests/analytic
class LitSurfaces {
 public:
  LitSurfaces() = default;
  /// Inputs:  window: the part of the picture that camera rays cover.
  LitSurfaces(const World& world, const Window& window, std::uint32_t seed, RayCounts& counts);

  bool empty() const { return beams_.empty(); }

  void save(CheckpointWriter& out) const;
  /// Reads what save() wrote for the same world. Errors:  CheckpointError.
  void restore(CheckpointReader& in, const World& world);

  struct Sample {
    int light = 0;     ///< index into World::lights
    Vec3 to_light{0};  ///< unit
    Vec3 position{0};
    Vec3 normal{0};                             ///< geometric, unit, on either side
    std::uint32_t instance = 0, primitive = 0;  ///< of the world's accel
    Vec2 on_primitive{0};
    float density = 0;  ///< as density()
  };
  /// Inputs:  u_beam, u_cell, u_light: uniform in [0,1); the direction to the light is that of
  ///          sample_light() for u_light.
  std::optional<Sample> sample(float time, float u_beam, const Vec2& u_cell,
                               const Vec2& u_light) const;
  /// Density with which sample() finds an opaque point that the light reaches from a direction, per
  /// area perpendicular to that direction; 0 if it does not find it.
  float density(int light, const Vec3& position, const Vec3& to_light) const;

 private:
  /// The rectangle of a light.
  struct Beam {
    int light = 0;
    float probability = 0;
    Vec3 origin{0};
    Frame frame;  ///< n: to the light
    Vec2 low{0}, size{0};
    float reach = 0;  ///< from the rectangle to the outside of the scene
    sampling::Distribution2D cells;
  };
  struct Lit;
  void add_beam(int light, const std::vector<Lit>& lit);
  void place(Beam& beam, const Vec3& origin) const;

  const World* world_ = nullptr;
  std::vector<Beam> beams_;
};

/// Whether sample() can find points of the instance, an index into the accel.
inline bool can_be_found(const World& world, std::uint32_t instance) {
  return (world.accel->instance(instance).mask & geom::RayMask::Shadow) != 0;
}

}  // namespace oriel
