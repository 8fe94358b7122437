// SPDX-License-Identifier: Apache-2.0
#include "sdk/picture.h"

#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

#include "image/rgbe.h"

namespace oriel::sdk {
namespace {

constexpr TypeTraits kTypes[miIMG_NTYPES] = {{"rgba", 4, Storage::U8},
                                             {"rgba_16", 4, Storage::U16},
                                             {"rgb", 3, Storage::U8},
                                             {"rgb_16", 3, Storage::U16},
                                             {"a", 1, Storage::U8},
                                             {"a_16", 1, Storage::U16},
                                             {"s", 1, Storage::U8},
                                             {"s_16", 1, Storage::U16},
                                             {"vta", 2, Storage::Float},
                                             {"vts", 2, Storage::Float},
                                             {"z", 1, Storage::Float},
                                             {"n", 3, Storage::Float},
                                             {"tag", 1, Storage::Label},
                                             {"rgba_fp", 4, Storage::Float},
                                             {"m", 3, Storage::Float},
                                             {"bit", 1, Storage::U8},
                                             {"rgb_fp", 3, Storage::Float},
                                             {"coverage", 1, Storage::Float},
                                             {"rgbe", 4, Storage::SharedExponent},
                                             {"a_fp", 1, Storage::Float},
                                             {"s_fp", 1, Storage::Float},
                                             {"rgba_h", 4, Storage::Half},
                                             {"rgb_h", 3, Storage::Half}};

template <class T>
T load(const unsigned char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}
template <class T>
void store(unsigned char* at, T value) {
  std::memcpy(at, &value, sizeof value);
}

/// NaN becomes 0.
template <class T>
T quantized(float value, float largest) {
  return static_cast<T>(std::lround((value > 0 ? std::min(value, 1.0f) : 0.0f) * largest));
}

bool is_alpha(miImg_type type) {
  return type == miIMG_TYPE_A || type == miIMG_TYPE_A_16 || type == miIMG_TYPE_A_FP;
}

}  // namespace

const TypeTraits& traits_of(miImg_type type) {
  return kTypes[type >= 0 && type < miIMG_NTYPES ? type : miIMG_TYPE_RGBA];
}

int bytes_of(Storage storage) {
  switch (storage) {
    case Storage::U16:
    case Storage::Half:
      return 2;
    case Storage::Float:
    case Storage::Label:
      return 4;
    default:
      return 1;
  }
}

std::size_t Picture::bytes_of_pixels(miImg_type type, int width, int height) {
  const TypeTraits& traits = traits_of(type);
  return static_cast<std::size_t>(std::max(width, 0)) *
         static_cast<std::size_t>(std::max(height, 0)) *
         static_cast<std::size_t>(traits.components * bytes_of(traits.storage));
}

Picture::Picture(miImg_type its_type, int its_width, int its_height)
    : Picture(its_type, its_width, its_height, nullptr) {
  own_.resize(bytes_of_pixels(its_type, its_width, its_height));
  pixels_ = own_.data();
}

Picture* Picture::in_one_block(miImg_type type, int width, int height) {
  void* const block = std::calloc(1, sizeof(Picture) + bytes_of_pixels(type, width, height));
  if (!block) return nullptr;
  return new (block)
      Picture(type, width, height, static_cast<unsigned char*>(block) + sizeof(Picture));
}

Picture::Picture(miImg_type its_type, int its_width, int its_height, unsigned char* pixels)
    : miImg_image{}, pixels_(pixels) {
  const TypeTraits& traits = traits_of(its_type);
  storage_ = traits.storage;
  type = its_type;
  width = std::max(its_width, 0);
  height = std::max(its_height, 0);
  comp = traits.components;
  bits = 8 * bytes_of(storage_);
  local = writable = miTRUE;
  const int line = width * bytes_of(storage_);
  for (int k = 0; k < 4; ++k) c[k] = k < comp ? k * line : 0;
}

unsigned char* Picture::row(int y, int component) {
  const std::size_t line =
      static_cast<std::size_t>(width) * static_cast<std::size_t>(bytes_of(storage_));
  const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(comp) +
                  static_cast<std::size_t>(component);
  return pixels_ + at * line;
}

float Picture::number(int x, int y, int component) {
  const unsigned char* at = row(y, component) + static_cast<std::ptrdiff_t>(x) * bytes_of(storage_);
  switch (storage_) {
    case Storage::U16:
      return static_cast<float>(load<std::uint16_t>(at)) / 65535;
    case Storage::Half:
      return load<half>(at);
    case Storage::Float:
      return load<float>(at);
    case Storage::Label:
      return static_cast<float>(load<miUint>(at));
    default:
      return static_cast<float>(*at) / 255;
  }
}

void Picture::set_number(int x, int y, int component, float value) {
  unsigned char* at = row(y, component) + static_cast<std::ptrdiff_t>(x) * bytes_of(storage_);
  switch (storage_) {
    case Storage::U16:
      return store(at, quantized<std::uint16_t>(value, 65535));
    case Storage::Half:
      return store(at, half(value));
    case Storage::Float:
      return store(at, value);
    case Storage::Label:
      return store(at, value > 0 ? static_cast<miUint>(std::min(value, 4e9f)) : 0u);
    default:
      return store(at, quantized<std::uint8_t>(value, 255));
  }
}

Rgba Picture::colour(int x, int y) {
  if (storage_ == Storage::SharedExponent) {
    const Rgb c = decode_rgbe({row(y, 0)[x], row(y, 1)[x], row(y, 2)[x], row(y, 3)[x]});
    return Rgba(c.x, c.y, c.z, 1);
  }
  const float first = number(x, y, 0);
  if (comp == 1) return Rgba(first, first, first, is_alpha(type) ? first : 1);
  return Rgba(first, number(x, y, 1), comp > 2 ? number(x, y, 2) : 0,
              comp > 3 ? number(x, y, 3) : 1);
}

void Picture::set_colour(int x, int y, const Rgba& v) {
  if (storage_ == Storage::SharedExponent) {
    const Rgbe code = encode_rgbe(rgb(v));
    for (int k = 0; k < 4; ++k) row(y, k)[x] = code[static_cast<std::size_t>(k)];
    return;
  }
  if (comp == 1) return set_number(x, y, 0, is_alpha(type) ? v.a : (v.r + v.g + v.b) * (1.0f / 3));
  for (int k = 0; k < comp; ++k) set_number(x, y, k, v[k]);
}

Vec3 Picture::vector(int x, int y) {
  if (storage_ != Storage::SharedExponent && comp < 3)
    return Vec3(number(x, y, 0), comp > 1 ? number(x, y, 1) : 0, 0);
  const Rgba pixel = colour(x, y);
  return Vec3(pixel.r, pixel.g, pixel.b);
}

void Picture::set_vector(int x, int y, const Vec3& v) {
  if (comp == 1) return set_number(x, y, 0, v.x);
  set_colour(x, y, Rgba(v.x, v.y, v.z, 1));
}

Image to_image(Picture& picture) {
  const bool shared = traits_of(picture.type).storage == Storage::SharedExponent;
  const int channels = shared ? 3 : picture.comp;
  Image image(picture.width, picture.height, channels);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      float* pixel = image.at(x, picture.height - 1 - y);
      const Rgba c = shared ? picture.colour(x, y) : Rgba(0);
      for (int k = 0; k < channels; ++k) pixel[k] = shared ? c[k] : picture.number(x, y, k);
    }
  return image;
}

