// SPDX-License-Identifier: Apache-2.0
#include "sdk/query_elements.h"

#include <cstddef>

#include "sdk/call.h"
#include "sdk/host.h"
#include "sdk/made_record.h"
#include "sdk/user_data.h"

namespace oriel::sdk {
namespace {

/// The instance that the tag of an instance, an object or a light comes from; null: none.
const scene::Instance* instance_behind(Host& host, miTag tag) {
  const std::string* name = nullptr;
  if (const InstanceData* i = host.instance(tag)) name = &i->name;
  if (const int l = host.light(tag); l >= 0)
    name = &host.world()->lights[static_cast<std::size_t>(l)].name;
  return name ? host.scene().get<scene::Instance>(*name) : nullptr;
}

/// What is attached to the scene's element that a tag stands for.
scene::Attachments attachments_of(Host& host, miTag tag) {
  const scene::Scene& scene = host.scene();
  const bool placed = kind_of(tag) == TagKind::Instance || kind_of(tag) == TagKind::LightInstance;
  const auto* instance = instance_behind(host, tag);
  if (!instance) return {};
  const auto of = [](const auto& element) {
    return static_cast<const scene::Attachments&>(settings_of(element));
  };
  if (placed) return of(*instance);
  if (const auto* object = scene.get<scene::Object>(instance->element)) return of(*object);
  if (const auto* light = scene.get<scene::Light>(instance->element)) return of(*light);
  return {};
}

/// Bounds of the object of an instance in object space.
geom::Box3 object_bounds(const Host& host, std::size_t index) {
  const geom::Accel& accel = *host.world()->accel;
  const geom::MeshId id = accel.instance(static_cast<std::uint32_t>(index)).mesh;
  const geom::Mesh& mesh = accel.mesh(id);
  if (!accel.is_baked(id)) return mesh.bounds();
  geom::Box3 box;
  const Mat4& to_object = host.world()->instances[index].to_object;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
    box.extendBy(transform_point(mesh.positions[i], to_object));
  return box;
}

}  // namespace

void store_written(Host& host, miTag tag, miLight& out) {
  const scene::Instance* instance = instance_behind(host, tag);
  const auto* light = instance ? host.scene().get<scene::Light>(instance->element) : nullptr;
  if (!light) return;
  const scene::LightSettings settings = settings_of(*light);
  out.label = settings.label;
  store_shadow_map(settings.shadow_map, out);
}

miTag data_of(Host& host, miTag tag) { return attached_data(attachments_of(host, tag), host); }

miUint label_of(Host& host, miTag tag) { return attachments_of(host, tag).label; }

miUint Host::hit_label(std::size_t instance) {
  if (!labels_ready_.load(std::memory_order_acquire)) {
    const std::unique_lock lock(mutex_);
    if (!labels_ready_.load(std::memory_order_relaxed)) {
      labels_.clear();
      for (std::size_t i = 0; world_ && i < world_->instances.size(); ++i) {
        const miUint own = label_of(*this, make_tag(TagKind::Instance, i));
        labels_.push_back(own ? own : label_of(*this, make_tag(TagKind::Object, i)));
      }
      labels_ready_.store(true, std::memory_order_release);
    }
  }
  return instance < labels_.size() ? labels_[instance] : 0;
}

bool query_object(miQ_type query, Host& host, miTag tag, void* result) {
  if (kind_of(tag) != TagKind::Object || !host.instance(tag)) return false;
  const InstanceData& data = *host.instance(tag);
  const auto index = static_cast<std::uint32_t>(index_of(tag));
  const std::uint32_t mask = host.world()->accel->instance(index).mask;
  const auto meets = [&](std::uint32_t kinds) { return miBoolean{(mask & kinds) != 0}; };
  const auto bits = [&](unsigned casts, unsigned receives) {
    return static_cast<miUint>(((data.visibility & casts) ? 1 : 0) |
                               ((data.visibility & receives) ? 2 : 0));
  };
  switch (query) {
    case miQ_OBJ_VISIBLE:
      return write_result(result, meets(geom::RayMask::Camera));
    case miQ_OBJ_TRACE:
      return write_result(result, meets(geom::RayMask::Reflection | geom::RayMask::Refraction));
    case miQ_OBJ_SHADOW:
      return write_result(result, meets(geom::RayMask::Shadow | geom::RayMask::ShadowTransparent));
    case miQ_OBJ_CAUSTIC:
      return write_result(result, bits(kCastsCaustics, kReceivesCaustics));
    case miQ_OBJ_GLOBILLUM:
      return write_result(result, bits(kCastsGlobillum, kReceivesGlobillum));
    case miQ_OBJ_LABEL:
      return write_result(result, label_of(host, tag));
    case miQ_OBJ_DATA:
      return write_result(result, data_of(host, tag));
    default:
      return false;  // the type of the object is not stored
  }
}

bool query_group(miQ_type query, Host& host, miTag tag, void* result, int index) {
  const auto* group = host.record_of<miGroup>(tag, miSCENE_GROUP, offsetof(miGroup, kids));
  if (!group) return false;
  if (query == miQ_GROUP_NKIDS) return write_result(result, group->no_kids);
  return index >= 0 && index < group->no_kids && write_result(result, group->kids[index]);
}

bool query_data(miQ_type query, Host& host, miTag tag, void* result) {
  auto* data = host.record_of<miUserdata>(tag, miSCENE_USERDATA, offsetof(miUserdata, parameters));
  if (!data) return false;
  switch (query) {
    case miQ_DATA_DECL:
      return write_result(result, data->data_decl);
    case miQ_DATA_NEXT:
      return write_result(result, data->next_data);
    case miQ_DATA_PARAM:
      return write_result(result, static_cast<char*>(data->parameters));
    case miQ_DATA_PARAM_SIZE:
      return write_result(result, data->parameter_size);
    case miQ_DATA_LABEL:
      return write_result(result, data->label);
    default:
      return false;
  }
}

bool query_primitive(miQ_type query, Host& host, const miState* state, void* result) {
  if (!state || kind_of(state->instance) != TagKind::Instance) return false;
  const std::size_t index = index_of(state->instance);
  if (query == miQ_GEO_DATA)
    return write_result(result, data_of(host, make_tag(TagKind::Object, index)));
  if (!state->pri) return false;
  // Called at every point of a surface, so the last result is cached.
  thread_local struct {
    const World* world = nullptr;
    std::size_t index = 0;
    geom::Box3 box;
  } last;
  if (last.world != host.world() || last.index != index)
    last = {host.world(), index, object_bounds(host, index)};
  return write_result(result, as_c(query == miQ_PRI_BBOX_MIN ? last.box.min : last.box.max));
}

}  // namespace oriel::sdk
