// SPDX-License-Identifier: Apache-2.0
// How bright is a luminaire in a direction: candela over the sphere, their flux, their sampling.
#pragma once

#include <vector>

#include "base/vec.h"
#include "sampling/distribution.h"

namespace oriel::photometry {

// Conventions
//   The luminaire's own frame: nadir ("straight down", what the luminaire is aimed with) is -z; +x
//   is the photometric horizontal, the 0 degree direction of IES files, along the luminaire's
//   length; +y completes a right-handed frame. Directions are unit and point away from the
//   luminaire. Intensity is in candela, flux in lumen, densities per solid angle. Tables are in
//   degrees, as files are.

/// Axes of a table's angles: `pole` where the polar angle is 0, azimuth 0 toward `zero` and 90
/// toward `side`.
struct PolarFrame {
  Vec3 pole{0, 0, -1}, zero{1, 0, 0}, side{0, 1, 0};
};

/// Candela where planes of constant azimuth cross cones of constant polar angle.
///
/// Inputs:  polar: ascending within 0 ... 180, at least 2. azimuth: ascending, at least 2, from
///          -180 or more over at most 360; a span of 360 closes the circle and its last plane
///          equals the first. candela: plane after plane, finite, not negative.
struct CandelaTable {
  PolarFrame frame;
  std::vector<float> polar, azimuth, candela;
  float at(std::size_t plane, std::size_t cone) const {
    return candela[plane * polar.size() + cone];
  }
};

/// How a profile fills in between the angles of its table.
struct ProfileGrid {
  bool cubic = false;  ///< by monotone cubics, tabled finely; else linear in both angles
  /// Cells of that finer table over the whole range; 0 = a degree or less each.
  int azimuth_cells = 0, polar_cells = 0;
};

/// Luminous intensity of a luminaire over all directions.
///
/// Model:   linear in both angles between the table's entries, 0 outside of its range. The cubic
///          goes through all entries and never past their extremes.
/// Source:  Fritsch, Butland, "A Method for Constructing Local Monotone Piecewise Cubic
///          Interpolants", SIAM J. Sci. Stat. Comput. 5, 1984.
/// Checked: LightProfile.*
class LightProfile {
 public:
  explicit LightProfile(CandelaTable table, const ProfileGrid& grid = {});

  float evaluate(const Vec3& direction) const;
  /// Exact integral of evaluate over the sphere, lm.
  float flux() const { return flux_; }
  /// Largest intensity, cd, and the first direction that has it.
  float peak() const { return peak_; }
  Vec3 peak_direction() const { return peak_direction_; }

  struct Sample {
    Vec3 direction{0, 0, -1};
    float pdf = 0;  ///< 0: the profile gives no light
  };
  /// Draws directions in proportion to evaluate, exactly: between the entries as well.
  Sample sample(const Vec2& u) const;
  float pdf(const Vec3& direction) const { return evaluate(direction) * inverse_flux_; }

 private:
  struct Corners {
    double near0, far0, near1, far1;  ///< at the lower and upper polar angle of both planes
  };
  Corners corners(std::size_t plane, std::size_t band) const;
  Vec3 direction(double polar, double azimuth) const;
  float interpolate(float polar, float azimuth) const;
  void measure();

  CandelaTable table_;                           // angles in radians
  bool closed_ = false;                          // the circle of azimuths
  sampling::Distribution1D bands_;               // polar, by flux
  std::vector<sampling::Distribution1D> cells_;  // azimuth, of each band
  float flux_ = 0, inverse_flux_ = 0, peak_ = 0;
  Vec3 peak_direction_{0, 0, -1};
};

/// Full width in degrees around the direction of `axis` within which intensity stays above `share`
/// of that on the axis, in the plane of `toward`: the mean of both sides, doubled.
float beam_width_deg(const LightProfile& profile, const Vec3& axis, const Vec3& toward,
                     float share);

}  // namespace oriel::photometry
