// SPDX-License-Identifier: Apache-2.0
// Data of the buffers and buffer views of a glTF file.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "base/file_access.h"
#include "models/gltf/document.h"

namespace oriel::models::gltf {

/// Reads each buffer and buffer view once, at its first use.
class Buffers {
 public:
  /// Inputs:  folder: folder of the model, which file names of buffers are relative to.
  ///          content_size: of the model file, in bytes. files: policy for files of buffers.
  Buffers(const Document& document, std::string folder, std::size_t content_size,
          FileAccess files = {})
      : document_(document),
        folder_(std::move(folder)),
        files_(std::move(files)),
        left_(most_bytes(content_size)) {}

  /// Content of a buffer view, decompressed; valid as long as this object.
  /// Errors:  Unreadable.
  std::string_view view(std::size_t index);

  /// Subtracts from the total decompressed size that the file may have.
  /// Errors:  Unreadable if the limit is exceeded: a small file may declare huge sizes.
  void spend(std::size_t bytes);

  const FileAccess& files() const { return files_; }

 private:
  static std::size_t most_bytes(std::size_t content_size);
  std::string_view buffer(std::size_t index);
  std::string load(std::size_t index);
  /// The byte range of a buffer that a buffer view describes.
  /// Why a part of a buffer does not exist.
  std::string excess(std::size_t size, std::size_t index, const std::string& what) const;
  std::string_view part(const json& view, const std::string& what);

  const Document& document_;
  std::string folder_;
  FileAccess files_;
  std::size_t left_;
  std::map<std::size_t, std::string> buffers_, unpacked_;
};

}  // namespace oriel::models::gltf
