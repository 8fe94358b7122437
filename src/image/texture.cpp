// SPDX-License-Identifier: Apache-2.0
#include "image/texture.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/input_files.h"
#include "image/module.h"
#include "image/reader_process.h"
#include "image/texture_statistics.h"

namespace oriel {
namespace {

/// The image library takes such names for patterns of other names or for options of the reader.
bool is_pattern(const std::string& path) {
  constexpr std::string_view kMarks[] = {"?",   "<UDIM>",  "<U>",      "<V>",     "<u>",
                                         "<v>", "_u##v##", "%(UDIM)d", "<UVTILE>"};
  return std::any_of(std::begin(kMarks), std::end(kMarks),
                     [&](std::string_view mark) { return path.find(mark) != path.npos; });
}

/// About 140 pictures of 2048 x 2048 pixels with 8 bits, and the tile cache.
constexpr float kDefaultCacheMegabytes = 4096;
constexpr float kKeptShare = 0.75f, kBytesOfMegabyte = 1 << 20;
std::atomic<float> cache_megabytes{kDefaultCacheMegabytes};
std::atomic<bool> has_module{false};

}  // namespace

TextureSystem::Entry& TextureSystem::opened_entry(const std::string& path, float gamma,
                                                  std::uint64_t most_tile_bytes) {
  std::unique_lock lock(mutex_);
  Entry& entry = textures_[{path, gamma}];
  lock.unlock();
  std::call_once(entry.once, [&] {
    if (is_pattern(path)) {
      entry.message = "cannot open texture '" + path +
                      "': its name contains ?, <UDIM> or another mark of a pattern; rename it";
      return;
    }
    try {
      FilesModule& module = files_module();
      has_module = true;
      module.set_source_opener(readers_are_isolated() ? open_isolated : PixelSourceOpener());
      module.set_cache_megabytes(cache_megabytes * kKeptShare, cache_megabytes * (1 - kKeptShare));
      entry.texture = module.open_texture(path, gamma, most_tile_bytes);
    } catch (const std::exception& e) {
      entry.message = "cannot open texture '" + path + "': " + e.what();
    }
  });
  return entry;
}

TextureSystem::Opened TextureSystem::open(const std::string& path, float gamma,
                                          std::uint64_t most_tile_bytes) {
  note_input_file(path, InputKind::Frame);
  Entry& entry = opened_entry(path, gamma, most_tile_bytes);
  const std::lock_guard lock(mutex_);
  const bool first = !std::exchange(entry.reported, true);
  if (first && entry.texture) {
    const std::uint64_t bytes = entry.texture->bytes_to_keep();
    const auto most = static_cast<std::uint64_t>(cache_megabytes * kKeptShare * kBytesOfMegabyte);
    if (bytes > 0 && kept_bytes_ + bytes <= most) {
      kept_bytes_ += bytes;
      entry.texture->keep_pixels();
    }
  }
  return {entry.texture.get(), first ? entry.message : std::string()};
}

void TextureSystem::open_ahead(const std::string& path, float gamma,
                               std::uint64_t most_tile_bytes) {
  opened_entry(path, gamma, most_tile_bytes);
}

void TextureSystem::set_cache_megabytes(float megabytes) {
  // Setting a limit must not load the module; open() passes it on.
  cache_megabytes = megabytes;
}

TextureStatistics texture_statistics() {
  return has_module ? files_module().texture_statistics() : TextureStatistics{};
}

}  // namespace oriel
