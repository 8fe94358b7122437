// SPDX-License-Identifier: Apache-2.0
// Materials over materials: the closure of a shader that is connected to another, scaled and
// joined.
#pragma once

#include "runtime/closure.h"
#include "runtime/shader_node.h"

namespace oriel {

/// A part of a closure under way: what is added to it while the part stands is scaled and joined
/// with what was there before.
class ClosurePart {
 public:
  /// Takes emission, albedo and ambient light out of the closure, so that what is added stands
  /// alone.
  explicit ClosurePart(Closure& closure);
  ClosurePart(const ClosurePart&) = delete;
  ClosurePart& operator=(const ClosurePart&) = delete;

  /// Scales what was added since, and puts back what was taken out.
  void join(const Rgb& level);

 private:
  Closure* closure_;
  int first_;
  Rgb emission_, albedo_, ambient_;
};

/// Scales a whole closure: lobes, emission, albedo, ambient light.
void scale(Closure& closure, const Rgb& level);

/// Adds what stands for the parameter at `offset`, times `level`: the closure of the material that
/// is connected there, or else what the parameter itself says, as light that is seen. Asks nothing
/// where the level is black.
///
/// Model:   cut-outs, media, light lists and switches are those of the material asked last.
/// Inputs:  offset: of the parameter; plain: its value. A shader that is no material gives its own.
/// Checked: MaterialChains.* in tests/shader_binding, RayNodes.* in tests/analytic.
void shade_input(const Call& call, std::size_t offset, const Rgba& plain, const Rgb& level,
                 Closure& closure);
void shade_input(const Call& call, std::size_t offset, ShaderRef plain, const Rgb& level,
                 Closure& closure);

}  // namespace oriel
