// SPDX-License-Identifier: Apache-2.0
// What stands behind a miState: how the functions of the interface reach the renderer.
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

/// A value of a connected parameter that was asked for, kept while the shader runs.
struct Evaluated {
  const void* parameter;
  void* value;
  const Evaluated* next;
};

/// state->child of one state: of the state of the point, of a copy of it or of another child.
struct OwnedChild {
  const miState* owner;
  miState child;
};

// Conventions
//   One Context for each ShadingPoint that users' shaders are run at, on the stack; miState::cache
//   points to it, in copies of the state too. Internal space is world space.
struct Context {
  Host* host = nullptr;
  const World* world = nullptr;
  ShadingPoint* point = nullptr;         ///< as the renderer knows it; never null
  const UserInstance* shader = nullptr;  ///< the call that runs
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
  bool shadow_is_black = false;  ///< ... and answers as behind an opaque blocker
  // What continues the ray or the photon of a lens, photon or emitter shader.
  LensNext* lens = nullptr;
  PhotonNext* photon = nullptr;
  PhotonEmission* emission = nullptr;
  EyeSample* sample = nullptr;   ///< state shaders: what they stand around
  OutputWork* output = nullptr;  ///< output shaders: the buffers that are open

  Tracer* tracer() const { return point->tracer; }
};

/// state->pri of a triangle: never null, another one for each, the same in all samples. Its lower
/// half alone tells the triangles of an instance apart, as seeds in sources do.
inline void* handle_of(int instance, std::uint32_t primitive) {
  const auto i = static_cast<std::uint32_t>(instance) + 1;
  // Odd factors: all triangles of an instance stay different.
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

/// Two independent numbers in [0,1): the path's where there is one, else from the point and how
/// many were drawn there before.
Vec2 next(const miState* state);

/// The point as the state now describes it, for the renderer's own shaders and rays: shaders may
/// move position, normals, texture coordinates and the ray.
ShadingPoint point_of(const miState* state);
/// Whether the state's instance is that of its point: the point knows where that is at its time.
bool is_own_instance(const miState* state);
/// Takes over into the point the vector that a shader in C left in state->tex.
void take_over_tex(const miState& state, ShadingPoint& point);
/// Takes over into the state what the renderer's shader did to the point (bump, vectors).
void take_over(const ShadingPoint& point, const ShadingPoint& before, miState* state);

/// Memory for as long as the running shader runs.
void* allocate_for_call(std::size_t bytes);

}  // namespace oriel::sdk
