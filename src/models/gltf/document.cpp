// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/document.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>

namespace oriel::models::gltf {
namespace {

constexpr std::size_t kFileHeader = 12, kChunkHeader = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;  // little-endian in the file and on all supported machines
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

/// Returns the content of the first chunk, clipped to the end of the file, and removes it from
/// `rest`.
std::string_view take_chunk(std::string_view& rest, std::uint32_t& type) {
  if (rest.size() < kChunkHeader) return {};
  const std::uint32_t length = word_at(rest, 0);
  type = word_at(rest, 4);
  const std::string_view chunk = rest.substr(kChunkHeader, length);
  rest.remove_prefix(kChunkHeader + chunk.size());
  return chunk;
}

/// Whether the nesting depth is within the limit. A parser callback could count it, but takes time
/// quadratic in the length of lists.
bool is_shallow(std::string_view text) {
  constexpr int kDeepest = 100;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\')
      ++i;
    else if (c == '"')
      quoted = !quoted;
    else if (!quoted && (c == '[' || c == '{'))
      ++depth;
    else if (!quoted && (c == ']' || c == '}'))
      --depth;
    if (depth > kDeepest) return false;
  }
  return true;
}

}  // namespace

std::optional<Document> parse(std::string_view content) {
  Document document;
  std::string_view text = content;
  if (content.size() >= kFileHeader && content.substr(0, 4) == "glTF") {
    std::string_view rest = content.substr(kFileHeader);
    std::uint32_t type = 0;
    text = take_chunk(rest, type);
    if (type != kJsonChunk) return std::nullopt;
    while (document.binary.empty() && rest.size() >= kChunkHeader)
      if (const std::string_view chunk = take_chunk(rest, type); type == kBinaryChunk)
        document.binary = chunk;
  }
  if (!is_shallow(text)) throw Unreadable("its JSON is nested too deeply");
  document.root = json::parse(text.begin(), text.end(), nullptr, false);
  if (!document.root.is_object()) return std::nullopt;
  // In glTF 1.0 these are objects instead of arrays.
  for (const char* name : {"meshes", "nodes", "accessors"})
    if (member(document.root, name).is_object()) return std::nullopt;
  return document;
}

std::string glb(const json& root, std::string_view binary) {
  std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::size_t padded = (binary.size() + 3) / 4 * 4;
  const std::size_t size = kFileHeader + 2 * kChunkHeader + text.size() + padded;
  std::string file;
  file.reserve(size);
  const auto put = [&](std::size_t word) {
    const auto w = static_cast<std::uint32_t>(word);
    file.append(reinterpret_cast<const char*>(&w), sizeof w);
  };
  file += "glTF";
  put(2), put(size);
  put(text.size()), put(kJsonChunk);
  file += text;
  put(padded), put(kBinaryChunk);
  file += binary;
  file.resize(size, '\0');
  return file;
}

}  // namespace oriel::models::gltf
