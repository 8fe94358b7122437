// SPDX-License-Identifier: Apache-2.0
// oriel measure: illuminance on a grid or at points, and luminance of pixels.
#include <fmt/format.h>

#include <cmath>
#include <cstdio>

#include "analysis/measure.h"
#include "base/durable_file.h"
#include "base/math.h"
#include "base/parallel.h"
#include "color/luminance.h"
#include "interrupt.h"
#include "measure_places.h"
#include "output/camera_output.h"
#include "prepare/prepare.h"
#include "render/unit_luminance.h"
#include "scene_code.h"
#include "scene_file.h"
#include "sdk/host.h"
#include "shaders/registry.h"
#include "sun_scene.h"

namespace oriel::app {
namespace {

using nlohmann::json;

struct MeasureArguments {
  SceneArguments scene;
  PlaceArguments places;
  std::vector<std::string> pixels;
  std::string precision = "2%", camera, sun, csv;
  std::optional<double> north;
  std::optional<float> unit_luminance;
  MeasureRequest request{.floor = .1};
  int threads = 0;
  bool json = false;
};

/// Readings of a pixel and of its visible surface.
struct SpotReading {
  int x, y;
  Spot spot;
  Reading luminance, illuminance;
};

/// The result of a run.
struct Measurement {
  UnitLuminance unit;
  float length_unit = 1;  ///< metres per scene unit; 1 = not given
  Places places;
  std::vector<Reading> readings;
  std::vector<SpotReading> spots;
  double open_sky = 0;  ///< lux of open ground if only the sky emits light; else 0
};

double parse_precision(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool percent = *end == '%' && end[1] == 0;
  if (end == text.c_str() || (*end != 0 && !percent) || !(value > 0))
    throw UsageError(
        fmt::format("--precision {}: expected a positive fraction, as 2% or 0.02", text));
  return percent ? value / 100 : value;
}

void check(MeasureArguments& a) {
  const PlaceArguments& p = a.places;
  a.request.precision = parse_precision(a.precision);
  if (p.points.empty() && p.grid.empty() && p.plane.empty() && a.pixels.empty())
    throw UsageError("nothing to measure: --grid, --plane, --at or --pixel is required");
  if (p.plane.empty() && !p.inset.empty()) throw UsageError("--inset requires --plane");
  if (p.plane.empty() && p.grid.empty() && !p.spacing.empty())
    throw UsageError("--spacing requires --plane or --grid");
  if (p.meters_per_unit && !(*p.meters_per_unit > 0))
    throw UsageError("--meters-per-unit: expected a positive number");
  if (a.unit_luminance && !(*a.unit_luminance > 0))
    throw UsageError("--unit-luminance: expected a positive number");
  if (!(a.request.seconds >= 0)) throw UsageError("--time: expected a positive number of seconds");
  if (a.north && a.sun.empty()) throw UsageError("--north requires --sun");
}

std::vector<Vec2> corners_of(const std::vector<std::string>& pixels, const Camera& camera) {
  std::vector<Vec2> corners;
  for (const std::string& text : pixels) {
    int x = 0, y = 0;
    char rest = 0;
    if (std::sscanf(text.c_str(), "%6d,%6d%c", &x, &y, &rest) != 2)
      throw UsageError(fmt::format("--pixel {}: expected X,Y", text));
    if (x < 0 || y < 0 || x >= camera.width || y >= camera.height)
      throw UserError(fmt::format("--pixel {}: the picture has {} x {} pixels", text, camera.width,
                                  camera.height));
    corners.emplace_back(static_cast<float>(x), static_cast<float>(camera.height - 1 - y));
  }
  return corners;
}

/// Lux of open level ground if the environment is the only source; else 0.
double open_sky(const World& world, float unit, const Vec3& up) {
  for (const Light& light : world.lights)
    if (!light.portal) return 0;
  return unit * luminance(open_sky_irradiance(world, up));
}

std::vector<SpotReading> read_spots(const MeasureArguments& a, const World& world, float unit) {
  const std::vector<Vec2> corners = corners_of(a.pixels, world.camera);
  const auto luminances = measure_luminance(world, corners, unit, a.request, &interrupted());
  std::vector<SpotReading> spots;
  std::vector<IrradianceSensor> sensors;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const int y = world.camera.height - 1 - static_cast<int>(corners[i].y);
    spots.push_back({static_cast<int>(corners[i].x),
                     y,
                     find_spot(world, corners[i] + Vec2(.5f)),
                     luminances[i],
                     {}});
    if (spots.back().spot.surface) sensors.push_back(spots.back().spot.sensor);
  }
  const auto lux = measure_illuminance(world, sensors, unit, a.request, {}, &interrupted());
  std::size_t next = 0;
  for (SpotReading& s : spots)
    if (s.spot.surface) s.illuminance = lux[next++];
  return spots;
}

json json_of(const Reading& r) {
  return {{"value", r.value},
          {"half_width", r.half_width},
          {"samples", r.samples},
          {"precise", r.precise}};
}
json json_of(const Vec3& v, float unit = 1) { return {v.x * unit, v.y * unit, v.z * unit}; }

/// Statistics of all sensors.
struct Summary {
  Reading mean;
  std::size_t least = 0, most = 0;  ///< indices of sensors
  int imprecise = 0;

