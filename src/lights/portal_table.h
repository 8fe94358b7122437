// SPDX-License-Identifier: Apache-2.0
// Sampling of portals, and their effect on rays.
#pragma once

#include <memory>
#include <optional>

#include "lights/environment_table.h"
#include "lights/light_shape.h"
#include "sampling/windowed_distribution.h"

namespace oriel {

struct World;

/// The environment behind portals of one orientation, over two coordinates in which every rectangle
/// of that orientation, seen from any point, is an axis-aligned rectangle.
///
/// Model:   luminance times solid angle over x / (|x| + z), y / (|y| + z); z points outside, x and
///          y along the edges. The coordinates replace the angles of the source: they need no
///          trigonometry and are within a factor of 2 as even. A share of the mean is spread evenly
///          over directions, so that details below the resolution of the table have a density above
///          0.
/// Source:  Bitterli, Novak, Jarosz, "Portal-Masked Environment Map Sampling", EGSR 2015.
/// Checked: Portal.* in tests/analytic/portals/portal_test.cpp.
class PortalTable {
 public:
  PortalTable(const NodeList& shaders, const World& world, RayKind lookup, const Vec3& x,
              const Vec3& y, const Vec3& z, TableDetail detail);

  const Vec3& x() const { return x_; }
  const Vec3& y() const { return y_; }
  const Vec3& z() const { return z_; }
  const NodeList& shaders() const { return shaders_; }
  RayKind lookup() const { return lookup_; }
  /// False where the environment is black on that side.
  bool lights() const { return lights_; }

  struct Sample {
    Vec3 local{0, 0, 1};  ///< unit, by x, y, z
    float pdf = 0;        ///< per solid angle
  };
  Sample sample(Vec2 u, const sampling::Window& window) const;
  /// A rectangle at `depth` along z.
  static sampling::Window window(float x0, float x1, float y0, float y1, float depth);
  /// Density of a unit direction, by x, y, z.
  float pdf(const Vec3& local, const sampling::Window& window) const;
  /// Mean luminance over the half sphere.
  float mean_luminance() const { return mean_luminance_; }
  /// Whether the environment is so uneven that the choice among portals should depend on it.
  bool uneven() const { return uneven_; }
  /// Whether directions through a portal should depend on it.
  bool structured() const { return structured_; }
  /// Luminance times solid angle within a rectangle at z = 1 by x, y, z; blurred over a few
  /// degrees.
  float rough_integral(float x0, float x1, float y0, float y1) const;

 private:
  Vec3 x_, y_, z_;
  NodeList shaders_;
  RayKind lookup_;
  bool lights_ = false, uneven_ = false, structured_ = false;
  float mean_luminance_ = 0;
  std::unique_ptr<sampling::WindowedDistribution2D> table_, rough_;
};

/// Whether the portal is sampled by its table, instead of as a shape.
inline bool is_sampled_by_table(const Portal& portal) {
  return portal.table && portal.table->structured();
}
/// A point of the portal, by its table.
std::optional<ShapeSample> sample_through(const Light& light, const Vec3& from, Vec2 u);
/// Density of sample_through for a direction that hits the portal.
float pdf_through(const Light& light, const Vec3& from, const Vec3& wi);
/// Radiance toward a point; wi: from the point to the portal; both at the current time. `kind`: the
/// threshold applies to Light and FinalGather; other rays see the unmodified surface.
/// Checked: PortalSeen.* in tests/analytic/portals/portal_seen_test.cpp
Rgb portal_radiance(const Light& light, const Vec3& from, const Vec3& wi, float distance,
                    float cosine, RayKind kind = RayKind::Light);
/// Mean luminance behind the portal. `environment`: of the camera's environment.
float mean_luminance(const Portal& portal, float environment);
/// A direction from the environment through the portal, by the table, for photons. World space,
/// with its density.
struct PortalDirection {
  Vec3 outward{0};
  float pdf = 0;
};
PortalDirection sample_portal_direction(const Light& light, Vec2 u);

/// Whether a ray at that time hits the portal from inside within (0, t_most).
bool crosses_portal(const Light& light, const Vec3& from, const Vec3& direction, float t_most,
                    float time);

/// The effect of the portals on a ray.
struct PortalsOnWay {
  bool ends_diffuse = false;  ///< diffuse rays see the portal's light and nothing behind
  bool ends_view = false;     ///< other rays do so as well, at a visible portal
  Rgb view{1};                ///< factor of radiance from behind
};
/// Rays toward a portal end at this share of the distance, so that it does not block itself.
inline constexpr float kShortOfPortal = 1 - 1e-4f;
/// `mapped`: the light of portals that only emit photons is in a map that replaces diffuse rays.
PortalsOnWay portals_on_way(const World& world, const Vec3& from, const Vec3& direction,
                            float t_most, float time, bool mapped = false);

/// Whether a portal lies between the environment and a point, so that photons of the portal replace
/// those of the environment.
bool is_behind_portal(const World& world, const Vec3& point, const Vec3& to_source, float t_most,
                      float time);

/// Orients and completes the portals among the lights; requires the bound environment.
void open_portals(World& world, TableDetail detail);

}  // namespace oriel
