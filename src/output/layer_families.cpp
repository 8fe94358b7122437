// SPDX-License-Identifier: Apache-2.0
#include "output/layer_families.h"

#include <fmt/format.h>

#include <algorithm>

#include "image/relight.h"
#include "output/layer_table.h"
#include "output/output_names.h"
#include "output/output_picture.h"
#include "scene/light_group.h"

namespace oriel {
namespace {

/// Whether a user buffer with that name would collide with another layer.
bool is_taken(const std::string& name) {
  return name.size() == 1 || name == "beauty" || name == kDenoisedLayer || name == kLinearLayer ||
         find_layer_spec(name) != nullptr;
}

}  // namespace

void add_light_layers(const RenderSession& session, std::vector<Layer>& layers) {
  const Film& film = session.film();
  const LightLayers& lights = session.world().light_layers;
  for (std::size_t i = 0; i < film.light_layers(); ++i) {
    const bool unknown = i == lights.unknown();
    if (unknown && !session.has_unknown_light()) continue;
    const std::string name{unknown              ? scene::kIndirectGroup
                           : i == lights.rest() ? scene::kRestGroup
                                                : std::string_view(lights.names[i])};
    layers.push_back({std::string(kLightLayerPrefix) + name,
                      {"R", "G", "B"},
                      collect_pixels(session, 3, [&](int x, int y, float* to) {
                        const Rgb c = film.light(x, y, i);
                        to[0] = c.x, to[1] = c.y, to[2] = c.z;
                      })});
  }
}

std::vector<std::string> channels_alone(const Image& image) {
  if (image.channels == 1) return {"Y"};
  if (image.channels == 3) return {"R", "G", "B"};
  return {"R", "G", "B", "A"};
}

void add_user_buffer_layers(const RenderSession& session, std::vector<Layer>& layers) {
  const auto& buffers = session.world().user_buffers;
  if (session.film().user_buffers() < buffers.size()) return;
  for (std::size_t slot = 0; slot < buffers.size(); ++slot) {
    const UserBuffer& buffer = buffers[slot];
    if (!buffer.name.empty() && !session.film().is_written(slot)) continue;
    std::string name = buffer.name.empty() ? fmt::format("fb{}", buffer.number) : buffer.name;
    const bool is_output = material_output_index(name) >= 0;
    if (!is_output && is_taken(name)) name = "fb_" + name;
    Image image = film_user_buffer(session, slot);
    std::vector<std::string> channels = image.channels == 1 ? std::vector<std::string>{"X"}
                                        : image.channels == 3
                                            ? std::vector<std::string>{"X", "Y", "Z"}
                                            : channels_alone(image);
    Layer layer{std::move(name), std::move(channels), std::move(image), true};
    const auto same = std::find_if(layers.begin(), layers.end(),
                                   [&](const Layer& l) { return l.name == layer.name; });
    if (same == layers.end())
      layers.push_back(std::move(layer));
    else if (is_output)
      *same = std::move(layer);
  }
}

}  // namespace oriel
