// SPDX-License-Identifier: Apache-2.0
// The shader state from which a new state is derived: of a ray, a light sample, or the same point.
#pragma once

#include <cstdint>
#include <optional>

#include "base/vec.h"
#include "oriel/sdk/shader.h"

namespace oriel {
struct ShadingPoint;
}

namespace oriel::sdk {

/// Final state of the first user material that a ray runs.
struct Answer {
  Vec3 position{0};  ///< of the hit
  miState state;
};

// Conventions
//   One per thread. All pointers may be null.
struct Caller {
  miState* ray = nullptr;    ///< state of the shader that casts the current ray
  miState* light = nullptr;  ///< state of the shader that samples a light
  /// State of the shader that evaluates a built-in shader at its own point.
  miState* same_point = nullptr;
  const ShadingPoint* point = nullptr;      ///< that point
  std::optional<Answer>* answer = nullptr;  ///< receives the state of the hit
  miState* light_answer = nullptr;          ///< receives the state of the light shader

  static Caller& current();
  static Caller of_ray(miState* state, std::optional<Answer>* answer = nullptr) {
    return {.ray = state, .answer = answer};
  }
  /// The parent of a light shader is the state of the sampling shader; the parent of a shadow
  /// shader is the state of the light shader.
  static Caller of_light(miState* state, miState* light_answer) {
    return {.ray = state, .light = state, .light_answer = light_answer};
  }
  /// The ray and its caller are unchanged.
  static Caller at_point(miState* state, const ShadingPoint& point) {
    return {.ray = current().ray, .same_point = state, .point = &point};
  }
};

/// Replaces the current caller during its lifetime.
class CallerScope {
 public:
  explicit CallerScope(const Caller& caller) : outer_(Caller::current()) {
    Caller::current() = caller;
  }
  ~CallerScope() { Caller::current() = outer_; }
  CallerScope(const CallerScope&) = delete;
  CallerScope& operator=(const CallerScope&) = delete;

 private:
  Caller outer_;
};

/// Number of the calling thread: the smallest one that no other shader thread uses.
short thread_number();

/// A number of the calling thread that no other thread of the process ever has; at least 1.
std::uint64_t thread_generation();

}  // namespace oriel::sdk
