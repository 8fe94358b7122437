// SPDX-License-Identifier: Apache-2.0
#include "image/oiio/allowed_formats.h"

#include <OpenImageIO/filesystem.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string_view>

namespace oriel::oiio {
namespace {

using namespace std::string_view_literals;

constexpr std::array kAllowed{"bmp"sv,  "dds"sv,       "dpx"sv,     "gif"sv,  "hdr"sv, "iff"sv,
                              "jpeg"sv, "jpeg2000"sv,  "openexr"sv, "png"sv,  "pnm"sv, "rla"sv,
                              "sgi"sv,  "softimage"sv, "targa"sv,   "tiff"sv, "webp"sv};

bool is_allowed(std::string_view format) {
  return std::find(kAllowed.begin(), kAllowed.end(), format) != kAllowed.end();
}

/// Format of each extension, from the list of the image library: "tiff:tif,tiff,tx;jpeg:jpg...".
const std::map<std::string, std::string>& format_of_extension() {
  static const std::map<std::string, std::string> formats = [] {
    std::map<std::string, std::string> all;
    std::istringstream list(OIIO::get_string_attribute("extension_list"));
    for (std::string entry; std::getline(list, entry, ';');) {
      const std::size_t colon = entry.find(':');
      const std::string format = entry.substr(0, colon);
      if (colon == std::string::npos || !is_allowed(format)) continue;
      std::istringstream extensions(entry.substr(colon + 1));
      for (std::string extension; std::getline(extensions, extension, ',');)
        all.emplace(extension, format);
    }
    return all;
  }();
  return formats;
}

struct Magic {
  std::string_view bytes, format;
};
constexpr Magic kMagic[] = {{"\xff\xd8\xff"sv, "jpeg"},
                            {"\x89PNG"sv, "png"},
                            {"II*\0"sv, "tiff"},
                            {"MM\0*"sv, "tiff"},
                            {"II+\0"sv, "tiff"},
                            {"MM\0+"sv, "tiff"},
                            {"\x76\x2f\x31\x01"sv, "openexr"},
                            {"#?"sv, "hdr"},
                            {"GIF8"sv, "gif"},
                            {"BM"sv, "bmp"},
                            {"RIFF"sv, "webp"},
                            {"DDS "sv, "dds"},
                            {"SDPX"sv, "dpx"},
                            {"XPDS"sv, "dpx"},
                            {"FOR4"sv, "iff"},
                            {"\x01\xda"sv, "sgi"},
                            {"\x53\x80\xf6\x34"sv, "softimage"},
                            {"\xff\x4f\xff\x51"sv, "jpeg2000"},
                            {"\0\0\0\x0cjP  "sv, "jpeg2000"},
                            {"P1"sv, "pnm"},
                            {"P2"sv, "pnm"},
                            {"P3"sv, "pnm"},
                            {"P4"sv, "pnm"},
                            {"P5"sv, "pnm"},
                            {"P6"sv, "pnm"},
                            {"PF"sv, "pnm"},
                            {"Pf"sv, "pnm"}};

std::string format_of_content(const std::string& path) {
  std::string head(16, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  for (const Magic& magic : kMagic)
    if (head.starts_with(magic.bytes)) return std::string(magic.format);
  return {};
}

/// Null with the reason in `why`.
std::unique_ptr<OIIO::ImageInput> open_as(const std::string& format, const std::string& path,
                                          const OIIO::ImageSpec* config, std::string& why) {
  auto input = OIIO::ImageInput::create(format);
  if (!input) {
    why = OIIO::geterror();
    return nullptr;
  }
  OIIO::ImageSpec spec;
  if (input->open(path, spec, config ? *config : OIIO::ImageSpec())) return input;
  why = input->geterror();
  return nullptr;
}

}  // namespace

std::unique_ptr<OIIO::ImageInput> open_allowed(const std::string& path,
                                               const OIIO::ImageSpec* config) {
  if (!OIIO::Filesystem::exists(path))
    throw std::runtime_error("Could not open file: file not found");
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string first, why;
  const auto& formats = format_of_extension();
  if (extension.size() > 1)
    if (const auto known = formats.find(extension.substr(1)); known != formats.end())
      first = known->second;
  if (!first.empty())
    if (auto input = open_as(first, path, config, why)) return input;
  if (const std::string second = format_of_content(path); !second.empty() && second != first) {
    std::string ignored;
    if (auto input = open_as(second, path, config, first.empty() ? why : ignored)) return input;
  }
  throw std::runtime_error(!why.empty()    ? why
                           : first.empty() ? "it is not a supported image file"
                                           : "the image library gives no reason");
}

}  // namespace oriel::oiio
