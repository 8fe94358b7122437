// SPDX-License-Identifier: Apache-2.0
// oriel tonemap: the exposure shaders on a finished picture, without rendering.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <optional>

#include "base/math.h"
#include "base/parallel.h"
#include "color/srgb.h"
#include "command.h"
#include "image/exr.h"
#include "image/files.h"
#include "image/view.h"
#include "pictures.h"
#include "suggest.h"
#include "tone/display_views.h"
#include "tone/exposure.h"

namespace oriel::app {
namespace {

struct TonemapArguments {
  std::string input, output;
  bool simple = false;
  std::string layer, whitepoint, view, curve = "ratio";
  std::optional<float> field_of_view;
  lens::PhotographicParameters photographic;
  lens::SimpleParameters plain;
  float gamma = 2.2f;
};

/// "r g b" or "r,g,b".
Rgb parse_color(const std::string& text) {
  Rgb c(0);
  char rest = 0;
  if (std::sscanf(text.c_str(), "%f%*[ ,]%f%*[ ,]%f%c", &c.x, &c.y, &c.z, &rest) != 3)
    throw UsageError(fmt::format("--whitepoint {}: expected three numbers, r,g,b", text));
  return c;
}

/// Maps all pixels: exposure(colour, x, y).
template <class Exposure>
void map_image(Image& image, const Exposure& exposure) {
  const int colours = std::min(image.channels == 2 ? 1 : image.channels, 3);
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t y) {
    for (int x = 0; x < image.width; ++x) {
      float* p = image.at(x, static_cast<int>(y));
      const Rgb c =
          exposure(colours == 3 ? Rgb(p[0], p[1], p[2]) : Rgb(p[0]), x, static_cast<int>(y));
      for (int i = 0; i < colours; ++i) p[i] = c[i];
    }
  });
}

/// Cosines of the rays through a picture's pixels to its middle.
class PixelCosine {
 public:
  /// All 1 where there is no vignetting to reckon.
  PixelCosine(const TonemapArguments& a, const Image& image)
      : width_(static_cast<float>(image.width)), height_(static_cast<float>(image.height)) {
    if (a.photographic.vignetting == 0) return;
    const float degrees = a.field_of_view ? *a.field_of_view : field_of_view(a.input);
    if (!(degrees > 0 && degrees < 180))
      throw UsageError("--fov: expected the horizontal field of view, between 0 and 180 degrees");
    per_pixel_ = 2 * math::tan(degrees * kPi / 360) / width_;
  }
  float operator()(int x, int y) const {
    const float fx = (static_cast<float>(x) + 0.5f - width_ / 2) * per_pixel_;
    const float fy = (static_cast<float>(y) + 0.5f - height_ / 2) * per_pixel_;
    return 1 / std::sqrt(1 + fx * fx + fy * fy);
  }

 private:
  /// As `oriel render` left it in the file.
  static float field_of_view(const std::string& path) {
    float degrees = 0;
    if (std::filesystem::path(path).extension() == ".exr") {
      const ExrFile file = read_exr(path);
      const auto found = file.metadata.find(kFieldOfViewKey);
      if (found != file.metadata.end()) degrees = std::strtof(found->second.c_str(), nullptr);
    }
    if (!(degrees > 0))
      throw UserError(fmt::format(
          "--vignetting: '{}' does not say its field of view; give it by --fov DEGREES", path));
    return degrees;
  }

  float width_, height_, per_pixel_ = 0;
};

void expose(Image& image, TonemapArguments& a) {
  if (!a.whitepoint.empty()) a.photographic.whitepoint = parse_color(a.whitepoint);
  a.photographic.gamma = a.plain.gamma = a.gamma;
  a.plain.curve = a.curve == "asymptotic" ? lens::KneeCurve::Asymptotic : lens::KneeCurve::Ratio;
  if (a.simple)
    return map_image(image, [exposure = lens::SimpleExposure(a.plain)](const Rgb& c, int, int) {
      return exposure(c);
    });
  if (!a.view.empty()) {
    // The view is the film: of the exposure it is the light alone that is left.
    a.photographic.burn_highlights = 1;
    a.photographic.crush_blacks = 0;
    a.photographic.saturation = a.photographic.gamma = 1;
  }
  const PixelCosine cosine(a, image);
  const lens::PhotographicExposure exposure(a.photographic);
  map_image(image, [&](const Rgb& c, int x, int y) {
    const Rgb exposed = exposure(c, cosine(x, y));
    if (a.view == "agx") return lens::agx(exposed);
    if (a.view == "neutral") return srgb_encode(lens::pbr_neutral(exposed));
    return exposed;
  });
}

