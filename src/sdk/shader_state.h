// SPDX-License-Identifier: Apache-2.0
// Values that shaders leave for each other under a key (mi_shaderstate_*).
#pragma once

#include "oriel/sdk/shader.h"

namespace oriel::sdk {

// Conventions
//   Kept by thread. Lifetime 0 ends with the shader that left the value, 1 with the eye ray, 2 with
//   the pixel (tiles are no notion of this renderer: what a shader may count on is less).

/// Around a call of a shader: values of lifetime 0 that it leaves end with it.
class ShaderStateScope {
 public:
  explicit ShaderStateScope(const miState& state);
  ~ShaderStateScope();
  ShaderStateScope(const ShaderStateScope&) = delete;
  ShaderStateScope& operator=(const ShaderStateScope&) = delete;

 private:
  int depth_;
};

/// Leaves `size` bytes under a key; the copy, or null for size 0.
void* leave_value(const char* key, const void* value, int size, int lifetime);
/// The value under a key; null when there is none.
void* left_value(const char* key, int* size);

}  // namespace oriel::sdk
