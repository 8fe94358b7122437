// SPDX-License-Identifier: Apache-2.0
// The miState of a point: data of the hit, and inherited members.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "sdk/call.h"
#include "sdk/host.h"
#include "sdk/tags.h"
#include "sdk/triangle.h"

namespace oriel::sdk {

void inherit(const miState& from, miState& to) {
  const bool enters = to.type == miRAY_REFRACT || to.type == miRAY_TRANSPARENT;
  to.raster_x = from.raster_x;
  to.raster_y = from.raster_y;
  to.face = from.face;
  to.ior = from.ior;
  to.ior_in = from.ior_in;
  to.volume = enters ? from.refraction_volume : from.volume;
  to.refraction_volume = from.refraction_volume;
  to.environment = from.environment;
  to.user = from.user;
  to.user_size = from.user_size;
}

StateFrame::StateFrame(Host& host, ShadingPoint& point, miState* parent) : state{} {
  context.host = &host;
  context.world = host.world();
  context.point = &point;
  state.version = 2;
  state.camera_inst = make_tag(TagKind::CameraInstance, 0);
  state.camera = host.camera();
  state.options = host.options();
  state.global_lock = host.global_lock();
  state.thread = thread_number();
  state.raster_x = point.raster.x;
  state.raster_y = point.raster.y;
  state.type = static_cast<miRay_type>(point.ray_kind);
  state.face = 'a';
  state.cache = &context;
  state.ior = state.ior_in = 1;
  state.volume = state.camera->volume;
  state.environment = state.camera->environment;
  if (context.world) state.time = context.world->shutter.scene_time(point.time);
  set_hit(host, point);
  set_bases(point);
  set_parent(parent);
  if (point.tracer) {
    const Tracer::Depth depth = point.tracer->depth();
    state.reflection_level = depth.reflections;
    state.refraction_level = depth.refractions;
    state.importance = depth.importance;
  } else {
    state.importance = 1;
  }
}

void StateFrame::set_hit(Host& host, ShadingPoint& point) {
  state.inv_normal = point.back_side;
  state.motion = as_c(motion_of(point));
  state.org = as_c(point.ray_origin);
  state.dir = as_c(point.ray_direction);
  const bool endless = point.environment || std::isinf(point.ray_length);
  state.dist = endless ? 0 : point.ray_length;
  state.material = point.environment ? 0 : host.tag_of(point.material);
  if (point.instance >= 0) {
    state.instance = make_tag(TagKind::Instance, static_cast<std::size_t>(point.instance));
    state.label = host.hit_label(static_cast<std::size_t>(point.instance));
  }
  if (point.light >= 0)
    state.light_instance = make_tag(TagKind::LightInstance, static_cast<std::size_t>(point.light));
  if (const std::optional<HitTriangle> hit = hit_triangle(point)) {
    const Vec3 weights = hit->weights(point.position);
    for (int i = 0; i < 3; ++i) state.bary[i] = weights[i];
  } else if (point.instance >= 0 && !point.environment) {
    // Hair: 0 to 1 from its left to its right side, seen along the ray with the tip up.
    const Vec3 right = cross(point.ray_direction, point.dpdu);
    if (right != Vec3(0)) state.bary[0] = .5f + .5f * dot(point.geometric_normal, normalize(right));
  }
  if (!endless) state.pri = handle_of(point.instance, point.primitive);
  state.point = as_c(point.position);
  state.normal = as_c(point.normal);
  state.normal_geom = as_c(point.geometric_normal);
  state.dot_nd = dot(point.normal, point.ray_direction);
  state.shadow_tol = point.ray_offset;
}

void StateFrame::set_bases(ShadingPoint& point) {
  // Shared memory: shaders may change the coordinates for shaders that run later.
  static_assert(sizeof(Vec3) == sizeof(miVector));
  state.tex_list = reinterpret_cast<miVector*>(point.tex);
  if (point.environment) std::fill(std::begin(point.tex), std::end(point.tex), Vec3(0));
  // Shaders may read texture spaces that an object lacks; values written there stay for later
  // shaders.
  if (!std::exchange(point.other_spaces_cleared, true))
    std::fill(point.tex + point.texture_spaces, std::end(point.tex), Vec3(0));
  for (int i = 0; i < point.texture_spaces; ++i) {
    const auto in_object = [&](const Vec3& v) {
      return as_c(point.to_object ? transform_vector(v, *point.to_object) : v);
    };
    bump_x_[i] = in_object(point.bump_u[i]);
    bump_y_[i] = in_object(point.bump_v[i]);
  }
  state.bump_x_list = bump_x_;
  state.bump_y_list = bump_y_;
  derivs_[0] = as_c(point.dpdu);
  derivs_[1] = as_c(point.dpdv);
  derivs_[2] = derivs_[3] = derivs_[4] = miVector{0, 0, 0};
  state.derivs = derivs_;
  if (point.texture_spaces > 0) state.tex = as_c(point.tex[0]);
}

void StateFrame::set_parent(miState* parent) {
  if (const Caller& caller = Caller::current();
      caller.same_point && caller.point == context.point) {
    // A built-in shader evaluates this one for the caller and shares its state.
    state.parent = caller.same_point->parent;
    const miTag volume = caller.same_point->volume;
    inherit(*caller.same_point, state);
    state.volume = volume;
  } else if (parent) {
    state.parent = parent;
    inherit(*parent, state);
    if (!context.point->tracer) {
      state.reflection_level = parent->reflection_level;
      state.refraction_level = parent->refraction_level;
    }
  } else if (state.type != miRAY_EYE) {
    eye_state_.emplace(state);
    eye_state_->type = miRAY_EYE;
    eye_state_->point = state.org;
    eye_state_->parent = nullptr;
    state.parent = &*eye_state_;
  }
}

}  // namespace oriel::sdk
