// SPDX-License-Identifier: Apache-2.0
#include "analysis/explain.h"

#include <algorithm>
#include <set>

#include "analysis/explain_observer.h"
#include "lights/emission.h"
#include "runtime/color_mapping.h"

namespace oriel {
namespace {

/// Name without trailing digits: "key_12" and "key_3" become "key_*".
std::string family_of(const std::string& name) {
  std::size_t end = name.size();
  while (end > 0 && name[end - 1] >= '0' && name[end - 1] <= '9') --end;
  return end == name.size() || end == 0 ? name : name.substr(0, end) + "*";
}

/// At most `most` names; more are merged to families, and the last ones are dropped.
std::vector<std::string> layer_names(const std::vector<std::string>& names, std::size_t most,
                                     bool& families) {
  const std::set<std::string> each(names.begin(), names.end());
  families = each.size() > most;
  std::set<std::string> unique = each;
  if (families) {
    unique.clear();
    for (const std::string& name : each) unique.insert(family_of(name));
  }
  std::vector<std::string> list(unique.begin(), unique.end());
  if (list.size() > most) list.resize(most);
  return list;
}

/// Records the colour after each exposure shader.
void follow_mappings(const World& world, const NodeList& outputs, const Vec2& raster,
                     Explanation& e) {
  Rgb colour = e.colour;
  for (const ShaderNode* node : world.lens) {
    const Rgb after = map_color({node}, world, raster, colour);
    e.mappings.push_back({node, false, colour, after});
    colour = after;
  }
  colour = e.shown;
  for (const ShaderNode* node : outputs) {
    if (!node->spec().lens.map_color) continue;
    const Rgb after = map_output({node}, world, raster, colour, e.colour);
    e.mappings.push_back({node, true, colour, after});
    colour = after;
  }
}

}  // namespace

Rgb ExplainedSurface::total() const {
  Rgb sum(0);
  for (const ExplainedLight& l : light) sum += l.light;
  return sum;
}

Rgb Explanation::total(std::size_t surface) const {
  Rgb sum = surfaces[surface].total();
  // Surfaces follow the surface that they were seen from.
  for (std::size_t i = surface + 1; i < surfaces.size(); ++i)
    if (surfaces[i].from == surface) sum += total(i);
  return sum;
}

void separate_light_layers(World& world) {
  const std::vector<EmissionKind> emission = emissive_instances(world, emissive_materials(world));
  std::vector<std::string> names;
  for (const Light& light : world.lights) names.push_back(light.name);
  for (std::size_t i = 0; i < emission.size(); ++i)
    if (emission[i] == EmissionKind::Source) names.push_back(world.instances[i].name);
  bool families = false;
  LightLayers layers;
  layers.names = layer_names(names, scene::kMaxLightGroups - 1, families);
  layers.environment = static_cast<std::uint8_t>(layers.names.size());
  layers.names.emplace_back(scene::kEnvironmentName);
  const auto layer_of = [&](const std::string& name) {
    const auto end = layers.names.end() - 1;
    const auto found =
        std::lower_bound(layers.names.begin(), end, families ? family_of(name) : name);
    const bool known = found != end && *found == (families ? family_of(name) : name);
    return static_cast<std::uint8_t>(known ? static_cast<std::size_t>(found - layers.names.begin())
                                           : layers.rest());
  };
  for (const Light& light : world.lights) layers.of_light.push_back(layer_of(light.name));
  for (std::size_t i = 0; i < emission.size(); ++i) {
    const bool of_lights = emission[i] == EmissionKind::OfLights;
    const std::size_t other = of_lights ? layers.unknown() : layers.rest();
    layers.some_unknown = layers.some_unknown || of_lights;
    layers.of_instance.push_back(emission[i] == EmissionKind::Source
                                     ? layer_of(world.instances[i].name)
                                     : static_cast<std::uint8_t>(other));
  }
  world.light_layers = std::move(layers);
}

Explanation explain_pixel(World& world, const SessionSettings& picture, int x, int y,
                          const NodeList& outputs, const Progressive::Callbacks& callbacks,
                          const std::atomic<bool>* cancel) {
  separate_light_layers(world);
  Explanation e;
  e.x = x, e.y = y;
  const int row = world.camera.height - 1 - y;
  const Window window{x, row, x + 1, row + 1};
  ExplainObserver observer(world);
  const int* frame = world.camera.window;
  SessionSettings settings = picture;
  settings.maps_for = picture.crop.value_or(Window{frame[0], frame[1], frame[2], frame[3]});
  settings.crop = window;
  settings.observer = &observer;
  RenderSession session(world, settings);
  session.run({callbacks.progress, {}}, cancel);

  const Film& film = session.film();
  const Film::Pixel pixel = film.pixel(0, 0);
  e.samples = film.samples(0, 0);
  e.colour = rgb(pixel.beauty);
  e.variance = pixel.variance;
  e.shown = film.shown(0, 0);
  e.sources = world.light_layers.names;
  e.sources.emplace_back("other lights");
  e.sources.emplace_back("unknown source");
  const Film::Shares shares = film.shares_of(0, 0);
  observer.write_to(shares.positive, shares.negative, e);
  e.unexplained = e.colour - e.total(0);
  follow_mappings(world, outputs, window.pixel_centre(0, 0), e);
  return e;
}

}  // namespace oriel
