// SPDX-License-Identifier: Apache-2.0
// What one `output` statement or frame buffer asks for: types, format and place of a file.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "output/output.h"
#include "scene/elements.h"

namespace oriel {

struct OutputRoots;

/// The file that an output with a file name asks for, without shaders. Rules and messages are those
/// of camera_outputs().
///
/// Inputs:  statement: what messages call it, "output" or "framebuffer". user_buffers: those that
/// "fbN" may name.
/// Returns: nothing when there is no file to write; a message has said why.
/// Checked: CameraOutput.* in camera_output_test.cpp
std::optional<PictureFile> requested_file(const scene::Output& output, std::string_view statement,
                                          const OutputRoots& roots,
                                          const std::vector<UserBuffer>& user_buffers,
                                          Diagnostics& diagnostics);

/// The extension the writers know for a format of the language or a suffix; empty when none does.
std::string_view writable_format(std::string_view name);

std::string lower_case(std::string text);

}  // namespace oriel
