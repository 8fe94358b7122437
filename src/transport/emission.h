// SPDX-License-Identifier: Apache-2.0
// Surface emission evaluated outside path tracing; also samples emissive triangles.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "runtime/world.h"

namespace oriel {

/// A triangle of the world's accel, world space.
struct TriangleCorners {
  Vec3 a, b, c;
  Vec3 normal_times_area() const { return cross(b - a, c - a) * 0.5f; }
  float area() const { return length(normal_times_area()); }
  /// Evenly spread for u in [0,1)^2.
  Vec3 at(Vec2 u) const {
    const float s = std::sqrt(u.x);
    return a * (1 - s) + b * (s * (1 - u.y)) + c * (s * u.y);
  }
};
TriangleCorners corners_of(const World& world, std::uint32_t instance, std::uint32_t primitive,
                           float time);

/// A point of a triangle in the middle of the shutter, as a ray that comes from straight above it,
/// or from below, meets it. Inputs:  u, v: barycentric weights of corners b and c; instance: of the
/// world's accel.
ShadingPoint point_of_triangle(const World& world, std::uint32_t instance, std::uint32_t primitive,
                               float u, float v, bool from_behind, RayKind kind);

/// What the surface emits there to rays of the point's kind.
struct SurfaceEmission {
  Rgb radiance{0};
  bool of_lights = false;  ///< the shader made it of light that it asked for: no source
};
SurfaceEmission emission_at(const Material& material, ShadingPoint& point);

enum class EmissionKind : std::uint8_t { None, Source, OfLights };
/// How materials emit, by index: their shaders may, and they do at some of kEmissionProbes points
/// of what wears them.
inline constexpr int kEmissionProbes = 256;
std::vector<EmissionKind> emissive_materials(const World& world);

/// The same of the world's instances, by index: the most of what they wear, a source before others.
std::vector<EmissionKind> emissive_instances(const World& world,
                                             const std::vector<EmissionKind>& materials);

/// The triangles that glow, as lights to sample.
///
/// Model:   each is asked what diffuse rays see at a few fixed points of both sides. Black at all
///          of them: it is no light, and rays find what there is. One side black: it is none for
///          points behind. Of more than kMostEmissiveTriangles triangles the brightest instances
///          are taken. None at all where glowing surfaces are as wide as the scene (their
///          participation ratio in the power above kWideShare of its box's surface): rays find
///          those better.
/// Checked: Emission.* in tests/analytic/lights/emission_test.cpp
inline constexpr std::size_t kMostEmissiveTriangles = std::size_t{1} << 22;
inline constexpr float kWideShare = 0.25f;
MeshLights mesh_lights_of(const World& world, const std::vector<EmissionKind>& materials);

}  // namespace oriel
