// SPDX-License-Identifier: Apache-2.0
#include "sdk/made_record.h"

#include <cstring>
#include <variant>
#include <vector>

#include "sdk/context.h"
#include "sdk/host.h"
#include "sdk/user_data.h"

namespace oriel::sdk {
namespace {

using Bytes = std::unique_ptr<std::byte[]>;

template <class T>
Bytes record(const T& value, std::size_t& size) {
  size = sizeof(T);
  auto bytes = std::make_unique<std::byte[]>(size);
  std::memcpy(bytes.get(), &value, size);
  return bytes;
}

Bytes group_record(const std::vector<miTag>& kids, miTag data, miUint label, std::size_t& size) {
  miGroup head = {};
  head.max_kids = head.no_kids = static_cast<int>(kids.size());
  head.userdata = data;
  head.label = label;
  constexpr std::size_t kHead = offsetof(miGroup, kids);
  size = std::max(sizeof head, kHead + kids.size() * sizeof(miTag));
  auto bytes = std::make_unique<std::byte[]>(size);
  std::memcpy(bytes.get(), &head, sizeof head);
  if (!kids.empty()) std::memcpy(bytes.get() + kHead, kids.data(), kids.size() * sizeof(miTag));
  return bytes;
}

void store(miMatrix to, const Mat4& from) { std::memcpy(to, from.getValue(), sizeof(miMatrix)); }

/// The named shader of a list; 0 if the list contains unnamed calls.
miTag shader_of(Host& host, const scene::ShaderList* list) {
  return list && !list->empty() ? host.tag_of_name(list->front().reference) : miNULLTAG;
}

/// Makes the structure of each kind of element.
struct Maker {
  Host& host;
  std::size_t& size;

  Bytes operator()(const scene::Instance& from) const {
    miInstance out = c_instance(from);
    out.item = host.tag_of_name(from.element);
    if (!from.materials.empty()) out.material = host.tag_of_name(from.materials.front());
    out.mtl_array_size = static_cast<int>(from.materials.size());
    attach(settings_of(from), out);
    return record(out, size);
  }
  Bytes operator()(const scene::InstanceGroup& from) const {
    std::vector<miTag> kids;
    for (const std::string& member : from.members)
      if (const miTag kid = host.tag_of_name(member)) kids.push_back(kid);
    const scene::InstanceGroupSettings settings = settings_of(from);
    return group_record(kids, attached_data(settings, host), settings.label, size);
  }
  Bytes operator()(const scene::Light& from) const {
    miLight out = {};
    out.type = !from.origin ? miLIGHT_DIRECTION : from.direction ? miLIGHT_SPOT : miLIGHT_ORIGIN;
    if (from.origin) out.origin = as_c(*from.origin);
    if (from.direction) out.direction = as_c(*from.direction);
    out.spread = from.spread.value_or(0);
    out.shader = shader_of(host, &from.shaders);
    out.emitter = shader_of(host, &from.emitters);
    const scene::LightSettings settings = settings_of(from);
    attach(settings, out);
    store_shadow_map(settings.shadow_map, out);
    return record(out, size);
  }
  Bytes operator()(const scene::Material& from) const {
    const auto slot = [&](const char* keyword) { return shader_of(host, from.slot(keyword)); };
    miMaterial out = {};
    out.opaque = from.opaque;
    out.shader = shader_of(host, &from.shaders);
    out.displace = slot("displace");
    out.shadow = slot("shadow");
    out.volume = slot("volume");
    out.environment = slot("environment");
    out.contour = slot("contour");
    out.photon = slot("photon");
    out.photonvol = slot("photonvol");
    out.lightmap = slot("lightmap");
    return record(out, size);
  }
  Bytes operator()(const scene::UserData& from) const { return user_data_record(from, host, size); }
  Bytes operator()(const scene::ShaderElement& from) const {
    miFunction out = {};
    out.type = miFUNCTION_C;
    if (!from.functions.empty()) out.function_decl = host.tag_of_name(from.functions[0].type);
    return record(out, size);
  }
  template <class Other>
  Bytes operator()(const Other&) const {
    return {};
  }
  template <class Record>
  void attach(const scene::Attachments& from, Record& out) const {
    out.userdata = attached_data(from, host);
    out.label = from.label;
  }
};

struct TypeOf {
  miScene_types operator()(const scene::Options&) const { return miSCENE_OPTIONS; }
  miScene_types operator()(const scene::Camera&) const { return miSCENE_CAMERA; }
  miScene_types operator()(const scene::Light&) const { return miSCENE_LIGHT; }
  miScene_types operator()(const scene::Material&) const { return miSCENE_MATERIAL; }
  miScene_types operator()(const scene::Texture&) const { return miSCENE_IMAGE; }
  miScene_types operator()(const scene::LightProfile&) const { return miSCENE_LIGHTPROFILE; }
  miScene_types operator()(const scene::Object&) const { return miSCENE_OBJECT; }
  miScene_types operator()(const scene::Instance&) const { return miSCENE_INSTANCE; }
  miScene_types operator()(const scene::InstanceGroup&) const { return miSCENE_GROUP; }
  miScene_types operator()(const scene::ShaderElement&) const { return miSCENE_FUNCTION; }
  miScene_types operator()(const scene::Assembly&) const { return miSCENE_ASSEMBLY; }
  miScene_types operator()(const scene::UserData&) const { return miSCENE_USERDATA; }
  miScene_types operator()(const scene::UninterpretedElement&) const { return miSCENE_NONE; }
};

bool is_declared(const Host& host, const std::string& name) {
  return host.scene().find_declaration(name) || host.registry().find(name);
}

}  // namespace

miScene_types type_of_element(const Host& host, const std::string& name) {
  if (const scene::Element* element = host.scene().find(name))
    return std::visit(TypeOf{}, *element);
  return is_declared(host, name) ? miSCENE_FUNCTION_DECL : miSCENE_NONE;
}

Bytes element_record(Host& host, const std::string& name, std::size_t& size) {
  if (const scene::Element* element = host.scene().find(name))
    return std::visit(Maker{host, size}, *element);
  if (!is_declared(host, name)) return {};
  const ShaderSpec* spec = host.registry().find(name);
  return record(miFunction_decl{spec ? spec->version : 0}, size);
}

Bytes root_record(Host& host, std::size_t& size) {
  const World& world = *host.world();
  std::vector<miTag> kids = {make_tag(TagKind::CameraInstance, 0)};
  for (std::size_t i = 0; i < world.instances.size(); ++i)
    kids.push_back(make_tag(TagKind::Instance, i));
  for (std::size_t i = 0; i < world.lights.size(); ++i)
    kids.push_back(make_tag(TagKind::LightInstance, i));
  return group_record(kids, miNULLTAG, 0, size);
}

miInstance c_instance(const scene::Instance& from) {
  const Mat4 to_local = from.transform.value_or(Mat4());
  miInstance out = {};
  store(out.tf.global_to_local, to_local);
  store(out.tf.local_to_global, to_local.inverse());
  store(out.motion_transform, from.motion_transform.value_or(Mat4()));
  out.tf.identity = to_local == Mat4();
  out.gen_motion = from.motion_transform.has_value();
  return out;
}

}  // namespace oriel::sdk
