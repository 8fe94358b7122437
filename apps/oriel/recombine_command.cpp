// SPDX-License-Identifier: Apache-2.0
// oriel recombine: puts the layers of a render together again and holds the sum against the
// beauty; or with lights stronger, weaker and of other colours.
#include "image/recombine.h"

#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include "command.h"
#include "image/exr.h"
#include "image/relight.h"
#include "pictures.h"
#include "scene_file.h"

namespace oriel::app {
namespace {

/// The promise of the manual's two equations.
constexpr float kFloatThreshold = 1e-4f;
/// The same for 16-bit layers: products of two values with a relative error of 2^-11 each.
constexpr float kHalfThreshold = 3e-3f;

struct RecombineArguments {
  std::string input, output;
  std::vector<std::string> lights;
  std::optional<float> threshold;
  bool json = false;
};

ExrFile read_picture(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw UserError(fmt::format("cannot read '{}': there is no such file", path));
  return read_exr(path);
}

/// Refuses layers that are not all there.
void check_outputs(const std::string& path, const std::vector<Layer>& layers) {
  const std::vector<std::string> wrong = unusable_outputs(layers);
  if (wrong.empty()) return;
  std::string list;
  for (const std::string& phrase : wrong) list += (list.empty() ? "" : ", ") + phrase;
  throw UsageError(fmt::format(
      "{}: {}; write them with oriel render SCENE -o FILE.exr --layers outputs", path, list));
}

/// Whether all values are representable in 16 bits.
bool is_half(const Image& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(),
                     [](float v) { return !std::isfinite(v) || static_cast<float>(half(v)) == v; });
}

/// The given threshold, otherwise that of the precision of the colour layers.
float threshold_of(const RecombineArguments& a, const std::vector<Layer>& layers) {
  if (a.threshold) return *a.threshold;
  const bool any_half = std::any_of(layers.begin(), layers.end(), [](const Layer& layer) {
    const auto& pixels = layer.image.pixels;
    const bool black = std::all_of(pixels.begin(), pixels.end(), [](float v) { return v == 0; });
    return layer.channel_names.front() == "R" && !black && is_half(layer.image);
  });
  return any_half ? kHalfThreshold : kFloatThreshold;
}

nlohmann::json json_of(const RebuiltDifference& d) {
  // JSON knows no infinity: null then.
  return {{"largest", d.largest},
          {"x", d.x},
          {"y", d.y},
          {"channel", std::string(1, "RGB"[d.channel])},
          {"beauty", d.beauty},
          {"rebuilt", d.rebuilt},
          {"pixels_above", d.above}};
}

void print_difference(const char* form, const RebuiltDifference& d, std::size_t pixels,
                      float threshold) {
  fmt::print(
      "{:<8} largest relative difference {:.3g} at {}, {} {}: beauty {:.9g}, rebuilt {:.9g}\n"
      "         {} of {} pixels above {:.3g}\n",
      form, d.largest, d.x, d.y, "RGB"[d.channel], d.beauty, d.rebuilt, d.above, pixels, threshold);
}

/// The larger difference of the two forms, per pixel and channel.
Image larger_difference(const Recombination& r, const Image& beauty) {
  Image out = relative_difference(r.simple, beauty);
  const Image other = relative_difference(r.complex, beauty);
  for (std::size_t i = 0; i < out.pixels.size(); ++i)
    out.pixels[i] = std::max(out.pixels[i], other.pixels[i]);
  return out;
}

/// "key=1.5", "key=1.5,0.2" or "key=1,.9,.7".
LightGain parse_gain(const std::string& text) {
  const auto refuse = [&] {
    return UsageError(fmt::format(
        "--light {}: expected NAME=FACTOR, NAME=FACTOR,WARMTH or NAME=RED,GREEN,BLUE", text));
  };
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0) throw refuse();
  std::vector<float> numbers;
  for (std::size_t at = equals + 1; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    float value = 0;
    const auto [rest, error] = std::from_chars(text.data() + at, text.data() + end, value);
    if (error != std::errc() || rest != text.data() + end || !std::isfinite(value)) throw refuse();
    numbers.push_back(value);
    at = end + 1;
  }
  LightGain gain{text.substr(0, equals), Rgb(0)};
  switch (numbers.size()) {
    case 1:
      gain.factor = Rgb(numbers[0]);
      break;
    case 2:
      gain.factor = tinted(numbers[0], numbers[1]);
      break;
    case 3:
      gain.factor = Rgb(numbers[0], numbers[1], numbers[2]);
      break;
    default:
      throw refuse();
  }
  return gain;
}

