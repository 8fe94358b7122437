// SPDX-License-Identifier: Apache-2.0
#include "image/texture.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <iterator>
#include <string_view>

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

constexpr float kDefaultCacheMegabytes = 1024;  // about eighty 2048 x 2048 8-bit RGB pictures
std::atomic<float> cache_megabytes{kDefaultCacheMegabytes};
std::atomic<bool> has_module{false};

}  // namespace

TextureSystem::Opened TextureSystem::open(const std::string& path, float gamma,
                                          std::uint64_t most_tile_bytes) {
  note_input_file(path, InputKind::Frame);
  const std::lock_guard lock(mutex_);
  const auto [entry, is_new] = textures_.try_emplace({path, gamma}, nullptr);
  if (!is_new) return {entry->second.get(), {}};
  if (is_pattern(path))
    return {nullptr, "cannot open texture '" + path +
                         "': its name contains ?, <UDIM> or another mark of a pattern; rename it"};
  try {
    FilesModule& module = files_module();
    has_module = true;
    module.set_source_opener(readers_are_isolated() ? open_isolated : PixelSourceOpener());
    module.set_cache_megabytes(cache_megabytes);
    entry->second = module.open_texture(path, gamma, most_tile_bytes);
    return {entry->second.get(), {}};
  } catch (const std::exception& e) {
    return {nullptr, "cannot open texture '" + path + "': " + e.what()};
  }
}

void TextureSystem::set_cache_megabytes(float megabytes) {
  // Setting a limit must not load the module; open() passes it on.
  cache_megabytes = megabytes;
}

TextureStatistics texture_statistics() {
  return has_module ? files_module().texture_statistics() : TextureStatistics{};
}

}  // namespace oriel
