// SPDX-License-Identifier: Apache-2.0
// What lies behind the scene: the environment's radiance and its importance sampling.
#pragma once

#include <memory>

#include "runtime/shader_node.h"
#include "sampling/distribution.h"

namespace oriel {

/// Radiance, in pixel units, of environment shaders in a direction; alpha as the shader returns it.
/// `blurred`: the ray is one of a glossy bundle. `roughness`: see ShadingPoint.
Rgba environment_radiance(const NodeList& shaders, const World& world, const Vec3& origin,
                          const Vec3& direction, RayKind kind, bool blurred = false,
                          float roughness = 0);

/// The scene's environment as a light: a table of what diffuse surfaces see of it, over
/// (u, v) = (azimuth / 2 pi, (1 - z) / 2), equal areas in solid angle, z world up or not.
class EnvironmentLight {
 public:
  EnvironmentLight() = default;
  /// Tabulates the shaders as rays of kind FinalGather see them.
  EnvironmentLight(NodeList shaders, const World& world);

  const NodeList& shaders() const { return shaders_; }
  bool empty() const { return shaders_.empty(); }
  /// Whether it brings any light to diffuse surfaces.
  bool lights() const { return mean_luminance_ > 0; }
  float mean_luminance() const { return mean_luminance_; }

  struct Sample {
    Vec3 wi;
    float pdf;  ///< per solid angle
  };
  /// For light that rays of lobes may find as well: what stands out from the mean is chosen more
  /// often than by its share, since those rays find the rest about as well.
  /// Source:  Karlik et al., "MIS Compensation: Optimizing Sampling Techniques in Multiple
  ///          Importance Sampling", ACM TOG 38(6), 2019.
  /// Checked: Sky.IrradianceOfTheSkyIsFoundWithFewSamples
  Sample sample(Vec2 u) const { return sample_from(*standing_out_, u); }
  float pdf(const Vec3& direction) const;
  /// In proportion to radiance alone, where no ray of a lobe helps: photons.
  Sample sample_alone(Vec2 u) const { return sample_from(*table_, u); }

 private:
  static Sample sample_from(const sampling::Distribution2D& table, Vec2 u);

  NodeList shaders_;
  std::unique_ptr<sampling::Distribution2D> table_, standing_out_;
  float mean_luminance_ = 0;
};

}  // namespace oriel
