// SPDX-License-Identifier: Apache-2.0
#include "sky/solar_position.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/math.h"

namespace oriel::sky {
namespace {

constexpr double kDeg = 0.017453292519943295;  // radians
constexpr double kArcsecond = 1.0 / 3600;      // degrees

double sine(double degrees) { return math::sin(degrees * kDeg); }
double cosine(double degrees) { return math::cos(degrees * kDeg); }
/// Reduces an angle to 0 .. 360.
double turn(double degrees) {
  const double d = std::fmod(degrees, 360);
  return d < 0 ? d + 360 : d;
}

/// Reads exactly `count` digits; -1 if there are fewer.
int take_number(std::string_view& text, std::size_t count) {
  if (text.size() < count) return -1;
  int value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (text[i] < '0' || text[i] > '9') return -1;
    value = 10 * value + (text[i] - '0');
  }
  text.remove_prefix(count);
  return value;
}

bool take(std::string_view& text, std::string_view any_of) {
  if (text.empty() || any_of.find(text[0]) == any_of.npos) return false;
  text.remove_prefix(1);
  return true;
}

/// Hours east of Greenwich of "Z", "+02", "+02:00", "-0730"; unset if anything follows.
std::optional<double> take_zone(std::string_view text) {
  if (text == "Z" || text == "z") return 0.0;
  const bool west = !text.empty() && text[0] == '-';
  if (!take(text, "+-")) return std::nullopt;
  const int hours = take_number(text, 2);
  int minutes = 0;
  if (!text.empty()) {
    take(text, ":");
    minutes = take_number(text, 2);
  }
  if (hours < 0 || hours > 14 || minutes < 0 || minutes > 59 || !text.empty()) return std::nullopt;
  return (west ? -1 : 1) * (hours + minutes / 60.0);
}

/// Difference between terrestrial time and universal time in seconds.
double delta_t(double julian_day) {
  const double t = (julian_day - 2451545) / 365.25;  // years from 2000
  if (t > -14 && t < 50) return 62.92 + t * (0.32217 + t * 0.005589);
  const double u = (t + 180) / 100;
  return -20 + 32 * u * u;
}

/// Perturbations of the Earth's longitude by Venus, Jupiter and the Moon, and a long-period term,
/// in degrees; `days` since 2000, noon.
double perturbations(double days) {
  const double t = (days + 36525) / 36525;  // centuries since 1900
  return 0.00134 * cosine(153.23 + 22518.7541 * t) + 0.00154 * cosine(216.57 + 45037.5082 * t) +
         0.00200 * cosine(312.69 + 32964.3577 * t) +
         0.00179 * sine(350.74 + 445267.1142 * t - 0.00144 * t * t) +
         0.00178 * sine(231.19 + 20.20 * t);
}

/// Atmospheric refraction in degrees.
double refraction(double elevation, const Place& place) {
  constexpr double kUpperLimbSets = -0.26667 - 0.5667;
  if (elevation < kUpperLimbSets) return 0;
  const double at_standard =
      1.02 / (60 * math::tan((elevation + 10.3 / (elevation + 5.11)) * kDeg));
  return place.pressure / 1010 * 283 / (273 + place.temperature) * at_standard;
}

}  // namespace

std::optional<double> julian_day(std::string_view text) {
  const int year = take_number(text, 4);
  if (year < 0 || !take(text, "-")) return std::nullopt;
  const int month = take_number(text, 2);
  if (month < 0 || !take(text, "-")) return std::nullopt;
  const int day = take_number(text, 2);
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(std::max(day, 0)))};
  if (!date.ok() || !take(text, "Tt ")) return std::nullopt;
  const int hours = take_number(text, 2);
  if (hours < 0 || hours > 23 || !take(text, ":")) return std::nullopt;
  const int minutes = take_number(text, 2);
  if (minutes < 0 || minutes > 59) return std::nullopt;
  double seconds = 0;
  if (take(text, ":")) {
    seconds = take_number(text, 2);
    if (seconds < 0 || seconds > 60) return std::nullopt;
    if (take(text, ".")) {
      double unit = 0.1;
      for (; !text.empty() && text[0] >= '0' && text[0] <= '9'; unit /= 10)
        seconds += unit * take_number(text, 1);
    }
  }
  const auto zone = take_zone(text);
  if (!zone) return std::nullopt;
  const auto days = std::chrono::sys_days(date).time_since_epoch().count();
  constexpr double kEpoch = 2440587.5;  // 1970, January 1, 0 h
  return kEpoch + static_cast<double>(days) + (hours - *zone + (minutes + seconds / 60) / 60) / 24;
}

