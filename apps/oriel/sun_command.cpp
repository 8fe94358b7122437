// SPDX-License-Identifier: Apache-2.0
// oriel sun: where the sun stands, and how bright the physical sun and sky are then.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/math.h"
#include "color/luminance.h"
#include "command.h"
#include "sky/daylight.h"
#include "sky/physical_sky.h"
#include "sun_scene.h"

namespace oriel::app {
namespace {

struct SunArguments {
  std::string place, time;
  float haze = 0;
  double north = 0;
  bool json = false;
};

struct Daylight {
  float sun_normal, sun_horizontal, sky_horizontal, zenith;  ///< lux, and cd/m2 of the zenith
};

/// Of mia_physicalsun and mia_physicalsky at that haze, by luminance.
Daylight daylight(float elevation_deg, float haze) {
  const float e = elevation_deg * kPi / 180;
  const Vec3 to_sun(math::cos(e), 0, math::sin(e));
  sky::SkyParameters p;
  p.rgb_unit_conversion = Rgb(1);
  p.haze = haze;
  p.sun_direction = to_sun;
  const sky::PhysicalSky model(p);
  const sky::PreethamSky gradient(to_sun, 2 + haze);
  const float sun =
      luminance(sky::sun_colour({.rgb_unit_conversion = Rgb(1), .haze = haze}, to_sun));
  return {sun, sun * std::max(0.0f, to_sun.z),
          luminance(sky::horizontal_illuminance(gradient)) * sky::night_factor(to_sun.z),
          luminance(model.radiance(Vec3(0, 0, 1), sky::SkyPart::Gradient)) / kPi};
}

/// Rounded for reading; zeros without a sign.
float rounded(float x) { return std::round(x * 1e6f) / 1e6f + 0.0f; }

nlohmann::json vector_of(const Vec3& d) { return {d.x, d.y, d.z}; }

int run_sun(const SunArguments& a) {
  const sky::Place place = read_place("--at", a.place);
  const sky::SolarPosition sun = sky::solar_position(read_time("--time", a.time), place);
  const Vec3 z_up = sky::direction_to_sun(sun.azimuth, sun.elevation, a.north, false);
  const Vec3 y_up = sky::direction_to_sun(sun.azimuth, sun.elevation, a.north, true);
  const Daylight light = daylight(static_cast<float>(sun.elevation), a.haze);
  if (a.json) {
    const nlohmann::json line = {
        {"azimuth", sun.azimuth},
        {"elevation", sun.elevation},
        {"geometric_elevation", sun.geometric_elevation},
        {"direction", {{"z_up", vector_of(z_up)}, {"y_up", vector_of(y_up)}}},
        {"haze", a.haze},
        {"sun_illuminance", {{"normal", light.sun_normal}, {"horizontal", light.sun_horizontal}}},
        {"sky_illuminance", {{"horizontal", light.sky_horizontal}}},
        {"zenith_luminance", light.zenith}};
    fmt::print("{}\n", line.dump());
    return kExitDone;
  }
  const auto show = [](const char* what, const Vec3& d) {
    fmt::print("{:<22}{:9.6f} {:9.6f} {:9.6f}\n", what, rounded(d.x), rounded(d.y), rounded(d.z));
  };
  fmt::print("{:<22}{:.3f} degrees, clockwise from north\n", "azimuth", sun.azimuth);
  fmt::print("{:<22}{:.3f} degrees ({:.3f} without the air)\n", "elevation", sun.elevation,
             sun.geometric_elevation);
  show("toward the sun, z up", z_up);
  show("toward the sun, y up", y_up);
  fmt::print("{:<22}{:.0f} lux facing it, {:.0f} lux on level ground\n", "sun", light.sun_normal,
             light.sun_horizontal);
  fmt::print("{:<22}{:.0f} lux on level ground\n", "sky", light.sky_horizontal);
  fmt::print("{:<22}{:.0f} cd/m2\n", "zenith", light.zenith);
  return kExitDone;
}

}  // namespace

Command add_sun_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "sun", "Print the position of the sun for a place and time, and the light of sun and sky");
  auto a = std::make_shared<SunArguments>();
  app->add_option("--at", a->place, "Place, in degrees north and east")
      ->required()
      ->type_name("LAT,LON");
  app->add_option("--time", a->time, "Date and time with zone, e.g. 2026-06-21T12:00+02:00")
      ->required()
      ->type_name("TIME");
  app->add_option("--haze", a->haze, "Haze, as in mia_physicalsun and mia_physicalsky")
      ->check(CLI::Range(0.0f, 15.0f))
      ->capture_default_str();
  app->add_option("--north", a->north,
                  "North: degrees clockwise from +Y, seen from above (from -Z if y is up)")
      ->capture_default_str();
  app->add_flag("--json", a->json, "Print one line of JSON");
  return {app, [a] { return run_sun(*a); }};
}

}  // namespace oriel::app
