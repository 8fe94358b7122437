// SPDX-License-Identifier: Apache-2.0
// Renderer data behind a miState, used by the functions of the C interface.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "oriel/sdk/shader.h"
#include "runtime/shader_node.h"
#include "runtime/tracer.h"

namespace oriel::sdk {

class Host;
struct UserInstance;
struct OutputWork;

/// Value of a connected parameter, cached while the shader runs.
struct Evaluated {
  const void* parameter;
  void* value;
  const Evaluated* next;
};

/// The state->child of one state: of the point's state, of a copy of it, or of another child.
struct OwnedChild {
  const miState* owner;
  miState child;
};

// Conventions
//   One Context, on the stack, per ShadingPoint at which user shaders run; miState::cache points to
//   it, also in copies of the state. Internal space is world space.
struct Context {
  Host* host = nullptr;
  const World* world = nullptr;
  ShadingPoint* point = nullptr;         ///< the point in the renderer; never null
  const UserInstance* shader = nullptr;  ///< the running call
  const Evaluated* evaluated = nullptr;
  miShader_type call_type = miSHADER_OTHER;
  std::uint32_t draws = 0;  ///< random numbers drawn without a tracer
  double ray_offset = 0, falloff_start = 0, falloff_stop = 0;  ///< mi_ray_offset, mi_ray_falloff
  miColor opacity = {1, 1, 1, 1};
  bool opacity_known = false;
  std::vector<std::unique_ptr<OwnedChild>> children = {};
  miColor volume_color = {0, 0, 0, 0};  ///< mi_volume_user_color

  // Light shaders.
  bool shadow_asked = false;     ///< mi_trace_shadow was called
  bool shadow_is_black = false;  ///< ... and returns the result of an opaque occluder
  // Continuation of the ray or photon in lens, photon and emitter shaders.
  LensNext* lens = nullptr;
  PhotonNext* photon = nullptr;
  PhotonEmission* emission = nullptr;
  EyeSample* sample = nullptr;   ///< state shaders: the current eye sample
  OutputWork* output = nullptr;  ///< output shaders: the open buffers

  Tracer* tracer() const { return point->tracer; }
};

/// Value of state->pri for a triangle: never null, unique per triangle, equal in all samples. The
/// lower half is also unique within an instance, because shaders use it as a seed.
inline void* handle_of(int instance, std::uint32_t primitive) {
  const auto i = static_cast<std::uint32_t>(instance) + 1;
  // The odd factor keeps all triangles of an instance distinct.
  const std::uint32_t low = (primitive + 1) * 0x9e3779b1u + i * 0x85ebca77u;
  return reinterpret_cast<void*>((std::uintptr_t{i} + 1) << 32 | low);
}

inline Context& context(const miState* state) { return *static_cast<Context*>(state->cache); }

using oriel::rgb;
inline Vec3 vec(const miVector& v) { return Vec3(v.x, v.y, v.z); }
inline miVector as_c(const Vec3& v) { return {v.x, v.y, v.z}; }
inline Rgb rgb(const miColor& c) { return Rgb(c.r, c.g, c.b); }
inline miColor as_c(const Rgb& c, float alpha) { return {c.x, c.y, c.z, alpha}; }
inline miColor as_c(const Rgba& c) { return {c.r, c.g, c.b, c.a}; }

/// Two independent numbers in [0,1): from the sampler of the path if there is one, else from a hash
/// of the point and the number of previous draws.
Vec2 next(const miState* state);

/// The point with the modifications of the state, for built-in shaders and rays: shaders may change
/// position, normals, texture coordinates and the ray.
ShadingPoint point_of(const miState* state);
/// Whether the instance of the state is that of its point, whose transform at the ray time is
/// known.
bool is_own_instance(const miState* state);
/// Copies state->tex, which a C shader may have changed, to the point.
void take_over_tex(const miState& state, ShadingPoint& point);
/// Copies changes by a built-in shader (bump, vectors) from the point to the state.
void take_over(const ShadingPoint& point, const ShadingPoint& before, miState* state);

/// Memory that is freed when the running shader returns.
void* allocate_for_call(std::size_t bytes);

}  // namespace oriel::sdk
