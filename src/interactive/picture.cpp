// SPDX-License-Identifier: Apache-2.0
#include "interactive/picture.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>

#include "base/parallel.h"
#include "image/relight.h"
#include "output/layer_table.h"
#include "output/output.h"

namespace oriel::interactive {
namespace {

constexpr float kLargestHalf = 65504;

std::uint16_t half_bits(float value) {
  if (std::isnan(value)) value = 0;
  return half(std::clamp(value, -kLargestHalf, kLargestHalf)).bits();
}

using ReadPixel = std::function<void(int x, int y, float* to)>;

/// Layers that a page can show: those of the film, photometric ones, position and motion.
bool is_displayable(const LayerSpec& row) {
  return row.group != LayerGroup::Always && row.group != LayerGroup::Coverage &&
         row.name != "halves" && row.name != "display" && (row.value || row.surface_value);
}

std::vector<std::string> light_names(const LightLayers& layers) {
  std::vector<std::string> names;
  if (!layers.asked()) return names;
  for (const std::string& name : layers.names)
    names.push_back(std::string(kLightLayerPrefix) + name);
  for (const std::string_view name : {scene::kRestGroup, scene::kIndirectGroup})
    names.push_back(std::string(kLightLayerPrefix) + std::string(name));
  return names;
}

struct LayerReader {
  ReadPixel read;  ///< empty: the session has no such layer
  int channels = 3;
};

void store_color(float* to, const Rgb& c) { to[0] = c.x, to[1] = c.y, to[2] = c.z; }

LayerReader reader_of(const RenderSession& session, const std::string& name) {
  const Film& film = session.film();
  if (name == kBeautyLayer || name == kDenoisedLayer)
    return {[&film](int x, int y, float* to) { store_color(to, rgb(film.pixel(x, y).beauty)); }, 3};
  if (name == kShownLayer)
    return {[&film](int x, int y, float* to) {
              store_color(to, film.mapped() ? film.shown(x, y) : rgb(film.pixel(x, y).beauty));
            },
            3};
  const std::vector<std::string> lights = light_names(session.world().light_layers);
  if (const auto at = std::find(lights.begin(), lights.end(), name); at != lights.end()) {
    const auto layer = static_cast<std::size_t>(at - lights.begin());
    if (layer >= film.light_layers()) return {};
    return {[&film, layer](int x, int y, float* to) { store_color(to, film.light(x, y, layer)); },
            3};
  }
  const LayerSpec* row = find_layer_spec(name);
  if (!row || !is_displayable(*row) || (row->exists && !row->exists(session))) return {};
  if (row->surface_value) {
    if (!film.stores(*row->surface_value)) return {};
    return {[&film, row](int x, int y, float* to) {
              store_color(to, film.surface_value(x, y, *row->surface_value));
            },
            3};
  }
  return {[&session, row](int x, int y, float* to) { row->value(session, x, y, to); },
          static_cast<int>(row->channels.size())};
}

/// Reads a denoised picture, which the reader owns; the noisy one if it cannot be denoised.
LayerReader denoised_reader(const RenderSession& session) {
  std::shared_ptr<const Image> clean;
  try {
    clean = std::make_shared<const Image>(denoised_beauty(session, Denoiser::Best).color);
  } catch (const std::runtime_error&) {
    return reader_of(session, kBeautyLayer);
  }
  const Window& w = session.window();
  return {[clean, w](int x, int y, float* to) {
            std::copy_n(clean->at(w.x0 + x, clean->height - w.y1 + y), 3, to);
          },
          3};
}

void write_row(const LayerReader& reader, int y, int width, LayerFormat format, std::byte* to) {
  float values[4] = {0, 0, 0, 0};
  for (int x = 0; x < width; ++x) {
    reader.read(x, y, values);
    if (format == LayerFormat::R32F) {
      const float value = std::isnan(values[0]) ? 0 : values[0];
      std::memcpy(to, &value, sizeof value);
    } else {
      const std::uint16_t halves[3] = {half_bits(values[0]), half_bits(values[1]),
                                       half_bits(values[2])};
      std::memcpy(to, halves, sizeof halves);
    }
    to += bytes_per_pixel(format);
  }
}

}  // namespace

std::vector<std::string> available_layers(const World& world) {
  std::vector<std::string> names = {kBeautyLayer, kShownLayer, kDenoisedLayer};
  for (const LayerSpec& row : layer_table())
    if (is_displayable(row)) names.push_back(row.name);
  for (std::string& name : light_names(world.light_layers)) names.push_back(std::move(name));
  return names;
}

void request_layers(const std::vector<std::string>& names, SessionSettings& settings) {
  for (const std::string& name : names) {
    const LayerSpec* row = find_layer_spec(name);
    if (!row) continue;
    settings.outputs |= row->need == LayerNeed::Outputs;
    settings.irradiance |= row->need == LayerNeed::Irradiance;
    if (row->surface_value)
      settings.surface_values.set(static_cast<std::size_t>(*row->surface_value));
  }
}

std::vector<PictureLayer> copy_layers(const RenderSession& session,
                                      const std::vector<std::string>& names, bool denoise) {
  const int width = session.film().width(), height = session.film().height();
  std::vector<PictureLayer> layers;
  for (const std::string& name : names) {
    const bool cleaned = denoise && name == kDenoisedLayer;
    const LayerReader reader = cleaned ? denoised_reader(session) : reader_of(session, name);
    PictureLayer layer;
    layer.name = name;
    layer.format = reader.channels == 1 ? LayerFormat::R32F : LayerFormat::Rgb16F;
    const std::size_t row_bytes = static_cast<std::size_t>(width) * bytes_per_pixel(layer.format);
    layer.pixels.resize(row_bytes * static_cast<std::size_t>(height));
    if (reader.read)
      parallel_for(static_cast<std::size_t>(height), [&](std::size_t y) {
        write_row(reader, static_cast<int>(y), width, layer.format,
                  layer.pixels.data() + y * row_bytes);
      });
    layers.push_back(std::move(layer));
  }
  return layers;
}

}  // namespace oriel::interactive
