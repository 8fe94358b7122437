// SPDX-License-Identifier: Apache-2.0
#include "image/picture_target.h"

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "base/durable_file.h"

namespace oriel {
namespace {

using namespace std::string_view_literals;

/// First bytes of picture files. Source: the specifications of the formats.
constexpr std::array kMagics = {
    "\x76\x2f\x31\x01"sv,   // OpenEXR
    "\x89PNG\r\n\x1a\n"sv,  // PNG
    "#?"sv,                 // Radiance HDR
    "\xff\xd8\xff"sv,       // JPEG
    "II*\0"sv,
    "MM\0*"sv,
    "II+\0"sv,
    "MM\0+"sv,  // TIFF, BigTIFF
    "BM"sv,     // BMP
    "GIF8"sv,   // GIF
    "FOR4"sv,
    "FOR8"sv,      // IFF of Maya
    "\x01\xda"sv,  // SGI
    "SDPX"sv,
    "XPDS"sv,       // DPX
    "SIMPLE  ="sv,  // FITS
    "\0\0\0\x0cjP  "sv,
    "\xff\x4f\xff\x51"sv,  // JPEG 2000
    "DDS "sv,
    "\xabKTX "sv,          // textures
    "8BPS"sv,              // Photoshop
    "\x53\x80\xf6\x34"sv,  // Softimage PIC
};

unsigned byte(std::string_view s, std::size_t at) { return static_cast<unsigned char>(s[at]); }
unsigned big_endian(std::string_view s, std::size_t at) {
  return byte(s, at) << 8 | byte(s, at + 1);
}

/// PBM, PGM, PPM, PAM, PFM.
bool is_pnm(std::string_view s) {
  return s.size() > 2 && s[0] == 'P' && std::string_view("1234567Ff").find(s[1]) != s.npos &&
         std::string_view(" \t\r\n#").find(s[2]) != s.npos;
}

/// Targa has no magic number: the fields of its header must be valid.
bool is_targa(std::string_view s) {
  if (s.size() < 18 || byte(s, 1) > 1) return false;
  const unsigned type = byte(s, 2), bits = byte(s, 16);
  const bool has_size = (byte(s, 12) | byte(s, 13)) && (byte(s, 14) | byte(s, 15));
  return has_size && ((type >= 1 && type <= 3) || (type >= 9 && type <= 11)) &&
         (bits == 8 || bits == 15 || bits == 16 || bits == 24 || bits == 32);
}

/// RLA and RLB: a revision in the header.
bool is_rla(std::string_view s) {
  return s.size() >= 28 && (big_endian(s, 26) == 0xfffe || big_endian(s, 26) == 0xfffd);
}

bool begins_like_picture(std::string_view s) {
  for (const std::string_view magic : kMagics)
    if (s.starts_with(magic)) return true;
  const bool is_webp = s.size() >= 12 && s.starts_with("RIFF") && s.substr(8, 4) == "WEBP";
  return is_webp || is_pnm(s) || is_rla(s) || is_targa(s);
}

}  // namespace

std::string picture_fault(const std::string& path) {
  if (std::string fault = target_fault(path); !fault.empty()) return fault;
  if (std::filesystem::path(path).filename().string().starts_with('.'))
    return "names that begin with a dot are not allowed; choose another name";
  constexpr std::size_t kHeader = 32;
  const std::string start = first_bytes(path, kHeader);
  std::error_code error;
  const bool has_content =
      std::filesystem::exists(path, error) && std::filesystem::file_size(path, error) > 0;
  if (has_content && !begins_like_picture(start))
    return "it exists and is not a picture; remove it or choose another name";
  return {};
}

void check_picture_target(const std::string& path) {
  if (const std::string fault = picture_fault(path); !fault.empty())
    throw std::runtime_error(fault);
}

}  // namespace oriel
