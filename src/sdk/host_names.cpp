// SPDX-License-Identifier: Apache-2.0
// Conversion between names and tags: mi_api_tag_lookup, mi_api_name_lookup.
#include "oriel/sdk/shader/lookup.h"
#include "sdk/current.h"
#include "sdk/frame_buffers.h"
#include "sdk/geometry_work.h"
#include "sdk/host.h"
#include "sdk/made_parts.h"

namespace oriel::sdk {
namespace {

/// Name of the element that an instance refers to; empty if there is no such instance.
std::string placed_by(const scene::Scene& scene, const std::string& instance) {
  const auto* element = scene.get<scene::Instance>(instance);
  return element ? element->element : std::string();
}

std::string bound_name(const World& world, const void* bound) {
  const auto found = world.names.find(bound);
  return found == world.names.end() ? std::string() : found->second;
}

/// Names of all elements of the world; of equal names the first is used.
std::unordered_map<std::string, miTag> names_of(const World& world, Host& host) {
  std::unordered_map<std::string, miTag> names;
  const scene::Scene& scene = host.scene();
  const auto add = [&](const std::string& name, miTag tag) {
    if (!name.empty() && tag != miNULLTAG) names.try_emplace(name, tag);
  };
  if (!scene.renders.empty()) {
    const scene::RenderCommand& command = scene.renders.back();
    add(command.root, make_tag(TagKind::Root, 0));
    add(command.camera, make_tag(TagKind::CameraInstance, 0));
    add(command.options, make_tag(TagKind::Options, 0));
  }
  if (const scene::Camera* camera = scene_camera(host))
    add(camera->name, make_tag(TagKind::Camera, 0));
  for (std::size_t i = 0; i < world.lights.size(); ++i) {
    add(world.lights[i].name, make_tag(TagKind::LightInstance, i));
    add(placed_by(scene, world.lights[i].name), make_tag(TagKind::Light, i));
  }
  for (std::size_t i = 0; i < world.instances.size(); ++i) {
    add(world.instances[i].name, make_tag(TagKind::Instance, i));
    add(placed_by(scene, world.instances[i].name), make_tag(TagKind::Object, i));
  }
  for (const Material& material : world.materials) add(material.name, host.tag_of(&material));
  for (const auto& node : world.nodes)
    if (world.names.count(node.get())) add(bound_name(world, node.get()), host.tag_of(node.get()));
  for (const auto& texture : world.textures)
    add(bound_name(world, texture.get()), host.tag_of(texture.get()));
  return names;
}

}  // namespace

miTag Host::tag_of_name(const std::string& name) {
  if (name.empty()) return miNULLTAG;
  const GeometryWork* work = GeometryWork::current();
  const std::string own = work ? work->own_name(name) : name;
  if (world_ && !work) {
    bool made = false;
    {
      const std::shared_lock lock(mutex_);
      made = !named_.empty();
      if (const auto found = named_.find(own); found != named_.end()) return found->second;
    }
    if (!made) {
      auto names = names_of(*world_, *this);
      names.try_emplace("", miNULLTAG);  // marks the map as created, even if it is empty
      const std::unique_lock lock(mutex_);
      if (named_.empty()) named_ = std::move(names);
      if (const auto found = named_.find(own); found != named_.end()) return found->second;
    }
  }
  if (const auto* data = scene_.get<scene::UserData>(own); data && !work) return tag_of(data);
  if (scene_.find(own)) return GeometryWork::tag_of(own);
  if (const UserSpec* spec = declaration_named(own)) return tag_of(*spec);
  const bool declared =
      scene_.find_declaration(own) || scene_.find_phenomenon(own) || registry_->find(own);
  return declared ? GeometryWork::tag_of(own) : miNULLTAG;
}

std::string Host::name_of(miTag tag) const {
  const std::size_t index = index_of(tag);
  const scene::RenderCommand* command = scene_.renders.empty() ? nullptr : &scene_.renders.back();
  switch (kind_of(tag)) {
    case TagKind::Made:
      return made::name_of(tag);
    case TagKind::LightInstance:
    case TagKind::Light: {
      if (light(tag) < 0) return {};
      const std::string& name = world_->lights[index].name;
      return kind_of(tag) == TagKind::Light ? placed_by(scene_, name) : name;
    }
    case TagKind::Instance:
    case TagKind::Object: {
      const InstanceData* data = instance(tag);
      if (!data) return {};
      return kind_of(tag) == TagKind::Object ? placed_by(scene_, data->name) : data->name;
    }
    case TagKind::Material: {
      const Material* found = material(tag);
      return found ? found->name : std::string();
    }
    case TagKind::Function:
      return world_ ? bound_name(*world_, node(tag)) : std::string();
    case TagKind::Texture:
      return world_ ? bound_name(*world_, texture(tag)) : std::string();
    case TagKind::UserData: {
      const scene::UserData* data = user_data(tag);
      return data ? data->name : std::string();
    }
    case TagKind::Declaration: {
      const UserSpec* spec = declaration(tag);
      return spec ? spec->own_name : std::string();
    }
    case TagKind::Camera: {
      const scene::Camera* camera = scene_camera(*this);
      return camera ? camera->name : std::string();
    }
    case TagKind::CameraInstance:
      return command ? command->camera : std::string();
    case TagKind::Options:
      return command ? command->options : std::string();
    case TagKind::Root:
      return command ? command->root : std::string();
    default:
      return {};
  }
}

}  // namespace oriel::sdk

using namespace oriel::sdk;

extern "C" {

const char* mi_api_tag_lookup(miTag tag) {
  const Host* host = current_host();
  if (!host || tag == miNULLTAG) return nullptr;
  const std::string name = host->name_of(tag);
  // Names with tags are never deleted, so the pointer stays valid.
  return name.empty() ? nullptr : GeometryWork::name_of(GeometryWork::tag_of(name))->c_str();
}

miTag mi_api_name_lookup(const char* name) {
  const std::string own = taken(name);
  Host* host = current_host();
  return host ? host->tag_of_name(own) : miNULLTAG;
}

}  // extern "C"
