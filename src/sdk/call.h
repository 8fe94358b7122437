// SPDX-License-Identifier: Apache-2.0
// Running users' shaders: the state they see, the guard around them, the roles they play.
#pragma once

#include <cstddef>
#include <cstring>
#include <optional>

#include "sdk/caller.h"
#include "sdk/context.h"
#include "sdk/crash.h"
#include "sdk/user_spec.h"

namespace oriel::sdk {

/// A miState with what stands behind it, for one point; lives on the stack.
class StateFrame {
 public:
  /// `parent`: of the shader that cast the ray or asked; null where that is none of the user's. Its
  /// user data and all else that rays inherit are copied.
  StateFrame(Host& host, ShadingPoint& point, miState* parent = Caller::current().ray);
  StateFrame(const StateFrame&) = delete;
  StateFrame& operator=(const StateFrame&) = delete;

  miState state;
  Context context;

 private:
  void set_hit(Host& host, ShadingPoint& point);
  void set_bases(ShadingPoint& point);
  void set_parent(miState* parent);

  /// Parent where the one that cast the ray is a built-in shader.
  std::optional<miState> eye_state_;
  miVector bump_x_[kMostTextureSpaces], bump_y_[kMostTextureSpaces], derivs_[NO_DERIVS];
};

/// Runs a user's shader with a state; `result` is of its C type. Returns what the shader returns;
/// false where it crashed.
bool run(UserInstance& shader, miState& state, void* result, miShader_type type,
         void* argument = nullptr);

/// Runs any shader at the state's point; `result` is of the C type of its result, at least 16
/// bytes. A material of the renderer is shaded with all its light.
bool run_node(const ShaderNode& node, miState& state, void* result, miShader_type type,
              void* argument = nullptr);

/// Gives the spec its functions, as its `apply` says; all where it says nothing.
void set_roles(UserSpec& spec);

/// Copies what rays inherit from the state that they are cast from. `to.type` is set.
void inherit(const miState& from, miState& to);

/// A value of the renderer as a C one, and back.
void to_c(ParamType type, const void* own, void* c);
void from_c(ParamType type, const void* c, void* own);
/// A shader's whole result.
void result_from_c(const UserSpec& spec, const std::byte* c, void* own);

/// Room for the result of a shader, on either side; as much as the shader has is cleared.
struct alignas(16) Result {
  explicit Result(std::size_t used) { std::memset(bytes, 0, used); }
  explicit Result(const UserSpec& spec) : Result(spec.c_result_size) {}
  miColor& color() { return *reinterpret_cast<miColor*>(bytes); }
  std::byte bytes[kMostParamBytes];
};

}  // namespace oriel::sdk
