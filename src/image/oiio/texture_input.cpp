// SPDX-License-Identifier: Apache-2.0
#include "image/oiio/texture_input.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <vector>

#include "base/math.h"
#include "image/oiio/local_source.h"

namespace oriel::oiio {
namespace {

struct SharedOpener {
  std::mutex mutex;
  PixelSourceOpener open;
};
SharedOpener& shared_opener() {
  static auto* const shared = new SharedOpener;  // never destroyed, like the texture system
  return *shared;
}

OIIO::TypeDesc type_of_level(const PixelLevel& level) {
  return OIIO::TypeDesc(static_cast<OIIO::TypeDesc::BASETYPE>(level.type));
}

class TextureInput final : public OIIO::ImageInput {
 public:
  const char* format_name() const override { return "oriel_texture"; }

  bool open(const std::string&, OIIO::ImageSpec&) override { return false; }

  bool open(const std::string&, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override {
    gamma_ = config.get_float_attribute("oriel:gamma", 1);
    try {
      source_ = open_source(std::string(config.get_string_attribute("oriel:path")));
    } catch (const std::exception& e) {
      errorfmt("{}", e.what());
      return false;
    }
    if (!source_->level(0, 0, level_)) return fail();
    adopt_level();
    spec = m_spec;
    return true;
  }

  bool close() override {
    source_.reset();
    return true;
  }
  int current_subimage() const override { return subimage_; }
  int current_miplevel() const override { return miplevel_; }

  bool seek_subimage(int subimage, int miplevel) override {
    if (!source_) return false;
    if (subimage == subimage_ && miplevel == miplevel_) return true;
    PixelLevel level;
    if (!source_->level(subimage, miplevel, level)) return false;
    level_ = level;
    subimage_ = subimage;
    miplevel_ = miplevel;
    adopt_level();
    return true;
  }

  bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override {
    return read_native_scanlines(subimage, miplevel, y, y + 1, z, data);
  }

  bool read_native_scanlines(int subimage, int miplevel, int y_begin, int y_end, int,
                             void* data) override {
    lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel)) return false;
    y_end = std::min(y_end, m_spec.y + m_spec.height);
    if (y_begin < m_spec.y || y_begin >= y_end) return false;
    const std::size_t values = static_cast<std::size_t>(y_end - y_begin) *
                               static_cast<std::size_t>(m_spec.width) *
                               static_cast<std::size_t>(m_spec.nchannels);
    return read(values, data, [&](std::span<std::byte> out) {
      return source_->rows(subimage, miplevel, y_begin, y_end, out);
    });
  }

  bool read_native_tile(int subimage, int miplevel, int x, int y, int, void* data) override {
    lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel)) return false;
    const std::size_t values =
        static_cast<std::size_t>(m_spec.tile_pixels()) * static_cast<std::size_t>(m_spec.nchannels);
    return read(values, data, [&](std::span<std::byte> out) {
      return source_->tile(subimage, miplevel, x, y, out);
    });
  }

 private:
  bool decodes() const { return gamma_ != 1 && is_integer(level_.type); }

  void adopt_level() {
    const PixelLevel& l = level_;
    m_spec = OIIO::ImageSpec(l.width, l.height, l.channels, type_of_level(l));
    m_spec.x = l.x, m_spec.y = l.y;
    m_spec.full_x = l.full_x, m_spec.full_y = l.full_y;
    m_spec.full_width = l.full_width, m_spec.full_height = l.full_height;
    m_spec.tile_width = l.tile_width, m_spec.tile_height = l.tile_height;
    m_spec.tile_depth = 1;
    m_spec.alpha_channel = l.alpha_channel;
    if (decodes())
      m_spec.set_format(l.type_bytes == 1 ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
  }

  bool fail() {
    errorfmt("{}", source_->error());
    return false;
  }

  /// `f` reads values of the file into a buffer.
  template <class F>
  bool read(std::size_t values, void* data, F&& f) {
    const std::size_t bytes = values * static_cast<std::size_t>(level_.type_bytes);
    if (!decodes()) return f({static_cast<std::byte*>(data), bytes}) || fail();
    stored_.resize(bytes);
    if (!f({stored_.data(), bytes})) return fail();
    decoded_.resize(values);
    OIIO::convert_pixel_values(type_of_level(level_), stored_.data(), OIIO::TypeDesc::FLOAT,
                               decoded_.data(), static_cast<int>(values));
    decode(decoded_, m_spec.nchannels, m_spec.alpha_channel, gamma_);
    return OIIO::convert_pixel_values(OIIO::TypeDesc::FLOAT, decoded_.data(), m_spec.format, data,
                                      static_cast<int>(values));
  }

  std::unique_ptr<PixelSource> source_;
  PixelLevel level_;
  int subimage_ = 0, miplevel_ = 0;
  std::vector<std::byte> stored_;
  std::vector<float> decoded_;
  float gamma_ = 1;
};

}  // namespace

OIIO::ImageInput* make_texture_input() { return new TextureInput; }

void set_source_opener(PixelSourceOpener opener) {
  const std::lock_guard lock(shared_opener().mutex);
  shared_opener().open = std::move(opener);
}

std::unique_ptr<PixelSource> open_source(const std::string& path) {
  PixelSourceOpener open;
  {
    const std::lock_guard lock(shared_opener().mutex);
    open = shared_opener().open;
  }
  return open ? open(path) : open_local_source(path);
}

bool is_integer(int base_type) { return base_type < OIIO::TypeDesc::HALF; }

void decode(std::span<float> values, int channels, int alpha_channel, float gamma) {
  int channel = 0;
  for (float& v : values) {
    if (channel != alpha_channel) v = v > 0 ? math::pow(v, gamma) : 0.0f;
    if (++channel == channels) channel = 0;
  }
}

}  // namespace oriel::oiio
