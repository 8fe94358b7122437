// SPDX-License-Identifier: Apache-2.0
// Binds textures and light profiles by name.
#include <fmt/format.h>

#include "runtime/binder.h"

namespace oriel {

const photometry::LightProfile* Binder::light_profile(const std::string& name,
                                                      SourceLocation where) {
  if (const auto known = light_profiles_.find(name); known != light_profiles_.end())
    return known->second;
  const photometry::LightProfile*& profile = light_profiles_[name];
  if (const auto* element = scene_.get<scene::LightProfile>(name)) {
    if (auto opened = open_light_profile(*element, scene_.files, diagnostics_)) {
      world_.light_profiles.push_back(std::move(opened));
      profile = world_.light_profiles.back().get();
    }
  } else {
    std::vector<std::string> names;
    for (const scene::Element& e : scene_.elements())
      if (std::holds_alternative<scene::LightProfile>(e)) names.push_back(scene::name_of(e));
    const std::string near = nearest_name(name, names);
    diagnostics_.warning("OR-RT-042", where, fmt::format("there is no light profile \"{}\"", name),
                         near.empty() ? "profiles are elements: lightprofile \"name\" ..."
                                      : fmt::format("did you mean \"{}\"?", near));
  }
  return profile;
}

const TextureNode* Binder::texture(const std::string& name, SourceLocation where, Scope* scope) {
  const auto keep = [&](std::unique_ptr<TextureNode> made) {
    world_.textures.push_back(std::move(made));
    return world_.textures.back().get();
  };
  // A shader that is used as a texture: one node each, since phenomena may use the same names.
  const auto procedure = [&](const ShaderNode* node) {
    const TextureNode*& known = procedures_[node];
    if (!known) known = keep(std::make_unique<TextureNode>(NodeList{node}));
    texture_cost_[known] = node->cost_;
    return known;
  };
  if (const ShaderNode* local = find_local(name, scope)) return procedure(local);
  if (const auto known = textures_.find(name); known != textures_.end()) return known->second;
  const auto* element = scene_.get<scene::Texture>(name);
  if (!element) {
    if (const ShaderNode* node = find_named(name, nullptr)) return procedure(node);
    if (!scene_.find(name)) {
      std::vector<std::string> names;
      for (const scene::Element& e : scene_.elements())
        if (std::holds_alternative<scene::Texture>(e)) names.push_back(scene::name_of(e));
      diagnostics_.warning("OR-RT-014", where, fmt::format("there is no texture \"{}\"", name),
                           did_you_mean(name, names));
    }
    return textures_[name] = nullptr;
  }
  // Null while its procedure is bound, so that a procedure that looks itself up finds nothing.
  textures_[name] = nullptr;
  if (element->procedure.empty()) {
    auto made = TextureNode::open(*element, scene_, world_.texture_system, world_.options.gamma,
                                  diagnostics_);
    if (made->missing()) report_.missing_textures.push_back(element->file);
    const TextureNode* kept = keep(std::move(made));
    world_.names.try_emplace(kept, name);
    return textures_[name] = kept;
  }
  NodeList nodes = bind_list(element->procedure, nullptr);
  float cost = 0;
  for (const ShaderNode* node : nodes) cost += node->cost_;
  const TextureNode* made = keep(std::make_unique<TextureNode>(std::move(nodes)));
  texture_cost_[made] = cost;
  world_.names.try_emplace(made, name);
  return textures_[name] = made;
}

}  // namespace oriel
