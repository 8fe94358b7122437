// SPDX-License-Identifier: Apache-2.0
// Groups of lights that a user names by patterns.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oriel::scene {

/// Lights whose share of the picture is wanted apart.
struct LightGroup {
  std::string name;                   ///< letters, digits, `_` and `-`; see light_group_complaint()
  std::vector<std::string> patterns;  ///< of names: `*` any text, `?` any one character
  bool operator==(const LightGroup&) const = default;
};

/// What environments are called among lights.
inline constexpr std::string_view kEnvironmentName = "environment";
/// Groups that are there once one is named, and so cannot be: of light that belongs to no group,
/// and of light that does not know where it comes from.
inline constexpr std::string_view kRestGroup = "rest", kIndirectGroup = "indirect";
/// Most groups of a picture.
inline constexpr std::size_t kMaxLightGroups = 62;

/// Patterns with commas between, blanks around them left out.
std::vector<std::string> split_patterns(std::string_view text);

/// Whether the whole name is as the pattern says. Upper and lower case differ.
/// Checked: LightGroup.PatternsMatchWholeNames
bool matches(std::string_view pattern, std::string_view name);

/// What is wrong with a group, empty when nothing is.
std::string light_group_complaint(const LightGroup& group);

/// Adds the group; its patterns replace those of one of the same name.
void set_light_group(std::vector<LightGroup>& groups, LightGroup group);

}  // namespace oriel::scene