  explicit Summary(const std::vector<Reading>& readings) : mean(mean_reading(readings)) {
    for (std::size_t i = 0; i < readings.size(); ++i) {
      if (readings[i].value < readings[least].value) least = i;
      if (readings[i].value > readings[most].value) most = i;
      imprecise += !readings[i].precise;
    }
  }
};

json json_of(const Measurement& m) {
  json out = {{"unit_luminance", m.unit.cd_m2},
              {"unit_luminance_source", m.unit.by},
              {"meters_per_unit", m.length_unit}};
  if (!m.readings.empty()) {
    json sensors = json::array();
    for (std::size_t i = 0; i < m.readings.size(); ++i) {
      json sensor = json_of(m.readings[i]);
      sensor["position"] = json_of(m.places.sensors[i].position, m.length_unit);
      sensor["normal"] = json_of(m.places.sensors[i].normal);
      sensors.push_back(sensor);
    }
    const Summary s(m.readings);
    const double least = m.readings[s.least].value;
    out["illuminance"] = {{"sensors", sensors},
                          {"columns", m.places.columns},
                          {"rows", m.places.rows},
                          {"mean", json_of(s.mean)},
                          {"min", least},
                          {"max", m.readings[s.most].value},
                          {"uniformity", s.mean.value > 0 ? least / s.mean.value : 0}};
    if (m.open_sky > 0) {
      out["illuminance"]["open_sky"] = m.open_sky;
      out["illuminance"]["daylight_factor"] = s.mean.value / m.open_sky;
    }
  }
  for (const SpotReading& r : m.spots) {
    json spot = {{"pixel", {r.x, r.y}}, {"luminance", json_of(r.luminance)}};
    if (r.spot.surface) {
      spot["illuminance"] = json_of(r.illuminance);
      spot["position"] = json_of(r.spot.sensor.position, m.length_unit);
      spot["normal"] = json_of(r.spot.sensor.normal);
      spot["distance"] = r.spot.distance * m.length_unit;
      spot["material"] = r.spot.material;
      spot["instance"] = r.spot.instance;
    }
    out["spots"].push_back(spot);
  }
  return out;
}

/// With the digits that are significant by the interval.
std::string text_of(const Reading& r) {
  const double width = std::max(r.half_width, 1e-3 * std::abs(r.value));
  const int digits =
      width > 0 ? std::clamp(1 - static_cast<int>(std::floor(math::log10(width))), 0, 6) : 0;
  return fmt::format("{:.{}f} +- {:.{}f}", r.value, digits, r.half_width, digits);
}

std::string place_text(const Vec3& p, float unit) {
  return fmt::format("{:.4g} {:.4g} {:.4g}", p.x * unit, p.y * unit, p.z * unit);
}

void print_grid(const Measurement& m) {
  for (int row = 0; row < m.places.rows; ++row) {
    std::string line;
    for (int column = 0; column < m.places.columns; ++column) {
      const int sensor = row * m.places.columns + column;
      const double lux = m.readings[static_cast<std::size_t>(sensor)].value;
      line += fmt::format(" {:>7}",
                          lux < 100 ? fmt::format("{:.1f}", lux) : fmt::format("{:.0f}", lux));
    }
    fmt::print("{}\n", line);
  }
}

void print_illuminance(const Measurement& m, double precision, const char* length) {
  const std::size_t n = m.readings.size();
  if (m.places.columns > 0) {
    fmt::print("lux, {} x {} sensors, spacing {:.4g} x {:.4g} {}, from {} to {}\n",
               m.places.columns, m.places.rows, m.places.spacing[0] * m.length_unit,
               m.places.spacing[1] * m.length_unit, length,
               place_text(m.places.sensors.front().position, m.length_unit),
               place_text(m.places.sensors.back().position, m.length_unit));
    print_grid(m);
  } else {
    for (std::size_t i = 0; i < n; ++i)
      fmt::print("{:<28}{} lux\n", place_text(m.places.sensors[i].position, m.length_unit),
                 text_of(m.readings[i]));
  }
  const Summary s(m.readings);
  const double least = m.readings[s.least].value;
  if (n > 1) {
    fmt::print("{:<12}{} lux\n", "mean", text_of(s.mean));
    fmt::print("{:<12}{} lux at {}\n", "min", text_of(m.readings[s.least]),
               place_text(m.places.sensors[s.least].position, m.length_unit));
    fmt::print("{:<12}{} lux at {}\n", "max", text_of(m.readings[s.most]),
               place_text(m.places.sensors[s.most].position, m.length_unit));
    fmt::print("{:<12}{:.3f} (min / mean)\n", "uniformity",
               s.mean.value > 0 ? least / s.mean.value : 0);
  }
  if (m.open_sky > 0)
    fmt::print("{:<12}{:.2f} % of {:.0f} lux under the open sky\n", "daylight",
               100 * s.mean.value / m.open_sky, m.open_sky);
  if (s.imprecise > 0)
    fmt::print(
        "{} of {} sensors exceed a relative error of {:.3g} %: increase --time or --max-samples\n",
        s.imprecise, n, 100 * precision);
}

void print_spot(const SpotReading& r, float unit, const char* length) {
  fmt::print("pixel {},{}\n", r.x, r.y);
  fmt::print("  {:<12}{} cd/m2\n", "luminance", text_of(r.luminance));
  if (!r.spot.surface) return fmt::print("  no surface\n");
  fmt::print("  {:<12}{} lux\n", "illuminance", text_of(r.illuminance));
  fmt::print("  {:<12}{}, {:.4g} {} away\n", "position", place_text(r.spot.sensor.position, unit),
             r.spot.distance * unit, length);
  fmt::print("  {:<12}{} of {}\n", "material", r.spot.material, r.spot.instance);
}

void write_csv(const std::string& path, const Measurement& m) {
  std::string text = "x,y,z,nx,ny,nz,lux,half_width,samples\n";
  for (std::size_t i = 0; i < m.readings.size(); ++i) {
    const Vec3 p = m.places.sensors[i].position * m.length_unit, n = m.places.sensors[i].normal;
    const Reading& r = m.readings[i];
    text += fmt::format("{},{},{},{},{},{},{:.7g},{:.4g},{}\n", p.x, p.y, p.z, n.x, n.y, n.z,
                        r.value, r.half_width, r.samples);
  }
  write_durably(path, text);
}

/// The first frame of the scene, prepared, with the objects that its shaders use.
struct LoadedScene {
  scene::Scene scene;
  std::optional<SceneCode> code;
  std::optional<sdk::Host> host;
  std::unique_ptr<World> world;  ///< null: an error was reported

