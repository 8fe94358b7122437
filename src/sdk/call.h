// SPDX-License-Identifier: Apache-2.0
// Running users' shaders: the state they see, the guard around them, the roles they play.
#pragma once

#include <csetjmp>
#include <cstddef>
#include <cstring>

#include "sdk/context.h"
#include "sdk/user_spec.h"

namespace oriel::sdk {

/// A miState with what stands behind it, for one point; lives on the stack.
class StateFrame {
 public:
  /// `parent`: of the ray that found the point; null for eye rays and where it is not known.
  StateFrame(Host& host, ShadingPoint& point, miState* parent = current_parent());
  StateFrame(const StateFrame&) = delete;
  StateFrame& operator=(const StateFrame&) = delete;

  miState state;
  Context context;

  /// State of the shader whose ray is being traced in this thread.
  static miState*& current_parent();

 private:
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

/// Handles a signal of a crash: does not return when a user's shader was running in this thread,
/// whose call then fails, and the rendering stops (Host::stopped). To be called from the program's
/// signal handler.
void leave_crashed_shader();

/// Name of the shader that crashed; empty when none did.
const std::string& crashed_shader();

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
