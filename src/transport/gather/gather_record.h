// SPDX-License-Identifier: Apache-2.0
// One final gather record: irradiance, its gradients and a radius from rays over a hemisphere.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "transport/gather/gather_light.h"

namespace oriel {

// Conventions
//   Everything is in world space. Irradiance is the integral over solid angle of incident radiance
//   times the cosine: a Lambert surface of albedo rho has radiance rho * E / pi; constant radiance
//   1 gives E = pi. Strata are stored as in gather_light.h.

/// Distances from here on count as no hit. Keeps all numbers of a record finite.
inline constexpr float kGatherFarthest = 1e10f;

/// The result of one gather ray.
struct GatherSample {
  Vec3 direction{0, 0, 1};  ///< unit, away from the surface
  Rgb radiance{0};
  float distance = kGatherFarthest;  ///< to the hit; infinity or kGatherFarthest = none
  Vec3 normal{0};                    ///< of the hit surface, either side; null = unknown
};

/// The rays of one point: rings x sectors strata with density cos / pi.
struct GatherHemisphere {
  Frame frame;
  int rings = 1, sectors = 4;

  /// About `rays` nearly square strata. `turn`, in turns, rotates them about the normal, so that
  /// neighbouring records have different strata.
  static GatherHemisphere for_rays(const Vec3& normal, int rays, float turn = 0);
  int count() const { return rings * sectors; }
  /// Direction in stratum i; u in [0, 1)^2 is the position within it.
  Vec3 direction(int i, const Vec2& u) const;
};

/// Bounds of a record's radius, in scene units or pixels.
struct GatherRadii {
  float min = 0, max = 0;  ///< max 0 = unbounded
  bool in_pixels = false;

  /// The bounds in scene units. `pixel`: length that one pixel covers at the point, scene units.
  GatherRadii in_scene(float pixel) const {
    return in_pixels ? GatherRadii{min * pixel, max * pixel, false} : *this;
  }
  /// Defined for all values: a minimum above the maximum is ignored.
  float clamped(float radius) const {
    radius = std::max(radius, min);
    return max > 0 ? std::min(radius, max) : radius;
  }
};

struct GatherRecord {
  Vec3 position{0}, normal{0, 0, 1};
  Rgb irradiance{0};
  /// By channel: change of E per length of displacement in the tangent plane.
  std::array<Vec3, 3> by_position{Vec3(0), Vec3(0), Vec3(0)};
  /// By channel: the dot product with another normal is the change of E, to first order.
  std::array<Vec3, 3> by_normal{Vec3(0), Vec3(0), Vec3(0)};
  float radius = 1;  ///< of validity, scene units; finite
  float noise = 0;   ///< estimated relative standard error of the irradiance
  float mean_distance = kGatherFarthest, min_distance = kGatherFarthest;
  /// Unoccluded distance along the surface in eight directions of Frame(normal), the first along s.
  std::array<float, 8> free = all_free();
  IncomingLight incoming;
  /// Shares of the irradiance by light layer and channel. Their sum is 1 where there is light;
  /// empty = unknown.
  std::vector<Rgb> shares;

  static constexpr std::array<float, 8> all_free() {
    std::array<float, 8> f{};
    for (float& x : f) x = kGatherFarthest;
    return f;
  }
};

/// The brightness used to compare records and rays: all channels have equal weight.
inline float gather_brightness(const Rgb& c) { return c.x + c.y + c.z; }

/// Azimuth of a vector in Frame(normal): 0..8 eighths of a turn from s towards t. Between multiples
/// it is not quite proportional to the angle, which avoids the arc tangent.
float gather_sector(const Vec3& normal, const Vec3& v);

/// Replaces the radiance of each ray by that of the ray of median brightness among its neighbours.
///
/// Model:   `reach` (0..4) strata in each direction, at most (2 reach + 1)^2 rays; sectors wrap
///          around, rings end at pole and horizon. The lower median of an even number. A single
///          bright stratum is removed with its energy, and a skewed distribution is replaced by its
///          median, which is below its mean: filtered irradiance is darker, the more the larger
///          `reach` is. Uniform radiance and edges that are straight over `reach` are unchanged.
/// Checked: GatherRecord.FilterRemovesASpeckle, GatherRecord.FilterPreservesAnEdge.
void filter_speckles(std::span<GatherSample> samples, int rings, int sectors, int reach);

/// Makes a record from the rays of one point.
///
/// Model:   E and the integrals over directions assume constant radiance in each stratum.
///          Translational gradient: light moves where neighbouring strata differ, at a rate given
///          by the distance of the nearer stratum; if samples have normals, by the distance of its
///          plane at the border of the strata. Without normals the gradient is too long on average:
///          1.5 high before a wall, with 100 rays, by 1.2 at distance 1 and 1.8 at 0.3; with
///          normals 0.97 and 1.07. Radius: harmonic mean of the distances, at most twice the
///          nearest, at most half of E / |gradient| (at E / |gradient| the extrapolation reaches
///          0), then clamped to `radii`.
/// Inputs:  samples: one per stratum, in order; negative and non-finite radiance counts as black.
///          radii: in scene units. filter: as filter_speckles.
/// Source:  Ward, Heckbert, "Irradiance Gradients", EGWR 1992; borders of strata as in Krivanek,
///          Gautron, Pattanaik, Bouatouch, "Radiance Caching for Efficient Global Illumination
///          Computation", IEEE TVCG 11(5), 2005. The rotational gradient is stored as the vector to
///          multiply with the new normal, not with the axis of rotation.
/// Checked: GatherRecord.*
GatherRecord make_gather_record(const Vec3& position, const GatherHemisphere& hemisphere,
                                std::span<const GatherSample> samples, const GatherRadii& radii,
                                int filter = 0);

/// Divides parts of light by their sum, by channel; if the sum is 0, the last part gets 1.
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
