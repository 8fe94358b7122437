// SPDX-License-Identifier: Apache-2.0
// oriel recombine: puts the outputs of a render together again and holds the sum against the
// beauty.
#include "image/recombine.h"

#include <fmt/format.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "command.h"
#include "image/exr.h"
#include "pictures.h"
#include "scene_file.h"

namespace oriel::app {
namespace {

/// The promise of the manual's two equations.
constexpr float kRecombineThreshold = 1e-4f;

struct RecombineArguments {
  std::string input, output;
  float threshold = kRecombineThreshold;
  bool json = false;
};

std::vector<Layer> read_outputs(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw UserError(fmt::format("cannot read '{}': there is no such file", path));
  std::vector<Layer> layers = read_exr(path).layers;
  const std::vector<std::string> wrong = unusable_outputs(layers);
  if (wrong.empty()) return layers;
  std::string list;
  for (const std::string& phrase : wrong) list += (list.empty() ? "" : ", ") + phrase;
  throw UsageError(fmt::format(
      "{}: {}; write them with oriel render SCENE -o FILE.exr --layers outputs", path, list));
}

/// True when the picture was stored in 16 bits: three digits cannot add up to four.
bool is_half(const Image& image) {
  return std::all_of(image.pixels.begin(), image.pixels.end(),
                     [](float v) { return !std::isfinite(v) || static_cast<float>(half(v)) == v; });
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

int run_recombine(const RecombineArguments& a) {
  if (!a.output.empty() && std::filesystem::path(a.output).extension() != ".exr")
    throw UsageError(fmt::format("-o {}: the layers go into an .exr file", a.output));
  const std::vector<Layer> layers = read_outputs(a.input);
  const Image& beauty = find_layer(layers, "")->image;
  Recombination r = recombine(layers);
  const RebuiltDifference simple = compare_rebuilt(r.simple, beauty, a.threshold);
  const RebuiltDifference complex = compare_rebuilt(r.complex, beauty, a.threshold);
  const bool agrees = simple.above == 0 && complex.above == 0;

  if (a.json) {
    print_json({{"agrees", agrees},
                {"threshold", a.threshold},
                {"floor", simple.floor},
                {"pixels", beauty.pixel_count()},
                {"simple", json_of(simple)},
                {"complex", json_of(complex)}});
  } else {
    print_difference("simple", simple, beauty.pixel_count(), a.threshold);
    print_difference("complex", complex, beauty.pixel_count(), a.threshold);
    if (!agrees && is_half(beauty))
      fmt::print("The file holds 16-bit floats, which carry three digits: compare a 32-bit one.\n");
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
      "recombine", "Rebuilds a render from the outputs of its materials and compares");
  auto a = std::make_shared<RecombineArguments>();
  app->add_option("IN", a->input, "EXR file of oriel render --layers outputs")->required();
  app->add_option("-o,--output", a->output,
                  "EXR file to write: layers simple, complex and difference (relative)");
  app->add_option("--threshold", a->threshold,
                  "Exit code 1 when a pixel differs by more than this share")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app->add_flag("--json", a->json, "One line of JSON");
  return {app, [a] { return run_recombine(*a); }};
}

}  // namespace oriel::app
