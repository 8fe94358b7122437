// SPDX-License-Identifier: Apache-2.0
#include "image/texture.h"

#include <atomic>
#include <exception>

#include "image/module.h"
#include "image/reader_process.h"
#include "image/texture_statistics.h"

namespace oriel {
namespace {

constexpr float kDefaultCacheMegabytes = 1024;  // about eighty 2048 x 2048 8-bit RGB pictures
std::atomic<float> cache_megabytes{kDefaultCacheMegabytes};
std::atomic<bool> has_module{false};

}  // namespace

TextureSystem::Opened TextureSystem::open(const std::string& path, float gamma) {
  const std::lock_guard lock(mutex_);
  const auto [entry, is_new] = textures_.try_emplace({path, gamma}, nullptr);
  if (!is_new) return {entry->second.get(), {}};
  try {
    FilesModule& module = files_module();
    has_module = true;
    module.set_source_opener(readers_are_isolated() ? open_isolated : PixelSourceOpener());
    module.set_cache_megabytes(cache_megabytes);
    entry->second = module.open_texture(path, gamma);
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
