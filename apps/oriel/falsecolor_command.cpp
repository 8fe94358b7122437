// SPDX-License-Identifier: Apache-2.0
// oriel falsecolor: a layer of numbers as a picture with a legend.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "color/luminance.h"
#include "command.h"
#include "image/exr.h"
#include "image/false_color.h"
#include "image/files.h"
#include "pictures.h"

namespace oriel::app {
namespace {

struct FalseColorArguments {
  std::string input, output, layer, range;
  bool logarithmic = false, isolines = false;
};

/// What is shown, one channel, and its unit.
struct Shown {
  Image values;
  std::string unit;
};

Image luminance_of(const Image& color, float unit) {
  Image out(color.width, color.height, 1);
  for (std::size_t i = 0; i < color.pixel_count(); ++i) {
    const float* p = &color.pixels[i * static_cast<std::size_t>(color.channels)];
    out.pixels[i] = unit * (color.channels < 3 ? *p : luminance(Rgb(p[0], p[1], p[2])));
  }
  return out;
}

/// Nothing asked: illuminance where the file has it, else luminance; that of the beauty where there
/// is no such layer.
Shown read_shown(const FalseColorArguments& a) {
  const Image beauty = read_linear_picture(a.input);
  ExrFile file;
  if (std::filesystem::path(a.input).extension() == ".exr") file = read_exr(a.input);
  const std::string name = !a.layer.empty()                             ? a.layer
                           : find_layer(file.layers, kIlluminanceLayer) ? kIlluminanceLayer
                                                                        : kLuminanceLayer;
  const std::string unit = name == kIlluminanceLayer ? "lx"
                           : name == kLuminanceLayer ? "cd/m2"
                                                     : "";
  if (const Layer* layer = find_layer(file.layers, name))
    return {luminance_of(layer->image, 1), unit};
  if (name != kLuminanceLayer) throw missing_layer(a.input, name, file.layers);
  return {luminance_of(beauty, number_attribute(file, kUnitLuminanceKey).value_or(1)), unit};
}

ValueScale scale_for(const FalseColorArguments& a, const Image& values) {
  if (a.range.empty()) return scale_of(values, a.logarithmic);
  ValueScale scale;
  scale.logarithmic = a.logarithmic;
  char rest = 0;
  if (std::sscanf(a.range.c_str(), "%f,%f%c", &scale.low, &scale.high, &rest) != 2 ||
      !(scale.low < scale.high) || (a.logarithmic && !(scale.low > 0)))
    throw UsageError(fmt::format("--range {}: expected LOW,HIGH{}", a.range,
                                 a.logarithmic ? ", above 0 with --log" : ""));
  return scale;
}

int run_falsecolor(const FalseColorArguments& a) {
  const Shown shown = read_shown(a);
  const Image picture = false_color(
      shown.values,
      {.scale = scale_for(a, shown.values), .isolines = a.isolines, .unit = shown.unit});
  write_image(a.output, picture);
  return kExitDone;
}

}  // namespace

Command add_falsecolor_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "falsecolor", "Show lux or cd/m2 of a rendered EXR file as colours with a legend");
  auto a = std::make_shared<FalseColorArguments>();
  app->add_option("IN", a->input, "EXR file of oriel render --layers illuminance,luminance")
      ->required();
  app->add_option("-o,--output", a->output, "Picture to write; the suffix sets the type")
      ->required();
  app->add_option("--layer", a->layer, "Layer (default: illuminance, else luminance)");
  app->add_option("--range", a->range,
                  "Values of the darkest and the brightest colour (default: from the picture)")
      ->type_name("LOW,HIGH");
  app->add_flag("--log", a->logarithmic, "Logarithmic scale");
  app->add_flag("--isolines", a->isolines, "Contour lines of the values in the legend");
  return {app, [a] { return run_falsecolor(*a); }};
}

}  // namespace oriel::app
