// SPDX-License-Identifier: Apache-2.0
// Surface emission evaluated outside path tracing; also builds emissive-triangle lights.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "lights/mesh_lights.h"
#include "runtime/world.h"

namespace oriel {

/// A triangle of the world's accel, world space.
struct TriangleCorners {
  Vec3 a, b, c;
  Vec3 normal_times_area() const { return cross(b - a, c - a) * 0.5f; }
};
TriangleCorners corners_of(const World& world, std::uint32_t instance, std::uint32_t primitive,
                           float time);

/// A point of a triangle in the middle of the shutter interval, as hit by a ray along the normal.
/// Inputs:  u, v: barycentric weights of corners b and c; instance: of the world's accel.
ShadingPoint point_of_triangle(const World& world, std::uint32_t instance, std::uint32_t primitive,
                               float u, float v, bool from_behind, RayKind kind);

/// Emission of a surface for rays of the point's kind.
struct SurfaceEmission {
  Rgb radiance{0};
  bool of_lights = false;  ///< the shader computed it from light it gathered: not a source
};
SurfaceEmission emission_at(const Material& material, ShadingPoint& point);

/// Whether the surface shaders can emit light with their parameters.
bool may_emit(const Material& material);

enum class EmissionKind : std::uint8_t { None, Source, OfLights };
/// How materials emit, by index: probed at up to kEmissionProbes points of surfaces that have the
/// material, if its shaders may emit.
inline constexpr int kEmissionProbes = 256;
std::vector<EmissionKind> emissive_materials(const World& world);

/// The same of the world's instances, by index: Source if any of their materials is one.
std::vector<EmissionKind> emissive_instances(const World& world,
                                             const std::vector<EmissionKind>& materials);

/// Emissive triangles, as lights to sample.
///
/// Model:   the emission that diffuse rays see is evaluated at a few fixed points of both sides of
///          each triangle. A triangle that is black at all of them is not sampled; rays find its
///          emission. A triangle with one black side does not light points on that side. Of more
///          than kMaxEmissiveTriangles triangles the brightest instances are sampled. None is
///          sampled where emissive surfaces are as large as the scene (the participation ratio of
///          their power exceeds kWideShare of the surface of the scene's box): rays find those
///          better.
/// Checked: Emission.* in tests/analytic/lights/emission_test.cpp
inline constexpr std::size_t kMaxEmissiveTriangles = std::size_t{1} << 22;
inline constexpr float kWideShare = 0.25f;
MeshLights mesh_lights_of(const World& world, const std::vector<EmissionKind>& materials);

}  // namespace oriel
