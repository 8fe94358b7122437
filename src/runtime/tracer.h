// SPDX-License-Identifier: Apache-2.0
// What a shader that is no material may ask of the scene around a point while it is rendered.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "runtime/material_outputs.h"
#include "runtime/shader_node.h"
#include "runtime/shading_point.h"

namespace oriel {

/// Conventions: world space. ShadingPoint::tracer is one while a surface is shaded for a path, and
/// null elsewhere (shadow rays, photons, displacement): shaders then answer without it. It must not
/// be kept. Implemented by transport/scene_tracer.h. Radiance in pixel units.
class Tracer {
 public:
  virtual ~Tracer() = default;

  struct Met {
    float distance = 0;
    Vec3 position{0};
    Vec3 normal{0, 0, 1};            ///< unit, interpolated, facing the ray's origin
    Vec3 geometric_normal{0, 0, 1};  ///< unit, of the triangle, facing the ray's origin
    bool back_side = false;          ///< met from behind
    const Material* material = nullptr;
    int instance = -1;            ///< index into World::instances
    std::uint32_t primitive = 0;  ///< triangle of the instance's mesh
  };
  /// The first surface within `reach`, whatever rays see it; cut-outs stop a ray by chance, as
  /// often as they are opaque. Unshaded.
  virtual std::optional<Met> probe(const Vec3& origin, const Vec3& direction, float reach) = 0;
  /// The same along a ray that leaves a point of a surface.
  virtual std::optional<Met> probe_from(const ShadingPoint& point, const Vec3& direction,
                                        float reach) = 0;

  struct Arriving {
    Rgb colour{0};       ///< a white Lambert surface that faces the light shows it; after shadows
    Rgb unshadowed{0};   ///< the same without shadows
    Vec3 wi{0};          ///< unit, to the light
    float distance = 0;  ///< infinity for directional lights
    float affects_diffuse = 1, affects_specular = 1;  ///< as LightValue
    bool force_specular = false, is_sun = false;
  };
  /// One sample of a light at a point; nothing where it does not reach.
  virtual std::optional<Arriving> light(int index, ShadingPoint& point) = 0;

  /// Two independent numbers in [0,1), evenly spread over the samples of a pixel.
  virtual Vec2 next() = 0;

  // For shaders that bring a finished colour: each answer is an estimate whose mean is right.

  /// How far the path has come that asks.
  struct Depth {
    int reflections = 0, refractions = 0;
    float importance = 1;  ///< share of the pixel that it decides, at most 1
  };
  virtual Depth depth() const = 0;

  struct SubRay {
    RayKind kind = RayKind::Reflect;  ///< Eye, Reflect, Refract, Transparent
    Vec3 direction{0, 0, 1};          ///< unit
    bool from_surface = true;         ///< leaves the point's surface, else `origin`
    Vec3 origin{0};
    Depth depth;                                           ///< those of the new ray
    float reach = std::numeric_limits<float>::infinity();  ///< beyond it is the environment
  };
  struct Seen {
    Rgba colour{0};
    std::optional<Met> met;  ///< the first surface; nothing: environment or a light's shape
  };
  /// What a ray sees: surfaces with all their light, visible lights, the environment.
  virtual Seen trace(const ShadingPoint& from, const SubRay& ray) = 0;

  /// Light of surfaces and environment on the side that `normal` faces, through mirrors and glass
  /// as well, by the method the scene is rendered with: irradiance. That of light sources that
  /// reach the point straight is not in it.
  virtual Rgb irradiance(const ShadingPoint& point, const Vec3& normal) = 0;

  /// The colour of materials at the point, each shader on what the one before left, and what
  /// it consists of where `outputs` is not null. Alpha as the eye sees it there.
  virtual Rgba shade(const NodeList& surface, ShadingPoint& point, MaterialOutputs* outputs) = 0;

  /// Leaves a value for World::user_buffers[slot] of this sample, and what was left there; false
  /// and nothing where the point is not what the eye or its mirrors see.
  virtual bool write_buffer(std::size_t slot, const Rgba& value) = 0;
  virtual std::optional<Rgba> read_buffer(std::size_t slot) const = 0;
};

}  // namespace oriel
