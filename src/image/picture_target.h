// SPDX-License-Identifier: Apache-2.0
// Which files a picture may be written to.
#pragma once

#include <string>

namespace oriel {

/// Why no picture may be written to `path`; empty if it may.
///
/// Model:   refused are symbolic links, folders, pipes and devices (target_fault()), names that
///          begin with a dot, and existing files that are neither empty nor begin like a picture of
///          a known format.
/// Checked: PictureTarget.* in picture_target_test.cpp
std::string picture_fault(const std::string& path);

/// Throws picture_fault() as std::runtime_error.
void check_picture_target(const std::string& path);

}  // namespace oriel
