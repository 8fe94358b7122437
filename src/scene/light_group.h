// SPDX-License-Identifier: Apache-2.0
// Light groups, defined by name patterns.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace oriel::scene {

/// Lights with a separate output layer.
struct LightGroup {
  std::string name;                   ///< letters, digits, `_` and `-`; see light_group_complaint()
  std::vector<std::string> patterns;  ///< of names: `*` any text, `?` any one character
  bool operator==(const LightGroup&) const = default;
};

/// Name of the environment in light groups.
inline constexpr std::string_view kEnvironmentName = "environment";
/// Reserved names: light of sources in no group, and indirect light without a known source. Both
/// layers exist if a light group exists.
inline constexpr std::string_view kRestGroup = "rest", kIndirectGroup = "indirect";
/// Maximum number of groups per image.
inline constexpr std::size_t kMaxLightGroups = 62;

/// Splits at commas and trims blanks.
std::vector<std::string> split_patterns(std::string_view text);

/// Whether the pattern matches the whole name. Case-sensitive.
/// Checked: LightGroup.PatternsMatchWholeNames
bool matches(std::string_view pattern, std::string_view name);

/// Why a group is invalid; empty if it is valid.
std::string light_group_complaint(const LightGroup& group);

/// Adds the group, or replaces the patterns of the group with the same name.
void set_light_group(std::vector<LightGroup>& groups, LightGroup group);

}  // namespace oriel::scene
