// SPDX-License-Identifier: Apache-2.0
#include "models/gltf/read.h"

#include <assimp/scene.h>
#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <filesystem>

#include "base/file_text.h"

namespace oriel::models {

namespace fs = std::filesystem;

namespace {

/// Bytes of a binary file by its header; 0: it is another file.
std::size_t size_in_header(const std::string& content) {
  constexpr std::size_t kHeader = 12, kSize = 8;
  if (content.size() < kHeader || !content.starts_with("glTF")) return 0;
  std::uint32_t size = 0;
  std::memcpy(&size, content.data() + kSize, sizeof size);
  return size;
}

}  // namespace

GltfModel read_gltf(Assimp::Importer& importer, const std::string& path, unsigned steps,
                    const gltf::PlainOptions& options, Diagnostics& diagnostics) {
  GltfModel model;
  std::error_code error;
  const std::string content = fs::is_regular_file(path, error) ? file_text(path) : std::string();
  if (const std::size_t whole = size_in_header(content); whole > content.size()) {
    model.error = fmt::format("the file is truncated: {} of {} bytes", content.size(), whole);
    return model;
  }
  const auto plain =
      gltf::make_plain(content, fs::path(path).parent_path().string(), options, diagnostics);
  if (!plain) {
    // glTF 1.0 or an invalid file: let assimp report the error.
    model.scene = importer.ReadFile(path, steps);
  } else if (!plain->error.empty()) {
    model.error = plain->error;
    return model;
  } else {
    model.scene =
        importer.ReadFileFromMemory(plain->binary.data(), plain->binary.size(), steps, "glb");
    model.extras = gltf_extras(plain->root);
  }
  if (!model.scene) model.error = importer.GetErrorString();
  return model;
}

}  // namespace oriel::models