/// The picture under other strengths of its lights.
int run_relight(const RecombineArguments& a, const ExrFile& picture) {
  if (a.output.empty()) throw UsageError("--light requires -o FILE.exr");
  std::vector<LightGain> gains;
  for (const std::string& text : a.lights) gains.push_back(parse_gain(text));
  std::vector<Layer> layers;
  try {
    layers = relight(picture.layers, gains);
  } catch (const std::runtime_error& e) {
    throw UsageError(fmt::format("{}: {}", a.input, e.what()));
  }
  ExrOptions options;
  options.metadata = picture.metadata;
  write_exr(a.output, layers, options);
  return kExitDone;
}

/// Whether layers of lights sum to the beauty.
int compare_lights(const RecombineArguments& a, const std::vector<Layer>& layers) {
  const Layer* beauty = find_linear_beauty(layers);
  const std::vector<Layer> sum = relight(layers, {});
  Image rgb(beauty->image.width, beauty->image.height, 3);
  for (std::size_t i = 0; i < rgb.pixel_count(); ++i)
    std::copy_n(sum.front().image.at(0, 0) + i * static_cast<std::size_t>(beauty->image.channels),
                3, &rgb.pixels[3 * i]);
  const float threshold = threshold_of(a, layers);
  const RebuiltDifference d = compare_rebuilt(rgb, beauty->image, threshold);
  if (a.json)
    print_json({{"agrees", d.above == 0},
                {"threshold", threshold},
                {"floor", d.floor},
                {"pixels", rgb.pixel_count()},
                {"groups", light_layer_names(layers)},
                {"lights", json_of(d)}});
  else
    print_difference("lights", d, rgb.pixel_count(), threshold);
  return d.above == 0 ? kExitDone : kExitFailed;
}

int run_recombine(const RecombineArguments& a) {
  if (!a.output.empty() && std::filesystem::path(a.output).extension() != ".exr")
    throw UsageError(fmt::format("-o {}: layers require an .exr file", a.output));
  const ExrFile picture = read_picture(a.input);
  if (!a.lights.empty()) return run_relight(a, picture);
  const std::vector<Layer>& layers = picture.layers;
  const bool has_lights = find_linear_beauty(layers) && !light_layer_names(layers).empty();
  // Of a picture with layers of lights alone these are compared.
  if (has_lights && !find_layer(layers, "diffuse_result") && a.output.empty())
    return compare_lights(a, layers);
  check_outputs(a.input, layers);
  const Image& beauty = find_linear_beauty(layers)->image;
  Recombination r = recombine(layers);
  const float threshold = threshold_of(a, layers);
  const RebuiltDifference simple = compare_rebuilt(r.simple, beauty, threshold);
  const RebuiltDifference complex = compare_rebuilt(r.complex, beauty, threshold);
  const bool agrees = simple.above == 0 && complex.above == 0;

  if (a.json) {
    print_json({{"agrees", agrees},
                {"threshold", threshold},
                {"floor", simple.floor},
                {"pixels", beauty.pixel_count()},
                {"simple", json_of(simple)},
                {"complex", json_of(complex)}});
  } else {
    print_difference("simple", simple, beauty.pixel_count(), threshold);
    print_difference("complex", complex, beauty.pixel_count(), threshold);
    if (!agrees && threshold == kHalfThreshold)
      fmt::print("The file contains 16-bit floats: render it with --exr float for exact sums.\n");
  }
  if (!a.output.empty()) {
    Image difference = larger_difference(r, beauty);
    const std::vector<std::string> rgb = {"R", "G", "B"};
    write_exr(a.output, {{"simple", rgb, std::move(r.simple)},
                         {"complex", rgb, std::move(r.complex)},
                         {"difference", rgb, std::move(difference)}});
  }
  return agrees ? kExitDone : kExitFailed;
}

}  // namespace

Command add_recombine_command(CLI::App& program) {
  CLI::App* app = program.add_subcommand(
      "recombine",
      "Rebuild a render from its layers and compare: from material outputs or, if there are none, "
      "from light groups. With --light: the picture with other strengths of its light groups");
  auto a = std::make_shared<RecombineArguments>();
  app->add_option("IN", a->input, "EXR file of oriel render --layers outputs or --light-group")
      ->required();
  app->add_option("-o,--output", a->output,
                  "EXR file to write: layers simple, complex and difference (relative); with "
                  "--light the new picture and its light groups");
  app->add_option(
         "--light", a->lights,
         "Factor of a light group: a number; a number and a colour temperature shift (1: red to "
         "blue 4:1 at equal luminance; negative: cooler); or red, green and "
         "blue. Repeatable; `rest` is the light of no group")
      ->allow_extra_args(false)
      ->type_name("NAME=FACTOR[,WARMTH]|R,G,B");
  app->add_option("--threshold", a->threshold,
                  "Exit with code 1 if the relative difference of a pixel is larger (default 1e-4; "
                  "3e-3 for 16-bit files)")
      ->check(CLI::NonNegativeNumber);
  app->add_flag("--json", a->json, "Print one line of JSON");
  return {app, [a] { return run_recombine(*a); }};
}

}  // namespace oriel::app
