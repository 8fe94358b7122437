// SPDX-License-Identifier: Apache-2.0
// oriel tonemap: the exposure shaders on a finished picture, without rendering.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <optional>

#include "base/math.h"
#include "base/parallel.h"
#include "color/luminance.h"
#include "color/srgb.h"
#include "command.h"
#include "denoise/denoise.h"
#include "image/exr.h"
#include "image/files.h"
#include "image/view.h"
#include "output/output.h"
#include "output/picture_metadata.h"
#include "pictures.h"
#include "suggest.h"
#include "tone/display_views.h"
#include "tone/exposure.h"

namespace oriel::app {
namespace {

struct TonemapArguments {
  std::string input, output;
  bool simple = false, automatic = false, keep_outliers = false;
  std::string layer, whitepoint, view, curve = "ratio";
  std::optional<float> field_of_view;
  lens::PhotographicParameters photographic;
  lens::SimpleParameters plain;
  float gamma = 2.2f;
  int bits = 8;
  OcioTransform ocio;
  /// Overwrites parameters of the file by those of the command line.
  std::function<void(lens::PhotographicParameters&)> apply_photographic;
  std::function<void(lens::SimpleParameters&)> apply_simple;
  std::function<bool()> photographic_given;

  bool uses_ocio() const { return !ocio.config.empty() || !ocio.lut.empty(); }
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
      degrees = number_attribute(read_exr(path), kFieldOfViewKey).value_or(0);
    }
    if (!(degrees > 0))
      throw UserError(fmt::format(
          "--vignetting: '{}' does not say its field of view; give it by --fov DEGREES", path));
    return degrees;
  }

  float width_, height_, per_pixel_ = 0;
};

/// Whether the exposure is linear, because a display transform follows.
bool is_linear_exposure(const TonemapArguments& a) { return !a.view.empty() || a.uses_ocio(); }

/// Parameters of the exposure that `oriel render` recorded in the file, if the kind of exposure is
/// that of the command.
void read_exposure(const ExrFile& file, TonemapArguments& a) {
  const auto name = text_attribute(file, kExposureKey);
  if (!name) return;
  const auto number = [&](const char* parameter, float& value) {
    value = number_attribute(file, std::string(kExposureKey) + "." + parameter).value_or(value);
  };
  if (*name == "mia_exposure_simple" && !a.simple && !a.automatic && !is_linear_exposure(a) &&
      a.whitepoint.empty() && !a.photographic_given())
    a.simple = true;
  if (name->starts_with("mia_exposure_photographic") && !a.simple) {
    lens::PhotographicParameters p;
    number("cm2_factor", p.cm2_factor);
    number("whitepoint.r", p.whitepoint.x);
    number("whitepoint.g", p.whitepoint.y);
    number("whitepoint.b", p.whitepoint.z);
    number("film_iso", p.film_iso);
    number("camera_shutter", p.camera_shutter);
    number("f_number", p.f_number);
    number("vignetting", p.vignetting);
    number("burn_highlights", p.burn_highlights);
    number("crush_blacks", p.crush_blacks);
    number("saturation", p.saturation);
    number("gamma", p.gamma);
    a.apply_photographic(p);
    a.photographic = p;
  } else if (*name == "mia_exposure_simple" && a.simple) {
    lens::SimpleParameters p;
    number("pedestal", p.pedestal);
    number("gain", p.gain);
    number("knee", p.knee);
    number("compression", p.compression);
    number("gamma", p.gamma);
    a.apply_simple(p);
    a.plain = p;
  }
}

/// The photographic exposure of one colour, with the display transforms of this program.
Rgb show(const lens::PhotographicExposure& exposure, const TonemapArguments& a, const Rgb& c,
         float cosine) {
  const Rgb exposed = exposure(c, cosine);
  if (a.uses_ocio()) return exposed;
  if (a.view == "agx") return lens::agx(exposed);
  if (a.view == "neutral") return srgb_encode(lens::pbr_neutral(exposed));
  return exposed;
}

