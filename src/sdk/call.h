// SPDX-License-Identifier: Apache-2.0
// Calls of user shaders: their state, crash guards, and shader roles.
#pragma once

#include <cstddef>
#include <cstring>
#include <optional>

#include "sdk/caller.h"
#include "sdk/context.h"
#include "sdk/crash.h"
#include "sdk/user_spec.h"

namespace oriel::sdk {

/// A miState with its context for one point; on the stack.
class StateFrame {
 public:
  /// `parent`: state of the shader that cast the ray or evaluates this one; null if that is not a
  /// user shader. Its user data and all other inherited members are copied.
  StateFrame(Host& host, ShadingPoint& point, miState* parent = Caller::current().ray);
  StateFrame(const StateFrame&) = delete;
  StateFrame& operator=(const StateFrame&) = delete;

  miState state;
  Context context;

 private:
  void set_hit(Host& host, ShadingPoint& point);
  void set_bases(ShadingPoint& point);
  void set_parent(miState* parent);

  /// Parent state if a built-in shader cast the ray.
  std::optional<miState> eye_state_;
  miVector bump_x_[kMaxTextureSpaces], bump_y_[kMaxTextureSpaces], derivs_[NO_DERIVS];
};

/// Runs a user shader with a state; `result` has its C type. Returns the return value of the
/// shader, or false if it crashed.
bool run(UserInstance& shader, miState& state, void* result, miShader_type type,
         void* argument = nullptr);

/// Runs any shader at the point of the state; `result` has the C type of its result and at least 16
/// bytes. A built-in material is shaded with full lighting.
bool run_node(const ShaderNode& node, miState& state, void* result, miShader_type type,
              void* argument = nullptr);

/// Sets the functions of the spec that its `apply` selects; all if it selects none.
void set_roles(UserSpec& spec);

/// Copies the members that a ray inherits from the state that casts it. `to.type` has to be set.
void inherit(const miState& from, miState& to);

/// Convert a value from the renderer's type to the C type, and back.
void to_c(ParamType type, const void* own, void* c);
void from_c(ParamType type, const void* c, void* own);
/// Converts the complete result of a shader.
void result_from_c(const UserSpec& spec, const std::byte* c, void* own);

/// Memory for the result of a shader of either kind; cleared to the size of the result.
struct alignas(16) Result {
  explicit Result(std::size_t used) { std::memset(bytes, 0, used); }
  explicit Result(const UserSpec& spec) : Result(spec.c_result_size) {}
  miColor& color() { return *reinterpret_cast<miColor*>(bytes); }
  std::byte bytes[kMaxParamBytes];
};

}  // namespace oriel::sdk
