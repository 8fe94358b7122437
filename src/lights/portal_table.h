// SPDX-License-Identifier: Apache-2.0
// Sampling of portals, and what portals do to rays.
#pragma once

#include <memory>
#include <optional>

#include "lights/light_shape.h"
#include "sampling/windowed_distribution.h"

namespace oriel {

struct World;

/// What lies behind windows of one orientation, by two angles in which a rectangle seen from
/// anywhere keeps its sides upright.
///
/// Model:   luminance times solid angle over (atan x/z, atan y/z); z points outside, x and y along
///          the edges. A share of the mean is spread evenly over directions, so that what the table
///          smoothed away is still found.
/// Source:  Bitterli, Novak, Jarosz, "Portal-Masked Environment Map Sampling", EGSR 2015.
/// Checked: Portal.* in tests/analytic/portals/portal_test.cpp.
class PortalTable {
 public:
  PortalTable(const NodeList& shaders, const World& world, RayKind lookup, const Vec3& x,
              const Vec3& y, const Vec3& z);

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
  /// Density of a unit direction, by x, y, z.
  float pdf(const Vec3& local, const sampling::Window& window) const;
  /// Mean luminance over the half sphere.
  float mean_luminance() const { return mean_luminance_; }
  /// Whether some of it is so bright that it matters through which of many portals it is seen.
  bool uneven() const { return uneven_; }
  /// Luminance times solid angle within a rectangle at z = 1 by x, y, z; blurred over a few
  /// degrees.
  float rough_integral(float x0, float x1, float y0, float y1) const;

 private:
  Vec3 x_, y_, z_;
  NodeList shaders_;
  RayKind lookup_;
  bool lights_ = false, uneven_ = false;
  float mean_luminance_ = 0;
  std::unique_ptr<sampling::WindowedDistribution2D> table_, rough_;
};

/// A point of the portal, by its table.
std::optional<ShapeSample> sample_through(const Light& light, const Vec3& from, Vec2 u);
/// Density with which sample_through finds a direction that meets the portal.
float pdf_through(const Light& light, const Vec3& from, const Vec3& wi);
/// Radiance toward a point, wi from there to the portal, both where they are in truth. `kind`: the
/// threshold acts on Light and FinalGather; eyes, mirrors and glass see the surface as it is.
/// Checked: PortalSeen.* in tests/analytic/portals/portal_seen_test.cpp
Rgb portal_radiance(const Light& light, const Vec3& from, const Vec3& wi, float distance,
                    float cosine, RayKind kind = RayKind::Light);
/// Mean luminance of all that is behind it. `environment`: of the camera's environment.
float mean_luminance(const Portal& portal, float environment);
/// A direction out of which the environment shines through the portal, by the table: where photons
/// come from. World space, with its density.
struct PortalDirection {
  Vec3 outward{0};
  float pdf = 0;
};
PortalDirection sample_portal_direction(const Light& light, Vec2 u);

/// Whether a ray of that time meets the portal from inside within (0, t_most).
bool crosses_portal(const Light& light, const Vec3& from, const Vec3& direction, float t_most,
                    float time);

/// What portals do to a ray on its way.
struct PortalsOnWay {
  bool ends_diffuse = false;  ///< diffuse rays find a portal's light here and nothing behind
  bool ends_view = false;     ///< so do other rays, at a visible portal
  Rgb view{1};                ///< what is left for the eye of what lies behind
};
/// A portal is not on the way to itself: ways end at this share of the distance.
inline constexpr float kShortOfPortal = 1 - 1e-4f;
/// `mapped`: light of portals that only send photons is in a map that diffuse rays stand back for.
PortalsOnWay portals_on_way(const World& world, const Vec3& from, const Vec3& direction,
                            float t_most, float time, bool mapped = false);

/// Whether a portal lies on the way to a point, so that its photons stand for those of the
/// environment that come along here.
bool is_behind_portal(const World& world, const Vec3& point, const Vec3& to_source, float t_most,
                      float time);

/// Orients and completes the portals among the lights; the environment is bound before.
void open_portals(World& world);

}  // namespace oriel
