// SPDX-License-Identifier: Apache-2.0
// A reference to an instance's matrix, or a matrix of its own on moving instances.
#pragma once

#include "base/vec.h"

namespace oriel {

/// Behaves like a pointer, null until set. Storage for an own matrix is uninitialised until then:
/// points are made and copied very often, and few are on moving objects.
class PlacedMatrix {
 public:
  PlacedMatrix() = default;
  PlacedMatrix(const Mat4* shared) : shared_(shared) {}
  PlacedMatrix(const PlacedMatrix& other) { *this = other; }
  PlacedMatrix& operator=(const PlacedMatrix& other) {
    if (this == &other) return *this;
    shared_ = other.shared_;
    is_own_ = other.is_own_;
    if (is_own_) own_ = other.own_;
    return *this;
  }
  /// Stores a copy.
  void set(const Mat4& own) {
    own_ = own;
    is_own_ = true;
  }
  operator const Mat4*() const { return is_own_ ? &own_ : shared_; }

 private:
  const Mat4* shared_ = nullptr;
  bool is_own_ = false;
  Mat4 own_{Imath::UNINITIALIZED};
};

}  // namespace oriel
