// SPDX-License-Identifier: Apache-2.0
#include "runtime/shade_input.h"

namespace oriel {
namespace {

/// False: no material is connected.
bool shade_material(const Call& call, std::size_t offset, const Rgb& level, Closure& closure) {
  const ShaderNode* source = call.node ? call.node->material_input(offset) : nullptr;
  if (!source) return false;
  ClosurePart part(closure);
  source->with_params(call.point,
                      [&](const Call& inner) { source->spec().material.fill(inner, closure); });
  part.join(level);
  return true;
}

}  // namespace

ClosurePart::ClosurePart(Closure& closure)
    : closure_(&closure),
      first_(closure.count),
      emission_(closure.emission),
      albedo_(closure.albedo),
      ambient_(closure.occlusion.ambient) {
  closure.emission = closure.albedo = closure.occlusion.ambient = Rgb(0);
}

void ClosurePart::join(const Rgb& level) {
  Closure& c = *closure_;
  for (int i = first_; i < c.count; ++i) c.lobes[i].weight *= level;
  c.emission = emission_ + c.emission * level;
  c.albedo = albedo_ + c.albedo * level;
  c.occlusion.ambient = ambient_ + c.occlusion.ambient * level;
}

void scale(Closure& closure, const Rgb& level) {
  for (int i = 0; i < closure.count; ++i) closure.lobes[i].weight *= level;
  closure.emission *= level;
  closure.albedo *= level;
  closure.occlusion.ambient *= level;
}

void shade_input(const Call& call, std::size_t offset, const Rgba& plain, const Rgb& level,
                 Closure& closure) {
  if (is_black(level) || shade_material(call, offset, level, closure)) return;
  closure.emission += rgb(plain) * level;
}

void shade_input(const Call& call, std::size_t offset, ShaderRef plain, const Rgb& level,
                 Closure& closure) {
  if (is_black(level) || shade_material(call, offset, level, closure)) return;
  if (plain.node && plain.node->spec().value)
    closure.emission += rgb(plain.node->color(call.point)) * level;
}

}  // namespace oriel