/// Mean of the logarithm of luminance; unset for black pictures.
std::optional<float> log_mean(const Image& image) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < image.pixel_count(); ++i) {
    const float* p = image.pixels.data() + i * static_cast<std::size_t>(image.channels);
    const float l = image.channels < 3 ? p[0] : luminance(Rgb(p[0], p[1], p[2]));
    if (!(l > 0) || !std::isfinite(l)) continue;
    sum += static_cast<double>(math::log2(l));
    ++count;
  }
  if (count == 0) return std::nullopt;
  return math::exp2(static_cast<float>(sum / static_cast<double>(count)));
}

/// Sets the gain of the exposure such that the log mean of the picture is displayed as middle grey
/// (0.18 linear). Bisection in stops: the displayed value increases with the gain.
void expose_automatically(const Image& image, TonemapArguments& a) {
  lens::PhotographicParameters& p = a.photographic;
  p.film_iso = 0;
  p.cm2_factor = 1;
  const auto mean = log_mean(image);
  if (!mean) return;
  constexpr float kMiddleGrey = 0.18f;
  float low = -40, high = 40;
  for (int i = 0; i < 40; ++i) {
    const float middle = (low + high) / 2;
    p.cm2_factor = math::exp2(middle) / *mean;
    const Rgb shown = show(lens::PhotographicExposure(p), a, Rgb(*mean) * p.whitepoint, 1);
    const float linear = a.uses_ocio() ? luminance(shown) : luminance(srgb_decode(shown));
    (linear < kMiddleGrey ? low : high) = middle;
  }
}

void expose(Image& image, TonemapArguments& a) {
  if (a.simple)
    return map_image(image, [exposure = lens::SimpleExposure(a.plain)](const Rgb& c, int, int) {
      return exposure(c);
    });
  if (is_linear_exposure(a)) {
    a.photographic.burn_highlights = 1;
    a.photographic.crush_blacks = 0;
    a.photographic.saturation = a.photographic.gamma = 1;
  }
  if (a.automatic) expose_automatically(image, a);
  const PixelCosine cosine(a, image);
  const lens::PhotographicExposure exposure(a.photographic);
  map_image(image, [&](const Rgb& c, int x, int y) { return show(exposure, a, c, cosine(x, y)); });
}

/// The picture to map: a layer, or the linear beauty with its outliers spread as in pictures of
/// `oriel render`.
Image choose_picture(const TonemapArguments& a, const ExrFile& file) {
  if (!a.layer.empty()) {
    const Layer* layer = find_layer(file.layers, a.layer);
    if (!layer) throw missing_layer(a.input, a.layer, file.layers);
    return layer->image;
  }
  const Layer* beauty = find_linear_beauty(file.layers);
  if (!beauty) return read_linear_picture(a.input);
  Image image = beauty->image;
  const DenoiseInput input = denoise_input(file.layers);
  const bool measured = input.color && (input.variance || input.half_difference);
  const float samples = number_attribute(file, "oriel.samples").value_or(0);
  if (a.keep_outliers || !measured || samples < kMinOutlierSamples || image.channels < 3)
    return image;
  const Image spread = spread_outliers(input);
  for (std::size_t i = 0; i < image.pixel_count(); ++i)
    std::copy_n(&spread.pixels[3 * i], 3,
                &image.pixels[i * static_cast<std::size_t>(image.channels)]);
  return image;
}

int run_tonemap(TonemapArguments& a) {
  if (!a.view.empty() && a.ocio.config.empty() && a.view != "agx" && a.view != "neutral")
    throw UsageError(fmt::format("--view {}: {}; views of a configuration require --ocio", a.view,
                                 expected_one_of(a.view, {"agx", "neutral"})));
  a.photographic.gamma = a.plain.gamma = a.gamma;
  Image image = read_named_picture(a.input);
  ExrFile file;
  if (std::filesystem::path(a.input).extension() == ".exr") {
    file = read_exr(a.input);
    image = choose_picture(a, file);
    read_exposure(file, a);
  } else if (!a.layer.empty()) {
    throw UserError(fmt::format("'{}' has no layer {}", a.input, a.layer));
  }
  if (!a.whitepoint.empty()) a.photographic.whitepoint = parse_color(a.whitepoint);
  a.plain.curve = a.curve == "asymptotic" ? lens::KneeCurve::Asymptotic : lens::KneeCurve::Ratio;
  expose(image, a);
  if (a.uses_ocio()) {
    a.ocio.view = a.view;
    if (a.ocio.config == "env") a.ocio.config.clear();
    apply_ocio(image, a.ocio);
  }
  const std::string suffix = std::filesystem::path(a.output).extension().string();
  FileOptions options;
  options.format = SampleFormat::Float;
  options.srgb = true;
  const bool keeps_floats = is_linear_file(a.output);
  if (!keeps_floats) {
    const bool is_tiff = suffix == ".tif" || suffix == ".tiff";
    options.format = is_tiff || a.bits == 16 ? SampleFormat::U16 : SampleFormat::U8;
    image = view_image(image, ViewOptions{});
  }
  write_image(a.output, image, options);
  return kExitDone;
}

