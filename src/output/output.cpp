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
#include "image/relight.h"
#include "output/matte_layers.h"
#include "output/output_names.h"
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

/// f(x, y, values) for each pixel of the film, with its values in an image of the whole picture.
template <class F>
void for_each_pixel(const RenderSession& session, Image& image, const F& f) {
  const Window& w = session.window();
  const Film& film = session.film();
  parallel_for(static_cast<std::size_t>(film.height()), [&](std::size_t y) {
    for (int x = 0; x < film.width(); ++x)
      f(x, static_cast<int>(y), image.at(w.x0 + x, image.height - w.y1 + static_cast<int>(y)));
  });
}

/// An image of the whole picture with f(x, y, values) written where the film is.
template <class F>
Image collect(const RenderSession& session, int channels, const F& f) {
  Image image(session.world().camera.width, session.world().camera.height, channels);
  for_each_pixel(session, image, f);
  return image;
}

void put(float* to, const Rgb& c) { to[0] = c.x, to[1] = c.y, to[2] = c.z; }

const std::vector<std::string> kRgbNames = {"R", "G", "B"}, kVectorNames = {"X", "Y", "Z"};
constexpr std::string_view kDenoisedLayer = "denoised";

/// Whether an output shader works on whole pictures; others map colours one by one.
bool works_on_picture(const ShaderNode* node) { return node->spec().output != nullptr; }

/// Output shaders in their order.
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

/// Values of a file that shows something else than colour.
Image data_image(const RenderSession& session, PixelView view) {
  const Film& film = session.film();
  switch (view) {
    case PixelView::Alpha:
      return collect(session, 1, [&](int x, int y, float* to) { *to = film.pixel(x, y).beauty.a; });
    case PixelView::Bit:
      return collect(session, 1, [&](int x, int y, float* to) {
        *to = film.pixel(x, y).beauty.a >= 0.5f ? 1.0f : 0.0f;
      });
    case PixelView::Tag:
      return label_image(session);
    case PixelView::Coverage:
      return coverage_image(session);
    case PixelView::Depth:
      return collect(session, 1, [&](int x, int y, float* to) { *to = film.pixel(x, y).depth; });
    case PixelView::Motion:
      return collect(session, 3, [&](int x, int y, float* to) {
        if (film.keeps_motion()) put(to, Rgb(film.motion(x, y)));
      });
    default:
      return collect(session, 3,
                     [&](int x, int y, float* to) { put(to, normalize(film.pixel(x, y).normal)); });
  }
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

/// Whether it shows the picture, and not something about it.
bool shows_colour(PixelView view) {
  return view == PixelView::ColorAlpha || view == PixelView::Color || view == PixelView::Intensity;
}

/// Beauty as the film has it, with other colours where there are any.
Image linear_image(const RenderSession& session, const Image* denoised) {
  Image image = std::move(film_layers(session, 0).front().image);
  if (denoised)
    for (std::size_t i = 0; i < image.pixel_count(); ++i)
      std::copy_n(&denoised->pixels[3 * i], 3, &image.pixels[4 * i]);
  return image;
}

/// An output, as it is.
Image output_image(const RenderSession& session, std::size_t index) {
  const bool scalar = material_output_names()[index] == "opacity";
  return collect(session, scalar ? 1 : 3, [&](int x, int y, float* to) {
    const Film& film = session.film();
    const Rgb c = resolve_outputs(film.outputs(x, y), rgb(film.pixel(x, y).beauty))[index];
    if (scalar)
      *to = c.x;
    else
      put(to, c);
  });
}

/// Whether the file shows a user's buffer rather than what else it means.
bool shows_user_buffer(const PictureFile& file, const RenderSession& session) {
  if (file.user_buffer < 0) return false;
  const auto slot = static_cast<std::size_t>(file.user_buffer);
  return slot < session.film().user_buffers() &&
         (file.only_user_buffer || session.film().is_written(slot));
}

/// A user's buffer after the output shaders of the file.
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

/// Names of the channels of a user's buffer that stands alone in a file.
std::vector<std::string> channels_alone(const Image& image) {
  if (image.channels == 1) return {"Y"};
  return image.channels == 3 ? kRgbNames : std::vector<std::string>{"R", "G", "B", "A"};
}

Image file_image(const PictureFile& file, const RenderSession& session, const Image* denoised) {
  if (shows_user_buffer(file, session)) {
    const Image image = user_buffer_image(file, session, denoised);
    return file.float_pixels ? image : view_image(image, view_options(session.world().options));
  }
  if (const int output = material_output_index(file.shown_layer); output >= 0) {
    const Image image = output_image(session, static_cast<std::size_t>(output));
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

/// Layers of users' buffers. A buffer that means an output of materials stands in its place.
void add_user_buffers(const RenderSession& session, std::vector<Layer>& layers) {
  const auto& buffers = session.world().user_buffers;
  if (session.film().user_buffers() < buffers.size()) return;
  for (std::size_t slot = 0; slot < buffers.size(); ++slot) {
    const UserBuffer& buffer = buffers[slot];
    if (!buffer.name.empty() && !session.film().is_written(slot)) continue;
    std::string name = buffer.name.empty() ? fmt::format("fb{}", buffer.number) : buffer.name;
    const bool is_output = material_output_index(name) >= 0;
    const bool is_taken = name.size() == 1 || name == "beauty" || name == kDenoisedLayer ||
                          name == kLinearLayer || (layer_bit(name) != 0 && !is_output);
    if (is_taken) name = "fb." + name;
    Image image = film_user_buffer(session, slot);
    std::vector<std::string> channels = image.channels == 1   ? std::vector<std::string>{""}
                                        : image.channels == 3 ? kVectorNames
                                                              : channels_alone(image);
    Layer layer{std::move(name), std::move(channels), std::move(image)};
    const auto same = std::find_if(layers.begin(), layers.end(),
                                   [&](const Layer& l) { return l.name == layer.name; });
    if (same == layers.end())
      layers.push_back(std::move(layer));
    else if (is_output)
      *same = std::move(layer);
  }
}

/// Writers go by the extension, so a file whose type says otherwise is written under another name
/// and then renamed.
void write_as(const std::string& type, const PictureFile& file, const Image& image,
              const FileOptions& options) {
  if (file_type({.path = file.path}) == type) return write_image(file.path, image, options);
  const std::string other = file.path + ".oriel-part." + type;
  write_image(other, image, options);
  std::error_code error;
  std::filesystem::rename(other, file.path, error);
  if (error) {
    std::filesystem::remove(other, error);
    throw std::runtime_error("cannot write '" + file.path + "'");
  }
}

}  // namespace

const std::vector<std::string>& layer_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = {"depth",       "normal",  "albedo", "variance",
                                    "samples",     "display", "halves", "luminance",
                                    "illuminance", "motion",  "tag",    "coverage"};
    const auto& outputs = material_output_names();
    all.insert(all.end(), outputs.begin(), outputs.end());
    return all;
  }();
  return names;
}

