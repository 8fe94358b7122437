// SPDX-License-Identifier: Apache-2.0
// Test support: an image with all outputs of a material that sum to it.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "image/pixel_buffer.h"

namespace oriel {

/// A beauty (R, G, B, A) and its outputs: levels and raw light vary from pixel to pixel, results
/// are their products, and the beauty is what both sums give, in double and then rounded.
inline std::vector<Layer> output_layers(int width, int height) {
  std::vector<Layer> layers = {{"", {"R", "G", "B", "A"}, Image(width, height, 4, 1)},
                               {"opacity", {""}, Image(width, height, 1)}};
  const auto colour = [&](const std::string& name, auto value) -> const Image& {
    Image image(width, height, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      image.pixels[i] = static_cast<float>(value(i));
    return layers.emplace_back(Layer{name, {"R", "G", "B"}, std::move(image)}).image;
  };
  // double: the sum is the truth that float sums are held against.
  std::vector<double> sum(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3);
  const auto wave = [](std::size_t i, double phase) {
    return 0.5 + 0.45 * std::sin(0.37 * double(i) + phase);
  };
  const auto add = [&](const std::string& name, auto value) {
    const Image& image = colour(name, value);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += double(image.pixels[i]);
  };
  layers.reserve(32);
  double phase = 0;
  for (const std::string part : {"diffuse", "spec", "refl", "refr", "tran"}) {
    phase += 1;
    const auto level = [=](std::size_t i) { return wave(i, phase); };
    const auto raw = [=](std::size_t i) { return 4 * wave(i, 2 * phase); };
    colour(part + "_level", level);
    colour(part + "_raw", raw);
    add(part + "_result", [&](std::size_t i) { return level(i) * raw(i); });
  }
  colour("indirect_raw", [&](std::size_t i) { return wave(i, 7); });
  colour("ao_raw", [&](std::size_t i) { return wave(i, 8); });
  colour("indirect_post_ao", [&](std::size_t i) { return wave(i, 7) * wave(i, 8); });
  add("indirect_result", [&](std::size_t i) { return wave(i, 1) * wave(i, 7) * wave(i, 8); });
  for (std::size_t i = 0; i < layers[1].image.pixels.size(); ++i)
    layers[1].image.pixels[i] = static_cast<float>(wave(i, 9));
  colour("opacity_raw", [&](std::size_t i) { return wave(i, 10); });
  add("opacity_result", [&](std::size_t i) { return (1 - wave(i / 3, 9)) * wave(i, 10); });
  add("add_result", [&](std::size_t i) { return 0.1 * wave(i, 11); });
  add("other", [&](std::size_t i) { return 0.2 * wave(i, 12); });
  for (std::size_t i = 0; i < sum.size(); ++i)
    layers[0].image.pixels[i / 3 * 4 + i % 3] = static_cast<float>(sum[i]);
  colour("result", [&](std::size_t i) { return sum[i]; });
  return layers;
}

}  // namespace oriel
