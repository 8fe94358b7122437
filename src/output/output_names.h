// SPDX-License-Identifier: Apache-2.0
// Names of material outputs in files and frame buffers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// kMaterialOutputNames as strings.
/// Checked: OutputNames.* in output_names_test.cpp
const std::vector<std::string>& material_output_names();

/// Index in material_output_names(); -1 if the name is not an output.
int material_output_index(std::string_view name);

/// The material output that a frame buffer name refers to: the longest output name at its end that
/// is not preceded by a letter ("fb_diffuse_raw", "beauty:diffuse_raw", "diffuse_raw").
///
/// Returns: an index into material_output_names(); -1 if there is no match.
/// Checked: OutputNames.FrameBuffersMeanTheLongestNameTheyEndWith
int output_of_frame_buffer(std::string_view buffer);

}  // namespace oriel
