// SPDX-License-Identifier: Apache-2.0
#include "sdk/shader_state.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace oriel::sdk {
namespace {

struct StateValue {
  std::string key;
  std::unique_ptr<std::byte[]> bytes;
  int size, lifetime;
  int depth;  ///< call depth of the shader that set it, for lifetime 0
};

struct Store {
  std::vector<StateValue> values;
  int depth = 0;
  float raster_x = -1, raster_y = -1;
};

Store& store() {
  thread_local Store values;
  return values;
}

template <class F>
void drop(F&& which) {
  auto& values = store().values;
  values.erase(std::remove_if(values.begin(), values.end(), which), values.end());
}

/// A different raster position means a new eye ray.
void begin_eye_ray(const miState& state) {
  Store& s = store();
  if (s.raster_x == state.raster_x && s.raster_y == state.raster_y) return;
  const bool same_pixel = static_cast<int>(s.raster_x) == static_cast<int>(state.raster_x) &&
                          static_cast<int>(s.raster_y) == static_cast<int>(state.raster_y);
  drop([&](const StateValue& v) {
    return v.lifetime == miSS_LIFETIME_EYERAY || (v.lifetime == miSS_LIFETIME_RECT && !same_pixel);
  });
  s.raster_x = state.raster_x;
  s.raster_y = state.raster_y;
}

}  // namespace

ShaderStateScope::ShaderStateScope(const miState& state) {
  Store& s = store();
  if (!s.values.empty() || s.raster_x != state.raster_x) begin_eye_ray(state);
  depth_ = s.depth++;
}

ShaderStateScope::~ShaderStateScope() {
  Store& s = store();
  s.depth = depth_;  // also removes deeper scopes of a crashed shader
  if (!s.values.empty())
    drop([&](const StateValue& v) {
      return v.lifetime == miSS_LIFETIME_SUBRAYS && v.depth > depth_;
    });
}

void* leave_value(const char* key, const void* value, int size, int lifetime) {
  Store& s = store();
  if (!value || size <= 0) {
    drop([&](const StateValue& v) { return v.key == key; });
    return nullptr;
  }
  auto found = std::find_if(s.values.rbegin(), s.values.rend(), [&](const StateValue& v) {
    return v.key == key && v.depth == s.depth;
  });
  StateValue* target = found != s.values.rend() ? &*found : nullptr;
  if (!target) {
    s.values.push_back({key, nullptr, 0, lifetime, s.depth});
    target = &s.values.back();
  }
  if (target->size != size)
    target->bytes = std::make_unique<std::byte[]>(static_cast<std::size_t>(size));
  target->size = size;
  target->lifetime = lifetime;
  std::copy_n(static_cast<const std::byte*>(value), size, target->bytes.get());
  return target->bytes.get();
}

void* left_value(const char* key, int* size) {
  auto& values = store().values;
  // The latest value, of the innermost call.
  const auto found = std::find_if(values.rbegin(), values.rend(),
                                  [&](const StateValue& v) { return v.key == key; });
  if (found == values.rend()) return nullptr;
  if (size) *size = found->size;
  return found->bytes.get();
}

}  // namespace oriel::sdk

using namespace oriel::sdk;

extern "C" {

miBoolean mi_shaderstate_set(miState*, const char* key, const void* value, int size, int lifetime) {
  if (!key) return miFALSE;
  leave_value(key, value, size, lifetime);
  return miTRUE;
}

void* mi_shaderstate_get(miState*, const char* key, int* size) {
  return key ? left_value(key, size) : nullptr;
}

void mi_shaderstate_enumerate(miState*, void (*cb)(void*, char*, void*, int, int), void* arg) {
  // Copies of the keys, because the callback may remove values.
  std::vector<std::pair<std::string, int>> keys;
  for (const StateValue& v : store().values) keys.emplace_back(v.key, v.lifetime);
  for (auto& [key, lifetime] : keys) {
    int size = 0;
    if (void* value = left_value(key.c_str(), &size)) cb(arg, key.data(), value, size, lifetime);
  }
}

}  // extern "C"
