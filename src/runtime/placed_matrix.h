// SPDX-License-Identifier: Apache-2.0
// A matrix that is an instance's, or where the instance moves the point's own.
#pragma once

#include "base/vec.h"

namespace oriel {

/// Reads as a pointer, null until set. The place for an own matrix is left as it is until then:
/// points are made and copied by the million, and few are on what moves.
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
  /// Keeps a copy.
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
