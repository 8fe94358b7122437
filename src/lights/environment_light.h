// SPDX-License-Identifier: Apache-2.0
// Importance sampling of the scene's environment.
#pragma once

#include <memory>

#include "base/vec.h"
#include "sampling/distribution.h"

namespace oriel {

struct World;

/// The scene's environment as a light: a table of what diffuse surfaces see of it, over
/// (u, v) = (azimuth / 2 pi, (1 - z) / 2), equal areas in solid angle, z world up or not.
class EnvironmentLight {
 public:
  EnvironmentLight() = default;
  /// Tabulates World::environment as rays of kind FinalGather see it. The table is finer where
  /// textures are bound already.
  explicit EnvironmentLight(const World& world);

  /// Whether it lights diffuse surfaces.
  bool lights() const { return mean_luminance_ > 0; }
  float mean_luminance() const { return mean_luminance_; }

  struct Sample {
    Vec3 wi;
    float pdf;  ///< per solid angle
  };
  /// For use with MIS: directions brighter than the mean are sampled more often than in proportion,
  /// since BSDF samples find the rest about as well.
  /// Source:  Karlik et al., "MIS Compensation: Optimizing Sampling Techniques in Multiple
  ///          Importance Sampling", ACM TOG 38(6), 2019.
  /// Checked: Sky.IrradianceOfTheSkyIsFoundWithFewSamples
  Sample sample(Vec2 u) const { return sample_from(*standing_out_, u); }
  float pdf(const Vec3& direction) const;
  /// In proportion to radiance, without MIS: for photons.
  Sample sample_alone(Vec2 u) const { return sample_from(*table_, u); }

 private:
  static Sample sample_from(const sampling::Distribution2D& table, Vec2 u);

  std::unique_ptr<sampling::Distribution2D> table_, standing_out_;
  float mean_luminance_ = 0;
};

}  // namespace oriel
