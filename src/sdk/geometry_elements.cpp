// SPDX-License-Identifier: Apache-2.0
// Instances and groups made by geometry shaders.
#include <algorithm>
#include <cstdarg>
#include <cstring>
#include <utility>

#include "sdk/context.h"
#include "sdk/geometry_work.h"
#include "sdk/made_parts.h"
#include "sdk/made_record.h"
#include "sdk/once.h"

namespace oriel::sdk {
namespace {

/// Flags set by the shader; 0 inherits those of the element and of parent instances.
void store_flags(const miInstance& from, std::vector<scene::Statement>& flags) {
  const auto ray_flag = [&](const char* word, int bits) {
    if (bits != 0) made::say(flags, word, made::integer(bits & 15));
  };
  ray_flag("visible", from.visible);
  ray_flag("shadow", from.shadow);
  ray_flag("reflection", from.reflection);
  ray_flag("refraction", from.refraction);
  ray_flag("transparency", from.transparency);
  ray_flag("finalgather", from.finalgather);
  ray_flag("caustic", from.caustic);
  ray_flag("globillum", from.globillum);
  if (from.off) made::say(flags, "hide", made::boolean(true));
  if (from.mtl_override) flags.push_back({"override", false, {}, {}});
  const char* face = from.face == 'f'   ? "front"
                     : from.face == 'b' ? "back"
                     : from.face == 'a' ? "both"
                                        : nullptr;
  if (face) made::say(flags, "face", made::text(face));
}

/// Transform from parent to local space, from either of the two matrices.
Mat4 transform_of(const miTransform& tf) {
  const Mat4 to_local = made::matrix_of(tf.global_to_local);
  const Mat4 to_parent = made::matrix_of(tf.local_to_global);
  if (to_local == Mat4() && to_parent != Mat4()) return to_parent.inverse();
  return to_local;
}

std::optional<scene::LightLinks> links_of(const GeometryWork& work, miTag list, bool exclusive) {
  const auto found = work.elements.light_lists.find(list);
  if (found == work.elements.light_lists.end()) return std::nullopt;
  return scene::LightLinks{exclusive, found->second};
}

void store(const GeometryWork& work, const miInstance& data, scene::Instance& made) {
  made.transform = transform_of(data.tf);
  if (data.gen_motion) made.motion_transform = made::matrix_of(data.motion_transform);
  if (const std::string material = made::name_of(data.material); !material.empty())
    made.materials = {material};
  store_flags(data, made.flags);
  made::attach(data, made.flags);
  if (auto links = links_of(work, data.light_list, data.exclusive)) made.light_links = links;
  if (auto links = links_of(work, data.shadow_list, data.shadow_excl)) made.shadow_links = links;
}

}  // namespace
}  // namespace oriel::sdk

using namespace oriel;
using namespace oriel::sdk;

extern "C" {

miInstance* mi_api_instance_begin(const char* name) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return nullptr;
  ElementWork& elements = work->elements;
  elements.instance.emplace();
  elements.instance->name = work->name_for(name);
  if (const auto* known = work->scene->get<scene::Instance>(elements.instance->name))
    elements.instance = *known;
  elements.instance_data = c_instance(*elements.instance);
  return &elements.instance_data;
}

miTag mi_api_instance_end(const char* item, miTag function, miTag params) {
  GeometryWork* work = GeometryWork::current();
  const std::string given = taken(item);
  if (!work || !work->elements.instance) return miNULLTAG;
  scene::Instance made = std::move(*work->elements.instance);
  work->elements.instance.reset();
  if (item) {
    made.element = work->own_name(given);
    made.geometry.clear();
  } else if (scene::ShaderList call = made::shader_list(*work->scene, function); !call.empty()) {
    made.geometry = std::move(call);
    made.element.clear();
  } else if (const std::string element = made::name_of(function); !element.empty()) {
    made.element = element;
  }
  if (params != miNULLTAG)
    warn_once("OR-SDK-040",
              "a geometry shader sets a transformation shader of an instance, which "
              "has no effect; the matrices of the instance are used");
  store(*work, work->elements.instance_data, made);
  return work->add(std::move(made));
}

miBoolean mi_api_light_list_begin(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return miFALSE;
  work->elements.light_list.clear();
  return miTRUE;
}

miBoolean mi_api_light_list_add(const char* instance) {
  GeometryWork* work = GeometryWork::current();
  const std::string given = taken(instance);
  if (!work || given.empty()) return miFALSE;
  work->elements.light_list.push_back(work->own_name(given));
  return miTRUE;
}

miTag mi_api_light_list_end(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return miNULLTAG;
  ElementWork& elements = work->elements;
  const miTag tag = GeometryWork::tag_of(work->prefix + "light list " +
                                         std::to_string(elements.light_lists.size()));
  elements.light_lists[tag] = std::exchange(elements.light_list, {});
  return tag;
}

miGroup* mi_api_instgroup_begin(const char* name) {
  GeometryWork* work = GeometryWork::current();
  if (!work) return nullptr;
  ElementWork& elements = work->elements;
  elements.group.emplace();
  elements.group->name = work->name_for(name);
  if (const auto* known = work->scene->get<scene::InstanceGroup>(elements.group->name))
    elements.group = *known;
  elements.group_data = {};
  elements.group_data.no_kids = static_cast<int>(elements.group->members.size());
  return &elements.group_data;
}

miBoolean mi_api_instgroup_additem(const char* instance_name, ...) {
  GeometryWork* work = GeometryWork::current();
  const std::string given = taken(instance_name);
  if (!work || !work->elements.group) return miFALSE;
  std::string name = work->own_name(given);
  if (!instance_name) {
    va_list list;
    va_start(list, instance_name);
    name = made::name_of(va_arg(list, miTag));
    va_end(list);
  }
  if (name.empty()) return miFALSE;
  work->elements.group->members.push_back(std::move(name));
  ++work->elements.group_data.no_kids;
  return miTRUE;
}

miBoolean mi_api_instgroup_clear(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work || !work->elements.group) return miFALSE;
  work->elements.group->members.clear();
  work->elements.group_data.no_kids = 0;
  return miTRUE;
}

miTag mi_api_instgroup_end(void) {
  GeometryWork* work = GeometryWork::current();
  if (!work || !work->elements.group) return miNULLTAG;
  scene::InstanceGroup made = std::move(*work->elements.group);
  work->elements.group.reset();
  made::attach(work->elements.group_data, made.settings);
  return work->add(std::move(made));
}

}  // extern "C"
