// SPDX-License-Identifier: Apache-2.0
// Luminous intensity distribution of a luminaire: evaluation, flux, importance sampling.
#pragma once

#include <vector>

#include "base/vec.h"
#include "sampling/distribution.h"

namespace oriel::photometry {

// Conventions
//   Luminaire frame: nadir ("straight down", the aiming axis of the luminaire) is -z; +x is the
//   photometric horizontal, the 0 degree direction of IES files, along the luminaire's length; +y
//   completes a right-handed frame. Directions are unit vectors away from the luminaire. Intensity
//   is in candela, flux in lumen, densities per solid angle. Tables are in degrees like the files.

/// Axes of the angles of a table: polar angle 0 is `pole`; azimuth 0 is `zero`, 90 is `side`.
struct PolarFrame {
  Vec3 pole{0, 0, -1}, zero{1, 0, 0}, side{0, 1, 0};
};

/// Candela at the crossings of planes of constant azimuth and cones of constant polar angle.
///
/// Inputs:  polar: ascending within 0 ... 180, at least 2. azimuth: ascending, at least 2, from
///          -180 or more over at most 360; a span of 360 closes the circle, and the last plane
///          equals the first. candela: plane after plane, finite, non-negative.
struct CandelaTable {
  PolarFrame frame;
  std::vector<float> polar, azimuth, candela;
  float at(std::size_t plane, std::size_t cone) const {
    return candela[plane * polar.size() + cone];
  }
};

/// Interpolation between the angles of the table.
struct ProfileGrid {
  bool cubic = false;  ///< monotone cubics, resampled to a finer table; else bilinear
  /// Resolution of the finer table over the whole range; 0 = at most one degree per cell.
  int azimuth_cells = 0, polar_cells = 0;
};

/// Luminous intensity of a luminaire as a function of direction.
///
/// Model:   bilinear in the angles between table entries, 0 outside of the range. The cubic
///          interpolates all entries and does not exceed their extremes.
/// Source:  Fritsch, Butland, "A Method for Constructing Local Monotone Piecewise Cubic
///          Interpolants", SIAM J. Sci. Stat. Comput. 5, 1984.
/// Checked: LightProfile.*
class LightProfile {
 public:
  explicit LightProfile(CandelaTable table, const ProfileGrid& grid = {});

  float evaluate(const Vec3& direction) const;
  /// Exact integral of evaluate over the sphere, lm.
  float flux() const { return flux_; }
  /// Maximum intensity in cd, and the first direction with that intensity.
  float peak() const { return peak_; }
  Vec3 peak_direction() const { return peak_direction_; }

  struct Sample {
    Vec3 direction{0, 0, -1};
    float pdf = 0;  ///< 0: the profile emits no light
  };
  /// Samples directions exactly in proportion to evaluate(), including the interpolation.
  Sample sample(const Vec2& u) const;
  float pdf(const Vec3& direction) const { return evaluate(direction) * inverse_flux_; }

 private:
  struct Corners {
    /// intensities at the lower and upper polar angle of both planes
    double near0, far0, near1, far1;
  };
  Corners corners(std::size_t plane, std::size_t band) const;
  Vec3 direction(double polar, double azimuth) const;
  float interpolate(float polar, float azimuth) const;
  void measure();

  CandelaTable table_;                           // angles in radians
  bool closed_ = false;                          // the azimuths cover the full circle
  sampling::Distribution1D bands_;               // polar, by flux
  std::vector<sampling::Distribution1D> cells_;  // azimuth, per band
  float flux_ = 0, inverse_flux_ = 0, peak_ = 0;
  Vec3 peak_direction_{0, 0, -1};
};

/// Full beam width in degrees in the plane of `axis` and `toward`, within which the intensity is
/// above `share` of that on the axis: twice the mean of both sides.
float beam_width_deg(const LightProfile& profile, const Vec3& axis, const Vec3& toward,
                     float share);

}  // namespace oriel::photometry
