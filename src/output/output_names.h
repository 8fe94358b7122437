// SPDX-License-Identifier: Apache-2.0
// What the outputs of a material are called, in files and in frame buffers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// kMaterialOutputNames as strings.
/// Checked: OutputNames.* in output_names_test.cpp
const std::vector<std::string>& material_output_names();

/// Where the name stands among material_output_names(), -1 when it is none of them.
int material_output_index(std::string_view name);

/// The output that the name of a frame buffer means: the longest output name it ends with, where
/// nothing or no letter stands before it ("fb_diffuse_raw", "beauty:diffuse_raw", "diffuse_raw").
///
/// Returns: an index into material_output_names(), -1 when the name means none of them.
/// Checked: OutputNames.FrameBuffersMeanTheLongestNameTheyEndWith
int output_of_frame_buffer(std::string_view buffer);

}  // namespace oriel