  ~LoadedScene() {
    if (host) host->end_frame();
  }
};

void load(const MeasureArguments& a, LoadedScene& loaded, Diagnostics& diagnostics,
          UnitLuminance& unit) {
  scene::Scene& scene = loaded.scene;
  mi::Reader reader(a.scene.path, read_options(a.scene, builtin_shaders()), diagnostics);
  if (!reader.opened() || !reader.next_frame(scene)) return;
  for (const std::string& edit : a.scene.edits) apply_edit(scene, edit, builtin_shaders());
  const scene::RenderCommand& command = scene.renders.back();
  if (!a.sun.empty()) turn_sun(scene, command.root, read_sun("--sun", a.sun), a.north.value_or(0));
  PrepareOptions options;
  options.camera = a.camera;
  PrepareReport report;
  SceneCode& code = loaded.code.emplace(a.scene, diagnostics);
  code.compile(scene);
  sdk::Host& host = loaded.host.emplace(scene, builtin_shaders(), code.trusted_folders(),
                                        diagnostics, &interrupted());
  std::unique_ptr<World>& world = loaded.world;
  world = prepare(scene, command, host.registry(), options, diagnostics, report);
  if (!world) return;
  world->options.choose_paths_alone();
  if (a.unit_luminance) {
    unit = {*a.unit_luminance, "--unit-luminance"};
    return;
  }
  NodeList outputs;
  if (const scene::Camera* camera = find_camera(scene, command, a.camera))
    outputs = camera_output_shaders(*camera, scene, host.registry(), *world, diagnostics);
  unit = unit_luminance(*world, outputs, diagnostics);
}

int run_measure(MeasureArguments& a) {
  check(a);
  const ThreadLimit limit(a.threads);
  flush_denormals();
  Diagnostics diagnostics;
  DiagnosticPrinter printer(diagnostics, a.json, false);
  Measurement m;
  LoadedScene loaded;
  load(a, loaded, diagnostics, m.unit);
  const std::unique_ptr<World>& world = loaded.world;
  printer.print_new();
  if (!world) return kExitFailed;
  m.length_unit = a.places.meters_per_unit.value_or(1);
  catch_interrupts();
  m.places = find_places(a.places, world->accel->bounds());
  m.readings =
      measure_illuminance(*world, m.places.sensors, m.unit.cd_m2, a.request, {}, &interrupted());
  m.spots = read_spots(a, *world, m.unit.cd_m2);
  loaded.host->end_frame();
  printer.print_new();
  if (interrupted()) return kExitFailed;
  if (!m.places.sensors.empty())
    m.open_sky = open_sky(*world, m.unit.cd_m2, m.places.sensors.front().normal);
  if (!a.csv.empty()) write_csv(a.csv, m);
  if (a.json) return print_json(json_of(m)), kExitDone;

  const char* length = a.places.meters_per_unit ? "m" : "scene units";
  fmt::print("one pixel unit is {:.6g} cd/m2 ({})\n", m.unit.cd_m2,
             m.unit.by.empty() ? "default; the scene does not define it" : m.unit.by);
  if (!m.readings.empty()) print_illuminance(m, a.request.precision, length);
  for (const SpotReading& spot : m.spots) print_spot(spot, m.length_unit, length);
  return kExitDone;
}

}  // namespace

