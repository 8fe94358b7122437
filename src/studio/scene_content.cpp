// SPDX-License-Identifier: Apache-2.0
#include "studio/scene_content.h"

#include <functional>
#include <utility>

#include "studio/token.h"

namespace oriel::studio {

SceneContent::SceneContent() { forget(); }

void SceneContent::forget() {
  files_ = make_token();
  known_.clear();
}

std::string SceneContent::name(const std::vector<std::string>& edits) const {
  const auto known = known_.find(edits);
  if (known != known_.end()) return known->second;
  std::string all;
  for (const std::string& edit : edits) all += edit + '\0';
  return files_ + '-' + std::to_string(std::hash<std::string>()(all));
}

void SceneContent::save(const std::vector<std::string>& edits,
                        const std::vector<std::string>& inverse) {
  std::map<std::vector<std::string>, std::string> known = {{{}, name(edits)}};
  if (!inverse.empty()) known.emplace(inverse, name({}));
  forget();
  known_ = std::move(known);
}

}  // namespace oriel::studio
