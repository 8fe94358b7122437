// SPDX-License-Identifier: Apache-2.0
#include "image/png.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <vector>

#include "base/durable_file.h"
#include "image/dither.h"
#include "image/picture_target.h"

namespace oriel {
namespace {

constexpr png_uint_32 kLargestPngSide = 1 << 16;
constexpr std::size_t kMaxBytes = std::size_t(1) << 30;

struct CloseFile {
  void operator()(std::FILE* f) const { std::fclose(f); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

File open_file(const std::string& path) {
  File file(std::fopen(path.c_str(), "rb"));
  if (!file) throw std::runtime_error("cannot open the file");
  return file;
}

// libpng reports errors by longjmp, which must not skip destructors. Each function that calls
// setjmp below therefore uses only objects that its caller owns.
struct Session {
  bool reading;
  png_structp png = nullptr;
  png_infop info = nullptr;
  char message[200] = "unknown libpng error";

  explicit Session(bool read) : reading(read) {
    png = read ? png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning)
               : png_create_write_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    info = png ? png_create_info_struct(png) : nullptr;
  }
  ~Session() {
    if (reading)
      png_destroy_read_struct(&png, &info, nullptr);
    else
      png_destroy_write_struct(&png, &info);
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  static void on_error(png_structp p, png_const_charp text) {
    auto* self = static_cast<Session*>(png_get_error_ptr(p));
    std::snprintf(self->message, sizeof self->message, "%s", text);
    png_longjmp(p, 1);
  }
  static void on_warning(png_structp, png_const_charp) {}
};

// --- writing ---

void write_bytes(png_structp p, png_bytep data, std::size_t size) {
  bool written = false;
  try {
    static_cast<DurableFile*>(png_get_io_ptr(p))->write(data, size);
    written = true;
  } catch (const std::exception&) {  // the file repeats the reason
  }
  if (!written) png_error(p, "the file cannot be written");
}

void flush_nothing(png_structp) {}

bool encode(Session& s, DurableFile& file, const Image& image, const PngOptions& options,
            png_bytepp rows) {
  if (setjmp(png_jmpbuf(s.png))) return false;
  constexpr int kColourType[] = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                 PNG_COLOR_TYPE_RGB_ALPHA};
  png_set_write_fn(s.png, &file, write_bytes, flush_nothing);
  png_set_user_limits(s.png, kLargestPngSide, kLargestPngSide);
  png_set_IHDR(s.png, s.info, image.width, image.height, options.bits,
               kColourType[image.channels - 1], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (options.encoding == PngEncoding::Srgb)
    png_set_sRGB_gAMA_and_cHRM(s.png, s.info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (options.encoding == PngEncoding::Gamma) png_set_gAMA(s.png, s.info, 1.0 / options.gamma);
  png_set_compression_level(s.png, 6);
  png_write_info(s.png, s.info);
  png_write_image(s.png, rows);
  png_write_end(s.png, nullptr);
  return true;
}

/// The picture as big-endian integers.
std::vector<png_byte> quantised(const Image& image, const PngOptions& options) {
  const float most = options.bits == 16 ? 65535.0f : 255.0f;
  const std::size_t bytes = options.bits / 8;
  std::vector<png_byte> out(image.pixels.size() * bytes);
  std::size_t at = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < image.channels; ++c) {
        const float value = image.at(x, y)[c];
        const float inside = value > 0 ? std::min(value, 1.0f) : 0.0f;  // NaN becomes 0
        const float shift = options.dither ? dither_offset(x, y, c) : 0.0f;
        const float step = std::clamp(std::floor(inside * most + 0.5f + shift), 0.0f, most);
        const auto integer = static_cast<unsigned>(step);
        if (bytes == 2) out[at++] = png_byte(integer >> 8);
        out[at++] = png_byte(integer & 255);
      }
  return out;
}

void write_file(const std::string& path, const Image& image, const PngOptions& options) {
  const std::size_t row_bytes = std::size_t(image.width) * image.channels * (options.bits / 8);
  std::vector<png_byte> data = quantised(image, options);
  std::vector<png_bytep> rows(image.height);
  for (int y = 0; y < image.height; ++y) rows[y] = data.data() + y * row_bytes;
  check_picture_target(path);
  DurableFile file(path);
  Session s(false);
  if (!s.info) throw std::runtime_error("libpng initialisation failed");
  const bool encoded = encode(s, file, image, options, rows.data());
  if (!encoded) file.check();
  if (!encoded) throw std::runtime_error(s.message);
  file.commit();
}

// --- reading ---

struct Shape {
  png_uint_32 width, height;
  int channels, bits;
  std::size_t row_bytes;
};

bool decode_header(Session& s, std::FILE* file, Shape& shape) {
  if (setjmp(png_jmpbuf(s.png))) return false;
  png_init_io(s.png, file);
  png_set_user_limits(s.png, kLargestPngSide, kLargestPngSide);
  png_set_chunk_malloc_max(s.png, 1 << 24);
  png_read_info(s.png, s.info);
  const int type = png_get_color_type(s.png, s.info);
  if (type == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(s.png);
  if (type == PNG_COLOR_TYPE_GRAY) png_set_expand_gray_1_2_4_to_8(s.png);
  if (png_get_valid(s.png, s.info, PNG_INFO_tRNS)) png_set_tRNS_to_alpha(s.png);
  png_set_interlace_handling(s.png);
  png_read_update_info(s.png, s.info);
  shape.width = png_get_image_width(s.png, s.info);
  shape.height = png_get_image_height(s.png, s.info);
  shape.channels = png_get_channels(s.png, s.info);
  shape.bits = png_get_bit_depth(s.png, s.info);
  shape.row_bytes = png_get_rowbytes(s.png, s.info);
  return true;
}

bool decode_pixels(Session& s, png_bytepp rows) {
  if (setjmp(png_jmpbuf(s.png))) return false;
  png_read_image(s.png, rows);
  png_read_end(s.png, nullptr);
  return true;
}

Image read_file(const std::string& path) {
  File file = open_file(path);
  Session s(true);
  if (!s.info) throw std::runtime_error("libpng initialisation failed");
  Shape shape{};
  if (!decode_header(s, file.get(), shape)) throw std::runtime_error(s.message);
  const std::size_t count = std::size_t(shape.width) * shape.height * shape.channels;
  if (count * sizeof(float) > kMaxBytes) throw std::runtime_error("its picture is too large");

  std::vector<png_byte> data(shape.row_bytes * shape.height);
  std::vector<png_bytep> rows(shape.height);
  for (png_uint_32 y = 0; y < shape.height; ++y) rows[y] = data.data() + y * shape.row_bytes;
  if (!decode_pixels(s, rows.data())) throw std::runtime_error(s.message);

  Image image(int(shape.width), int(shape.height), shape.channels);
  for (std::size_t i = 0; i < count; ++i)
    image.pixels[i] = shape.bits == 16 ? float(data[2 * i] << 8 | data[2 * i + 1]) / 65535.0f
                                       : float(data[i]) / 255.0f;
  return image;
}

}  // namespace

void write_png(const std::string& path, const Image& image, const PngOptions& options) {
  try {
    if (image.empty() || image.channels < 1 || image.channels > 4)
      throw std::runtime_error("a PNG has 1 to 4 channels and at least one pixel");
    if (options.bits != 8 && options.bits != 16)
      throw std::runtime_error("a PNG is written with 8 or 16 bits");
    if (options.encoding == PngEncoding::Gamma && !(options.gamma > 0))
      throw std::runtime_error("the gamma must be above 0");
    write_file(path, image, options);
  } catch (const std::exception& e) {
    throw std::runtime_error("cannot write '" + path + "': " + e.what());
  }
}

Image read_png(const std::string& path) {
  try {
    return read_file(path);
  } catch (const std::exception& e) {
    throw std::runtime_error("cannot read '" + path + "': " + e.what());
  }
}

}  // namespace oriel
