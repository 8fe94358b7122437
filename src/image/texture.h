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
//   Values are the file's: colour and alpha as stored, never multiplied or divided. A picture
//   without alpha has alpha 1, a grey one has it in R, G and B.

enum class Wrap : std::uint8_t {
  Black,     ///< outside [0, 1): transparent black, with a hard border
  Periodic,  ///< repeats
  Clamp,     ///< the border texel goes on
  Mirror,    ///< repeats, every other copy mirrored
};

enum class Interpolation : std::uint8_t { Nearest, Bilinear, Bicubic };

/// How to look up. `Bicubic` acts where the texture is magnified; in memory it is Bilinear.
struct TextureSampling {
  Wrap wrap_u = Wrap::Periodic;
  Wrap wrap_v = Wrap::Periodic;
  Interpolation interpolation = Interpolation::Bilinear;
  float anisotropy = 16;  ///< longest ratio of the filter's axes; beyond it the result blurs
};

/// The footprint of a pixel: change of uv per pixel step in x and y. All zero = no filtering, the
/// full-resolution picture is interpolated.
struct TextureFootprint {
  Vec2 dx{0, 0}, dy{0, 0};
};

class Texture {
 public:
  virtual ~Texture() = default;

  /// The filtered colour. Safe on any thread, no exception, total: where uv is not finite it is
  /// transparent black. Where the file turns out to be broken it is magenta, and error() says why.
  /// Checked: Texture.*
  virtual Rgba sample(const Vec2& uv, const TextureFootprint& footprint,
                      const TextureSampling& how) const = 0;

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
  int channels() const { return channels_; }  ///< of the file, also where only four are used

 protected:
  int width_ = 0, height_ = 0, channels_ = 0;
};

enum class RowOrder { BottomUp, TopDown };

/// A texture of bytes, `components` of them (1 to 4) per pixel, decoded as value^gamma (alpha not).
///
/// Model:   box-filtered pyramid, trilinear, with up to `anisotropy` probes along the longer axis.
/// Errors:  null when `bytes` is not width x height x components long or a size is out of range.
/// Checked: MemoryTexture.*
std::unique_ptr<Texture> make_memory_texture(int width, int height, int components,
                                             std::span<const std::uint8_t> bytes, float gamma = 1,
                                             RowOrder order = RowOrder::BottomUp);

/// The file textures of one world; each (path, gamma) is opened once. All share one tile cache.
class TextureSystem {
 public:
  struct Opened {
    const Texture* texture;  ///< owned by the system; null when it cannot be opened
    std::string message;     ///< why, for the first caller only; empty when it was said before
  };

  /// Opens a file by its resolved path; a new system sees a changed file anew. Safe on any thread,
  /// not for the hot path.
  ///
  /// Inputs:  gamma: integer pictures are decoded as value^gamma before filtering (alpha is not);
  ///          1 = as stored. Float pictures never are. No sRGB curve is ever assumed.
  /// Checked: FileTexture.*
  Opened open(const std::string& path, float gamma = 1);

  /// Memory of the tile cache, shared by all systems of the process; 1024 unless set, 16 at least.
  /// Takes effect when the next texture is opened.
  static void set_cache_megabytes(float megabytes);

 private:
  std::mutex mutex_;
  std::map<std::pair<std::string, float>, std::unique_ptr<Texture>> textures_;
};

}  // namespace oriel
