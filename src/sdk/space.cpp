// SPDX-License-Identifier: Apache-2.0
// Conversion of points, vectors and normals between the spaces of a state. Internal space is world
// space.
#include <cmath>

#include "oriel/sdk/shader/space.h"
#include "sdk/context.h"
#include "sdk/host.h"

namespace {

using oriel::Camera;
using oriel::Mat4;
using oriel::Vec3;
using oriel::sdk::context;
using oriel::sdk::vec;

/// Matrices between internal space and another one, in both directions; null if they are equal.
struct SpaceTransform {
  const Mat4* to = nullptr;
  const Mat4* from = nullptr;
  SpaceTransform reversed() const { return {from, to}; }
};

SpaceTransform to_world(const miState* /*state*/) { return {}; }

SpaceTransform to_camera(const miState* state) {
  const oriel::World* world = context(state).world;
  if (!world) return {};
  return {&world->camera.to_camera, &world->camera.to_world};
}

// By tag first, since shaders may set another instance.
SpaceTransform to_object(const miState* state) {
  const oriel::sdk::Context& c = context(state);
  if (c.host && state->instance != miNULLTAG)
    if (const oriel::InstanceData* instance = c.host->instance(state->instance);
        instance && !oriel::sdk::is_own_instance(state))
      return {&instance->to_object, &instance->to_world};
  return {c.point->to_object, c.point->to_world};
}

SpaceTransform to_light(const miState* state) {
  const oriel::sdk::Context& c = context(state);
  const int index = c.host->light(state->light_instance);
  if (index < 0) return {};  // also without a world
  const oriel::Light& light = c.world->lights[static_cast<std::size_t>(index)];
  return {&light.to_local, &light.to_world};
}

void move_point(const SpaceTransform& transform, miVector* result, const miVector* in) {
  *result = transform.to ? oriel::sdk::as_c(oriel::transform_point(vec(*in), *transform.to)) : *in;
}
void move_vector(const SpaceTransform& transform, miVector* result, const miVector* in) {
  *result = transform.to ? oriel::sdk::as_c(oriel::transform_vector(vec(*in), *transform.to)) : *in;
}
void move_normal(const SpaceTransform& transform, miVector* result, const miVector* in) {
  *result =
      transform.from ? oriel::sdk::as_c(oriel::transform_normal(vec(*in), *transform.from)) : *in;
}

}  // namespace

#define ORIEL_SPACE(space)                                                                  \
  void mi_point_to_##space(const miState* state, miVector* result, const miVector* in) {    \
    move_point(to_##space(state), result, in);                                              \
  }                                                                                         \
  void mi_point_from_##space(const miState* state, miVector* result, const miVector* in) {  \
    move_point(to_##space(state).reversed(), result, in);                                   \
  }                                                                                         \
  void mi_vector_to_##space(const miState* state, miVector* result, const miVector* in) {   \
    move_vector(to_##space(state), result, in);                                             \
  }                                                                                         \
  void mi_vector_from_##space(const miState* state, miVector* result, const miVector* in) { \
    move_vector(to_##space(state).reversed(), result, in);                                  \
  }                                                                                         \
  void mi_normal_to_##space(const miState* state, miVector* result, const miVector* in) {   \
    move_normal(to_##space(state), result, in);                                             \
  }                                                                                         \
  void mi_normal_from_##space(const miState* state, miVector* result, const miVector* in) { \
    move_normal(to_##space(state).reversed(), result, in);                                  \
  }

ORIEL_SPACE(world)
ORIEL_SPACE(camera)
ORIEL_SPACE(object)
ORIEL_SPACE(light)

#undef ORIEL_SPACE

void mi_point_to_raster(const miState* state, miVector* result, const miVector* in) {
  const oriel::World* world = context(state).world;
  if (!world) {
    *result = *in;
    return;
  }
  const Vec3 p = oriel::transform_point(vec(*in), world->camera.to_camera);
  *result = oriel::sdk::as_c(world->camera.raster_of(p));
}

// Vectors parallel to the image plane at the depth of the hit, with the length of one pixel there.
miBoolean mi_raster_unit(const miState* state, miVector* x, miVector* y) {
  const oriel::World* world = context(state).world;
  if (!world) return miFALSE;
  const Camera& camera = world->camera;
  const float depth = -oriel::transform_point(vec(state->point), camera.to_camera).z;
  if (!(depth > 0)) return miFALSE;
  const oriel::Vec2 pixel = camera.pixel_size(depth);
  const miVector step_x = {pixel.x, 0, 0}, step_y = {0, pixel.y, 0};
  mi_vector_from_camera(state, x, &step_x);
  mi_vector_from_camera(state, y, &step_y);
  mi_vector_to_object(state, x, x);
  mi_vector_to_object(state, y, y);
  return miTRUE;
}
