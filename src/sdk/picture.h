// SPDX-License-Identifier: Apache-2.0
// Images of shaders: miImg_image with its pixels.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "base/vec.h"
#include "image/pixel_buffer.h"
#include "oriel/sdk/shader/image.h"

namespace oriel::sdk {

/// Storage type of a component.
enum class Storage { U8, U16, Half, Float, Label, SharedExponent };

struct TypeTraits {
  char name[12];  ///< name in scenes
  int components;
  Storage storage;
};
/// Traits of a type; those of RGBA for invalid types.
const TypeTraits& traits_of(miImg_type type);
int bytes_of(Storage storage);

// Conventions
//   y counts from the bottom. A row stores its components one after the other, each for all x.
//   Integers represent 0...1; larger values are clipped.
struct Picture : miImg_image {
  Picture(miImg_type its_type, int its_width, int its_height);
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  /// A picture in one block of malloc, including the pixels, so that free() deletes it. Null if out
  /// of memory.
  static Picture* in_one_block(miImg_type type, int width, int height);
  /// Mip levels at 1/2, 1/4, ... of the size, created on demand.
  std::vector<std::unique_ptr<Picture>> levels;

  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  unsigned char* row(int y, int component);
  float number(int x, int y, int component);
  void set_number(int x, int y, int component, float value);

  /// Grey types fill all channels; types without alpha return 1.
  Rgba colour(int x, int y);
  void set_colour(int x, int y, const Rgba& value);
  Vec3 vector(int x, int y);
  void set_vector(int x, int y, const Vec3& value);

 private:
  Picture(miImg_type its_type, int its_width, int its_height, unsigned char* pixels);
  static std::size_t bytes_of_pixels(miImg_type type, int width, int height);

  Storage storage_;
  std::vector<unsigned char> own_;  ///< empty if the pixels follow in the same block
  unsigned char* pixels_ = nullptr;
};

/// Conversions to and from pictures of the renderer, whose rows start at the top.
Image to_image(Picture& picture);
void fill(Picture& picture, const Image& image);
/// Copies row y, counted from the bottom in both.
void fill_row(Picture& picture, const Image& image, int y);
/// The next mip level by means of four pixels; labels use the first of the four.
std::unique_ptr<Picture> halved(Picture& picture);

}  // namespace oriel::sdk