LayerSet layer_bit(std::string_view name) {
  if (const int output = material_output_index(name); output >= 0)
    return LayerSet{1} << (kFirstOutputBit + output);
  const auto& names = layer_names();
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? 0 : LayerSet{1} << (at - names.begin());
}

bool is_mapped(const PictureFile& file, const World& world) {
  return !file.unmapped && file.shown_layer.empty() && !file.only_user_buffer &&
         shows_colour(file.view) && !(world.lens.empty() && file.shaders.empty());
}

bool needs_outputs(const PictureFile& file) {
  return (file.layers & kOutputLayers) != 0 || !file.shown_layer.empty();
}

bool needs_mattes(const PictureFile& file) {
  return (file.layers & (kLayerTag | kLayerCoverage)) != 0 || file.view == PixelView::Tag ||
         file.view == PixelView::Coverage;
}

bool needs_irradiance(const PictureFile& file) { return (file.layers & kLayerIlluminance) != 0; }

bool needs_motion(const PictureFile& file) { return (file.layers & kLayerMotion) != 0; }

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
  return file;
}

std::vector<Layer> film_layers(const RenderSession& session, LayerSet layers) {
  const Film& film = session.film();
  std::vector<Layer> out;
  out.push_back({"", {"R", "G", "B", "A"}, collect(session, 4, [&](int x, int y, float* to) {
                   const Rgba c = film.pixel(x, y).beauty;
                   put(to, rgb(c));
                   to[3] = c.a;
                 })});
  if (layers & kLayerDepth) out.push_back({"Z", {""}, data_image(session, PixelView::Depth)});
  if (layers & kLayerNormal)
    out.push_back({"normal", kVectorNames, data_image(session, PixelView::Normal)});
  const auto colours = [&](const char* name, auto member) {
    out.push_back({name, kRgbNames, collect(session, 3, [&](int x, int y, float* to) {
                     put(to, film.pixel(x, y).*member);
                   })});
  };
  if (layers & kLayerAlbedo) colours("albedo", &Film::Pixel::albedo);
  if (layers & kLayerVariance) colours("variance", &Film::Pixel::variance);
  if (layers & kLayerSamples)
    out.push_back({"samples", {""}, collect(session, 1, [&](int x, int y, float* to) {
                     *to = static_cast<float>(film.samples(x, y));
                   })});
  if ((layers & kLayerDisplay) && film.mapped())
    out.push_back({"display", kRgbNames, collect(session, 3, [&](int x, int y, float* to) {
                     put(to, film.shown(x, y));
                   })});
  if ((layers & kLayerHalves) && film.has_split_samples())
    colours("halves", &Film::Pixel::split_difference);
  const auto photometric = [&](const char* name, auto value) {
    const float unit = session.unit_luminance();
    out.push_back({name, {""}, collect(session, 1, [&, unit](int x, int y, float* to) {
                     *to = value(film.pixel(x, y)) * unit;
                   })});
  };
  if (layers & kLayerLuminance)
    photometric("luminance", [](const Film::Pixel& p) { return luminance(rgb(p.beauty)); });
  if ((layers & kLayerIlluminance) && session.keeps_irradiance())
    photometric("illuminance", [](const Film::Pixel& p) { return p.irradiance; });
  if ((layers & kLayerMotion) && film.keeps_motion())
    out.push_back({"motion", kVectorNames, data_image(session, PixelView::Motion)});
  if (film.keeps_outputs())
    for (std::size_t i = 0; i < kMaterialOutputs; ++i)
      if (layers & (LayerSet{1} << (kFirstOutputBit + static_cast<int>(i)))) {
        Image image = output_image(session, i);
        std::vector<std::string> channels =
            image.channels == 1 ? std::vector<std::string>{""} : kRgbNames;
        out.push_back({material_output_names()[i], std::move(channels), std::move(image)});
      }
  if (layers & kLayerLights)
    for (std::size_t i = 0; i < film.light_layers(); ++i) {
      const LightLayers& lights = session.world().light_layers;
      const bool unknown = i == lights.unknown();
      if (unknown && !session.has_unknown_light()) continue;
      const std::string name{unknown              ? scene::kIndirectGroup
                             : i == lights.rest() ? scene::kRestGroup
                                                  : std::string_view(lights.names[i])};
      out.push_back(
          {std::string(kLightLayerPrefix) + name, kRgbNames,
           collect(session, 3, [&](int x, int y, float* to) { put(to, film.light(x, y, i)); })});
    }
  if (session.mattes()) {
    if (layers & kLayerTag) out.push_back({"tag", {""}, label_image(session)});
    if (layers & kLayerCoverage) out.push_back({"coverage", {""}, coverage_image(session)});
    if (layers & kLayerMattes)
      for (Layer& layer : cryptomatte_layers(session)) out.push_back(std::move(layer));
  }
  if (layers & kLayerUserBuffers) add_user_buffers(session, out);
  return out;
}

