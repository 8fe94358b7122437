// SPDX-License-Identifier: Apache-2.0
// One point of final gathering: rays over a hemisphere become irradiance, its gradients, a radius.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "transport/gather/gather_light.h"

namespace oriel {

// Conventions
//   Everything is in world space. Irradiance is the integral of incoming radiance times the cosine
//   over solid angle: a Lambert surface of albedo rho shows rho * E / pi; under radiance 1 from
//   everywhere E is pi. Strata are laid out as in gather_light.h.

/// Distances at and beyond this count as nothing: the sky. Keeps all numbers of a record finite.
inline constexpr float kGatherFarthest = 1e10f;

/// What one ray brings back.
struct GatherSample {
  Vec3 direction{0, 0, 1};  ///< unit, away from the surface
  Rgb radiance{0};
  float distance = kGatherFarthest;  ///< to what it hit; infinity or kGatherFarthest = nothing
  Vec3 normal{0};                    ///< of what it hit, either side; null = not known
};

/// The rays of one point: rings x sectors strata with density cos / pi.
struct GatherHemisphere {
  Frame frame;
  int rings = 1, sectors = 4;

  /// About `rays` strata that are nearly square. `turn`, in turns, rotates them about the normal,
  /// so that neighbours do not share the same strata.
  static GatherHemisphere for_rays(const Vec3& normal, int rays, float turn = 0);
  int count() const { return rings * sectors; }
  /// Direction of stratum i, u in [0, 1)^2 within it.
  Vec3 direction(int i, const Vec2& u) const;
};

/// Bounds of the radius that a record has, in scene units or in pixels.
struct GatherRadii {
  float min = 0, max = 0;  ///< max 0 = unbounded
  bool in_pixels = false;

  /// In scene units. `pixel`: length that one pixel covers at the point, scene units.
  GatherRadii in_scene(float pixel) const {
    return in_pixels ? GatherRadii{min * pixel, max * pixel, false} : *this;
  }
  /// Total: a minimum above the maximum is ignored.
  float clamped(float radius) const {
    radius = std::max(radius, min);
    return max > 0 ? std::min(radius, max) : radius;
  }
};

struct GatherRecord {
  Vec3 position{0}, normal{0, 0, 1};
  Rgb irradiance{0};
  /// By channel: change of E per length of moving, in the tangent plane.
  std::array<Vec3, 3> by_position{Vec3(0), Vec3(0), Vec3(0)};
  /// By channel: E changes by its product with another normal, to first order.
  std::array<Vec3, 3> by_normal{Vec3(0), Vec3(0), Vec3(0)};
  float radius = 1;  ///< of validity, scene units; finite
  float noise = 0;   ///< standard error of the irradiance's brightness, as share of it; a guess
  float mean_distance = kGatherFarthest, min_distance = kGatherFarthest;
  /// How far one gets along the surface before something stands there, in eight directions of
  /// Frame(normal), the first along s.
  std::array<float, 8> free = all_free();
  IncomingLight incoming;
  /// Shares of the irradiance by layers of lights, by channel, sums 1 where there is light; empty =
  /// not known.
  std::vector<Rgb> shares;

  static constexpr std::array<float, 8> all_free() {
    std::array<float, 8> f{};
    for (float& x : f) x = kGatherFarthest;
    return f;
  }
};

/// What records and rays are judged by: all channels alike.
inline float gather_brightness(const Rgb& c) { return c.x + c.y + c.z; }

/// Where a vector points within Frame(normal): 0..8, eighths of a turn from s towards t (in between
/// not quite proportional to the angle, which saves the arc tangent).
float gather_sector(const Vec3& normal, const Vec3& v);

/// Replaces each ray's radiance by that of the ray of median brightness among its neighbours.
///
/// Model:   `reach` (0..4) strata each way, at most (2 reach + 1)^2 rays; sectors wrap around,
/// rings
///          end at pole and horizon. The lower median where the number is even. A lone bright
///          stratum vanishes with its energy, and a skewed distribution goes to its median, below
///          its mean: filtered irradiance is darker, the more the larger the reach. Uniform
///          radiance and edges that are straight over the reach stay.
/// Checked: GatherRecord.FilterRemovesASpeckle, GatherRecord.FilterKeepsAnEdge.
void filter_speckles(std::span<GatherSample> samples, int rings, int sectors, int reach);

/// Makes a record of the rays of one point.
///
/// Model:   E and the integrals over directions take the radiance as constant in each stratum.
///          Translational gradient: light moves where neighbouring strata differ, as fast as the
///          nearer of the two is near; where samples bring normals, as near as its plane is at the
///          strata's border. Without, the gradient is too long in the mean: before
///          a wall 1.5 high, with 100 rays, by 1.2 at distance 1 and 1.8 at 0.3; with them 0.97 and
///          1.07. Radius: harmonic mean of the distances, no longer than
///          twice the nearest, nor than half of E / |gradient| (beyond the whole, E would be
///          extrapolated to nothing), then kept within `radii`.
/// Inputs:  samples: one for each stratum, in order; radiance that is negative or not finite counts
///          as black. radii: in scene units. filter: as filter_speckles.
/// Source:  Ward, Heckbert, "Irradiance Gradients", EGWR 1992; strata's borders as in Krivanek,
///          Gautron, Pattanaik, Bouatouch, "Radiance Caching for Efficient Global Illumination
///          Computation", IEEE TVCG 11(5), 2005. The rotational gradient is kept as the vector to
///          multiply with the new normal, not with the rotation's axis.
/// Checked: GatherRecord.*
GatherRecord make_gather_record(const Vec3& position, const GatherHemisphere& hemisphere,
                                std::span<const GatherSample> samples, const GatherRadii& radii,
                                int filter = 0);

/// Divides parts of light by their sum, by channel; where there is none the last has all.
void normalise_shares(std::span<Rgb> parts);

/// Irradiance at another point and normal, by the gradients.
///
/// Returns: each channel within a factor kGatherExtrapolation of the record's own, so never
///          negative.
/// Checked: GatherRecord.ExtrapolationIsBounded
Rgb extrapolate(const GatherRecord& record, const Vec3& position, const Vec3& normal);
inline constexpr float kGatherExtrapolation = 2;

inline Rgb blurred_radiance(const GatherRecord& record, const Vec3& direction, float roughness) {
  return blurred_radiance(record.incoming, direction, roughness);
}

}  // namespace oriel
