// SPDX-License-Identifier: Apache-2.0
#include "mi/utf16.h"

#include <cstdint>

namespace oriel::mi {
namespace {

void append_utf8(std::string& text, std::uint32_t c) {
  const auto byte = [&](std::uint32_t b) { text += static_cast<char>(b); };
  if (c < 0x80) return byte(c);
  if (c < 0x800) {
    byte(0xc0 | c >> 6);
  } else {
    if (c < 0x10000) {
      byte(0xe0 | c >> 12);
    } else {
      byte(0xf0 | c >> 18);
      byte(0x80 | (c >> 12 & 0x3f));
    }
    byte(0x80 | (c >> 6 & 0x3f));
  }
  byte(0x80 | (c & 0x3f));
}

}  // namespace

bool is_utf16(std::string_view bytes) {
  return bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff");
}

std::string utf8_of_utf16(std::string_view bytes) {
  const std::size_t low = bytes.starts_with("\xff\xfe") ? 0 : 1;
  const std::size_t units = bytes.size() / 2;
  const auto unit = [&](std::size_t i) {
    return i >= units
               ? 0u
               : static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[2 * i + low])) |
                     static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[2 * i + 1 - low]))
                         << 8;
  };
  constexpr std::uint32_t kReplacement = 0xfffd;
  std::string text;
  text.reserve(units);
  for (std::size_t i = 1; i < units; ++i) {
    const std::uint32_t first = unit(i), second = unit(i + 1);
    if (first < 0xd800 || first > 0xdfff) {
      append_utf8(text, first);
    } else if (first < 0xdc00 && second >= 0xdc00 && second <= 0xdfff) {
      append_utf8(text, 0x10000 + ((first - 0xd800) << 10) + (second - 0xdc00));
      ++i;
    } else {
      append_utf8(text, kReplacement);
    }
  }
  return text;
}

}  // namespace oriel::mi
