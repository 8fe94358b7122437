// SPDX-License-Identifier: Apache-2.0
// What of a scene refers to elements that have changed.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "scene/hierarchy.h"
#include "scene/references.h"
#include "scene/scene.h"

namespace oriel {

/// Names of changed elements, and questions about what refers to them.
class ChangedElements {
 public:
  ChangedElements(const scene::Scene& scene, std::set<std::string> names)
      : scene_(scene), names_(std::move(names)) {}

  /// Whether update_world() can handle the change of every element: materials, shaders, lights,
  /// textures and instances, to which no phenomenon, option, output or geometry shader refers; and
  /// cameras, if their shaders changed only.
  bool are_supported() const;
  std::size_t size() const { return names_.size(); }
  bool contain(const std::string& name) const { return names_.contains(name); }
  /// Whether a list of shaders refers to them.
  bool affect(const scene::ShaderList& list) const;
  bool affect(const scene::Light& light) const;
  /// Whether the element with that name is one of them or refers to them.
  bool affect(const std::string& element) const;
  /// Whether an instance above the leaf is one of them.
  bool place(const scene::Leaf& leaf) const;
  /// Adds the names by which shaders refer to the light of a leaf.
  void add_light(const scene::Leaf& leaf);

 private:
  bool affect(const scene::References& references) const;

  const scene::Scene& scene_;
  std::set<std::string> names_;
};

}  // namespace oriel
