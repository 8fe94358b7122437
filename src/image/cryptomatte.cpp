// SPDX-License-Identifier: Apache-2.0
#include "image/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <set>

namespace oriel {
namespace {

constexpr std::uint32_t kFirst = 0xcc9e2d51, kSecond = 0x1b873593;

std::uint32_t scrambled(std::uint32_t block) { return std::rotl(block * kFirst, 15) * kSecond; }

std::uint32_t byte_at(std::string_view text, std::size_t i) {
  return static_cast<unsigned char>(text[i]);
}

/// The JSON string of a name. Control characters, quotes and backslashes are escaped; other bytes
/// are copied.
std::string json_string(std::string_view name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\')
      text += std::string("\\") + c;
    else if (static_cast<unsigned char>(c) < 0x20)
      text += fmt::format("\\u{:04x}", static_cast<int>(c));
    else
      text += c;
  }
  return text + "\"";
}

}  // namespace

std::uint32_t murmur3_32(std::string_view text, std::uint32_t seed) {
  std::uint32_t hash = seed;
  std::size_t i = 0;
  for (; i + 4 <= text.size(); i += 4) {
    const std::uint32_t block = byte_at(text, i) | byte_at(text, i + 1) << 8 |
                                byte_at(text, i + 2) << 16 | byte_at(text, i + 3) << 24;
    hash = std::rotl(hash ^ scrambled(block), 13) * 5 + 0xe6546b64;
  }
  std::uint32_t rest = 0;
  for (std::size_t k = text.size(); k > i; --k) rest = rest << 8 | byte_at(text, k - 1);
  hash ^= scrambled(rest);
  hash ^= static_cast<std::uint32_t>(text.size());
  // Final mixing of MurmurHash3.
  hash = (hash ^ hash >> 16) * 0x85ebca6b;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35;
  return hash ^ hash >> 16;
}

float cryptomatte_id(std::string_view name) {
  const std::uint32_t hash = murmur3_32(name);
  const std::uint32_t exponent = std::clamp(hash >> 23 & 0xffu, 1u, 254u);
  return std::bit_cast<float>((hash & 0x807fffffu) | exponent << 23);
}

void rank_shares(std::vector<CryptomatteShare>& shares, std::span<float> out) {
  std::sort(shares.begin(), shares.end(), [](auto& a, auto& b) { return a.id < b.id; });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (kept > 0 && shares[kept - 1].id == shares[i].id)
      shares[kept - 1].coverage += shares[i].coverage;
    else
      shares[kept++] = shares[i];
  }
  shares.resize(kept);
  std::stable_sort(shares.begin(), shares.end(),
                   [](auto& a, auto& b) { return a.coverage > b.coverage; });
  std::fill(out.begin(), out.end(), 0.0f);
  for (std::size_t i = 0; i < kept && 2 * i + 1 < out.size(); ++i)
    out[2 * i] = shares[i].id, out[2 * i + 1] = shares[i].coverage;
}

std::map<std::string, std::string> cryptomatte_metadata(std::string_view type,
                                                        std::span<const std::string> names) {
  // The key is the first seven digits of the hash of the type name, so it is the same in every
  // file.
  const std::string key =
      fmt::format("cryptomatte/{}/", fmt::format("{:08x}", murmur3_32(type)).substr(0, 7));
  std::string manifest;
  for (const std::string& name : std::set<std::string>(names.begin(), names.end()))
    manifest += fmt::format("{}{}:\"{:08x}\"", manifest.empty() ? "" : ",", json_string(name),
                            std::bit_cast<std::uint32_t>(cryptomatte_id(name)));
  return {{key + "name", std::string(type)},
          {key + "hash", "MurmurHash3_32"},
          {key + "conversion", "uint32_to_float32"},
          {key + "manifest", "{" + manifest + "}"}};
}

}  // namespace oriel
