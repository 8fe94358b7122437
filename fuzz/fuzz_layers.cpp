// SPDX-License-Identifier: Apache-2.0
// Layers of any shape, number and values under the names that commands look for: what the fuzzer
// `exr` reaches through intact files alone.
#include "file.h"
#include "fuzzers.h"
#include "process_layers.h"

int oriel::fuzz::fuzz_layers(const std::uint8_t* data, std::size_t size) {
  constexpr const char* kNames[] = {"",
                                    "linear",
                                    "variance",
                                    "halves",
                                    "albedo",
                                    "normal",
                                    "Z",
                                    "light_key",
                                    "light.key",
                                    "light_rest",
                                    "other",
                                    "opacity",
                                    "add_result",
                                    "spec_raw",
                                    "spec_level",
                                    "refl_raw",
                                    "refl_level",
                                    "refr_raw",
                                    "refr_level",
                                    "tran_raw",
                                    "tran_level",
                                    "diffuse_raw",
                                    "spec_result",
                                    "refl_result",
                                    "refr_result",
                                    "tran_result",
                                    "opacity_raw",
                                    "diffuse_level",
                                    "opacity_result",
                                    "diffuse_result",
                                    "indirect_result",
                                    "indirect_post_ao"};
  constexpr std::size_t kMaxSide = 24, kMaxLayers = 40, kMaxChannels = 5;
  Numbers numbers(data, size);
  const int width = static_cast<int>(numbers.below(kMaxSide));
  const int height = static_cast<int>(numbers.below(kMaxSide));
  std::vector<Layer> layers;
  while (!numbers.at_end() && layers.size() < kMaxLayers) {
    const std::size_t name = numbers.next<std::uint8_t>(), shape = numbers.next<std::uint8_t>();
    Layer layer;
    layer.name = kNames[name % std::size(kNames)];
    const int channels = static_cast<int>(shape % kMaxChannels);
    layer.image = shape < 250 ? Image(width, height, channels) : Image(height, width, channels);
    for (int c = 0; c < channels; ++c) layer.channel_names.emplace_back(1, "RGBAX"[c]);
    // Few values, so that inputs are short.
    float values[3];
    for (float& value : values) value = numbers.next<float>();
    for (std::size_t i = 0; i < layer.image.pixels.size(); ++i)
      layer.image.pixels[i] = values[i * i / 7 % std::size(values)];
    layers.push_back(std::move(layer));
  }
  process_layers(layers);
  return 0;
}