/// The picture to map: the beauty, or a layer of an EXR file.
Image read_picture(const TonemapArguments& a) {
  Image image = read_linear_picture(a.input);
  if (a.layer.empty()) return image;
  std::vector<Layer> layers;
  if (std::filesystem::path(a.input).extension() == ".exr") layers = read_exr(a.input).layers;
  const Layer* layer = find_layer(layers, a.layer);
  if (!layer) throw missing_layer(a.input, a.layer, layers);
  return layer->image;
}

int run_tonemap(TonemapArguments& a) {
  Image image = read_picture(a);
  expose(image, a);
  const std::string suffix = std::filesystem::path(a.output).extension().string();
  FileOptions options;
  options.format = SampleFormat::Float;
  const bool keeps_floats = is_linear_file(a.output);
  if (!keeps_floats) {
    options.format = suffix == ".tif" || suffix == ".tiff" ? SampleFormat::U16 : SampleFormat::U8;
    image = view_image(image, ViewOptions{});
  }
  write_image(a.output, image, options);
  return kExitDone;
}

}  // namespace

Command add_tonemap_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "tonemap", "Tone-map a linear picture by mia_exposure_photographic (or _simple)");
  auto a = std::make_shared<TonemapArguments>();
  app->add_option("IN", a->input, "Linear picture, usually EXR")->required();
  app->add_option("-o,--output", a->output, "Picture to write; the suffix sets the type")
      ->required();
  app->add_option("--layer", a->layer, "Layer of an EXR file, e.g. denoised (default: the beauty)");
  CLI::Option* gamma = app->add_option("--gamma", a->gamma, "Display gamma")->capture_default_str();

  auto& p = a->photographic;
  p.vignetting = 0;  // a picture alone does not say where its camera's axis was
  const std::string photographic = "Photographic exposure";
  std::vector<CLI::Option*> of_photographic = {
      app->add_option("--iso", p.film_iso, "Film speed; 0 = --cm2 is a plain gain"),
      app->add_option("--shutter", p.camera_shutter, "Shutter time is one over this, in seconds"),
      app->add_option("--f-number", p.f_number, "Aperture"),
      app->add_option("--cm2", p.cm2_factor, "cd/m2 per pixel unit"),
      app->add_option("--vignetting", p.vignetting,
                      "Exponent of the cosine, 0 = none, 3 = natural"),
      app->add_option(
             "--fov", a->field_of_view,
             "Horizontal field of view in degrees (default: from EXR files of oriel render)")
          ->type_name("DEGREES"),
      app->add_option("--burn", p.burn_highlights,
                      "Compression of highlights, 1 = linear, 0 = never over-exposed"),
      app->add_option("--crush", p.crush_blacks, "Darkening of shadows, 0 = linear"),
      app->add_option("--saturation", p.saturation, "Saturation, 0 = grey, 1 = unchanged"),
      app->add_option("--whitepoint", a->whitepoint, "Colour that becomes neutral, r,g,b")};
  CLI::Option* simple = app->add_flag("--simple", a->simple, "Use the simple exposure");
  auto& s = a->plain;
  const std::vector<CLI::Option*> of_simple = {
      app->add_option("--pedestal", s.pedestal, "Offset that is added first"),
      app->add_option("--gain", s.gain, "Factor"),
      app->add_option("--knee", s.knee, "Luminance at which compression begins"),
      app->add_option("--compression", s.compression, "Ratio above the knee"),
      app->add_option("--knee-curve", a->curve,
                      "Curve above the knee: ratio, or asymptotic (smooth, never above 1)")
          ->check(one_of({"ratio", "asymptotic"}))
          ->type_name("CURVE")};
  for (CLI::Option* option : of_simple)
    option->group("Simple exposure")->needs(simple)->capture_default_str();
  CLI::Option* view =
      app->add_option(
             "--view", a->view,
             "Apply the exposure above, then the display transform agx or neutral (PBR Neutral)")
          ->check(one_of({"agx", "neutral"}))
          ->type_name("VIEW")
          ->excludes(simple)
          ->excludes(gamma);
  for (const char* curve : {"--burn", "--crush", "--saturation"})
    view->excludes(app->get_option(curve));
  for (CLI::Option* option : of_photographic) {
    option->group(photographic)->excludes(simple);
    if (option->get_name() != "--whitepoint" && option->get_name() != "--fov")
      option->capture_default_str();
  }
  return {app, [a] { return run_tonemap(*a); }};
}

}  // namespace oriel::app
