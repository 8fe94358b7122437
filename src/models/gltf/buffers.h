// SPDX-License-Identifier: Apache-2.0
// The bytes that a glTF file's buffers and buffer views stand for.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "models/gltf/document.h"

namespace oriel::models::gltf {

/// Reads each buffer and view once, when it is asked for.
class Buffers {
 public:
  /// Inputs:  folder: of the model's file, which the names of buffers are relative to; what lies
  ///          elsewhere is not read. content_size: of that file, bytes.
  Buffers(const Document& document, std::string folder, std::size_t content_size)
      : document_(document), folder_(std::move(folder)), left_(most_bytes(content_size)) {}

  /// Content of a buffer view, decompressed; valid as long as this is.
  /// Errors:  Unreadable.
  std::string_view view(std::size_t index);

  /// Takes so many bytes from what the whole file may unfold to.
  /// Errors:  Unreadable, where that is too much: few bytes can claim to be many.
  void spend(std::size_t bytes);

 private:
  static std::size_t most_bytes(std::size_t content_size);
  std::string_view buffer(std::size_t index);
  std::string load(std::size_t index);
  /// So many bytes of a buffer from there on.
  std::string_view part(const json& view, const std::string& what);

  const Document& document_;
  std::string folder_;
  std::size_t left_;
  std::map<std::size_t, std::string> buffers_, unpacked_;
};

}  // namespace oriel::models::gltf
