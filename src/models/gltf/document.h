// SPDX-License-Identifier: Apache-2.0
// The two parts of a glTF 2.0 file: its text and, in binary files, the bytes behind it.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "models/gltf/json_read.h"

namespace oriel::models::gltf {

/// Why a part of the file cannot be read, in words. Thrown and caught while loading.
class Unreadable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Document {
  json root;                ///< an object
  std::string_view binary;  ///< the GLB-stored buffer; empty: none
};

/// Inputs:  content: of a .gltf or .glb file; the document refers to it.
/// Returns: unset where it is no glTF 2: damaged text, or glTF 1.0.
/// Errors:  Unreadable where it is nested deeper than a hundred levels, which glTF's own parts
/// never
///          are: what reads it takes a piece of the stack for each.
/// Source:  glTF 2.0, 4.4 (binary form).
/// Checked: GltfDocument.*
std::optional<Document> parse(std::string_view content);

/// A binary file of a text and its buffer.
std::string glb(const json& root, std::string_view binary);

}  // namespace oriel::models::gltf
