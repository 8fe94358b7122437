// SPDX-License-Identifier: Apache-2.0
// Layered materials: scales the closure of a connected material and adds it to another.
#pragma once

#include "runtime/closure.h"
#include "runtime/shader_node.h"

namespace oriel {

/// A part of a closure under construction: lobes that are added during its lifetime are scaled,
/// then combined with the earlier ones.
class ClosurePart {
 public:
  /// Removes emission, albedo and ambient light from the closure, so that it contains only the
  /// part.
  explicit ClosurePart(Closure& closure);
  ClosurePart(const ClosurePart&) = delete;
  ClosurePart& operator=(const ClosurePart&) = delete;

  /// Scales the part and restores the removed values.
  void join(const Rgb& level);

 private:
  Closure* closure_;
  int first_;
  Rgb emission_, albedo_, ambient_;
};

/// Scales a whole closure: lobes, emission, albedo, ambient light.
void scale(Closure& closure, const Rgb& level);

/// Adds the input at `offset` times `level`: the closure of the connected material, or otherwise
/// the parameter's value as emission. Evaluates nothing if the level is black.
///
/// Model:   cut-outs, media, light lists and switches are those of the last evaluated material.
/// Inputs:  offset: of the parameter; plain: its value, used if no material is connected.
/// Checked: MaterialChains.* in tests/shader_binding, RayNodes.* in tests/analytic.
void shade_input(const Call& call, std::size_t offset, const Rgba& plain, const Rgb& level,
                 Closure& closure);
void shade_input(const Call& call, std::size_t offset, ShaderRef plain, const Rgb& level,
                 Closure& closure);

}  // namespace oriel
