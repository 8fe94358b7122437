// SPDX-License-Identifier: Apache-2.0
// The two parts of a glTF 2.0 file: its text and, in binary files, the bytes behind it.
#pragma once

#include <optional>
#include <string_view>

#include "models/gltf/json_read.h"

namespace oriel::models::gltf {

struct Document {
  json root;                ///< an object
  std::string_view binary;  ///< the GLB-stored buffer; empty: none
};

/// Inputs:  content: of a .gltf or .glb file; the document refers to it.
/// Returns: unset where it is no glTF 2: damaged text, or glTF 1.0. What is nested deeper than a
///          hundred levels is left out, which glTF's own parts never are.
/// Source:  glTF 2.0, 4.4 (binary form).
/// Checked: GltfDocument.*
std::optional<Document> parse(std::string_view content);

/// A binary file of a text and its buffer.
std::string glb(const json& root, std::string_view binary);

}  // namespace oriel::models::gltf
