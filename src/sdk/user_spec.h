// SPDX-License-Identifier: Apache-2.0
// User shaders: spec from the declaration, layout of the C struct, functions.
#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "oriel/sdk/shader.h"
#include "runtime/shader_node.h"
#include "scene/shader.h"

namespace oriel::sdk {

class Host;

/// A member of a C struct and its offset in the layout of the renderer.
struct CMember {
  ParamType type = ParamType::Scalar;
  std::size_t c_offset = 0, offset = 0;  ///< bytes
  // For arrays: members of an element relative to its start, and the element size.
  std::vector<CMember> members = {};
  std::size_t c_stride = 0, stride = 0;
};

/// Offset of array elements that follow a block of `end` bytes: aligned to a multiple of the
/// element size from the array itself, because C accesses them by index.
std::size_t begin_of_array(const CMember& array, std::size_t end);

/// Size of a value in C structs: 4-byte units, tags for names.
std::size_t c_size(ParamType type);
miParam_type c_type(ParamType type);

/// Errors:  OR-SDK-010 for parameters that cannot be stored in a C struct; they are ignored.
struct UserSpec : ShaderSpec {
  UserSpec(const scene::ShaderDeclaration& declaration, Host& owner, Diagnostics& diagnostics);

  Host* host;
  std::string own_name;
  std::string library_name;       ///< file name
  std::deque<std::string> texts;  ///< names in the rows
  std::vector<ParamSpec> rows, result_rows;
  std::deque<std::vector<ParamSpec>> element_rows;  ///< for arrays of structs
  std::vector<CMember> members, result_members;
  std::size_t c_params_size = 0, c_result_size = 0;
  std::size_t index = 0;       ///< index in the Host
  std::string parameter_text;  ///< `.mi` form of the parameters, for miQ_DECL_PARAM

  bool is_data = false;  ///< layout of user data instead of a shader
  void* function = nullptr;
  void* init = nullptr;
  void* exit = nullptr;
  bool initialised = false, each_instance = false;  ///< protected by the host's shader lock
  mutable std::atomic<bool> crashed = false;        ///< it is not called again
  mutable std::atomic<bool> broken = false;         ///< it returned NaN or infinity
};

/// A connected parameter of a call.
struct CConnection {
  std::size_t c_offset;
  ParamType type;
  const Connection* source;
};

/// Per-thread pointers of a call: miQ_FUNC_TLS_SET.
///
/// Model:   the key is a number that is never reused, unlike thread ids: a new thread would
///          otherwise find the pointer of one that has ended. No function accesses memory of
///          shaders while it holds the lock, since a crash would not release it.
class ThreadPointers {
 public:
  void* get() const;  ///< null if this thread has not set one
  void set(void* pointer);
  std::vector<void*> all() const;  ///< of all threads, also of those that have ended
  void take(ThreadPointers& other);

 private:
  mutable std::mutex mutex_;
  std::map<std::uint64_t, void*> of_;
};

/// One call of a user shader with its C parameter struct.
struct UserInstance final : ShaderState {
  UserInstance() = default;
  UserInstance(const UserInstance&) = delete;
  UserInstance& operator=(const UserInstance&) = delete;
  ~UserInstance() override;

  const UserSpec* spec = nullptr;
  std::shared_ptr<Host*> host;   ///< points to null after its destruction
  const World* world = nullptr;  ///< world of the call
  const ShaderNode* node = nullptr;
  std::unique_ptr<std::byte[]> block;  ///< miFunction, parameters, tags of connections
  miFunction* function = nullptr;
  void* parameters = nullptr;
  std::vector<CConnection> connections;
  void* user = nullptr;  ///< miQ_FUNC_USERPTR
  ThreadPointers thread_pointers;
  miLock lock = {};
  std::atomic<bool> ready = false, called = false;
  bool initialised = false;

  /// Builds the block and calls the init functions of the shader, once.
  void make_ready(const ShaderNode& of);

 private:
  void initialise(Host& owner);
};

/// The call of a node; null if it is not a user shader.
UserInstance* user_instance(const ShaderNode& node);

}  // namespace oriel::sdk
