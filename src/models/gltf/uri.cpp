// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/uri.h"

#include <filesystem>

namespace oriel::models::gltf {
namespace {

namespace fs = std::filesystem;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return c >= 'A' && c <= 'F' ? c - 'A' + 10 : -1;
}

/// Value 0..63; -1 if the character is not a base64 digit.
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::optional<std::string> from_base64(std::string_view text) {
  while (!text.empty() && (text.back() == '=' || text.back() == '\n')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  unsigned bits = 0;
  int known = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6 | static_cast<unsigned>(digit)) & 0xffffff;
    if ((known += 6) < 8) continue;
    known -= 8;
    bytes += static_cast<char>(bits >> known & 0xff);
  }
  return bytes;
}

}  // namespace

std::string unescaped(std::string_view uri) {
  std::string name;
  name.reserve(uri.size());
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const int high = uri[i] == '%' && i + 2 < uri.size() ? hex_digit(uri[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(uri[i + 2]) : -1;
    // File names cannot contain zero bytes.
    if (low < 0 || high + low == 0) {
      name += uri[i];
      continue;
    }
    name += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return name;
}

std::optional<DataUri> data_of(std::string_view uri) {
  constexpr std::string_view kScheme = "data:", kBase64 = ";base64";
  if (uri.substr(0, kScheme.size()) != kScheme) return std::nullopt;
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  std::string_view kind = uri.substr(kScheme.size(), comma - kScheme.size());
  const std::string_view data = uri.substr(comma + 1);
  DataUri made;
  made.media_type = kind.substr(0, kind.find(';'));
  if (kind.size() < kBase64.size() || kind.substr(kind.size() - kBase64.size()) != kBase64) {
    made.bytes = unescaped(data);
    return made;
  }
  auto bytes = from_base64(data);
  if (!bytes) return std::nullopt;
  made.bytes = std::move(*bytes);
  return made;
}

std::string file_name(const std::string& uri, const std::string& folder, const FileAccess& files) {
  std::string name = unescaped(uri);
  const auto exists = [&](const std::string& candidate) {
    return files.open((fs::path(folder) / candidate).string(), FileUse::Asset).fault() !=
           OpenFile::Fault::Missing;
  };
  return name != uri && !exists(name) && exists(uri) ? uri : name;
}

}  // namespace oriel::models::gltf
