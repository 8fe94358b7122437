// SPDX-License-Identifier: Apache-2.0
// Where is a file that a scene names by a path of another machine?
#pragma once

#include <string>
#include <vector>

namespace oriel::scene {

/// Paths a file may have here, best first: as written, with slashes, then its last parts alone
/// ("W:\maps\oak.tif": "W:/maps/oak.tif", "maps/oak.tif", "oak.tif"). No part "..": what a scene
/// names is not looked for above where it stands.
std::vector<std::string> spellings_of(const std::string& written);

/// The first spelling that is a file, from `folder` on; as written where none is.
/// Checked: AssetPath.*
std::string find_asset(const std::string& written, const std::string& folder);

}  // namespace oriel::scene
