// SPDX-License-Identifier: Apache-2.0
#include "output/layer_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/parallel.h"
#include "color/luminance.h"
#include "output/layer_families.h"
#include "output/matte_layers.h"
#include "transport/path/resolve_outputs.h"

namespace oriel {
namespace {

using Session = RenderSession;

const std::vector<std::string> kColor = {"R", "G", "B"}, kVector = {"X", "Y", "Z"}, kNumber = {"X"};

void store(float* to, const Vec3& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

/// A member of Film::Pixel.
template <auto kMember>
void pixel_value(const Session& s, int x, int y, float* to) {
  store(to, s.film().pixel(x, y).*kMember);
}

void add_film_rows(std::vector<LayerSpec>& rows) {
  using P = Film::Pixel;
  const LayerGroup film = LayerGroup::Film;
  rows.push_back(
      {.name = "depth",
       .exr = "Z",
       .channels = {""},
       .group = film,
       .type = "z",
       .view = PixelView::Depth,
       .about = "distance to the first surface, mean over the samples that hit one; 0 = none",
       .value = [](const Session& s, int x, int y, float* to) {
         *to = s.film().pixel(x, y).depth;
       }});
  rows.push_back({.name = "normal",
                  .exr = "normal",
                  .channels = kVector,
                  .group = film,
                  .type = "n",
                  .view = PixelView::Normal,
                  .about = "world normal, unit",
                  .value = [](const Session& s, int x, int y, float* to) {
                    store(to, normalize(s.film().pixel(x, y).normal));
                  }});
  rows.push_back({.name = "albedo",
                  .exr = "albedo",
                  .channels = kColor,
                  .group = film,
                  .about = "sum of the weights of the first surface's lobes",
                  .value = pixel_value<&P::albedo>});
  rows.push_back({.name = "variance",
                  .exr = "variance",
                  .channels = kColor,
                  .group = film,
                  .about = "variance of the mean of the beauty",
                  .value = pixel_value<&P::variance>,
                  .statistics = true});
  rows.push_back({.name = "samples",
                  .exr = "samples",
                  .channels = kNumber,
                  .group = film,
                  .about = "number of samples",
                  .value = [](const Session& s, int x, int y, float* to) {
                    *to = static_cast<float>(s.film().samples(x, y));
                  }});
  rows.push_back(
      {.name = "display",
       .exr = "display",
       .channels = kColor,
       .group = film,
       .about = "the picture after lens shaders, in files without them",
       .value = [](const Session& s, int x, int y, float* to) { store(to, s.film().shown(x, y)); },
       .exists = [](const Session& s) { return s.film().mapped(); }});
  rows.push_back({.name = "halves",
                  .exr = "halves",
                  .channels = kColor,
                  .group = film,
                  .about = "half the difference of two halves of the samples, from 8 samples on",
                  .value = pixel_value<&P::split_difference>,
                  .exists = [](const Session& s) { return s.film().has_split_samples(); },
                  .statistics = true});
}

void add_measured_rows(std::vector<LayerSpec>& rows) {
  rows.push_back({.name = "luminance",
                  .exr = "luminance",
                  .channels = kNumber,
                  .group = LayerGroup::Photometric,
                  .about = "luminance of the beauty, cd/m2",
                  .value = [](const Session& s, int x, int y, float* to) {
                    *to = luminance(rgb(s.film().pixel(x, y).beauty)) * s.unit_luminance();
                  }});
  rows.push_back(
      {.name = "illuminance",
       .exr = "illuminance",
       .channels = kNumber,
       .group = LayerGroup::Photometric,
       .need = LayerNeed::Irradiance,
       .about = "illuminance of the first surface, lux",
       .value = [](const Session& s, int x, int y,
                   float* to) { *to = s.film().pixel(x, y).irradiance * s.unit_luminance(); },
       .exists = [](const Session& s) { return s.keeps_irradiance(); }});
  rows.push_back(
      {.name = "motion",
       .exr = "motion",
       .channels = kVector,
       .group = LayerGroup::Motion,
       .type = "m",
       .view = PixelView::Motion,
       .about =
           "motion on the picture during the shutter interval: x and y in pixels, z the increase "
           "of distance",
       .surface_value = SurfaceValue::Motion});
  rows.push_back({.name = "position",
                  .exr = "position",
                  .channels = kVector,
                  .group = LayerGroup::Motion,
                  .about = "world position of the first surface of a sample, scene units; 0 = none",
                  .surface_value = SurfaceValue::Position});
}

void add_material_rows(std::vector<LayerSpec>& rows) {
  for (std::size_t i = 0; i < kMaterialOutputs; ++i) {
    const std::string name = kMaterialOutputNames[i];
    const bool is_number = name == "opacity";
    rows.push_back({.name = name,
                    .exr = name,
                    .channels = is_number ? kNumber : kColor,
                    .group = LayerGroup::Outputs,
                    .need = LayerNeed::Outputs,
                    .value =
                        [i, is_number](const Session& s, int x, int y, float* to) {
                          const Film& film = s.film();
                          const Rgb c =
                              resolve_outputs(film.outputs(x, y), rgb(film.pixel(x, y).beauty))[i];
                          if (is_number)
                            *to = c.x;
                          else
                            store(to, c);
                        },
                    .exists = [](const Session& s) { return s.film().keeps_outputs(); }});
  }
}

void add_scene_rows(std::vector<LayerSpec>& rows) {
  const auto has_mattes = [](const Session& s) { return s.mattes() != nullptr; };
  rows.push_back({.name = "light_NAME",
                  .group = LayerGroup::Always,
                  .need = LayerNeed::LightLayers,
                  .about = "light of a group (`--light-group`); `light_rest` is the other light",
                  .expand = add_light_layers});
  rows.push_back({.name = "tag",
                  .exr = "tag",
                  .channels = kNumber,
                  .group = LayerGroup::Coverage,
                  .need = LayerNeed::Mattes,
                  .type = "tag",
                  .view = PixelView::Tag,
                  .about = "label (`tag`) of the instance, else of its object, that covers most of "
                           "the pixel",
                  .value = write_label,
                  .exists = has_mattes});
  rows.push_back({.name = "coverage",
                  .exr = "coverage",
                  .channels = kNumber,
                  .group = LayerGroup::Coverage,
                  .need = LayerNeed::Mattes,
                  .type = "coverage",
                  .view = PixelView::Coverage,
                  .about = "the share of the pixel that this instance covers",
                  .value = write_coverage,
                  .exists = has_mattes});
  rows.push_back({.name = "CryptoObjectNN, CryptoMaterialNN, CryptoAssetNN",
                  .group = LayerGroup::Always,
                  .need = LayerNeed::Mattes,
                  .about = "mattes by name (`--cryptomatte`)",
                  .expand = [](const Session& s, std::vector<Layer>& layers) {
                    for (Layer& layer : cryptomatte_layers(s)) layers.push_back(std::move(layer));
                  }});
  rows.push_back({.name = "fbN",
                  .group = LayerGroup::Always,
                  .need = LayerNeed::UserBuffers,
                  .about = "frame buffers that user shaders write, by number or name",
                  .expand = add_user_buffer_layers});
}

template <class F>
const LayerSpec* find_row(const F& is_wanted) {
  const auto& rows = layer_table();
  const auto at = std::find_if(rows.begin(), rows.end(), is_wanted);
  return at == rows.end() ? nullptr : &*at;
}

}  // namespace

const std::vector<LayerSpec>& layer_table() {
  static const std::vector<LayerSpec> table = [] {
    std::vector<LayerSpec> rows;
    add_film_rows(rows);
    add_measured_rows(rows);
    add_material_rows(rows);
    add_scene_rows(rows);
    return rows;
  }();
  return table;
}

LayerSet::LayerSet(std::string_view name) {
  const auto& rows = layer_table();
  for (std::size_t i = 0; i < rows.size(); ++i)
    rows_[i] = rows[i].name == name && rows[i].group != LayerGroup::Always;
}

LayerSet::LayerSet(LayerGroup group) {
  const auto& rows = layer_table();
  for (std::size_t i = 0; i < rows.size(); ++i) rows_[i] = rows[i].group == group;
}

LayerSet LayerSet::all() {
  return LayerSet(LayerGroup::Film) | LayerSet(LayerGroup::Photometric) |
         LayerSet(LayerGroup::Motion) | LayerSet(LayerGroup::Outputs);
}

bool LayerSet::needs(LayerNeed need) const {
  const auto& rows = layer_table();
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows_[i] && rows[i].need == need) return true;
  return false;
}

SurfaceValues LayerSet::surface_values() const {
  SurfaceValues values;
  const auto& rows = layer_table();
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (rows_[i] && rows[i].surface_value)
      values.set(static_cast<std::size_t>(*rows[i].surface_value));
  return values;
}

std::vector<std::string> layer_names() {
  std::vector<std::string> names;
  for (const LayerSpec& row : layer_table())
    if (row.group != LayerGroup::Always) names.push_back(row.name);
  return names;
}

const LayerSpec* layer_of_type(std::string_view type) {
  return find_row([&](const LayerSpec& row) { return row.type && row.type == type; });
}

const LayerSpec* layer_of_view(PixelView view) {
  return find_row([&](const LayerSpec& row) { return row.type && row.view == view; });
}

const LayerSpec* find_layer_spec(std::string_view name) {
  return find_row(
      [&](const LayerSpec& row) { return row.name == name && row.group != LayerGroup::Always; });
}

Image collect_pixels(const RenderSession& session, int channels,
                     const std::function<void(int x, int y, float* to)>& f) {
  const Window& w = session.window();
  const Film& film = session.film();
  Image image(session.world().camera.width, session.world().camera.height, channels);
  parallel_for(static_cast<std::size_t>(film.height()), [&](std::size_t row) {
    const int y = static_cast<int>(row);
    for (int x = 0; x < film.width(); ++x) f(x, y, image.at(w.x0 + x, image.height - w.y1 + y));
  });
  return image;
}

Image layer_image(const RenderSession& session, const LayerSpec& row) {
  return collect_pixels(session, static_cast<int>(row.channels.size()),
                        [&](int x, int y, float* to) {
                          if (row.surface_value)
                            store(to, session.film().surface_value(x, y, *row.surface_value));
                          else
                            row.value(session, x, y, to);
                        });
}

std::string layer_documentation() {
  std::string text;
  for (const LayerSpec& row : layer_table()) {
    if (row.group == LayerGroup::Outputs) continue;
    std::string channels;
    for (const std::string& channel : row.channels)
      channels += (channels.empty() ? "" : ", ") + row.exr + (channel.empty() ? "" : "." + channel);
    text += fmt::format("| `{}` | {} | {} |\n", row.name, channels, row.about);
  }
  return text;
}

}  // namespace oriel
