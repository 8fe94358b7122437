// SPDX-License-Identifier: Apache-2.0
#include "sun_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "command.h"
#include "scene/hierarchy.h"
#include "scene/sun_shaders.h"

namespace oriel::app {
namespace {

int turn_skies(scene::ShaderList& list, const sky::SolarPosition& sun, double north) {
  int turned = 0;
  for (scene::ShaderUse& use : list) {
    if (!scene::is_sky_shader(use.type)) continue;
    const Vec3 d = sky::direction_to_sun(sun.azimuth, sun.elevation, north, scene::is_y_up(use));
    scene::Value value;
    value.kind = scene::Value::Kind::Numbers;
    value.numbers = {d.x, d.y, d.z};
    std::erase_if(use.arguments, [](const auto& a) { return a.name == "sun_direction"; });
    use.arguments.push_back({"sun_direction", value, {}});
    ++turned;
  }
  return turned;
}

int turn_all_skies(scene::Scene& scene, const sky::SolarPosition& sun, double north) {
  int turned = 0;
  const auto turn = [&](scene::ShaderList& list) { turned += turn_skies(list, sun, north); };
  for (scene::Element& element : scene.elements()) {
    if (auto* camera = std::get_if<scene::Camera>(&element))
      for (auto* list : {&camera->lens, &camera->volume, &camera->environment}) turn(*list);
    if (auto* shader = std::get_if<scene::ShaderElement>(&element)) turn(shader->functions);
    if (auto* texture = std::get_if<scene::Texture>(&element)) turn(texture->procedure);
    if (auto* material = std::get_if<scene::Material>(&element))
      for (scene::Material::Slot& slot : material->slots) turn(slot.shaders);
  }
  for (scene::Phenomenon& phenomenon : scene.phenomena) {
    for (scene::ShaderElement& shader : phenomenon.shaders) turn(shader.functions);
    for (scene::Phenomenon::Root& root : phenomenon.roots) turn(root.shaders);
  }
  return turned;
}

}  // namespace

sky::Place read_place(const std::string& option, const std::string& text) {
  const char* at = text.c_str();
  char* end = nullptr;
  sky::Place place;
  place.latitude = std::strtod(at, &end);
  const bool first = end != at && *end == ',';
  const char* second = first ? end + 1 : end;
  place.longitude = std::strtod(second, &end);
  if (!first || end == second || *end != 0 || !(std::fabs(place.latitude) <= 90) ||
      !(std::fabs(place.longitude) <= 360))
    throw UsageError(
        fmt::format("{} {}: write LAT,LON in degrees, north and east positive, as in 48.14,11.58",
                    option, text));
  return place;
}

double read_time(const std::string& option, const std::string& text) {
  if (const auto day = sky::julian_day(text)) return *day;
  throw UsageError(fmt::format(
      "{} {}: write the time with its zone, as in 2026-06-21T12:00+02:00 or 2026-06-21T10:00Z",
      option, text));
}

sky::SolarPosition read_sun(const std::string& option, const std::string& text) {
  const std::size_t second = text.find(',', text.find(',') + 1);
  if (second == text.npos)
    throw UsageError(fmt::format(
        "{} {}: write LAT,LON,TIME, as in 48.14,11.58,2026-06-21T12:00+02:00", option, text));
  const sky::Place place = read_place(option, text.substr(0, second));
  return sky::solar_position(read_time(option, text.substr(second + 1)), place);
}

void turn_sun(scene::Scene& scene, const std::string& root, const sky::SolarPosition& sun,
              double north) {
  Diagnostics ignored;  // rendering tells them again
  std::map<std::string, Vec3> directions;
  for (const scene::Leaf& leaf : scene::flatten(scene, root, ignored)) {
    if (leaf.kind != scene::LeafKind::Light) continue;
    const scene::ShaderUse* use = scene::find_sun(scene, leaf.light()->shaders);
    if (!use) continue;
    const Vec3 to_sun =
        sky::direction_to_sun(sun.azimuth, sun.elevation, north, scene::is_y_up(*use));
    const Vec3 local = normalize(transform_vector(-to_sun, leaf.world_to_local));
    const auto [known, added] = directions.try_emplace(leaf.light()->name, local);
    if (!added && length(known->second - local) > 1e-4f)
      throw UserError(fmt::format("--sun: the instances of light \"{}\" have different rotations",
                                  leaf.light()->name));
  }
  for (const auto& [name, direction] : directions)
    scene.get<scene::Light>(name)->direction = direction;
  if (turn_all_skies(scene, sun, north) == 0 && directions.empty())
    throw UserError("--sun: the scene has no light with mia_physicalsun and no sky to turn");
}

}  // namespace oriel::app