/// A group of options for numbers of `parameters`. Those given on the command line are applied to
/// other parameters by the returned function.
template <class Parameters>
class NumberOptions {
 public:
  NumberOptions(CLI::App& app, Parameters& parameters, std::string group)
      : app_(app), parameters_(parameters), group_(std::move(group)) {}

  CLI::Option* add(const char* name, float Parameters::*member, const char* help) {
    CLI::Option* option = app_.add_option(name, parameters_.*member, help);
    option->group(group_)->capture_default_str();
    options_.emplace_back(option, member);
    return option;
  }
  std::function<void(Parameters&)> given() const {
    return [options = options_, &from = parameters_](Parameters& to) {
      for (const auto& [option, member] : options)
        if (option->count() > 0) to.*member = from.*member;
    };
  }
  std::function<bool()> any_given() const {
    return [options = options_] {
      return std::any_of(options.begin(), options.end(),
                         [](const auto& option) { return option.first->count() > 0; });
    };
  }
  template <class F>
  void for_each(const F& f) const {
    for (const auto& option : options_) f(option.first);
  }

 private:
  CLI::App& app_;
  Parameters& parameters_;
  std::string group_;
  std::vector<std::pair<CLI::Option*, float Parameters::*>> options_;
};

NumberOptions<lens::PhotographicParameters> add_photographic(CLI::App& app, TonemapArguments& a) {
  using P = lens::PhotographicParameters;
  a.photographic.vignetting = 0;  // most pictures do not contain the axis of their camera
  NumberOptions<P> options(app, a.photographic, "Photographic exposure");
  options.add("--iso", &P::film_iso, "Film speed; 0: --cm2 is a plain gain");
  options.add("--shutter", &P::camera_shutter, "Reciprocal of the shutter time, 1/s");
  options.add("--f-number", &P::f_number, "Aperture");
  options.add("--cm2", &P::cm2_factor, "cd/m2 per pixel unit");
  options.add("--vignetting", &P::vignetting, "Exponent of the cosine (0 = none; 3 = camera)");
  options.add("--burn", &P::burn_highlights, "1 = linear, 0 = never over-exposed");
  options.add("--crush", &P::crush_blacks, "0 = linear; larger values darken shadows");
  options.add("--saturation", &P::saturation, "0 = grey, 1 = unchanged");
  return options;
}

NumberOptions<lens::SimpleParameters> add_simple(CLI::App& app, TonemapArguments& a) {
  using P = lens::SimpleParameters;
  NumberOptions<P> options(app, a.plain, "Simple exposure");
  options.add("--pedestal", &P::pedestal, "Offset, added first");
  options.add("--gain", &P::gain, "Factor");
  options.add("--knee", &P::knee, "Luminance at which compression begins");
  options.add("--compression", &P::compression, "Compression ratio above the knee");
  return options;
}

