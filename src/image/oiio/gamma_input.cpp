// SPDX-License-Identifier: Apache-2.0
#include "image/oiio/gamma_input.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/math.h"

namespace oriel::oiio {
namespace {

class GammaInput final : public OIIO::ImageInput {
 public:
  const char* format_name() const override { return "oriel_gamma"; }

  bool open(const std::string&, OIIO::ImageSpec&) override { return false; }

  bool open(const std::string&, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override {
    gamma_ = config.get_float_attribute("oriel:gamma", 1);
    OIIO::ImageSpec plain;
    plain.attribute("oiio:UnassociatedAlpha", 1);
    inner_ = OIIO::ImageInput::open(std::string(config.get_string_attribute("oriel:path")), &plain);
    if (!inner_) {
      errorfmt("{}", OIIO::geterror());
      return false;
    }
    adopt_spec();
    spec = m_spec;
    return true;
  }

  bool close() override { return !inner_ || inner_->close(); }
  int current_subimage() const override { return inner_->current_subimage(); }
  int current_miplevel() const override { return inner_->current_miplevel(); }

  bool seek_subimage(int subimage, int miplevel) override {
    if (!inner_ || !inner_->seek_subimage(subimage, miplevel)) return false;
    adopt_spec();
    return true;
  }

  bool read_native_scanline(int subimage, int miplevel, int y, int, void* data) override {
    lock_guard lock(*this);
    const int count = m_spec.width * m_spec.nchannels;
    row_.resize(count);
    if (!inner_->read_scanlines(subimage, miplevel, y, y + 1, 0, 0, m_spec.nchannels,
                                OIIO::TypeDesc::FLOAT, row_.data()))
      return fail();
    return store(row_, data);
  }

  bool read_native_tile(int subimage, int miplevel, int x, int y, int z, void* data) override {
    lock_guard lock(*this);
    row_.resize(std::size_t(m_spec.tile_pixels()) * m_spec.nchannels);
    const int x1 = std::min(x + m_spec.tile_width, m_spec.x + m_spec.width);
    const int y1 = std::min(y + m_spec.tile_height, m_spec.y + m_spec.height);
    const OIIO::stride_t pixel = OIIO::stride_t(sizeof(float)) * m_spec.nchannels;
    if (!inner_->read_tiles(subimage, miplevel, x, x1, y, y1, z, z + 1, 0, m_spec.nchannels,
                            OIIO::TypeDesc::FLOAT, row_.data(), pixel, pixel * m_spec.tile_width))
      return fail();
    return store(row_, data);
  }

 private:
  void adopt_spec() {
    m_spec = inner_->spec();
    const OIIO::TypeDesc native = m_spec.format;
    const bool narrow = native == OIIO::TypeDesc::UINT8 || native == OIIO::TypeDesc::INT8;
    m_spec.set_format(narrow ? OIIO::TypeDesc::HALF : OIIO::TypeDesc::FLOAT);
    m_spec.channelformats.clear();
  }

  bool fail() {
    errorfmt("{}", inner_->geterror());
    return false;
  }

  bool store(std::vector<float>& values, void* data) const {
    const int n = m_spec.nchannels;
    for (std::size_t i = 0; i < values.size(); ++i)
      if (int(i % n) != m_spec.alpha_channel)
        values[i] = values[i] > 0 ? math::pow(values[i], gamma_) : 0.0f;
    return OIIO::convert_pixel_values(OIIO::TypeDesc::FLOAT, values.data(), m_spec.format, data,
                                      int(values.size()));
  }

  std::unique_ptr<OIIO::ImageInput> inner_;
  std::vector<float> row_;
  float gamma_ = 1;
};

}  // namespace

OIIO::ImageInput* make_gamma_input() { return new GammaInput; }

}  // namespace oriel::oiio
