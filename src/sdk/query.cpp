// SPDX-License-Identifier: Apache-2.0
// mi_query: information about the shader call, elements by tag, the hit and the rendering.
#include <cstdarg>
#include <cstring>
#include <utility>
#include <vector>

#include "sdk/call.h"
#include "sdk/current.h"
#include "sdk/host.h"
#include "sdk/query_elements.h"

namespace oriel::sdk {
namespace {

bool list_thread_pointers(ThreadPointers& pointers, void* result, int* count) {
  thread_local std::vector<void*> list;
  list = pointers.all();
  if (count) *count = static_cast<int>(list.size());
  return write_result(result, list.data());
}

/// The queried call: that of the tag, or the running one.
const UserInstance* call_of(Host& host, const miState* state, miTag tag) {
  if (tag != miNULLTAG) {
    const ShaderNode* node = host.node(tag);
    UserInstance* user = node ? user_instance(*node) : nullptr;
    if (user && !user->ready.load(std::memory_order_acquire)) user->make_ready(*node);
    return user;
  }
  return state && state->cache ? context(state).shader : nullptr;
}

bool query_function(miQ_type query, Host& host, const miState* state, miTag tag, void* result,
                    int* count) {
  const UserInstance* shader = call_of(host, state, tag);
  if (!shader) return false;
  auto* own = const_cast<UserInstance*>(shader);
  switch (query) {
    case miQ_FUNC_USERPTR:
      return write_result(result, &own->user);
    case miQ_FUNC_LOCK:
    case miQ_DECL_LOCK:
      return write_result(result, &own->lock);
    case miQ_FUNC_TAG:
      return write_result(result, host.tag_of(shader->node));
    case miQ_FUNC_DECL:
      return write_result(result, host.tag_of(*shader->spec));
    case miQ_FUNC_NEXT:
    case miQ_FUNC_INDIRECT:
      return write_result(result, miNULLTAG);
    case miQ_FUNC_TYPE:
      return write_result(result, 0);
    case miQ_FUNC_PARAM:
      return write_result(result, shader->parameters);
    case miQ_FUNC_PARAM_SIZE:
      return write_result(result, static_cast<int>(shader->spec->c_params_size));
    case miQ_FUNC_RESULT_SIZE:
      return write_result(result, static_cast<int>(shader->spec->c_result_size));
    case miQ_FUNC_CALLTYPE:
      return state && write_result(result, static_cast<int>(context(state).call_type));
    case miQ_FUNC_IS_ROOT:
      return write_result(result, miTRUE);
    case miQ_FUNC_TLS_GET:
      return write_result(result, own->thread_pointers.get());
    case miQ_FUNC_TLS_SET: {
      void* pointer = nullptr;
      std::memcpy(&pointer, result, sizeof pointer);
      own->thread_pointers.set(pointer);
      return true;
    }
    case miQ_FUNC_TLS_GETALL:
      return list_thread_pointers(own->thread_pointers, result, count);
    default:
      return false;
  }
}

bool query_declaration(miQ_type query, Host& host, const miState* state, miTag tag, void* result) {
  const UserSpec* spec = host.declaration(tag);
  if (!spec)
    if (const UserInstance* shader = call_of(host, state, tag)) spec = shader->spec;
  if (!spec) return false;
  switch (query) {
    case miQ_DECL_NAME:
      return write_result(result, spec->name);
    case miQ_DECL_PARAM:
      return write_result(result, spec->parameter_text.c_str());
    case miQ_DECL_RESULT_SIZE:
      return write_result(result, static_cast<int>(spec->c_result_size));
    case miQ_DECL_VERSION:
      return write_result(result, spec->version);
    case miQ_DECL_TYPE:
      return write_result(result, static_cast<int>(c_type(spec->result)));
    default:
      return false;
  }
}

bool query_instance(miQ_type query, Host& host, miTag tag, void* result) {
  const auto* instance = host.record_of<miInstance>(tag, miSCENE_INSTANCE);
  if (!instance) return false;
  switch (query) {
    case miQ_INST_ITEM:
      return write_result(result, instance->item);
    case miQ_INST_PARENT:
      return write_result(result, instance->parent);
    case miQ_INST_MATERIAL:
      return write_result(result, instance->material);
    case miQ_INST_GLOBAL_TO_LOCAL:
      return write_result(result, &instance->tf.global_to_local);
    case miQ_INST_LOCAL_TO_GLOBAL:
      return write_result(result, &instance->tf.local_to_global);
    case miQ_INST_IDENTITY:
      return write_result(result, instance->tf.identity);
    case miQ_INST_HIDE:
      return write_result(result, static_cast<miBoolean>(instance->off));
    case miQ_INST_VISIBLE:
      return write_result(result, static_cast<miUint>(instance->visible));
    case miQ_INST_SHADOW:
      return write_result(result, static_cast<miUint>(instance->shadow));
    case miQ_INST_TRACE:
      return write_result(result, static_cast<miUint>(instance->reflection));
    case miQ_INST_CAUSTIC:
      return write_result(result, static_cast<miUint>(instance->caustic));
    case miQ_INST_GLOBILLUM:
      return write_result(result, static_cast<miUint>(instance->globillum));
    case miQ_INST_FINALGATHER:
      return write_result(result, static_cast<miUint>(instance->finalgather));
    case miQ_INST_LABEL:
      return write_result(result, instance->label);
    case miQ_INST_DATA:
      return write_result(result, instance->userdata);
    case miQ_INST_AREA: {
      const int light = host.light(tag);
      return light >= 0 &&
             write_result(result, host.world()->lights[static_cast<std::size_t>(light)].area);
    }
    default:
      return false;
  }
}

bool query_light(miQ_type query, Host& host, miTag tag, void* result) {
  const auto* light = host.record_of<miLight>(tag, miSCENE_LIGHT);
  if (!light) return false;
  const auto& shape = light->primitive;
  switch (query) {
    case miQ_LIGHT_TYPE:
      return write_result(result, static_cast<int>(light->type));
    case miQ_LIGHT_AREA:
      return write_result(result, static_cast<int>(light->area));
    case miQ_LIGHT_AREA_SAMPLES_U:
      return write_result(result, static_cast<int>(light->samples_u));
    case miQ_LIGHT_AREA_SAMPLES_V:
      return write_result(result, static_cast<int>(light->samples_v));
    case miQ_LIGHT_ORIGIN:
      return write_result(result, light->origin);
    case miQ_LIGHT_DIRECTION:
      return write_result(result, light->direction);
    case miQ_LIGHT_SPREAD:
      return write_result(result, light->spread);
    case miQ_LIGHT_EXPONENT:
      return write_result(result, light->exponent);
    case miQ_LIGHT_SHADER:
      return write_result(result, light->shader);
    case miQ_LIGHT_EMITTER:
      return write_result(result, light->emitter);
    case miQ_LIGHT_DATA:
      return write_result(result, light->userdata);
    case miQ_LIGHT_ENERGY:
      return write_result(result, light->energy);
    case miQ_LIGHT_AREA_D_RADIUS:
      return light->area == miLIGHT_DISC && write_result(result, shape.disc.radius);
    case miQ_LIGHT_AREA_S_RADIUS:
      return light->area == miLIGHT_SPHERE && write_result(result, shape.sphere.radius);
    case miQ_LIGHT_AREA_C_RADIUS:
      return light->area == miLIGHT_CYLINDER && write_result(result, shape.cylinder.radius);
    case miQ_LIGHT_AREA_R_EDGE_U:
      return light->area == miLIGHT_RECTANGLE && write_result(result, shape.rectangle.edge_u);
    case miQ_LIGHT_AREA_R_EDGE_V:
      return light->area == miLIGHT_RECTANGLE && write_result(result, shape.rectangle.edge_v);
    case miQ_LIGHT_AREA_D_NORMAL:
      return light->area == miLIGHT_DISC && write_result(result, shape.disc.normal);
    case miQ_LIGHT_AREA_C_AXIS:
      return light->area == miLIGHT_CYLINDER && write_result(result, shape.cylinder.axis);
    default:
      return false;
  }
}

bool query_material(miQ_type query, Host& host, miTag tag, void* result) {
  const auto* material = host.record_of<miMaterial>(tag, miSCENE_MATERIAL);
  if (!material) return false;
  switch (query) {
    case miQ_MTL_SHADER:
      return write_result(result, material->shader);
    case miQ_MTL_DISPLACE:
      return write_result(result, material->displace);
    case miQ_MTL_SHADOW:
      return write_result(result, material->shadow);
    case miQ_MTL_VOLUME:
      return write_result(result, material->volume);
    case miQ_MTL_ENVIRONMENT:
      return write_result(result, material->environment);
    case miQ_MTL_CONTOUR:
      return write_result(result, material->contour);
    case miQ_MTL_PHOTON:
      return write_result(result, material->photon);
    case miQ_MTL_PHOTONVOL:
      return write_result(result, material->photonvol);
    case miQ_MTL_LIGHTMAP:
      return write_result(result, material->lightmap);
    case miQ_MTL_OPAQUE:
      return write_result(result, material->opaque);
    default:
      return false;
  }
}

/// The matrix between two spaces; internal space is world space.
bool query_transform(miQ_type query, const miState* state, void* result) {
  if (!state) return false;
  static const Mat4 kIdentity;
  const Context& c = context(state);
  const Camera& camera = c.world->camera;
  const InstanceData* instance =
      is_own_instance(state) ? nullptr : c.host->instance(state->instance);
  const Mat4 *to_object = c.point->to_object, *to_world = c.point->to_world;
  if (instance) to_object = &instance->to_object, to_world = &instance->to_world;
  if (!to_object) to_object = &kIdentity;
  if (!to_world) to_world = &kIdentity;
  // Results stay readable after the call.
  thread_local Mat4 product[2];
  switch (query) {
    case miQ_TRANS_INTERNAL_TO_WORLD:
    case miQ_TRANS_WORLD_TO_INTERNAL:
      return write_result(result, &kIdentity);
    case miQ_TRANS_INTERNAL_TO_CAMERA:
    case miQ_TRANS_WORLD_TO_CAMERA:
      return write_result(result, &camera.to_camera);
    case miQ_TRANS_CAMERA_TO_INTERNAL:
    case miQ_TRANS_CAMERA_TO_WORLD:
      return write_result(result, &camera.to_world);
    case miQ_TRANS_INTERNAL_TO_OBJECT:
    case miQ_TRANS_WORLD_TO_OBJECT:
      return write_result(result, to_object);
    case miQ_TRANS_OBJECT_TO_INTERNAL:
    case miQ_TRANS_OBJECT_TO_WORLD:
      return write_result(result, to_world);
    case miQ_TRANS_CAMERA_TO_OBJECT:
      product[0] = camera.to_world * *to_object;
      return write_result(result, &product[0]);
    case miQ_TRANS_OBJECT_TO_CAMERA:
      product[1] = *to_world * camera.to_camera;
      return write_result(result, &product[1]);
    default:
      return false;
  }
}

/// Number of bump vector pairs: indices below it are valid.
int bumps_of(const ShadingPoint& point) {
  int count = 0;
  while (count < point.texture_spaces &&
         (point.bump_u[count] != Vec3(0) || point.bump_v[count] != Vec3(0)))
    ++count;
  return count;
}

bool query_hit(miQ_type query, Host& host, const miState* state, void* result, int extra) {
  if (query == miQ_NUM_GLOBAL_LIGHTS)
    return write_result(result, static_cast<int>(host.lights().size()));
  if (query == miQ_GLOBAL_LIGHTS) return write_result(result, host.lights().data());
  if (!state) return false;
  const ShadingPoint& point = *context(state).point;
  switch (query) {
    case miQ_NUM_TEXTURES:
      return write_result(result, static_cast<int>(point.texture_spaces));
    case miQ_NUM_BUMPS:
      return write_result(result, bumps_of(point));
    case miQ_TEXTURE_DIM:
      return extra >= 0 && extra < point.texture_spaces && write_result(result, miUint{3});
    case miQ_PRI_INDEX:
      return state->pri && write_result(result, static_cast<miUint>(point.primitive));
    case miQ_GEO_HAS_DERIVS:
      return write_result(result, static_cast<miBoolean>(point.dpdu != Vec3(0)));
    case miQ_GEO_HAS_DERIVS2:
      return write_result(result, static_cast<miBoolean>(miFALSE));
    case miQ_GEO_LABEL:
      return write_result(result, state->label);
    default:
      return false;
  }
}

bool query_rendering(miQ_type query, Host& host, const miState* state, void* result) {
  switch (query) {
    case miQ_FINALGATHER_STATE:
      return write_result(result, state && state->type == miRAY_FINALGATHER ? 1 : 0);
    case miQ_SAMPLE_MOVING:
      return write_result(result, 0);
    case miQ_PIXEL_SAMPLE: {
      if (!state) return false;
      const miScalar place[2] = {state->raster_x, state->raster_y};
      return write_result(result, place);
    }
    case miQ_TILE_PIXELS: {
      const miCamera& camera = *host.camera();
      return write_result(result, camera.window);
    }
    case miQ_SCENE_BBOX_ALL:
    case miQ_SCENE_BBOX_SHADOW:
    case miQ_SCENE_BBOX_GLOBILLUM_G:
    case miQ_SCENE_BBOX_GLOBILLUM_R:
    case miQ_SCENE_BBOX_CAUSTIC_G:
    case miQ_SCENE_BBOX_CAUSTIC_R: {
      const geom::Box3 box = host.world()->accel->bounds();
      const miVector corners[2] = {as_c(box.min), as_c(box.max)};
      return write_result(result, corners);
    }
    case miQ_SCENE_ROOT_GROUP:
      return write_result(result, make_tag(TagKind::Root, 0));
    case miQ_STAGE:
      return write_result(result, miSTAGE_TILE);
    case miQ_VERSION:
      return write_result(result, static_cast<const char*>("Oriel"));
    case miQ_DATE:
      return write_result(result, static_cast<const char*>(__DATE__));
    default:
      return false;
  }
}

bool query_image(miQ_type query, Host& host, miTag tag, void* result) {
  const TextureNode* texture = host.texture(tag);
  if (!texture || texture->width() == 0) return false;
  switch (query) {
    case miQ_IMAGE_WIDTH:
      return write_result(result, texture->width());
    case miQ_IMAGE_HEIGHT:
      return write_result(result, texture->height());
    case miQ_IMAGE_BITS:
      return write_result(result, 32);
    case miQ_IMAGE_COMP:
      return write_result(result, 4);
    case miQ_IMAGE_GAMMA:
      return write_result(result, 1.0);
    default:
      return false;
  }
}

}  // namespace

}  // namespace oriel::sdk

