// SPDX-License-Identifier: Apache-2.0
// Which shader's state a new state continues: who casts the ray, asks the light, shares the point.
#pragma once

#include <optional>

#include "base/vec.h"
#include "oriel/sdk/shader.h"

namespace oriel {
struct ShadingPoint;
}

namespace oriel::sdk {

/// State of the first user's material that a ray runs, as that material leaves it.
struct Answer {
  Vec3 position{0};  ///< of the hit
  miState state;
};

// Conventions
//   One for each thread. All pointers may be null.
struct Caller {
  miState* ray = nullptr;    ///< of the shader whose ray is being traced
  miState* light = nullptr;  ///< of the shader that samples a light
  /// Of the shader that evaluates a built-in shader at its own point.
  miState* same_point = nullptr;
  const ShadingPoint* point = nullptr;      ///< that point
  std::optional<Answer>* answer = nullptr;  ///< where the state of the hit is stored
  miState* light_answer = nullptr;          ///< where that of the light shader is stored

  static Caller& current();
  static Caller of_ray(miState* state, std::optional<Answer>* answer = nullptr) {
    return {.ray = state, .answer = answer};
  }
  /// Light shaders have the asking shader's state as parent, shadow shaders that of the light.
  static Caller of_light(miState* state, miState* light_answer) {
    return {.ray = state, .light = state, .light_answer = light_answer};
  }
  /// Rays still come from where they came from.
  static Caller at_point(miState* state, const ShadingPoint& point) {
    return {.ray = current().ray, .same_point = state, .point = &point};
  }
};

/// Exchanges the current caller while it lives.
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

/// Number of the calling thread: the smallest that no other thread has that runs shaders.
short thread_number();

}  // namespace oriel::sdk
