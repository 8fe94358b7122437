// SPDX-License-Identifier: Apache-2.0
// Position of the sun for a place, a date and a time.
#pragma once

#include <optional>
#include <string_view>

#include "base/vec.h"

namespace oriel::sky {

// Conventions
//   Angles in degrees. Latitude north, longitude east, azimuth clockwise from north (90 = east).
//   double: Julian days require 13 digits, and the mean longitude of the sun is a difference of
//   large angles.

struct Place {
  double latitude = 0, longitude = 0;
  double pressure = 1010;   ///< hPa; 0: no refraction
  double temperature = 10;  ///< degrees Celsius
};

struct SolarPosition {
  double azimuth = 0;
  double elevation = 0;                         ///< apparent, with refraction
  double geometric_elevation = 0;               ///< without refraction
  double declination = 0, right_ascension = 0;  ///< apparent, geocentric
};

/// Julian day in universal time of "2026-06-21T12:00+02:00": date, T or a blank, hours and minutes,
/// optional seconds, and Z or the offset from universal time. Unset if the format is invalid, the
/// day does not exist, or the zone is missing.
/// Checked: SolarPosition.TimesAreReadWithTheirZone
std::optional<double> julian_day(std::string_view time);

/// The sun's position.
///
/// Model:   longitude of the sun by the equation of the centre, the largest perturbations,
///          aberration, the four largest terms of nutation, parallax, refraction. The error is
///          below 0.003 degrees around 2000 and below 0.01 within some centuries.
/// Source:  Meeus, Astronomical Algorithms, 2nd ed., chapters 12, 22, 25; perturbations: Meeus,
///          Astronomical Formulae for Calculators, 3rd ed., chapter 18; refraction and its use
///          near the horizon: Reda and Andreas, Solar Position Algorithm, NREL/TP-560-34302 (2008);
///          length of the day: Espenak and Meeus, Five Millennium Canon of Solar Eclipses (2006).
/// Checked: SolarPosition.MatchesTheExampleOfNrelsReport, SolarPosition.MatchesMeeusExample
SolarPosition solar_position(double julian_day, const Place& place);

/// Unit vector towards an azimuth and elevation.
///
/// Inputs:  north: direction of north, clockwise seen from above, from +Y (from -Z with y up).
/// Returns: for north 0, z up: x east, y north; y up: x east, z south.
Vec3 direction_to_sun(double azimuth, double elevation, double north, bool y_is_up);

}  // namespace oriel::sky