/// Options of views and OpenColorIO.
void add_views(CLI::App& app, TonemapArguments& a, CLI::Option* simple, CLI::Option* gamma) {
  const auto add = [&](const char* name, std::string& value, const char* help) {
    return app.add_option(name, value, help)->group("Display transform");
  };
  CLI::Option* view = add("--view", a.view,
                          "Display transform after a linear exposure: agx, neutral (PBR Neutral), "
                          "or with --ocio a view of the configuration (default: its first)");
  view->type_name("VIEW")->excludes(simple)->excludes(gamma);
  for (const char* curve : {"--burn", "--crush", "--saturation"})
    view->excludes(app.get_option(curve));
  CLI::Option* ocio = add("--ocio", a.ocio.config,
                          "OpenColorIO configuration; \"env\" = that of the variable OCIO");
  ocio->type_name("CONFIG")->excludes(simple)->excludes(gamma);
  add("--display", a.ocio.display, "Display of the configuration (default: its first)")
      ->needs(ocio);
  add("--ocio-space", a.ocio.space,
      "Colour space of the input (default: linear Rec. 709 if the configuration has it, otherwise "
      "its scene_linear)")
      ->needs(ocio);
  add("--lut", a.ocio.lut,
      "Look-up table (.cube, .clf, .3dl, ...) applied to the exposed linear picture")
      ->type_name("FILE")
      ->excludes(simple)
      ->excludes(gamma)
      ->excludes(view)
      ->excludes(ocio);
}

}  // namespace

Command add_tonemap_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "tonemap",
      "Tone-map a linear picture by mia_exposure_photographic (or _simple). Exposure parameters "
      "default to those of the scene, for EXR files of oriel render");
  auto a = std::make_shared<TonemapArguments>();
  app->add_option("IN", a->input, "Linear picture, usually EXR")->required();
  app->add_option("-o,--output", a->output, "Output file; the suffix sets the type")->required();
  app->add_option("--layer", a->layer,
                  "Layer of an EXR file, e.g. \"denoised\" (default: the beauty)");
  app->add_option("--bits", a->bits, "Bits per channel of PNG files: 8 or 16 (default 8)")
      ->check(CLI::IsMember({8, 16}));
  app->add_flag("--keep-outliers", a->keep_outliers,
                "Show pixels that single rare samples make far too bright (default: their light is "
                "spread over the neighbourhood, for EXR files of oriel render)");
  CLI::Option* gamma = app->add_option("--gamma", a->gamma, "Display gamma")->capture_default_str();
  const auto photographic = add_photographic(*app, *a);
  const char* group = "Photographic exposure";
  CLI::Option* fov =
      app->add_option(
             "--fov", a->field_of_view,
             "Horizontal field of view in degrees (default: from EXR files of oriel render)")
          ->type_name("DEGREES")
          ->group(group);
  CLI::Option* white =
      app->add_option("--whitepoint", a->whitepoint, "Colour that becomes neutral, r,g,b")
          ->group(group);
  CLI::Option* automatic = app->add_flag("--auto", a->automatic,
                                         "Gain for which the logarithmic mean of the picture is "
                                         "displayed as middle grey (0.18 linear)")
                               ->group(group);
  for (const char* name : {"--iso", "--shutter", "--f-number", "--cm2"})
    automatic->excludes(app->get_option(name));
  CLI::Option* simple = app->add_flag("--simple", a->simple, "Simple exposure instead");
  const auto plain = add_simple(*app, *a);
  plain.for_each([&](CLI::Option* option) { option->needs(simple); });
  app->add_option("--knee-curve", a->curve, "ratio, or asymptotic: smooth and never above 1")
      ->check(one_of({"ratio", "asymptotic"}))
      ->type_name("CURVE")
      ->group("Simple exposure")
      ->needs(simple)
      ->capture_default_str();
  photographic.for_each([&](CLI::Option* option) { option->excludes(simple); });
  for (CLI::Option* option : {fov, white, automatic}) option->excludes(simple);
  add_views(*app, *a, simple, gamma);
  a->apply_photographic = [given = photographic.given(), a = a.get(),
                           gamma](lens::PhotographicParameters& p) {
    given(p);
    if (gamma->count() > 0) p.gamma = a->gamma;
  };
  a->apply_simple = [given = plain.given(), a = a.get(), gamma](lens::SimpleParameters& p) {
    given(p);
    if (gamma->count() > 0) p.gamma = a->gamma;
  };
  a->photographic_given = photographic.any_given();
  return {app, [a] { return run_tonemap(*a); }};
}

}  // namespace oriel::app
