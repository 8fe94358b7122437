// SPDX-License-Identifier: Apache-2.0
// The two parts of a glTF 2.0 file: its JSON and, in binary files, the buffer.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "models/gltf/json_read.h"

namespace oriel::models::gltf {

/// The reason why a part of the file cannot be read. Thrown and caught while loading.
class Unreadable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Document {
  json root;                ///< an object
  std::string_view binary;  ///< the GLB-stored buffer; empty if there is none
};

/// Inputs:  content: of a .gltf or .glb file; must outlive the document.
/// Returns: unset if the file is not glTF 2: invalid JSON, or glTF 1.0.
/// Errors:  Unreadable if the JSON is nested deeper than a hundred levels, to limit the stack of
///          recursive functions. Valid glTF is never that deep.
/// Source:  glTF 2.0, 4.4 (binary form).
/// Checked: GltfDocument.*
std::optional<Document> parse(std::string_view content);

/// Makes a binary file from JSON and a buffer.
std::string glb(const json& root, std::string_view binary);

}  // namespace oriel::models::gltf
