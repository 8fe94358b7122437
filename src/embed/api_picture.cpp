// SPDX-License-Identifier: Apache-2.0
// The functions of include/oriel/oriel.h that read pictures.
#include <half.h>

#include <algorithm>
#include <cstring>

#include "embed/embed_picture.h"
#include "embed/guard.h"

namespace oriel::embed {
namespace {

using interactive::LayerFormat;
using interactive::PictureLayer;

const PictureLayer& layer_of(const OrielPicture* picture, std::size_t index) {
  const auto& layers = required(picture, "picture").picture->layers;
  if (index >= layers.size())
    throw EmbedError(ORIEL_NOT_FOUND, "the picture has no layer of this number");
  return layers[index];
}

void read_floats(const PictureLayer& layer, float* to, std::size_t count) {
  const bool is_float = layer.format == LayerFormat::R32F;
  const std::size_t values = layer.pixels.size() / (is_float ? sizeof(float) : sizeof(half));
  if (count < values) throw EmbedError(ORIEL_BAD_ARGUMENT, "the buffer is too small");
  if (is_float) {
    std::memcpy(to, layer.pixels.data(), layer.pixels.size());
    return;
  }
  for (std::size_t i = 0; i < values; ++i) {
    std::uint16_t bits = 0;
    std::memcpy(&bits, layer.pixels.data() + i * sizeof bits, sizeof bits);
    half value;
    value.setBits(bits);
    to[i] = value;
  }
}

}  // namespace
}  // namespace oriel::embed

using oriel::embed::guarded;
using oriel::embed::required;

extern "C" {

void oriel_picture_release(OrielPicture* picture) { delete picture; }

OrielResult oriel_picture_info(const OrielPicture* picture, OrielPictureInfo* info) {
  return guarded([&] {
    const oriel::interactive::Picture& p = *required(picture, "picture").picture;
    OrielPictureInfo known{};
    known.size = required(info, "info").size;
    known.epoch = p.epoch;
    known.number = p.number;
    known.preview = p.preview;
    known.divider = p.divider;
    known.width = p.width, known.height = p.height;
    known.x = p.x, known.y = p.y, known.w = p.w, known.h = p.h;
    known.samples = p.samples;
    known.layer_count = p.layers.size();
    std::memcpy(info, &known, std::min(known.size, sizeof known));
  });
}

OrielResult oriel_picture_layer(const OrielPicture* picture, size_t index, OrielLayer* layer) {
  return guarded([&] {
    const auto& from = oriel::embed::layer_of(picture, index);
    OrielLayer known{};
    known.size = required(layer, "layer").size;
    known.name = from.name.c_str();
    known.format = from.format == oriel::interactive::LayerFormat::R32F ? ORIEL_FORMAT_FLOAT
                                                                        : ORIEL_FORMAT_HALF_RGB;
    known.pixels = from.pixels.data();
    known.bytes = from.pixels.size();
    std::memcpy(layer, &known, std::min(known.size, sizeof known));
  });
}

OrielResult oriel_picture_read(const OrielPicture* picture, size_t index, float* to, size_t count) {
  return guarded([&] {
    oriel::embed::read_floats(oriel::embed::layer_of(picture, index), &required(to, "to"), count);
  });
}

}  // extern "C"
