// SPDX-License-Identifier: Apache-2.0
// Rays and light samples for shaders that are not materials.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "base/assert.h"
#include "runtime/material_outputs.h"
#include "runtime/shader_node.h"
#include "runtime/shading_point.h"

namespace oriel {

/// Conventions: world space. ShadingPoint::tracer is valid while a surface is shaded for a path,
/// and null otherwise (shadow rays, photons, displacement): shaders then return a result without
/// it. The pointer must not be stored. Implemented by transport/scene_tracer.h. Radiance in pixel
/// units.
class Tracer {
 public:
  virtual ~Tracer() = default;

  struct Met {
    float distance = 0;
    Vec3 position{0};
    Vec3 normal{0, 0, 1};            ///< unit, interpolated, facing the ray's origin
    Vec3 geometric_normal{0, 0, 1};  ///< unit, of the triangle, facing the ray's origin
    bool back_side = false;          ///< the back face was hit
    const Material* material = nullptr;
    int instance = -1;            ///< index into World::instances
    std::uint32_t primitive = 0;  ///< triangle of the instance's mesh
  };
  /// The first surface within `reach`, regardless of visibility flags. A cut-out stops the ray with
  /// its opacity as probability. Unshaded.
  virtual std::optional<Met> probe(const Vec3& origin, const Vec3& direction, float reach) = 0;
  /// The same along a ray that leaves a surface point.
  virtual std::optional<Met> probe_from(const ShadingPoint& point, const Vec3& direction,
                                        float reach) = 0;

  struct Arriving {
    Rgb colour{0};       ///< of a white Lambert surface that faces the light, with shadows
    Rgb unshadowed{0};   ///< the same without shadows
    Vec3 wi{0};          ///< unit, to the light
    float distance = 0;  ///< infinity for directional lights
    float affects_diffuse = 1, affects_specular = 1;  ///< as LightValue
    bool force_specular = false, is_sun = false;
  };
  /// One sample of a light at a point; empty if no light arrives.
  virtual std::optional<Arriving> light(int index, ShadingPoint& point) = 0;

  /// Lights to sample at a point in a volume: all if they are few, else one at random. Every light
  /// has a probability above 0 at every point.
  struct PickedLights {
    static constexpr int kMost = 12;
    struct Light {
      int index = 0;               ///< into World::lights
      float expected_samples = 1;  ///< at most 1
    };
    std::array<Light, kMost> of;
    int count = 0;
    const Light* begin() const { return of.data(); }
    const Light* end() const { return of.data() + count; }
    void add(int index, float expected_samples) {
      ORIEL_ASSERT(count < kMost);
      of[static_cast<std::size_t>(count++)] = {index, expected_samples};
    }
  };
  virtual PickedLights pick_lights(const Vec3& place) = 0;

  /// Two independent numbers in [0,1), stratified over the samples of a pixel.
  virtual Vec2 next() = 0;

  // For shaders that return a final colour: each result is an unbiased estimate.

  /// Depth of the path at this point.
  struct Depth {
    int reflections = 0, refractions = 0;
    float importance = 1;  ///< share of the pixel, at most 1
  };
  virtual Depth depth() const = 0;

  struct SubRay {
    RayKind kind = RayKind::Reflect;  ///< Eye, Reflect, Refract, Transparent
    Vec3 direction{0, 0, 1};          ///< unit
    bool from_surface = true;         ///< starts at the point's surface, otherwise at `origin`
    Vec3 origin{0};
    Depth depth;  ///< of the new ray
    /// only the environment is visible beyond it
    float reach = std::numeric_limits<float>::infinity();
  };
  struct Seen {
    Rgba colour{0};
    std::optional<Met> met;  ///< the first surface; empty: environment or the shape of a light
  };
  /// The radiance along a ray: surfaces with all their light, visible lights, the environment.
  virtual Seen trace(const ShadingPoint& from, const SubRay& ray) = 0;

  /// Indirect irradiance on the side of `normal`: light of surfaces and environment, also by
  /// mirrors and glass, computed by the scene's method. Direct light of light sources is not
  /// included.
  virtual Rgb irradiance(const ShadingPoint& point, const Vec3& normal) = 0;

  /// The colour of a list of materials at the point, and its outputs if `outputs` is not null.
  /// Alpha is that for the camera.
  virtual Rgba shade(const NodeList& surface, ShadingPoint& point, MaterialOutputs* outputs) = 0;

  /// Writes a value of this sample to World::user_buffers[slot]; false, without effect, if the
  /// point is not visible to the camera directly or by mirrors.
  virtual bool write_buffer(std::size_t slot, const Rgba& value) = 0;
  virtual std::optional<Rgba> read_buffer(std::size_t slot) const = 0;
};

}  // namespace oriel
