// SPDX-License-Identifier: Apache-2.0
// Objects made by geometry shaders, and the content of placeholders.
#include <filesystem>

#include "mi/placeholder.h"
#include "sdk/context.h"
#include "sdk/current.h"
#include "sdk/geometry_work.h"
#include "sdk/host.h"
#include "sdk/made_parts.h"
#include "sdk/tags.h"
#include "shaders/registry.h"

namespace oriel::sdk {
namespace {

/// Flags as statements of the object.
std::vector<scene::Statement> flag_statements(const miObject& from) {
  std::vector<scene::Statement> flags;
  const auto boolean = [&](const char* word, bool on) {
    made::say(flags, word, made::boolean(on));
  };
  const auto integer = [&](const char* word, int number) {
    made::say(flags, word, made::integer(number));
  };
  boolean("visible", from.visible);
  boolean("shadow", from.shadow);
  integer("reflection", from.reflection);
  integer("refraction", from.refraction);
  integer("transparency", from.transparency);
  integer("finalgather", from.finalgather);
  integer("caustic", from.caustic);
  integer("globillum", from.globillum);
  return flags;
}

miObject default_flags() {
  miObject flags = {};
  flags.visible = flags.shadow = miTRUE;
  flags.reflection = flags.refraction = 3;
  flags.transparency = flags.finalgather = 3;
  flags.face = 'a';
  return flags;
}

/// Name of the element for an object that a shader begins.
std::string object_name(GeometryWork& work, const std::string& wanted) {
  const std::string known = work.own_name(wanted);
  if (!work.filling.empty() && (wanted.empty() || wanted == work.filling || known == work.filling))
    return work.filling;
  if (work.incremental && !wanted.empty() &&
      (work.objects.count(known) > 0 || work.scene->get<scene::Object>(known)))
    return known;
  return work.free_name(wanted);
}

/// Base of relative file names: the main scene file.
SourceLocation place_of_scene(const scene::Scene& scene) {
  return scene.renders.empty() ? SourceLocation{} : scene.renders.back().where;
}

void load_file(GeometryWork& work, const std::string& name, const std::string& file) {
  Host* host = current_host();
  auto* object = work.scene->get<scene::Object>(name);
  if (!host || !object) return;
  scene::Value path;
  path.kind = scene::Value::Kind::Text;
  path.text = file;
  object->flags.push_back({"file", false, {path}, {}});
  object->where = place_of_scene(*work.scene);
  mi::ReadOptions options;
  options.packages = builtin_packages();
  options.knows_shader = [host](std::string_view shader) {
    return host->registry().find(shader) != nullptr;
  };
  options.files = host->scene().files;
  options.budgets = host->scene().budgets;
  // Shaders have the rights of the user: files are not restricted to folders. The name may be a
  // parameter of the scene, which has no such rights if it is untrusted.
  if (!options.files.is_untrusted() || options.files.permits(file, FileUse::Scene))
    options.include_paths = {std::filesystem::path(file).parent_path().string()};
  mi::load_placeholder(*work.scene, name, options, host->diagnostics());
}

}  // namespace

std::string taken(const char* name) {
  if (!name) return {};
  std::string own = name;
  mi_mem_release(const_cast<char*>(name));
  return own;
}

scene::PolygonGroup* open_group() {
  GeometryWork* work = GeometryWork::current();
  return work && !work->object.groups.empty() ? &work->object.groups.back() : nullptr;
}

std::uint32_t material_index(scene::PolygonGroup& group, const std::string& name) {
  if (name.empty()) return scene::kNone;
  std::uint32_t index = 0;
  while (index < group.materials.size() && group.materials[index] != name) ++index;
  if (index == group.materials.size()) group.materials.push_back(name);
  return index;
}

std::string GeometryWork::free_name(const std::string& wanted) {
  const std::string stem = wanted.empty()        ? prefix + "made"
                           : scene->find(wanted) ? prefix + wanted
                                                 : wanted;
  std::string own = stem;
  for (int i = 2; scene->find(own); ++i) own = stem + "#" + std::to_string(i);
  if (!wanted.empty()) given[wanted] = own;
  return own;
}

miObject* GeometryWork::object_of(miTag tag) {
  GeometryWork* work = current();
  const std::string* name = name_of(tag);
  if (!work || !name) return nullptr;
  const auto found = work->objects.find(*name);
  return found == work->objects.end() ? nullptr : &found->second->flags;
}

void finish_objects(GeometryWork& work) {
  // A callback may create further placeholders. `arguments` are complete at this point.
  for (std::size_t i = 0; i < work.callbacks.size(); ++i) {
    const GeometryWork::Callback callback = work.callbacks[i];
    work.object = {};
    work.filling = callback.object;
    callback.call(GeometryWork::tag_of(callback.object), callback.arguments);
  }
  work.filling.clear();
  for (const auto& [name, record] : work.objects)
    if (auto* object = work.scene->get<scene::Object>(name)) {
      object->flags = flag_statements(record->flags);
      made::attach(record->flags, object->flags);
    }
  for (const auto& [name, record] : work.objects)
    if (!record->file.empty()) load_file(work, name, record->file);
}

}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miObject* mi_api_object_begin(const char* name) {
  GeometryWork* work = GeometryWork::current();
  const std::string wanted = taken(name);
  if (!work) return nullptr;
  work->object = {};
  work->hair = {};
  work->surface = {};
  work->map = {};
  work->object.name = object_name(*work, wanted);
  auto& record = work->objects[work->object.name];
  const bool known = record != nullptr;
  if (!known) record = std::make_unique<GeometryWork::ObjectRecord>();
  // The shader may have removed the previous element of that name.
  if (!known || !work->scene->get<scene::Object>(work->object.name))
    record->flags = default_flags();
  record->file.clear();
  return &record->flags;
}

miTag mi_api_object_end(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work || work->object.name.empty()) return miNULLTAG;
  const miTag tag = work->add(std::move(work->object));
  work->object = {};
  return tag;
}

miBoolean mi_api_object_callback(miApi_object_callback callback, void* args) {
  GeometryWork* work = GeometryWork::current();
  if (!work || !callback || work->object.name.empty()) return miFALSE;
  work->objects[work->object.name]->flags.type = miOBJECT_PLACEHOLDER;
  work->callbacks.push_back({work->object.name, callback, args});
  return miTRUE;
}

miBoolean mi_api_object_file(const char* filename) {
  GeometryWork* work = GeometryWork::current();
  const std::string file = taken(filename);
  if (!work || work->object.name.empty() || file.empty()) return miFALSE;
  auto& record = *work->objects[work->object.name];
  record.flags.type = miOBJECT_PLACEHOLDER;
  record.file = file;
  return miTRUE;
}

miBoolean mi_api_incremental(miBoolean on) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return miFALSE;
  work->incremental = on != miFALSE;
  return miTRUE;
}

}  // extern "C"
