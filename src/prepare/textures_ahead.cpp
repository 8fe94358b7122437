// SPDX-License-Identifier: Apache-2.0
#include "prepare/textures_ahead.h"

#include <tbb/task_group.h>

#include <unordered_set>
#include <utility>

#include "base/parallel.h"
#include "runtime/texture_node.h"
#include "scene/references.h"

namespace oriel {

std::vector<std::string> used_textures(const scene::Scene& scene, const scene::Camera& camera,
                                       const std::vector<scene::Leaf>& leaves) {
  scene::References search(scene);
  search.follow(camera.environment);
  std::unordered_set<const void*> seen;
  for (const scene::Leaf& leaf : leaves) {
    if (const scene::Object* object = leaf.object(); object && seen.insert(object).second)
      for (const scene::PolygonGroup& group : object->groups)
        for (const std::string& name : group.materials) search.follow(name);
    if (const scene::Instance* source = leaf.material_source; source && seen.insert(source).second)
      for (const std::string& name : source->materials) search.follow(name);
  }
  std::vector<std::string> files;
  for (const std::string& name : search.names()) {
    const auto* texture = scene.get<scene::Texture>(name);
    if (texture && !texture->file.empty() && texture->procedure.empty()) files.push_back(name);
  }
  return files;
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
