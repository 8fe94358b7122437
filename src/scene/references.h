// SPDX-License-Identifier: Apache-2.0
// The elements that shaders refer to.
#pragma once

#include <string>
#include <unordered_set>
#include <vector>

#include "scene/scene.h"

namespace oriel::scene {

/// Collects the names that materials, shaders and textures refer to, directly and through others.
/// Names of elements that do not exist are among them; names within phenomena are not followed.
class References {
 public:
  explicit References(const Scene& scene) : scene_(scene) {}

  void follow(const std::string& name);
  void follow(const ShaderList& list);

  /// In the order in which they were found.
  const std::vector<std::string>& names() const { return found_; }
  bool contains(const std::string& name) const { return seen_.contains(name); }

 private:
  void follow_noted();
  void note(const std::string& name);
  void note_shader(const std::string& name);
  void note(const ShaderList& list);
  void note(const Value& value);

  const Scene& scene_;
  std::vector<std::string> noted_, found_;
  std::unordered_set<std::string> seen_;
};

}  // namespace oriel::scene
