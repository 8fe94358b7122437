// SPDX-License-Identifier: Apache-2.0
// Textures: filtered lookups in image files (cached by OpenImageIO) and in pixels from the scene.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>

#include "base/vec.h"

namespace oriel {

// Conventions
//   uv (0, 0) is the lower left corner of the picture, u to the right, v up; the centre of texel
//   (i, j) from below lies at ((i + 0.5) / width, (j + 0.5) / height).
//   Values are those of the file: colour and alpha as stored, without (un)premultiplication. A
//   picture without alpha has alpha 1; a grey picture has its value in R, G and B.

enum class Wrap : std::uint8_t {
  Black,     ///< outside [0, 1): transparent black, with a hard border
  Periodic,  ///< repeats
  Clamp,     ///< the border texel is repeated
  Mirror,    ///< repeats, every second copy mirrored
};

enum class Interpolation : std::uint8_t { Nearest, Bilinear };

/// Filter settings.
struct TextureSampling {
  Wrap wrap_u = Wrap::Periodic;
  Wrap wrap_v = Wrap::Periodic;
  Interpolation interpolation = Interpolation::Bilinear;
  float anisotropy = 16;  ///< maximum ratio of the filter axes; beyond it the result is blurred
};

/// The footprint of a pixel: change of uv per pixel step in x and y. All zero disables filtering;
/// the full resolution is interpolated.
struct TextureFootprint {
  Vec2 dx{0, 0}, dy{0, 0};
};

class Texture {
 public:
  virtual ~Texture() = default;

  /// The filtered colour. Thread-safe; never throws. Returns transparent black if uv is not finite.
  /// Returns magenta if the file turns out to be invalid; error() then has the reason.
  /// Checked: Texture.*
  virtual Rgba sample(const Vec2& uv, const TextureFootprint& footprint,
                      const TextureSampling& how) const = 0;

  /// Memory that keep_pixels() will take; 0 if there is nothing to keep.
  virtual std::uint64_t bytes_to_keep() const { return 0; }
  /// From its first lookup on, keeps a file decoded in memory: lookups are several times faster
  /// than by the tile cache, and a file without tiles is decoded once. Not thread-safe. Checked:
  /// FileTexture.KeptPixelsGiveTheSameValues
  virtual void keep_pixels() {}

  /// Scalar lookup: the mean of R, G and B.
  float sample_scalar(const Vec2& uv, const TextureFootprint& footprint,
                      const TextureSampling& how) const {
    const Rgba c = sample(uv, footprint, how);
    return (c.r + c.g + c.b) * (1.0f / 3.0f);
  }

  /// The first error of a lookup, or empty.
  virtual std::string error() const { return {}; }

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }  ///< channels of the file; at most four are used

 protected:
  int width_ = 0, height_ = 0, channels_ = 0;
};

enum class RowOrder { BottomUp, TopDown };

/// A texture from bytes with `components` (1 to 4) per pixel, decoded as value^gamma except alpha.
///
/// Model:   box-filtered pyramid, trilinear, with up to `anisotropy` probes along the longer axis.
/// Errors:  null if `bytes` does not have width x height x components elements or a size is out of
///          range.
/// Checked: MemoryTexture.*
std::unique_ptr<Texture> make_memory_texture(int width, int height, int components,
                                             std::span<const std::uint8_t> bytes, float gamma = 1,
                                             RowOrder order = RowOrder::BottomUp);

/// The file textures of one world. Each (path, gamma) is opened once. Pictures are kept in memory
/// in the order of open(), up to three quarters of the cache; those beyond it share the tile cache,
/// which all systems have together.
class TextureSystem {
 public:
  struct Opened {
    Texture* texture;     ///< owned by the system; null if the file cannot be opened
    std::string message;  ///< reason; reported to the first caller only, empty afterwards
  };

  /// Opens a file by its resolved path. A new system detects files that were modified. Thread-safe,
  /// but too slow for use during shading.
  ///
  /// Inputs:  gamma: integer pictures are decoded as value^gamma before filtering, except alpha; 1
  ///          = as stored. Float pictures are not decoded. An sRGB curve is never applied.
  ///          most_tile_bytes: maximum size of a tile or strip of the file in memory.
  /// Checked: FileTexture.*
  Opened open(const std::string& path, float gamma = 1, std::uint64_t most_tile_bytes = UINT64_MAX);
  /// Opens a file that open() will be called for with the same arguments. Thread-safe; files are
  /// opened at the same time.
  void open_ahead(const std::string& path, float gamma, std::uint64_t most_tile_bytes);

  /// Memory in MB of kept pictures and of the tile cache (default 4096, minimum 16). Takes effect
  /// when the next texture is opened.
  static void set_cache_megabytes(float megabytes);

 private:
  struct Entry {
    std::once_flag once;
    std::unique_ptr<Texture> texture;
    std::string message;
    bool reported = false;
  };
  Entry& opened_entry(const std::string& path, float gamma, std::uint64_t most_tile_bytes);

  std::mutex mutex_;
  std::map<std::pair<std::string, float>, Entry> textures_;
  std::uint64_t kept_bytes_ = 0;
};

}  // namespace oriel
