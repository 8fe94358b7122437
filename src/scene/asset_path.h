// SPDX-License-Identifier: Apache-2.0
// Finds files that a scene refers to by a path of another machine.
#pragma once

#include <string>
#include <vector>

#include "base/file_access.h"

namespace oriel::scene {

/// Converts backslashes of Windows paths to slashes.
std::string with_slashes(std::string path);

/// Candidate paths of a file, best first: as written, with slashes, then shorter and shorter ends
/// of the path ("W:\maps\oak.tif": "W:/maps/oak.tif", "maps/oak.tif", "oak.tif"). The shortened
/// paths contain no "..", so that they stay below the folder they are resolved in.
std::vector<std::string> spellings_of(const std::string& written);

/// The first candidate path that is a file, resolved against `folder`; otherwise the first one that
/// matches a file except for the case of ASCII letters; otherwise the path as written. Files that
/// `access` does not permit are passed over.
/// Checked: AssetPath.*
std::string find_asset(const std::string& written, const std::string& folder,
                       const FileAccess& access = {});

}  // namespace oriel::scene