Image denoised_beauty(const RenderSession& session) {
  return without_alpha(denoise(denoise_input(film_layers(session, kFilmLayers & ~kLayerDisplay))));
}

Image shown_image(const RenderSession& session, const NodeList& output_shaders,
                  const Image* denoised) {
  const Film& film = session.film();
  const Window& w = session.window();
  Image shown = collect(session, 4, [&](int x, int y, float* to) {
    const float* clean = denoised ? denoised->at(w.x0 + x, denoised->height - w.y1 + y) : nullptr;
    put(to, clean ? film.shown(x, y, Rgb(clean[0], clean[1], clean[2])) : film.shown(x, y));
    to[3] = film.pixel(x, y).beauty.a;
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
                   const std::map<std::string, std::string>& metadata, const Image* denoised) {
  const std::string type = file_type(file);
  if (type.empty())
    throw std::runtime_error("cannot write '" + file.path +
                             "': the name has no suffix that tells the file type");
  if (type == "exr") {
    ExrOptions exr;
    exr.half = file.samples == SampleFormat::Half;
    exr.metadata = metadata;
    const std::size_t threads =
        tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    exr.threads = threads > 1 ? static_cast<int>(threads) : 0;
    std::vector<Layer> layers;
    if (shows_user_buffer(file, session)) {
      Image image = user_buffer_image(file, session, denoised);
      std::vector<std::string> channels = channels_alone(image);
      layers.push_back({"", std::move(channels), std::move(image)});
      return write_exr(file.path, layers, exr);
    }
    if (const int shown = material_output_index(file.shown_layer); shown >= 0) {
      Image image = output_image(session, static_cast<std::size_t>(shown));
      layers.push_back(
          {"", image.channels == 1 ? std::vector<std::string>{"Y"} : kRgbNames, std::move(image)});
      return write_exr(file.path, layers, exr);
    }
    const bool mapped = is_mapped(file, session.world());
    const LayerSet asked = mapped ? file.layers & ~LayerSet{kLayerDisplay} : file.layers;
    layers = film_layers(session, asked | kLayerLights | kLayerUserBuffers | kLayerMattes);
    if (mapped) {
      Image shown = shown_image(session, file.shaders);
      layers.push_back({std::string(kLinearLayer), layers.front().channel_names,
                        std::exchange(layers.front().image, std::move(shown))});
    }
    exr.metadata.merge(cryptomatte_metadata(session));
    if (denoised) layers.push_back({std::string(kDenoisedLayer), kRgbNames, *denoised});
    return write_exr(file.path, layers, exr);
  }
  FileOptions options;
  options.format = file.samples;
  options.dither = session.world().options.dither;
  options.jpeg_quality = file.quality;
  write_as(type, file, file_image(file, session, denoised), options);
}

}  // namespace oriel
