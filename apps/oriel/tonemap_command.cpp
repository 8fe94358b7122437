// SPDX-License-Identifier: Apache-2.0
// oriel tonemap: the exposure shaders on a finished picture, without rendering.
#include <fmt/format.h>

#include <filesystem>

#include "base/parallel.h"
#include "command.h"
#include "image/files.h"
#include "image/view.h"
#include "lens/exposure.h"
#include "pictures.h"

namespace oriel::app {
namespace {

struct TonemapArguments {
  std::string input, output;
  bool simple = false;
  std::string whitepoint;
  lens::PhotographicParameters photographic;
  lens::SimpleParameters plain;
  float gamma = 2.2f;
};

/// "r g b" or "r,g,b".
Rgb parse_color(const std::string& text) {
  Rgb c(0);
  char rest = 0;
  if (std::sscanf(text.c_str(), "%f%*[ ,]%f%*[ ,]%f%c", &c.x, &c.y, &c.z, &rest) != 3)
    throw UsageError(fmt::format("--whitepoint {}: write three numbers, r,g,b", text));
  return c;
}

template <class Exposure>
void map_image(Image& image, const Exposure& exposure) {
  const int colours = std::min(image.channels == 2 ? 1 : image.channels, 3);
  parallel_for(static_cast<std::size_t>(image.height), [&](std::size_t y) {
    for (int x = 0; x < image.width; ++x) {
      float* p = image.at(x, static_cast<int>(y));
      const Rgb c = exposure(colours == 3 ? Rgb(p[0], p[1], p[2]) : Rgb(p[0]));
      for (int i = 0; i < colours; ++i) p[i] = c[i];
    }
  });
}

int run_tonemap(TonemapArguments& a) {
  Image image = read_named_picture(a.input);
  if (!a.whitepoint.empty()) a.photographic.whitepoint = parse_color(a.whitepoint);
  a.photographic.gamma = a.plain.gamma = a.gamma;
  if (a.simple) {
    map_image(image, lens::SimpleExposure(a.plain));
  } else {
    // A picture alone does not say where its camera's axis was, so there is no vignetting.
    const lens::PhotographicExposure exposure(a.photographic);
    map_image(image, [&](const Rgb& c) { return exposure(c); });
  }
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
      "tonemap", "Exposes a linear picture as mia_exposure_photographic (or _simple) would");
  auto a = std::make_shared<TonemapArguments>();
  app->add_option("IN", a->input, "Linear picture, usually EXR")->required();
  app->add_option("-o,--output", a->output, "The picture to write, type by suffix")->required();
  app->add_option("--gamma", a->gamma, "Display gamma")->capture_default_str();

  auto& p = a->photographic;
  const std::string photographic = "Photographic exposure";
  std::vector<CLI::Option*> of_photographic = {
      app->add_option("--iso", p.film_iso, "Film speed; 0: --cm2 is a plain gain"),
      app->add_option("--shutter", p.camera_shutter, "Shutter time is one over this, in seconds"),
      app->add_option("--f-number", p.f_number, "Aperture"),
      app->add_option("--cm2", p.cm2_factor, "cd/m2 per pixel unit"),
      app->add_option("--burn", p.burn_highlights, "1 linear ... 0 never over-exposed"),
      app->add_option("--crush", p.crush_blacks, "0 linear ... darker shadows"),
      app->add_option("--saturation", p.saturation, "0 grey, 1 as it is"),
      app->add_option("--whitepoint", a->whitepoint, "Colour that becomes grey, r,g,b")};
  CLI::Option* simple = app->add_flag("--simple", a->simple, "Simple exposure instead");
  auto& s = a->plain;
  const std::vector<CLI::Option*> of_simple = {
      app->add_option("--pedestal", s.pedestal, "Added first"),
      app->add_option("--gain", s.gain, "Multiplies"),
      app->add_option("--knee", s.knee, "Where compression begins"),
      app->add_option("--compression", s.compression, "Ratio above the knee")};
  for (CLI::Option* option : of_photographic) {
    option->group(photographic)->excludes(simple);
    if (option->get_name() != "--whitepoint") option->capture_default_str();
  }
  for (CLI::Option* option : of_simple)
    option->group("Simple exposure")->needs(simple)->capture_default_str();
  return {app, [a] { return run_tonemap(*a); }};
}

}  // namespace oriel::app