using namespace oriel::sdk;

extern "C" miBoolean mi_query(miQ_type query, const miState* state, miUint tag, void* result, ...) {
  Host* host = state && state->cache ? context(state).host : current_host();
  if (!host || !result) return miFALSE;
  va_list list;
  va_start(list, result);
  int extra = 0;
  int* count = nullptr;
  if (query == miQ_TEXTURE_DIM || query == miQ_GROUP_KID) extra = va_arg(list, int);
  if (query == miQ_FUNC_TLS_GETALL) count = va_arg(list, int*);
  va_end(list);
  const auto within = [&](miQ_type first, miQ_type last) {
    return query >= first && query <= last;
  };
  bool answer = false;
  // The remaining queries need the world, which exit functions of geometry shaders may outlive.
  if (!host->world() && !within(miQ_FUNC_USERPTR, miQ_DECL_LOCK) &&
      !within(miQ_DECL_NAME, miQ_DECL_VERSION))
    return miFALSE;
  if (within(miQ_FUNC_USERPTR, miQ_DECL_LOCK))
    answer = query_function(query, *host, state, tag, result, count);
  else if (within(miQ_DECL_NAME, miQ_DECL_VERSION))
    answer = query_declaration(query, *host, state, tag, result);
  else if (within(miQ_INST_ITEM, miQ_INST_AREA))
    answer = query_instance(query, *host, tag, result);
  else if (within(miQ_LIGHT_TYPE, miQ_LIGHT_AREA_C_AXIS))
    answer = query_light(query, *host, tag, result);
  else if (within(miQ_MTL_SHADER, miQ_MTL_OPAQUE))
    answer = query_material(query, *host, tag, result);
  else if (within(miQ_TRANS_INTERNAL_TO_WORLD, miQ_TRANS_OBJECT_TO_CAMERA))
    answer = query_transform(query, state, result);
  else if (within(miQ_IMAGE_WIDTH, miQ_IMAGE_GAMMA))
    answer = query_image(query, *host, tag, result);
  else if (within(miQ_GROUP_NKIDS, miQ_GROUP_KID))
    answer = query_group(query, *host, tag, result, extra);
  else if (within(miQ_OBJ_TYPE, miQ_OBJ_DATA))
    answer = query_object(query, *host, tag, result);
  else if (within(miQ_DATA_DECL, miQ_DATA_LABEL))
    answer = query_data(query, *host, tag, result);
  else if (query == miQ_PRI_BBOX_MIN || query == miQ_PRI_BBOX_MAX || query == miQ_GEO_DATA)
    answer = query_primitive(query, *host, state, result);
  else if (query >= miQ_FINALGATHER_STATE)
    answer = query_rendering(query, *host, state, result);
  else
    answer = query_hit(query, *host, state, result, extra);
  return answer ? miTRUE : miFALSE;
}
