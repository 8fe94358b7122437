// SPDX-License-Identifier: Apache-2.0
// Where is a file that a scene names by a path of another machine?
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oriel::scene {

/// A path of any system as this one writes it.
std::string with_slashes(std::string path);

/// Is `path` the folder, or in it? Both canonical; nothing lies below an empty one.
bool lies_below(std::string_view path, std::string_view folder);

/// Paths a file may have here, best first: as written, with slashes, then its last parts alone
/// ("W:\maps\oak.tif": "W:/maps/oak.tif", "maps/oak.tif", "oak.tif"). No part "..": what a scene
/// names is not looked for above where it stands.
std::vector<std::string> spellings_of(const std::string& written);

/// The first spelling that is a file, from `folder` on, else the first that is one in another case
/// of its ASCII letters; as written where none is.
/// Checked: AssetPath.*
std::string find_asset(const std::string& written, const std::string& folder);

}  // namespace oriel::scene
