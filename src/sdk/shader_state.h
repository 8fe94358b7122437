// SPDX-License-Identifier: Apache-2.0
// Values that shaders exchange under a key (mi_shaderstate_*).
#pragma once

#include "oriel/sdk/shader.h"

namespace oriel::sdk {

// Conventions
//   Stored per thread. Lifetime 0 ends with the shader that set the value, 1 with the eye ray, 2
//   with the pixel (Oriel has no tiles; the lifetime is the shortest that shaders can rely on).

/// Scope of a shader call: values of lifetime 0 that it sets are removed at its end.
class ShaderStateScope {
 public:
  explicit ShaderStateScope(const miState& state);
  ~ShaderStateScope();
  ShaderStateScope(const ShaderStateScope&) = delete;
  ShaderStateScope& operator=(const ShaderStateScope&) = delete;

 private:
  int depth_;
};

/// Sets a value of `size` bytes under a key; returns the copy, or null for size 0.
void* leave_value(const char* key, const void* value, int size, int lifetime);
/// The value under a key; null if there is none.
void* left_value(const char* key, int* size);

}  // namespace oriel::sdk
