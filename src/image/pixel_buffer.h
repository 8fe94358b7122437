// SPDX-License-Identifier: Apache-2.0
// A picture in memory: float pixels with interleaved channels, and named render layers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace oriel {

// Conventions
//   Row 0 is the top row of the picture, x runs to the right, channels are interleaved. The pixel
//   buffer does not record whether its values are linear or display-encoded.

struct Image {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<float> pixels;  ///< height x width x channels

  Image() = default;
  Image(int w, int h, int c, float value = 0)
      : width(w), height(h), channels(c), pixels(std::size_t(w) * h * c, value) {}

  std::size_t offset(int x, int y) const { return (std::size_t(y) * width + x) * channels; }
  float* at(int x, int y) { return pixels.data() + offset(x, y); }
  const float* at(int x, int y) const { return pixels.data() + offset(x, y); }
  bool empty() const { return pixels.empty(); }
  std::size_t pixel_count() const { return std::size_t(width) * height; }
};

/// One layer of a picture. The beauty has an empty name. If the only channel of a layer has an
/// empty name, its full name is the name of the layer ("Z").
struct Layer {
  std::string name;
  std::vector<std::string> channel_names;  ///< as many as image.channels
  Image image;
  bool exact = false;  ///< data, not colour: files contain it in 32 bits and without loss
};

/// The layer with the given name, or null.
inline const Layer* find_layer(const std::vector<Layer>& layers, const std::string& name) {
  for (const Layer& layer : layers)
    if (layer.name == name) return &layer;
  return nullptr;
}

/// Layer with the linear beauty, in files whose beauty was mapped by lens or output shaders.
inline constexpr const char* kLinearLayer = "linear";

/// The linear beauty of a file, or null if the file has none.
inline const Layer* find_linear_beauty(const std::vector<Layer>& layers) {
  const Layer* linear = find_layer(layers, kLinearLayer);
  return linear ? linear : find_layer(layers, "");
}

}  // namespace oriel