SolarPosition solar_position(double julian_day, const Place& place) {
  const double days = julian_day - 2451545;
  // Julian centuries of terrestrial time
  const double t = (days + delta_t(julian_day) / 86400) / 36525;

  // Geocentric longitude.
  const double mean_longitude = 280.46646 + t * (36000.76983 + t * 0.0003032);
  const double anomaly = 357.52911 + t * (35999.05029 - t * 0.0001537);
  const double centre = sine(anomaly) * (1.914602 - t * (0.004817 + t * 0.000014)) +
                        sine(2 * anomaly) * (0.019993 - t * 0.000101) +
                        sine(3 * anomaly) * 0.000289;
  const double eccentricity = 0.016708634 - t * (0.000042037 + t * 0.0000001267);
  const double distance = 1.000001018 * (1 - eccentricity * eccentricity) /
                          (1 + eccentricity * cosine(anomaly + centre));  // astronomical units
  const double node = 125.04452 - t * 1934.136261;
  const double moon = 218.3165 + t * 481267.8813;
  const double nutation = kArcsecond * (-17.20 * sine(node) - 1.32 * sine(2 * mean_longitude) -
                                        0.23 * sine(2 * moon) + 0.21 * sine(2 * node));
  const double aberration = -20.4898 * kArcsecond / distance;
  const double longitude = mean_longitude + centre + perturbations(days) + aberration + nutation;
  const double obliquity = 23.4392911 - t * kArcsecond * (46.8150 + t * (0.00059 - t * 0.001813)) +
                           kArcsecond * (9.20 * cosine(node) + 0.57 * cosine(2 * mean_longitude) +
                                         0.10 * cosine(2 * moon) - 0.09 * cosine(2 * node));

  SolarPosition sun;
  sun.right_ascension =
      turn(math::atan2(cosine(obliquity) * sine(longitude), cosine(longitude)) / kDeg);
  sun.declination = math::asin(sine(obliquity) * sine(longitude)) / kDeg;

  const double sidereal =
      280.46061837 + 360.98564736629 * days + 0.000387933 * t * t + nutation * cosine(obliquity);
  const double hour = sidereal + place.longitude - sun.right_ascension;
  const double up = sine(place.latitude) * sine(sun.declination) +
                    cosine(place.latitude) * cosine(sun.declination) * cosine(hour);
  const double south = sine(place.latitude) * cosine(sun.declination) * cosine(hour) -
                       cosine(place.latitude) * sine(sun.declination);
  const double west = cosine(sun.declination) * sine(hour);
  sun.azimuth = turn(180 + math::atan2(west, south) / kDeg);
  const double parallax = 8.794 * kArcsecond / distance;
  const double seen_from_centre = math::atan2(up, math::hypot(south, west)) / kDeg;
  sun.geometric_elevation = seen_from_centre - parallax * cosine(seen_from_centre);
  sun.elevation = sun.geometric_elevation + refraction(sun.geometric_elevation, place);
  return sun;
}

Vec3 direction_to_sun(double azimuth, double elevation, double north, bool y_is_up) {
  const double a = azimuth + north;
  const auto east = static_cast<float>(cosine(elevation) * sine(a));
  const auto ahead = static_cast<float>(cosine(elevation) * cosine(a));
  const auto up = static_cast<float>(sine(elevation));
  return y_is_up ? Vec3(east, up, -ahead) : Vec3(east, ahead, up);
}

}  // namespace oriel::sky
