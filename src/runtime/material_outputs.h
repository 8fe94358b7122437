// SPDX-License-Identifier: Apache-2.0
// The outputs of the architectural material by number, for frame buffers and connections.
#pragma once

#include <array>

#include "base/vec.h"

namespace oriel {

/// The 24 outputs in the order of the material's declaration, then "other": light of none of them.
/// All are colours except "opacity", a scalar.
/// Source: manual 1.6.11.
inline constexpr std::array kMaterialOutputNames = {
    "result",      "diffuse_result",  "diffuse_raw",  "diffuse_level",    "spec_result",
    "spec_raw",    "spec_level",      "refl_result",  "refl_raw",         "refl_level",
    "refr_result", "refr_raw",        "refr_level",   "tran_result",      "tran_raw",
    "tran_level",  "indirect_result", "indirect_raw", "indirect_post_ao", "ao_raw",
    "add_result",  "opacity_result",  "opacity_raw",  "opacity",          "other"};
inline constexpr std::size_t kMaterialOutputs = kMaterialOutputNames.size();
/// The number of outputs of the material; the others belong to the picture only.
inline constexpr std::size_t kMaterialResults = kMaterialOutputs - 1;

using MaterialOutputs = std::array<Rgb, kMaterialOutputs>;

}  // namespace oriel
