// SPDX-License-Identifier: Apache-2.0
#include "output/output.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "base/parallel.h"
#include "color/luminance.h"
#include "denoise/denoise.h"
#include "image/exr.h"
#include "output/layer_families.h"
#include "output/matte_layers.h"
#include "output/output_picture.h"
#include "runtime/color_mapping.h"

namespace oriel {
namespace {

std::string file_type(const PictureFile& file) {
  std::string type = file.format;
  if (type.empty()) {
    type = std::filesystem::path(file.path).extension().string();
    if (!type.empty()) type.erase(0, 1);
  }
  std::transform(type.begin(), type.end(), type.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return type;
}

/// Calls f(x, y, values) for each pixel of the film, with its values in an image of the full frame.
template <class F>
void for_each_pixel(const RenderSession& session, Image& image, const F& f) {
  const Window& w = session.window();
  const Film& film = session.film();
  parallel_for(static_cast<std::size_t>(film.height()), [&](std::size_t y) {
    for (int x = 0; x < film.width(); ++x)
      f(x, static_cast<int>(y), image.at(w.x0 + x, image.height - w.y1 + static_cast<int>(y)));
  });
}

void put(float* to, const Rgb& c) { to[0] = c.x, to[1] = c.y, to[2] = c.z; }

const std::vector<std::string> kRgbNames = {"R", "G", "B"};

/// Whether an output shader processes whole pictures; other output shaders map single colours.
bool works_on_picture(const ShaderNode* node) { return node->spec().output != nullptr; }

/// Runs output shaders in order.
void run_in_order(const NodeList& shaders, const RenderSession& session, Image& shown,
                  const Image* denoised, OutputPicture& picture) {
  const Window& w = session.window();
  for (auto at = shaders.begin(); at != shaders.end();) {
    if (works_on_picture(*at)) {
      run_output_shader(**at++, picture);
      continue;
    }
    const auto end = std::find_if(at, shaders.end(), works_on_picture);
    const NodeList mapping(at, end);
    for_each_pixel(session, shown, [&](int x, int y, float* to) {
      const float* clean = denoised ? denoised->at(w.x0 + x, denoised->height - w.y1 + y) : nullptr;
      const Rgb film =
          clean ? Rgb(clean[0], clean[1], clean[2]) : rgb(session.film().pixel(x, y).beauty);
      put(to, map_output(mapping, session.world(), w.pixel_centre(x, y), Rgb(to[0], to[1], to[2]),
                         film));
    });
    at = end;
  }
}

/// Values of a file that does not show colour.
Image data_image(const RenderSession& session, PixelView view) {
  if (const LayerSpec* layer = layer_of_view(view)) return layer_image(session, *layer);
  return collect_pixels(session, 1, [&](int x, int y, float* to) {
    const float alpha = session.film().pixel(x, y).beauty.a;
    *to = view == PixelView::Alpha ? alpha : alpha >= 0.5f ? 1.0f : 0.0f;
  });
}

Image without_alpha(const Image& rgba) {
  Image image(rgba.width, rgba.height, 3);
  for (std::size_t i = 0; i < rgba.pixel_count(); ++i)
    std::copy_n(&rgba.pixels[4 * i], 3, &image.pixels[3 * i]);
  return image;
}

Image intensity(const Image& rgba, const Rgb& weight) {
  Image image(rgba.width, rgba.height, 1);
  for (std::size_t i = 0; i < rgba.pixel_count(); ++i)
    image.pixels[i] =
        luminance(Rgb(rgba.pixels[4 * i], rgba.pixels[4 * i + 1], rgba.pixels[4 * i + 2]), weight);
  return image;
}

/// Whether the view shows the picture instead of other data.
bool shows_colour(PixelView view) {
  return view == PixelView::ColorAlpha || view == PixelView::Color || view == PixelView::Intensity;
}

/// The linear beauty of the film, with replaced colours if `denoised` is not null.
Image linear_image(const RenderSession& session, const Image* denoised) {
  Image image = std::move(film_layers(session, {}).front().image);
  if (denoised)
    for (std::size_t i = 0; i < image.pixel_count(); ++i)
      std::copy_n(&denoised->pixels[3 * i], 3, &image.pixels[4 * i]);
  return image;
}

/// Whether the file shows a user buffer instead of its other content.
bool shows_user_buffer(const PictureFile& file, const RenderSession& session) {
  if (file.user_buffer < 0) return false;
  const auto slot = static_cast<std::size_t>(file.user_buffer);
  return slot < session.film().user_buffers() &&
         (file.only_user_buffer || session.film().is_written(slot));
}

/// A user buffer after the output shaders of the file.
Image user_buffer_image(const PictureFile& file, const RenderSession& session,
                        const Image* denoised) {
  const auto slot = static_cast<std::size_t>(file.user_buffer);
  if (std::none_of(file.shaders.begin(), file.shaders.end(), works_on_picture))
    return film_user_buffer(session, slot);
  Image shown = shown_image(session, {}, denoised);
  OutputPicture picture(session, shown);
  run_in_order(file.shaders, session, shown, denoised, picture);
  return std::move(picture.user_buffer(slot));
}

Image file_image(const PictureFile& file, const RenderSession& session, const Image* denoised) {
  if (shows_user_buffer(file, session)) {
    const Image image = user_buffer_image(file, session, denoised);
    return file.float_pixels ? image : view_image(image, view_options(session.world().options));
  }
  if (const LayerSpec* output = find_layer_spec(file.shown_layer)) {
    const Image image = layer_image(session, *output);
    return file.float_pixels ? image : view_image(image, view_options(session.world().options));
  }
  if (!shows_colour(file.view)) return data_image(session, file.view);
  Image image = file.unmapped ? linear_image(session, denoised)
                              : shown_image(session, file.shaders, denoised);
  if (file.view == PixelView::Intensity)
    image = intensity(image, session.world().options.luminance_weight);
  if (!file.float_pixels) image = view_image(image, view_options(session.world().options));
  return file.view == PixelView::Color ? without_alpha(image) : image;
}

/// The layer that a file without layers shows; null = the picture.
const LayerSpec* shown_layer(const PictureFile& file) {
  return file.shown_layer.empty() ? layer_of_view(file.view) : find_layer_spec(file.shown_layer);
}

}  // namespace

bool is_mapped(const PictureFile& file, const World& world) {
  return !file.unmapped && file.shown_layer.empty() && !file.only_user_buffer &&
         shows_colour(file.view) && !(world.lens.empty() && file.shaders.empty());
}

bool needs(const PictureFile& file, LayerNeed need) {
  const LayerSpec* shown = shown_layer(file);
  return file.layers.needs(need) || (shown && shown->need == need);
}

SurfaceValues surface_values(const PictureFile& file) {
  const LayerSpec* shown = shown_layer(file);
  return file.layers.surface_values() |
         (shown ? LayerSet(shown->name).surface_values() : SurfaceValues());
}

bool holds_light_layers(const PictureFile& file) {
  return file_type(file) == "exr" && file.shown_layer.empty() && file.user_buffer < 0;
}

PictureFile picture_file(const std::string& path) {
  PictureFile file{.path = path};
  const std::string type = file_type(file);
  file.float_pixels = type == "exr" || type == "hdr";
  file.samples = file.float_pixels                 ? SampleFormat::Float
                 : type == "tif" || type == "tiff" ? SampleFormat::U16
                                                   : SampleFormat::U8;
  file.precision = ExrPrecision::HalfIfFits;
  return file;
}

std::vector<Layer> film_layers(const RenderSession& session, const LayerSet& layers) {
  std::vector<Layer> out;
  out.push_back({"", {"R", "G", "B", "A"}, collect_pixels(session, 4, [&](int x, int y, float* to) {
                   const Rgba c = session.film().pixel(x, y).beauty;
                   put(to, rgb(c));
                   to[3] = c.a;
                 })});
  const auto& rows = layer_table();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const LayerSpec& row = rows[i];
    const bool exists = row.surface_value ? session.film().stores(*row.surface_value)
                                          : !row.exists || row.exists(session);
    if (!layers.contains(i) || !exists) continue;
    if (row.expand)
      row.expand(session, out);
    else
      out.push_back({row.exr, row.channels, layer_image(session, row), row.is_exact()});
  }
  return out;
}

DenoisedPicture denoised_beauty(const RenderSession& session, Denoiser denoiser) {
  const LayerSet layers = LayerSet(LayerGroup::Film) - LayerSet("display");
  const std::vector<Layer> film = film_layers(session, layers);
  DenoisedPicture picture = denoise_with_parts(denoise_input(film), {.denoiser = denoiser});
  picture.color = without_alpha(picture.color);
  return picture;
}

Image beauty_without_outliers(const RenderSession& session) {
  if (session.world().preview || session.film().mean_samples() < kMinOutlierSamples) return {};
  const auto layers = film_layers(session, LayerSet("halves") | LayerSet("variance"));
  return spread_outliers(denoise_input(layers));
}

Image shown_image(const RenderSession& session, const NodeList& output_shaders,
                  const Image* denoised) {
  const Film& film = session.film();
  const Window& w = session.window();
  Image shown = collect_pixels(session, 4, [&](int x, int y, float* to) {
    const float* clean = denoised ? denoised->at(w.x0 + x, denoised->height - w.y1 + y) : nullptr;
    const Rgba own = film.pixel(x, y).beauty;
    const bool changed = clean && Rgb(clean[0], clean[1], clean[2]) != rgb(own);
    put(to, changed ? film.shown(x, y, Rgb(clean[0], clean[1], clean[2])) : film.shown(x, y));
    to[3] = own.a;
  });
  OutputPicture picture(session, shown);
  run_in_order(output_shaders, session, shown, denoised, picture);
  return shown;
}

ViewOptions view_options(const scene::RenderOptions& options) {
  ViewOptions view;
  view.gamma = options.gamma;
  view.desaturate = options.desaturate;
  view.premultiply = options.premultiply;
  view.clip = options.colorclip == scene::ColorClip::Rgb     ? ColorClip::KeepColor
              : options.colorclip == scene::ColorClip::Alpha ? ColorClip::KeepAlpha
                                                             : ColorClip::Raw;
  view.luminance_weight = options.luminance_weight;
  return view;
}

void write_picture(const PictureFile& file, const RenderSession& session,
                   const std::map<std::string, ExrValue>& metadata, const Image* denoised) {
  const std::string type = file_type(file);
  if (type.empty())
    throw std::runtime_error("cannot write '" + file.path +
                             "': the file name has no extension that selects the file type");
  if (type == "exr") {
    ExrOptions exr;
    exr.precision = file.precision;
    exr.compression = file.compression;
    exr.metadata = metadata;
    const Window& w = session.window();
    const int height = session.world().camera.height;
    exr.window = ExrWindow{w.x0, height - w.y1, w.x1, height - w.y0};
    const std::size_t threads =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    exr.threads = threads > 1 ? static_cast<int>(threads) : 0;
    std::vector<Layer> layers;
    if (shows_user_buffer(file, session)) {
      Image image = user_buffer_image(file, session, denoised);
      std::vector<std::string> channels = channels_alone(image);
      layers.push_back({"", std::move(channels), std::move(image), true});
      return write_exr(file.path, layers, exr);
    }
    if (const LayerSpec* shown = find_layer_spec(file.shown_layer)) {
      Image image = layer_image(session, *shown);
      layers.push_back({"", image.channels == 1 ? std::vector<std::string>{"Y"} : kRgbNames,
                        std::move(image), shown->is_exact()});
      return write_exr(file.path, layers, exr);
    }
    const bool mapped = is_mapped(file, session.world());
    const LayerSet asked = mapped ? file.layers - LayerSet("display") : file.layers;
    layers = film_layers(session, asked | LayerSet(LayerGroup::Always));
    if (mapped) {
      Image shown = shown_image(session, file.shaders);
      layers.push_back({std::string(kLinearLayer), layers.front().channel_names,
                        std::exchange(layers.front().image, std::move(shown))});
    }
    for (auto& [key, value] : cryptomatte_metadata(session)) exr.metadata[key] = value;
    if (denoised) layers.push_back({kDenoisedLayer, kRgbNames, *denoised});
    return write_exr(file.path, layers, exr);
  }
  FileOptions options;
  options.format = file.samples;
  options.dither = session.world().options.dither;
  options.jpeg_quality = file.quality;
  options.srgb = shows_colour(file.view) && file.user_buffer < 0 && file.shown_layer.empty();
  options.type = type;
  write_image(file.path, file_image(file, session, denoised), options);
}

}  // namespace oriel
