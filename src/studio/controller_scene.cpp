// SPDX-License-Identifier: Apache-2.0
// What is in the scene and in its pixels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/explain.h"
#include "geom/accel.h"
#include "interactive/interactive_session.h"
#include "output/camera_output.h"
#include "render/indirect_plan.h"
#include "studio/controller.h"
#include "studio/describe.h"
#include "studio/jobs.h"
#include "studio/json_values.h"
#include "studio/request_error.h"

namespace oriel::studio {
namespace {

using json = nlohmann::json;
using interactive::RenderLoop;

World& world_if(RenderLoop& loop, bool prepared) {
  if (!prepared) throw RequestError("failed", "the scene cannot be rendered");
  return *loop.scene().world();
}

/// The world of a loop, for measurements of light.
World& world_of(RenderLoop& loop) { return world_if(loop, loop.prepare_completely()); }

/// The same for rays alone.
const World& geometry_of(RenderLoop& loop) { return world_if(loop, loop.prepare()); }

/// Raster position of the lower left corner of a pixel of the full-size picture.
Vec2 pixel_corner(const RenderLoop& loop, const World& world, const json& request) {
  const auto [width, height] = loop.full_size();
  const int x = int_field(request, "x"), y = int_field(request, "y");
  if (x < 0 || y < 0 || x >= width || y >= height)
    throw RequestError("bad-request", fmt::format("the picture has {} x {} pixels", width, height));
  const auto scaled = loop.scaled_pixel(x, y);
  return {static_cast<float>(scaled[0]), static_cast<float>(world.camera.height - 1 - scaled[1])};
}

json spot_json(const scene::Scene& scene, const Spot& spot) {
  json result = {{"hit", spot.surface}};
  if (!spot.surface) return result;
  const auto* instance = scene.get<scene::Instance>(spot.instance);
  result["instance"] = spot.instance;
  result["object"] = instance ? instance->element : std::string();
  result["material"] = spot.material;
  result["position"] = json_of(spot.sensor.position);
  result["normal"] = json_of(spot.sensor.normal);
  result["distance"] = spot.distance;
  return result;
}

/// The radiance of the film at a pixel; null if it is not there.
json film_radiance(const RenderLoop& loop, int x, int y) {
  const RenderSession* session = loop.session();
  if (!session) return nullptr;
  const Window& w = session->window();
  const int column = x - w.x0, row = y - (session->world().camera.height - w.y1);
  if (column < 0 || row < 0 || column >= session->film().width() ||
      row >= session->film().height() || session->film().samples(column, row) == 0)
    return nullptr;
  return json_of(rgb(session->film().pixel(column, row).beauty));
}

MeasureRequest measure_request(const json& request) {
  MeasureRequest m;
  m.precision = std::clamp(optional_number(request, "precision").value_or(.02), 1e-4, 1.0);
  m.floor = .1;
  m.seconds = std::clamp(optional_number(request, "seconds").value_or(20), .01, 3600.0);
  return m;
}

/// Measures light by path tracing, as `oriel measure` does.
class PathTraced {
 public:
  explicit PathTraced(World& world) : world_(world), chosen_(world.options.choose_paths_alone()) {}
  ~PathTraced() { world_.options.choose(chosen_); }
  PathTraced(const PathTraced&) = delete;
  PathTraced& operator=(const PathTraced&) = delete;

