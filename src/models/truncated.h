// SPDX-License-Identifier: Apache-2.0
// Recognizes truncated model files.
#pragma once

#include <string>

#include "models/text_files.h"

namespace oriel::models {

/// Why a model file is incomplete, as the end of a sentence; empty if it appears to be complete.
///
/// Model:   sizes that formats define (PLY, binary STL, 3DS, binary FBX), closing marks (Collada,
///          glTF, ASCII STL, IFC), balanced braces (ASCII FBX), and last lines that lack values
///          (OBJ and its material files). An OBJ file cut at the end of a line is a valid file.
/// Inputs:  suffix: in lower case, with its dot. GLB files and buffers of glTF: see gltf/read.h.
/// Checked: TruncatedModels.*
std::string truncation_of(const std::string& path, const std::string& suffix,
                          const ModelFiles& files);

}  // namespace oriel::models
