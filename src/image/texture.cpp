// SPDX-License-Identifier: Apache-2.0
#include "image/texture.h"

#include <exception>

#include "image/module.h"

namespace oriel {

TextureSystem::Opened TextureSystem::open(const std::string& path, float gamma) {
  const std::lock_guard lock(mutex_);
  const auto [entry, is_new] = textures_.try_emplace({path, gamma}, nullptr);
  if (!is_new) return {entry->second.get(), {}};
  try {
    entry->second = files_module().open_texture(path, gamma);
    return {entry->second.get(), {}};
  } catch (const std::exception& e) {
    return {nullptr, "cannot open texture '" + path + "': " + e.what()};
  }
}

void TextureSystem::set_cache_megabytes(float megabytes) {
  files_module().set_cache_megabytes(megabytes);
}

}  // namespace oriel
