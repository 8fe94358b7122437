// SPDX-License-Identifier: Apache-2.0
#include "prepare/textures_ahead.h"

#include <tbb/task_group.h>

#include <unordered_set>
#include <utility>

#include "base/parallel.h"
#include "runtime/texture_node.h"

namespace oriel {
namespace {

/// Follows references between materials, shaders and textures.
class TextureSearch {
 public:
  explicit TextureSearch(const scene::Scene& scene) : scene_(scene) {}

  void follow(const std::string& name) {
    note(name);
    follow_noted();
  }
  void follow(const scene::ShaderList& list) {
    note(list);
    follow_noted();
  }

  std::vector<std::string> found;

 private:
  // Chains of references may be long, so they are not followed by recursion.
  void follow_noted() {
    while (!noted_.empty()) {
      const std::string name = std::move(noted_.back());
      noted_.pop_back();
      if (const auto* texture = scene_.get<scene::Texture>(name)) {
        if (!texture->file.empty() && texture->procedure.empty()) found.push_back(name);
        note(texture->procedure);
      } else if (const auto* shader = scene_.get<scene::ShaderElement>(name)) {
        note(shader->functions);
      } else if (const auto* material = scene_.get<scene::Material>(name)) {
        note(material->shaders);
        for (const scene::Material::Slot& slot : material->slots) note(slot.shaders);
      }
    }
  }
  void note(const std::string& name) {
    if (!name.empty() && seen_.insert(name).second) noted_.push_back(name);
  }
  void note(const scene::ShaderList& list) {
    for (const scene::ShaderUse& use : list) {
      note(use.reference);
      for (const scene::Argument& argument : use.arguments) note(argument.value);
    }
  }
  void note(const scene::Value& value) {
    using Kind = scene::Value::Kind;
    if (value.kind == Kind::Text) note(value.text);
    if (value.kind == Kind::Connection) note(value.text.substr(0, value.text.find('.')));
    for (const scene::Value& item : value.items) note(item);
    for (const scene::Argument& member : value.members) note(member.value);
  }

  std::vector<std::string> noted_;
  const scene::Scene& scene_;
  std::unordered_set<std::string> seen_;
};

}  // namespace

std::vector<std::string> used_textures(const scene::Scene& scene, const scene::Camera& camera,
                                       const std::vector<scene::Leaf>& leaves) {
  TextureSearch search(scene);
  search.follow(camera.environment);
  std::unordered_set<const void*> seen;
  for (const scene::Leaf& leaf : leaves) {
    if (const scene::Object* object = leaf.object(); object && seen.insert(object).second)
      for (const scene::PolygonGroup& group : object->groups)
        for (const std::string& name : group.materials) search.follow(name);
    if (const scene::Instance* source = leaf.material_source; source && seen.insert(source).second)
      for (const std::string& name : source->materials) search.follow(name);
  }
  return std::move(search.found);
}

struct TexturesAhead::Tasks {
  Tasks(const scene::Scene& of, std::vector<std::string> wanted, TextureSystem& opener, float g)
      : scene(of), names(std::move(wanted)), system(opener), gamma(g) {}

  const scene::Scene& scene;
  std::vector<std::string> names;
  TextureSystem& system;
  float gamma;
  tbb::task_group group;

  void open(std::size_t i) const {
    TextureNode::open_ahead(*scene.get<scene::Texture>(names[i]), scene, system, gamma);
  }
};

TexturesAhead::TexturesAhead(const scene::Scene& scene, std::vector<std::string> names,
                             TextureSystem& system, float gamma) {
  if (names.empty()) return;
  tasks_ = std::make_unique<Tasks>(scene, std::move(names), system, gamma);
  tasks_->group.run([tasks = tasks_.get()] {
    tasks->open(0);
    parallel_for(tasks->names.size() - 1, [&](std::size_t i) { tasks->open(i + 1); });
  });
}

TexturesAhead::~TexturesAhead() {
  if (!tasks_) return;
  tasks_->group.cancel();
  tasks_->group.wait();
}

}  // namespace oriel
