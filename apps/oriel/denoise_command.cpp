// SPDX-License-Identifier: Apache-2.0
// oriel denoise: takes the noise out of a finished render, from the layers of its own file.
#include "denoise/denoise.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/parallel.h"
#include "command.h"
#include "denoiser_option.h"
#include "image/exr.h"
#include "image/files.h"
#include "image/relight.h"
#include "pictures.h"

namespace oriel::app {
namespace {

struct DenoiseArguments {
  std::string input, output;
  float strength = 1;
  std::string denoiser;
  int threads = 0;
};

int run_denoise(const DenoiseArguments& a) {
  if (!is_linear_file(a.output))
    throw UsageError(fmt::format(
        "-o {}: the result is linear and requires .exr or .hdr; convert it by oriel tonemap",
        a.output));
  if (!std::filesystem::is_regular_file(a.input))
    throw UserError(fmt::format("cannot read '{}': there is no such file", a.input));
  const ThreadLimit limit(a.threads);
  const ExrFile file = read_exr(a.input);
  DenoiseInput input = denoise_input(file.layers);
  if (!input.color || (!input.variance && !input.half_difference))
    throw UserError(fmt::format(
        "{}: the noise estimate is missing (layer 'variance' or 'halves'); render with all layers",
        a.input));
  const bool exr = std::filesystem::path(a.output).extension() == ".exr";
  const std::vector<std::string> groups =
      exr ? light_layer_names(file.layers) : std::vector<std::string>();
  if (exr)
    for (const Layer* light : light_layers(file.layers)) input.parts.push_back(&light->image);
  DenoisedPicture denoised =
      denoise_with_parts(input, {.denoiser = denoiser_of(a.denoiser), .strength = a.strength});
  if (!denoised.note.empty())
    fmt::print(stderr, "oriel: warning: {}; Oriel's own denoiser was used\n", denoised.note);
  Image& image = denoised.color;
  std::vector<std::string> names = find_linear_beauty(file.layers)->channel_names;
  if (!exr) {
    write_image(a.output, image, {.format = SampleFormat::Float});
    return kExitDone;
  }
  ExrOptions options;
  options.metadata = file.metadata;
  options.metadata["oriel.denoised"] = a.strength;
  options.metadata["oriel.denoiser"] = denoised.denoiser;
  std::vector<Layer> layers;
  layers.push_back({"", std::move(names), std::move(image)});
  for (std::size_t i = 0; i < groups.size(); ++i)
    layers.push_back({std::string(kLightLayerPrefix) + groups[i],
                      {"R", "G", "B"},
                      std::move(denoised.parts[i])});
  write_exr(a.output, layers, options);
  return kExitDone;
}

}  // namespace

Command add_denoise_command(CLI::App& program) {
  CLI::App* app =
      program.add_subcommand("denoise",
                             "Denoise a render from its EXR layers. Light groups of the file are "
                             "denoised with the same weights: "
                             "they sum to the picture and can be recombined with other strengths");
  auto a = std::make_shared<DenoiseArguments>();
  app->add_option("IN", a->input, "EXR file of oriel render, with its layers")->required();
  app->add_option("-o,--output", a->output, "Linear picture to write: .exr or .hdr")->required();
  app->add_option("--strength", a->strength,
                  "Strength of denoising (default 1); larger values blur more")
      ->check(CLI::Range(0.1f, 10.0f))
      ->capture_default_str();
  add_denoiser_option(*app, a->denoiser);
  app->add_option("--threads", a->threads, "Number of threads, 0 = all (default 0)")
      ->check(CLI::Range(0, 4096));
  return {app, [a] { return run_denoise(*a); }};
}

}  // namespace oriel::app
