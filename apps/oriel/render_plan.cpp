// SPDX-License-Identifier: Apache-2.0
#include "render_plan.h"

#include <fmt/format.h>

#include <algorithm>

#include <filesystem>

#include "denoiser_option.h"
#include "numbers.h"
#include "parts.h"
#include "render/integrator.h"
#include "suggest.h"
#include "sun_scene.h"

namespace oriel::app {
namespace {

namespace fs = std::filesystem;

std::optional<scene::IndirectMethod> parse_gi(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (const IntegratorSpec* spec = find_integrator(text)) return spec->method;
  std::vector<std::string> names;
  for (const IntegratorSpec& spec : integrators()) names.emplace_back(spec.name);
  throw UsageError(fmt::format("--gi {}: {}", text, expected_one_of(text, names)));
}

UsageError unknown_layer(const std::string& name) {
  std::vector<std::string> names = {"beauty"};
  for (const std::string& layer : layer_names()) names.push_back(layer);
  names.insert(names.end(), {"outputs", "all"});
  return UsageError(fmt::format("--layers {}: {}", name, expected_one_of(name, names)));
}

LayerSet parse_layers(const std::string& text) {
  LayerSet layers;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string name = text.substr(at, end - at);
    const LayerSet layer(name);
    if (name == "all")
      layers = LayerSet::all();
    else if (name == "outputs")
      layers |= LayerSet(LayerGroup::Outputs);
    else if (layer.empty() && name != "beauty" && name != "alpha")
      throw unknown_layer(name);
    layers |= layer;
    at = end + 1;
  }
  return layers;
}

/// "key=window*,spot_??".
scene::LightGroup parse_light_group(const std::string& text) {
  const std::size_t equals = text.find('=');
  scene::LightGroup group{text.substr(0, equals), {}};
  if (equals != text.npos) group.patterns = scene::split_patterns(text.substr(equals + 1));
  const std::string complaint = scene::light_group_complaint(group);
  if (!complaint.empty())
    throw UsageError(
        fmt::format("--light-group {}: {}; expected NAME=PATTERN,PATTERN,...", text, complaint));
  return group;
}

/// "half,dwaa": precision and compression in any order.
void parse_exr(const std::string& text, RenderPlan& plan) {
  std::size_t begin = 0;
  while (begin <= text.size()) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    const auto& names = kExrCompressionNames;
    const auto known = std::find(names.begin(), names.end(), word);
    if (word == "half")
      plan.precision = ExrPrecision::HalfIfFits;
    else if (word == "float")
      plan.precision = ExrPrecision::Float;
    else if (known != names.end())
      plan.compression = static_cast<ExrCompression>(known - names.begin());
    else
      throw UsageError(fmt::format("--exr {}: unknown \"{}\"; write half or float, and {}", text,
                                   word, fmt::join(names, ", ")));
  }
}

/// Checkpoints of a part are its own file, which may be named.
void plan_part(const RenderArguments& a, RenderPlan& plan) {
  plan.part = read_part(a.part);
  if (a.time)
    throw UsageError("--part cannot be combined with --time: parts would end at different samples");
  if (!a.maps_only.empty()) throw UsageError("--maps-only computes the maps of all parts");
  plan.checkpoint.file = a.checkpoint;
  plan.checkpoint.seconds = take_checkpoint_seconds(plan.checkpoint.file);
  plan.checkpoint.resume = a.resume;
}

}  // namespace

RenderPlan render_plan(const RenderArguments& a) {
  RenderPlan plan;
  plan.gi = parse_gi(a.gi);
  plan.guiding = !a.no_guiding;
  plan.prepare.camera = a.camera;
  if (!a.size.empty()) {
    const PictureSize size = parse_size(a.size);
    plan.prepare.width = size.width, plan.prepare.height = size.height;
  }
  if (!a.crop.empty()) {
    const std::vector<int> crop = parse_integers(a.crop, ',');
    if (crop.size() != 4 || crop[2] < crop[0] || crop[3] < crop[1])
      throw UsageError(fmt::format(
          "--crop {}: expected XL,YL,XH,YH in pixels from the lower left, ends included", a.crop));
    plan.session.crop = Window{crop[0], crop[1], crop[2] + 1, crop[3] + 1};
  }
  for (const std::string& text : a.light_groups)
    scene::set_light_group(plan.prepare.light_groups, parse_light_group(text));
  if (plan.prepare.light_groups.size() > scene::kMaxLightGroups)
    throw UsageError(
        fmt::format("--light-group: the maximum is {} groups", scene::kMaxLightGroups));
  if (!a.frames.empty()) plan.frames = FrameList(a.frames);
  if (a.part.empty())
    plan.checkpoint = checkpoint_request(a.checkpoint, a.resume);
  else
    plan_part(a, plan);
  if (!a.maps.empty() && !a.maps_only.empty())
    throw UsageError("--maps reads what --maps-only writes: one of both is possible");
  if (!a.sun.empty()) plan.sun = read_sun("--sun", a.sun);
  if (a.north && !plan.sun) throw UsageError("--north requires --sun");
  if (!a.layers.empty()) plan.layers = parse_layers(a.layers);
  if (a.unit_luminance && !(*a.unit_luminance > 0))
    throw UsageError("--unit-luminance: expected a positive number");
  if (a.samples && *a.samples == 0) throw UsageError("--samples: expected at least 1");
  if (a.noise && !(*a.noise > 0)) throw UsageError("--noise: expected a positive number");
  if (a.time && !(*a.time > 0)) throw UsageError("--time: expected a positive number of seconds");
  if (!a.cryptomatte.empty()) {
    const std::vector<int> ranks = parse_integers(a.cryptomatte, ',');
    if (ranks.size() != 1 || ranks[0] > kMaxMatteRanks)
      throw UsageError(
          fmt::format("--cryptomatte: expected 0 to {} names per pixel", kMaxMatteRanks));
    plan.matte_ranks = ranks[0];
  }
  if (!a.exr.empty()) parse_exr(a.exr, plan);
  if (a.texture_cache && !(*a.texture_cache >= 16))
    throw UsageError("--texture-cache: expected at least 16 MB");
  if (a.denoise && denoiser_of(a.denoiser) == Denoiser::Oidn && !has_oidn())
    throw UserError(
        "--denoiser oidn: the library of Open Image Denoise was not found; install it, or set "
        "ORIEL_OIDN_LIBRARY to its path");
  if (a.denoise && a.samples && *a.samples < 2)
    throw UsageError("--denoise requires at least 2 samples to estimate the noise");
  plan.session.budget = {a.samples, a.noise, a.time, !a.even_samples};
  plan.session.seed = a.seed;
  for (const std::string& output : a.outputs) {
    const fs::path folder = fs::path(output).parent_path();
    if (!has_writable_suffix(output))
      throw UsageError(
          fmt::format("-o {}: unknown file type; the suffix must be one of exr, hdr, png, jpg, "
                      "tif, tga, bmp, ppm, ...",
                      output));
    if (!folder.empty() && !fs::is_directory(folder))
      throw UserError(
          fmt::format("cannot write '{}': there is no folder '{}'", output, folder.string()));
  }
  return plan;
}

}  // namespace oriel::app
