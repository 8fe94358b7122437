// SPDX-License-Identifier: Apache-2.0
// Helpers of the fallback shaders for other programs: parameter tables marked as approximated,
// specs under a second name, angles.
#pragma once

#include <array>
#include <cmath>

#include "runtime/shader_node.h"

namespace oriel {

/// Marks all rows as approximated, except those that are marked as ignored.
template <std::size_t N>
constexpr std::array<ParamSpec, N> about(const ParamSpec (&rows)[N]) {
  std::array<ParamSpec, N> all{};
  for (std::size_t i = 0; i < N; ++i) {
    all[i] = rows[i];
    if (all[i].support == Support::Exact) all[i].support = Support::Approximated;
  }
  return all;
}

template <std::size_t N, std::size_t M>
constexpr std::array<ParamSpec, N + M> joined(const std::array<ParamSpec, N>& head,
                                              const std::array<ParamSpec, M>& tail) {
  std::array<ParamSpec, N + M> all{};
  for (std::size_t i = 0; i < N; ++i) all[i] = head[i];
  for (std::size_t i = 0; i < M; ++i) all[N + i] = tail[i];
  return all;
}

/// The same shader under another name.
constexpr ShaderSpec renamed(ShaderSpec spec, const char* name) {
  spec.name = name;
  return spec;
}

/// Exporters write angles in radians; values above a full turn are assumed to be degrees.
inline float angle_of(float x) { return std::abs(x) > kTwoPi ? x * kPi / 180 : x; }

inline Rgb clamped(const Rgba& c) { return Rgb(clamp01(c.r), clamp01(c.g), clamp01(c.b)); }

/// The texture coordinate: the connected one, else that of the surface.
inline Vec3 coordinate(const Call& call, std::size_t offset, const Vec3& connected) {
  if (call.node && call.node->connected(offset)) return connected;
  return call.point.texture_spaces > 0 ? call.point.tex[0] : Vec3(0);
}

}  // namespace oriel
