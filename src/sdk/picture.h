// SPDX-License-Identifier: Apache-2.0
// Images that shaders hold: miImg_image with its pixels.
#pragma once

#include <cstddef>
#include <vector>

#include "base/vec.h"
#include "image/pixel_buffer.h"
#include "oriel/sdk/shader/image.h"

namespace oriel::sdk {

/// How the numbers of an image type are kept.
enum class Storage { U8, U16, Half, Float, Label, SharedExponent };

struct TypeTraits {
  char name[12];  ///< in scenes
  int components;
  Storage storage;
};
/// Those of RGBA for types that are none.
const TypeTraits& traits_of(miImg_type type);
int bytes_of(Storage storage);

// Conventions
//   y counts from the bottom. A row holds its components one after the other, each for all x.
//   Integers stand for 0...1 and clip.
struct Picture : miImg_image {
  Picture(miImg_type its_type, int its_width, int its_height);
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;
  /// A picture in one block of malloc, pixels included: free() may end it. Null without memory.
  static Picture* in_one_block(miImg_type type, int width, int height);
  /// At half, a quarter, ... of the width and height, as far as they were asked for.
  std::vector<std::unique_ptr<Picture>> levels;

  bool holds(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  unsigned char* row(int y, int component);
  float number(int x, int y, int component);
  void set_number(int x, int y, int component, float value);

  /// Grey types fill the channels, those without alpha have 1.
  Rgba colour(int x, int y);
  void set_colour(int x, int y, const Rgba& value);
  Vec3 vector(int x, int y);
  void set_vector(int x, int y, const Vec3& value);

 private:
  Picture(miImg_type its_type, int its_width, int its_height, unsigned char* pixels);
  static std::size_t bytes_of_pixels(miImg_type type, int width, int height);

  Storage storage_;
  std::vector<unsigned char> own_;  ///< empty where the pixels follow in the block
  unsigned char* pixels_ = nullptr;
};

/// Scanned from the top, as the renderer keeps pictures, and back.
Image to_image(Picture& picture);
void fill(Picture& picture, const Image& image);
/// The row y of both, counted from the bottom.
void fill_row(Picture& picture, const Image& image, int y);
/// Half as wide and high, by the mean of four pixels; labels are those of the first.
std::unique_ptr<Picture> halved(Picture& picture);

}  // namespace oriel::sdk