 private:
  World& world_;
  scene::RenderOptions::IndirectChoice chosen_;
};

struct SensorGrid {
  std::vector<IrradianceSensor> sensors;
  int columns = 0, rows = 0;
};

constexpr int kMaxSensors = 10'000;

/// Sensors in the middle of equal cells, row by row, from the far end of the second edge.
SensorGrid sensor_grid(const json& request) {
  const Vec3 origin = vector_field(request, "origin");
  const Vec3 u = vector_field(request, "u"), v = vector_field(request, "v");
  SensorGrid grid;
  grid.columns = int_field(request, "columns");
  grid.rows = int_field(request, "rows");
  if (grid.columns < 1 || grid.rows < 1 || grid.columns > kMaxSensors || grid.rows > kMaxSensors ||
      grid.columns * grid.rows > kMaxSensors)
    throw RequestError("too-large", fmt::format("a grid has 1 to {} sensors", kMaxSensors));
  Vec3 normal = cross(u, v);
  if (request.contains("normal") && !request["normal"].is_null())
    normal = vector_field(request, "normal");
  if (!(length(normal) > 0)) throw RequestError("bad-request", "the grid has no area");
  normal = normalize(normal);
  for (int row = grid.rows - 1; row >= 0; --row)
    for (int column = 0; column < grid.columns; ++column) {
      const float s = (static_cast<float>(column) + .5f) / static_cast<float>(grid.columns);
      const float t = (static_cast<float>(row) + .5f) / static_cast<float>(grid.rows);
      grid.sensors.push_back({origin + u * s + v * t, normal});
    }
  return grid;
}

}  // namespace

json Controller::outline(Loop& loop, const json&) { return outline_json(loop.scene().scene()); }

json Controller::element(Loop& loop, const json& request) {
  json found = element_json(loop.scene().scene(), loop.diagnostics(), text_field(request, "name"),
                            loop.scene().registry(), history_.now());
  if (found.is_null()) throw RequestError("not-found", "there is no such element");
  return found;
}

json Controller::shader(Loop& loop, const json& request) {
  json found = shader_json(loop.scene().registry(), text_field(request, "name"));
  if (found.is_null()) throw RequestError("not-found", "there is no such shader");
  return found;
}

json Controller::pick(Loop& loop, const json& request) {
  const World& world = geometry_of(loop);
  const Spot spot = find_spot(world, pixel_corner(loop, world, request) + Vec2(.5f));
  json result = spot_json(loop.scene().scene(), spot);
  if (!spot.surface) return result;
  json element = element_json(loop.scene().scene(), loop.diagnostics(), spot.material,
                              loop.scene().registry(), history_.now());
  if (!element.is_null()) result["element"] = std::move(element);
  return result;
}

json Controller::probe(Loop& loop, const json& request) {
  World& world = world_of(loop);
  const Vec2 corner = pixel_corner(loop, world, request);
  const Spot spot = find_spot(world, corner + Vec2(.5f));
  json result = spot_json(loop.scene().scene(), spot);
  const UnitLuminance& unit = loop.scene().unit();
  result["x"] = request["x"], result["y"] = request["y"];
  const auto scaled = loop.scaled_pixel(int_field(request, "x"), int_field(request, "y"));
  result["radiance"] = film_radiance(loop, scaled[0], scaled[1]);
  result["unit_luminance"] = unit.cd_m2;
  result["unit_luminance_source"] = unit.by;
  const PathTraced traced(world);
  MeasureRequest measure = measure_request(request);
  if (!optional_number(request, "seconds")) measure.seconds = 2;
  result["luminance"] = json_of(measure_luminance(world, {corner}, unit.cd_m2, measure)[0]);
  if (spot.surface)
    result["illuminance"] =
        json_of(measure_illuminance(world, {spot.sensor}, unit.cd_m2, measure)[0]);
  return result;
}

json Controller::lux_grid(Loop& loop, const json& request) {
  World& world = world_of(loop);
  const SensorGrid grid = sensor_grid(request);
  const float unit = loop.scene().unit().cd_m2;
  const PathTraced traced(world);
  const std::vector<Reading> readings = measure_illuminance(
      world, grid.sensors, unit, measure_request(request), {}, &session_->interrupted());
  if (readings.size() != grid.sensors.size() || readings[0].samples == 0)
    throw RequestError("cancelled", "the measurement was interrupted");
  json sensors = json::array();
  double least = readings[0].value, most = readings[0].value;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    json sensor = json_of(readings[i]);
    sensor["position"] = json_of(grid.sensors[i].position);
    sensor["normal"] = json_of(grid.sensors[i].normal);
    sensors.push_back(std::move(sensor));
    least = std::min(least, readings[i].value), most = std::max(most, readings[i].value);
  }
  const Reading mean = mean_reading(readings);
  return {{"unit_luminance", unit},
          {"unit_luminance_source", loop.scene().unit().by},
          {"illuminance",
           {{"sensors", sensors},
            {"columns", grid.columns},
            {"rows", grid.rows},
            {"mean", json_of(mean)},
            {"min", least},
            {"max", most},
            {"uniformity", mean.value > 0 ? least / mean.value : 0}}}};
}

json Controller::explain(Loop& loop, const json& request) {
  World& world = world_of(loop);
  pixel_corner(loop, world, request);
  const auto [x, y] = loop.scaled_pixel(int_field(request, "x"), int_field(request, "y"));
  if (!services_.explain) throw RequestError("failed", "explanations are not available");
  SessionSettings settings = loop.session_settings(1);
  settings.crop.reset();
  settings.budget = {.samples = static_cast<std::uint32_t>(std::clamp(
                         optional_number(request, "samples").value_or(256), 1.0, 65536.0))};
  // Explanations put each light into a layer of its own.
  const LightLayers layers = world.light_layers;
  const Explanation facts = explain_pixel(world, settings, x, y, loop.scene().output_shaders(), {},
                                          &session_->interrupted());
  const bool interrupted = session_->interrupted() && facts.samples == 0;
  json result;
  if (!interrupted)
    result = services_.explain(facts, world, plan_indirect(world.options), loop.scene().unit());
  world.light_layers = layers;
  if (interrupted) throw RequestError("cancelled", "the explanation was interrupted");
  return result;
}

json Controller::focus(Loop& loop, const json& request) {
  const World& world = geometry_of(loop);
  const Spot spot = find_spot(world, pixel_corner(loop, world, request) + Vec2(.5f));
  if (!spot.surface) throw RequestError("not-found", "there is no surface");
  const scene::Camera* camera =
      find_camera(loop.scene().scene(), loop.scene().command(), loop.view().camera);
  const float depth = -transform_point(spot.sensor.position, world.camera.to_camera).z;
  for (const char* name : {"plane", "focus_distance", "focus"}) {
    // The plane of physical_lens_dof lies at a negative distance.
    const float value = std::string_view(name) == "plane" ? -depth : depth;
    try {
      std::vector<std::string> edits = interactive::with_edit(
          loop.scene().scene(), history_.now(), fmt::format("{}.{}={}", camera->name, name, value));
      return try_edits(loop, std::move(edits), optional_text(request, "gesture"));
    } catch (const interactive::EditError&) {
    }
  }
  throw RequestError("not-found", "the camera has no depth of field");
}

}  // namespace oriel::studio