void fill_row(Picture& picture, const Image& image, int y) {
  const int width = std::min(picture.width, image.width);
  if (y < 0 || y >= std::min(picture.height, image.height)) return;
  for (int x = 0; x < width; ++x) {
    const float* p = image.at(x, image.height - 1 - y);
    const bool grey = image.channels < 3;
    const float alpha = image.channels % 2 == 0 ? p[image.channels - 1] : 1;
    picture.set_colour(x, y, grey ? Rgba(p[0], p[0], p[0], alpha) : Rgba(p[0], p[1], p[2], alpha));
  }
}

void fill(Picture& picture, const Image& image) {
  for (int y = 0; y < picture.height; ++y) fill_row(picture, image, y);
}

std::unique_ptr<Picture> halved(Picture& picture) {
  auto half =
      std::make_unique<Picture>(picture.type, (picture.width + 1) / 2, (picture.height + 1) / 2);
  for (int y = 0; y < half->height; ++y)
    for (int x = 0; x < half->width; ++x) {
      const int left = 2 * x, right = std::min(left + 1, picture.width - 1);
      const int low = 2 * y, high = std::min(low + 1, picture.height - 1);
      if (traits_of(picture.type).storage == Storage::Label) {
        std::memcpy(half->row(y, 0) + sizeof(miUint) * static_cast<std::size_t>(x),
                    picture.row(low, 0) + sizeof(miUint) * static_cast<std::size_t>(left),
                    sizeof(miUint));
        continue;
      }
      half->set_colour(x, y,
                       (picture.colour(left, low) + picture.colour(right, low) +
                        picture.colour(left, high) + picture.colour(right, high)) *
                           0.25f);
    }
  return half;
}

}  // namespace oriel::sdk
