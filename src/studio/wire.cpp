// SPDX-License-Identifier: Apache-2.0
#include "studio/wire.h"

#include <algorithm>
#include <cstring>

namespace oriel::studio {
namespace {

constexpr std::uint32_t kMagic = 0x4C49524F;
constexpr unsigned kLastStrip = 1, kPreview = 2, kFirstOfEpoch = 4;

/// Appends little-endian integers.
class WireWriter {
 public:
  explicit WireWriter(std::string& to) : to_(to) {}
  void u8(unsigned v) { to_ += static_cast<char>(v); }
  void u16(int v) { u8(static_cast<unsigned>(v) & 255), u8(static_cast<unsigned>(v) >> 8 & 255); }
  void u32(std::uint32_t v) { u16(static_cast<int>(v & 0xffff)), u16(static_cast<int>(v >> 16)); }

 private:
  std::string& to_;
};

}  // namespace

std::vector<std::shared_ptr<const std::string>> wire_strips(const interactive::Picture& p,
                                                            std::uint32_t frame) {
  std::vector<std::shared_ptr<const std::string>> strips;
  for (std::size_t layer = 0; layer < p.layers.size(); ++layer) {
    const interactive::PictureLayer& l = p.layers[layer];
    const std::size_t row = static_cast<std::size_t>(p.w) * interactive::bytes_per_pixel(l.format);
    const int rows =
        static_cast<int>(std::max<std::size_t>(1, kMaxStripBytes / std::max<std::size_t>(row, 1)));
    for (int y = 0; y < p.h; y += rows) {
      const int h = std::min(rows, p.h - y);
      const bool is_last = layer + 1 == p.layers.size() && y + h == p.h;
      std::string bytes;
      bytes.reserve(kWireHeaderBytes + row * static_cast<std::size_t>(h));
      WireWriter out(bytes);
      out.u32(kMagic);
      out.u8(1), out.u8(0), out.u8(static_cast<unsigned>(l.format));
      out.u8((is_last ? kLastStrip : 0) | (p.preview ? kPreview : 0) |
             (p.first ? kFirstOfEpoch : 0));
      out.u32(p.epoch);
      out.u16(static_cast<int>(layer)), out.u16(p.divider);
      out.u16(p.x), out.u16(p.y + y), out.u16(p.w), out.u16(h);
      out.u32(p.samples), out.u32(frame);
      const auto* from =
          reinterpret_cast<const char*>(l.pixels.data()) + row * static_cast<std::size_t>(y);
      bytes.append(from, row * static_cast<std::size_t>(h));
      strips.push_back(std::make_shared<const std::string>(std::move(bytes)));
    }
  }
  return strips;
}

}  // namespace oriel::studio
