// SPDX-License-Identifier: Apache-2.0
// Textures, materials and user data made by geometry shaders, and removal of elements.
#include <cstdint>

#include "sdk/current.h"
#include "sdk/geometry_work.h"
#include "sdk/host.h"
#include "sdk/made_parts.h"

namespace oriel::sdk {
namespace {

/// Maximum size of user data that a shader may copy.
constexpr std::size_t kMaxDataBytes = std::size_t{1} << 30;

/// The scene element with a name given by a shader; frees the string.
template <class T>
const T* find(GeometryWork* work, const char* name) {
  const std::string given = taken(name);
  return work ? work->scene->get<T>(work->own_name(given)) : nullptr;
}

/// A tag that a shader passes as a pointer: the value itself or its address.
miTag tag_behind(const void* value) {
  const auto number = reinterpret_cast<std::uintptr_t>(value);
  if (number <= 0xffffffffu) return static_cast<miTag>(number);
  return *static_cast<const miTag*>(value);
}

/// Moves the parameters of a call to user data.
void take_parameters(const GeometryWork& work, miTag call, scene::UserData& data) {
  const auto* element = work.scene->get<scene::ShaderElement>(made::name_of(call));
  if (!element || element->functions.empty()) return;
  data.declaration = element->functions[0].type;
  data.arguments = element->functions[0].arguments;
}

/// Removes an element and its contents or instances.
void remove_tree(scene::Scene& scene, const std::string& name) {
  std::vector<std::string> below = {name};
  while (!below.empty()) {
    const std::string next = std::move(below.back());
    below.pop_back();
    if (const auto* group = scene.get<scene::InstanceGroup>(next))
      below.insert(below.end(), group->members.begin(), group->members.end());
    if (const auto* instance = scene.get<scene::Instance>(next)) below.push_back(instance->element);
    scene.remove(next);
  }
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miTag mi_api_texture_begin(const char* name, int type, int flags) {
  GeometryWork* work = GeometryWork::current();
  std::string given = taken(name);
  if (!work) return miNULLTAG;
  work->elements.texture.reset();
  const std::string own = work->own_name(given);
  if (work->scene->get<scene::Texture>(own) && !work->incremental) return GeometryWork::tag_of(own);
  scene::Texture& texture = work->elements.texture.emplace();
  texture.name = work->scene->find(own) ? work->prefix + given : own;
  work->given[given] = texture.name;
  texture.type = type == 1   ? ParamType::ScalarTexture
                 : type == 2 ? ParamType::VectorTexture
                             : ParamType::ColorTexture;
  texture.local = (flags & 1) != 0;
  if (flags & 2) texture.filter = 1.0f;
  texture.writable = (flags & 4) != 0;
  return miNULLTAG;
}

miTag mi_api_texture_file_def(const char* file) {
  GeometryWork* work = GeometryWork::current();
  std::string path = taken(file);
  if (!work || !work->elements.texture) return miNULLTAG;
  scene::Texture made = std::move(*work->elements.texture);
  work->elements.texture.reset();
  made.file = std::move(path);
  return work->add(std::move(made));
}

miTag mi_api_texture_lookup(const char* name, miTag) {
  const auto* texture = find<scene::Texture>(GeometryWork::current(), name);
  return texture ? GeometryWork::tag_of(texture->name) : miNULLTAG;
}

miMaterial* mi_api_material_begin(const char* name) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return nullptr;
  work->elements.material.emplace();
  work->elements.material->name = work->name_for(name);
  work->elements.material_data = {};
  return &work->elements.material_data;
}

miTag mi_api_material_end(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work || !work->elements.material) return miNULLTAG;
  scene::Material made = std::move(*work->elements.material);
  work->elements.material.reset();
  const miMaterial& data = work->elements.material_data;
  made.opaque = data.opaque != miFALSE;
  made.shaders = made::shader_list(*work->scene, data.shader);
  const auto slot = [&](const char* keyword, miTag call) {
    scene::ShaderList list = made::shader_list(*work->scene, call);
    if (!list.empty()) made.slots.push_back({keyword, std::move(list)});
  };
  slot("displace", data.displace);
  slot("shadow", data.shadow);
  slot("volume", data.volume);
  slot("environment", data.environment);
  slot("contour", data.contour);
  slot("photon", data.photon);
  slot("photonvol", data.photonvol);
  slot("lightmap", data.lightmap);
  return work->add(std::move(made));
}

miBoolean mi_api_data_begin(const char* name, int kind, void* value) {
  GeometryWork* work = GeometryWork::current();
  if (!work) {
    taken(name);
    return miFALSE;
  }
  scene::UserData& data = work->elements.data.emplace();
  data.name = work->name_for(name);
  if (kind == 1) data.file = taken(static_cast<const char*>(value));
  if (kind == 2 && value) take_parameters(*work, tag_behind(value), data);
  return miTRUE;
}

miBoolean mi_api_data_byte_copy(int size, miUchar* bytes) {
  GeometryWork* work = GeometryWork::current();
  if (!work || !work->elements.data || size < 0 || (size > 0 && !bytes)) return miFALSE;
  std::vector<std::uint8_t>& all = work->elements.data->bytes;
  if (all.size() + static_cast<std::size_t>(size) > kMaxDataBytes) return miFALSE;
  all.insert(all.end(), bytes, bytes + size);
  return miTRUE;
}

miTag mi_api_data_end(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work || !work->elements.data) return miNULLTAG;
  scene::UserData made = std::move(*work->elements.data);
  work->elements.data.reset();
  return work->add(std::move(made));
}

miTag mi_api_data_append(miTag list, miTag next) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return list;
  scene::Scene& scene = *work->scene;
  const std::string behind = made::name_of(next);
  if (!scene.get<scene::UserData>(behind)) return list;
  auto* last = scene.get<scene::UserData>(made::name_of(list));
  if (!last) return next;
  // Prevents cycles in the list of user data.
  for (const auto* data = scene.get<scene::UserData>(behind); data;
       data = scene.get<scene::UserData>(data->next))
    if (data == last) return list;
  while (auto* further = scene.get<scene::UserData>(last->next)) {
    if (further->name == behind) return list;
    last = further;
  }
  last->next = behind;
  if (Host* host = current_host()) host->renew(GeometryWork::tag_of(last->name));
  return list;
}

miBoolean mi_api_delete(const char* name) {
  GeometryWork* work = GeometryWork::current();
  const std::string given = taken(name);
  return work && work->scene->remove(work->own_name(given)) ? miTRUE : miFALSE;
}

miBoolean mi_api_delete_tree(const char* name) {
  GeometryWork* work = GeometryWork::current();
  const std::string given = taken(name);
  if (!work || !work->scene->find(work->own_name(given))) return miFALSE;
  remove_tree(*work->scene, work->own_name(given));
  return miTRUE;
}

miBoolean mi_api_touch(const char* name) {
  GeometryWork* work = GeometryWork::current();
  const std::string given = taken(name);
  return work && work->scene->touch(work->own_name(given)) ? miTRUE : miFALSE;
}

}  // extern "C"