Command add_measure_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "measure",
      "Measure light: lux of sensors on a grid or at points, cd/m2 of pixels, each with its 95 % "
      "confidence interval");
  auto a = std::make_shared<MeasureArguments>();
  add_scene_arguments(*app, a->scene);
  PlaceArguments& p = a->places;
  CLI::Option* grid =
      app->add_option(
             "--grid", p.grid,
             "Rectangle of sensors: corner, two edges, numbers, e.g. 0,0,.85:4,0,0:0,3,0:8x6")
          ->type_name("ORIGIN:U:V[:NUxNV]");
  CLI::Option* plane =
      app->add_option(
             "--plane", p.plane,
             "Horizontal or vertical grid of sensors through the bounding box, e.g. z=0.85")
          ->type_name("AXIS=VALUE")
          ->excludes(grid);
  app->add_option("--spacing", p.spacing, "Distance between sensors of --plane and --grid");
  app->add_option("--inset", p.inset,
                  "Distance of --plane from the sides of the bounding box (default 0)");
  app->add_option("--at", p.points, "One sensor; repeatable")
      ->allow_extra_args(false)
      ->type_name("X,Y,Z")
      ->excludes(grid)
      ->excludes(plane);
  app->add_option("--normal", p.normal,
                  "Direction of the sensors (default: normal of the plane or grid; 0,0,1 for --at)")
      ->type_name("X,Y,Z");
  app->add_option("--pixel", a->pixels,
                  "Luminance of a pixel, counted from the upper left (0,0); repeatable")
      ->allow_extra_args(false)
      ->type_name("X,Y");
  app->add_option("--precision", a->precision,
                  "Relative error of each reading at 95 % confidence (default 2%)");
  app->add_option("--floor", a->request.floor,
                  "Sufficient absolute error in lux and cd/m2 (default 0.1)")
      ->check(CLI::NonNegativeNumber);
  app->add_option("--max-samples", a->request.max_samples,
                  "Maximum number of paths per reading (default 1048576)")
      ->check(CLI::PositiveNumber);
  app->add_option("--time", a->request.seconds,
                  "Time limit in seconds, for all sensors and again for all pixels (default none)");
  app->add_option(
      "--unit-luminance", a->unit_luminance,
      "cd/m2 of one pixel unit (default: from the exposure or sky of the scene, else 1)");
  app->add_option(
      "--meters-per-unit", p.meters_per_unit,
      "Metres per scene unit. Positions are printed in metres, and lengths may be given as 0.5m. "
      "Does not change the light: the falloff of lights uses scene units");
  app->add_option("--sun", a->sun, "Position of the sun, as in oriel render")
      ->type_name("LAT,LON,TIME");
  app->add_option("--north", a->north, "Direction of north, as in oriel render");
  app->add_option("--camera", a->camera, "Camera instance to use");
  app->add_option("--csv", a->csv, "CSV file to write, one line per sensor");
  app->add_option("--seed", a->request.seed, "Random seed (default 0)");
  app->add_option("--threads", a->threads, "Number of threads, 0 = all (default 0)")
      ->check(CLI::Range(0, 4096));
  app->add_flag("--json", a->json, "Print one line of JSON");
  return {app, [a] { return run_measure(*a); }};
}

}  // namespace oriel::app
