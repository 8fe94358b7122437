// SPDX-License-Identifier: Apache-2.0
// A user's shader: the spec made of its declaration, the layout of its C struct, its functions.
#pragma once

#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/diagnostic.h"
#include "oriel/sdk/shader.h"
#include "runtime/shader_node.h"
#include "scene/shader.h"

namespace oriel::sdk {

class Host;

/// A member of a C struct and where its value stands in the renderer's own layout.
struct CMember {
  ParamType type = ParamType::Scalar;
  std::size_t c_offset = 0, offset = 0;  ///< bytes
  // Arrays: what an element has, from its begin, and its size.
  std::vector<CMember> members = {};
  std::size_t c_stride = 0, stride = 0;
};

/// Where the elements of an array stand that follow `end` bytes of a block: a multiple of their
/// size behind the array's own place, as C reaches them by index.
std::size_t begin_of_array(const CMember& array, std::size_t end);

/// Bytes of a value in C structs: 4-byte units, tags for names.
std::size_t c_size(ParamType type);
miParam_type c_type(ParamType type);

/// Errors: OR-SDK-010 for parameters that no C struct can be made of (they are left out).
struct UserSpec : ShaderSpec {
  UserSpec(const scene::ShaderDeclaration& declaration, Host& owner, Diagnostics& diagnostics);

  Host* host;
  std::string own_name;
  std::deque<std::string> texts;  ///< names of rows
  std::vector<ParamSpec> rows, result_rows;
  std::deque<std::vector<ParamSpec>> element_rows;  ///< of arrays of structs
  std::vector<CMember> members, result_members;
  std::size_t c_params_size = 0, c_result_size = 0;
  std::size_t index = 0;       ///< among the Host's
  std::string parameter_text;  ///< `.mi` form of the parameters, for miQ_DECL_PARAM

  bool is_data = false;  ///< layout of user data, no shader
  void* function = nullptr;
  void* init = nullptr;
  void* exit = nullptr;
  bool initialised = false, each_instance = false;  ///< under the host's shader lock
};

/// A connected parameter of a call.
struct CConnection {
  std::size_t c_offset;
  ParamType type;
  const Connection* source;
};

/// One call of a user's shader: its parameters as its C struct.
struct UserInstance final : ShaderState {
  const UserSpec* spec = nullptr;
  const ShaderNode* node = nullptr;
  std::unique_ptr<std::byte[]> block;  ///< miFunction, parameters, tags of what is connected
  miFunction* function = nullptr;
  void* parameters = nullptr;
  std::vector<CConnection> connections;
  void* user = nullptr;  ///< miQ_FUNC_USERPTR
  std::mutex thread_mutex;
  std::map<std::thread::id, void*> of_thread;  ///< miQ_FUNC_TLS_*; under thread_mutex
  miLock lock = {};
  std::atomic<bool> ready = false;
  bool initialised = false;

  /// Makes the block and calls the shader's init functions, once.
  void make_ready(const ShaderNode& of);

 private:
  void initialise(Host& host);
};

/// The call behind a node; null when it is no user's shader.
UserInstance* user_instance(const ShaderNode& node);

}  // namespace oriel::sdk
