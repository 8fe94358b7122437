// SPDX-License-Identifier: Apache-2.0
// Evaluates one `output` statement or frame buffer: types, format and location of a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "output/output.h"
#include "scene/elements.h"

namespace oriel {

struct OutputRoots;

/// The file of an output with a file name, without shaders. Rules and messages are those of
/// camera_outputs().
///
/// Inputs:  statement: its name in messages, "output" or "framebuffer". user_buffers: those that
///          "fbN" may refer to.
/// Returns: unset if there is no file to write; the reason was reported.
/// Checked: CameraOutput.* in camera_output_test.cpp
std::optional<PictureFile> requested_file(const scene::Output& output, std::string_view statement,
                                          const OutputRoots& roots,
                                          const std::vector<UserBuffer>& user_buffers,
                                          Diagnostics& diagnostics);

/// The extension for the image writers of a format or suffix; empty if unsupported.
std::string_view writable_format(std::string_view name);

/// Whether the name has the suffix of a format of the .mi language or of the image writers,
/// supported or not.
bool has_picture_suffix(const std::string& path);

std::string lower_case(std::string text);

}  // namespace oriel
