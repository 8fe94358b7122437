// SPDX-License-Identifier: Apache-2.0
// Replaces file names in the text of a scene.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "farm/references.h"

namespace oriel::farm {

/// A name that has to change.
struct NewName {
  const FileReference* reference;
  std::string name;  ///< without quotes, backslashes and control characters
};

/// The text with new names. All other bytes are kept.
/// Errors:  std::runtime_error if a name is not found at its place.
/// Checked: PackText.*
std::string with_names(std::string_view text, char newline, const std::vector<NewName>& names);

}  // namespace oriel::farm
