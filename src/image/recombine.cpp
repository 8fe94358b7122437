// SPDX-License-Identifier: Apache-2.0
#include "image/recombine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace oriel {
namespace {

/// Layers used by the two sums, except `opacity`.
constexpr const char* kColours[] = {"diffuse_result",  "diffuse_raw",      "diffuse_level",
                                    "spec_result",     "spec_raw",         "spec_level",
                                    "refl_result",     "refl_raw",         "refl_level",
                                    "refr_result",     "refr_raw",         "refr_level",
                                    "tran_result",     "tran_raw",         "tran_level",
                                    "indirect_result", "indirect_post_ao", "add_result",
                                    "opacity_result",  "opacity_raw",      "other"};

std::string with_unit(int channels) {
  return std::to_string(channels) + (channels == 1 ? " channel" : " channels");
}

std::string size_of(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels";
}

/// Why a layer with this channel count cannot be used; empty if it can.
std::string complaint(const std::vector<Layer>& layers, const std::string& name, int channels) {
  const Layer* layer = find_layer(layers, name);
  if (!layer) return name + " is missing";
  if (layer->image.channels != channels)
    return name + " has " + with_unit(layer->image.channels) + " instead of " +
           std::to_string(channels);
  const Layer* beauty = find_linear_beauty(layers);
  if (beauty && size_of(layer->image) != size_of(beauty->image))
    return name + " has " + size_of(layer->image) + ", the picture " + size_of(beauty->image);
  return {};
}

/// A sum of RGB layers of equal size.
class Sum {
 public:
  explicit Sum(const std::vector<Layer>& layers) : layers_(layers) {
    const Image& beauty = find_linear_beauty(layers)->image;
    total = Image(beauty.width, beauty.height, 3);
  }
  const Image& image(const std::string& name) const { return find_layer(layers_, name)->image; }

  void add(const std::string& name) {
    const Image& a = image(name);
    for (std::size_t i = 0; i < total.pixels.size(); ++i) total.pixels[i] += a.pixels[i];
  }
  void add_product(const std::string& level, const std::string& raw) {
    const Image &a = image(level), &b = image(raw);
    for (std::size_t i = 0; i < total.pixels.size(); ++i)
      total.pixels[i] += a.pixels[i] * b.pixels[i];
  }
  void add_diffuse() {
    const Image &level = image("diffuse_level"), &direct = image("diffuse_raw"),
                &indirect = image("indirect_post_ao");
    for (std::size_t i = 0; i < total.pixels.size(); ++i)
      total.pixels[i] += level.pixels[i] * (direct.pixels[i] + indirect.pixels[i]);
  }
  void add_background() {
    const Image &opacity = image("opacity"), &raw = image("opacity_raw");
    for (std::size_t i = 0; i < total.pixels.size(); ++i)
      total.pixels[i] += (1 - opacity.pixels[i / 3]) * raw.pixels[i];
  }

  Image total;

 private:
  const std::vector<Layer>& layers_;
};

/// Minimum brightness for relative differences.
float brightness_floor(const Image& beauty) {
  // double: a sum over tens of millions of values.
  double sum = 0;
  std::size_t count = 0;
  const auto channels = static_cast<std::size_t>(beauty.channels);
  for (std::size_t i = 0; i < beauty.pixels.size(); ++i)
    if (i % channels < 3 && std::isfinite(beauty.pixels[i])) {
      sum += double(std::abs(beauty.pixels[i]));
      ++count;
    }
  const double mean = count ? sum / double(count) : 0;
  // In a black picture any positive value counts as an error.
  return std::max(kRecombineFloorShare * static_cast<float>(mean),
                  std::numeric_limits<float>::min());
}

}  // namespace

std::vector<std::string> unusable_outputs(const std::vector<Layer>& layers) {
  std::vector<std::string> wrong;
  const Layer* beauty = find_linear_beauty(layers);
  if (!beauty)
    wrong.emplace_back("the beauty layer (R, G, B) is missing");
  else if (beauty->image.channels < 3)
    wrong.push_back("the beauty layer has " + with_unit(beauty->image.channels) + " instead of 3");
  const auto look_at = [&](const std::string& name, int channels) {
    std::string text = complaint(layers, name, channels);
    if (!text.empty()) wrong.push_back(std::move(text));
  };
  for (const char* name : kColours) look_at(name, 3);
  look_at("opacity", 1);
  return wrong;
}

Recombination recombine(const std::vector<Layer>& layers) {
  const std::vector<std::string> wrong = unusable_outputs(layers);
  if (!wrong.empty()) throw std::runtime_error("the layers cannot be used: " + wrong.front());

  Sum simple(layers);
  for (const char* name : {"diffuse_result", "indirect_result", "spec_result", "refl_result",
                           "refr_result", "tran_result", "add_result", "opacity_result", "other"})
    simple.add(name);

  Sum complex(layers);
  complex.add_diffuse();
  for (const std::string part : {"spec", "refl", "refr", "tran"})
    complex.add_product(part + "_level", part + "_raw");
  complex.add("add_result");
  complex.add_background();
  complex.add("other");
  return {std::move(simple.total), std::move(complex.total)};
}

Image relative_difference(const Image& rebuilt, const Image& beauty) {
  if (rebuilt.channels != 3 || beauty.channels < 3 || size_of(rebuilt) != size_of(beauty))
    throw std::runtime_error("the rebuilt picture and the beauty differ in shape");
  const float floor = brightness_floor(beauty);
  Image out(rebuilt.width, rebuilt.height, 3);
  const auto stride = static_cast<std::size_t>(beauty.channels);
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    const float a = rebuilt.pixels[i], b = beauty.pixels[i / 3 * stride + i % 3];
    out.pixels[i] = std::isfinite(a) && std::isfinite(b)
                        ? std::abs(a - b) / std::max(std::abs(b), floor)
                        : std::numeric_limits<float>::infinity();
  }
  return out;
}

RebuiltDifference compare_rebuilt(const Image& rebuilt, const Image& beauty, float threshold) {
  const Image difference = relative_difference(rebuilt, beauty);
  RebuiltDifference out;
  out.floor = brightness_floor(beauty);
  std::size_t worst = 0;
  for (std::size_t pixel = 0; pixel < difference.pixel_count(); ++pixel) {
    bool above = false;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      above |= difference.pixels[i] > threshold;
      if (difference.pixels[i] > difference.pixels[worst]) worst = i;
    }
    out.above += above;
  }
  if (difference.empty()) return out;
  const auto width = static_cast<std::size_t>(difference.width);
  out.largest = difference.pixels[worst];
  out.x = static_cast<int>(worst / 3 % width);
  out.y = static_cast<int>(worst / 3 / width);
  out.channel = static_cast<int>(worst % 3);
  out.rebuilt = rebuilt.pixels[worst];
  out.beauty = beauty.at(out.x, out.y)[out.channel];
  return out;
}

}  // namespace oriel
