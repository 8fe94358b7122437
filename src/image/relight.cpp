// SPDX-License-Identifier: Apache-2.0
#include "image/relight.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "base/diagnostic.h"
#include "base/math.h"
#include "color/luminance.h"

namespace oriel {
namespace {

constexpr std::array<std::string_view, 4> kKept = {"Z", "normal", "albedo", "samples"};

/// Files of earlier versions have nested names.
constexpr std::string_view kOldPrefix = "light.";
static_assert(kOldPrefix.size() == kLightLayerPrefix.size());

bool is_light(const Layer& layer) {
  return layer.name.starts_with(kLightLayerPrefix) || layer.name.starts_with(kOldPrefix);
}

}  // namespace

std::vector<const Layer*> light_layers(const std::vector<Layer>& layers) {
  std::vector<const Layer*> lights;
  for (const Layer& layer : layers)
    if (is_light(layer)) lights.push_back(&layer);
  return lights;
}

std::vector<std::string> light_layer_names(const std::vector<Layer>& layers) {
  std::vector<std::string> names;
  for (const Layer* layer : light_layers(layers))
    names.push_back(layer->name.substr(kLightLayerPrefix.size()));
  return names;
}

Rgb tinted(float factor, float warmth) {
  const Rgb tint(math::exp2(warmth), 1, math::exp2(-warmth));
  return tint * (factor / luminance(tint));
}

std::vector<Layer> relight(const std::vector<Layer>& layers, const std::vector<LightGain>& gains) {
  const Layer* beauty = find_linear_beauty(layers);
  if (!beauty || beauty->image.channels < 3)
    throw std::runtime_error("the beauty layer (R, G, B) is missing");
  const std::vector<std::string> names = light_layer_names(layers);
  if (names.empty())
    throw std::runtime_error(
        "there are no light layers; write them with oriel render SCENE -o FILE.exr "
        "--light-group NAME=PATTERNS");
  for (const LightGain& gain : gains)
    if (std::find(names.begin(), names.end(), gain.name) == names.end()) {
      std::string list;
      for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
      const std::string near = nearest_name(gain.name, names);
      throw std::runtime_error("unknown light group \"" + gain.name + "\": expected one of " +
                               list + (near.empty() ? "" : "; did you mean " + near + "?"));
    }
  std::vector<Layer> out{*beauty};
  Image sum = beauty->image;
  const auto channels = static_cast<std::size_t>(sum.channels);
  for (std::size_t i = 0; i < sum.pixel_count(); ++i) std::fill_n(&sum.pixels[i * channels], 3, 0);
  for (const Layer& layer : layers)
    if (std::find(kKept.begin(), kKept.end(), layer.name) != kKept.end()) out.push_back(layer);
  for (const Layer& layer : layers) {
    if (!is_light(layer)) continue;
    if (layer.image.channels != 3 || layer.image.pixel_count() != sum.pixel_count())
      throw std::runtime_error(layer.name + " differs from the beauty in size or channels");
    Rgb factor(1);
    for (const LightGain& gain : gains)
      if (layer.name.substr(kLightLayerPrefix.size()) == gain.name) factor *= gain.factor;
    Layer scaled = layer;
    for (std::size_t i = 0; i < sum.pixel_count(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        float& value = scaled.image.pixels[3 * i + c];
        value *= factor[static_cast<int>(c)];
        sum.pixels[i * channels + c] += value;
      }
    out.push_back(std::move(scaled));
  }
  out.front().image = std::move(sum);
  return out;
}

}  // namespace oriel
