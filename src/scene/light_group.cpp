// SPDX-License-Identifier: Apache-2.0
#include "scene/light_group.h"

#include <algorithm>
#include <cctype>

namespace oriel::scene {

std::vector<std::string> split_patterns(std::string_view text) {
  std::vector<std::string> patterns;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    std::string_view word = text.substr(at, end - at);
    while (word.starts_with(' ')) word.remove_prefix(1);
    while (word.ends_with(' ')) word.remove_suffix(1);
    if (!word.empty()) patterns.emplace_back(word);
    at = end + 1;
  }
  return patterns;
}

bool matches(std::string_view pattern, std::string_view name) {
  // On a mismatch the last star matches one more character.
  std::size_t p = 0, n = 0, star = pattern.npos, taken = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      taken = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p, ++n;
    } else if (star != pattern.npos) {
      p = star + 1;
      n = ++taken;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::string light_group_complaint(const LightGroup& group) {
  if (group.name.empty()) return "a light group requires a name";
  if (!std::all_of(group.name.begin(), group.name.end(),
                   [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '-'; }))
    return "the name of a light group consists of letters, digits, _ and -";
  if (group.name == kRestGroup || group.name == kIndirectGroup)
    return "the name \"" + group.name + "\" is reserved for light outside of groups";
  if (group.patterns.empty()) return "a light group requires names of lights, or patterns";
  return {};
}

void set_light_group(std::vector<LightGroup>& groups, LightGroup group) {
  const auto same = std::find_if(groups.begin(), groups.end(),
                                 [&](const LightGroup& g) { return g.name == group.name; });
  if (same != groups.end())
    same->patterns = std::move(group.patterns);
  else
    groups.push_back(std::move(group));
}

}  // namespace oriel::scene
