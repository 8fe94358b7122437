// SPDX-License-Identifier: Apache-2.0
// Importance sampling of the scene's environment.
#pragma once

#include <memory>

#include "base/vec.h"
#include "lights/environment_table.h"
#include "sampling/distribution.h"
#include "sampling/facing_distribution.h"

namespace oriel {

/// The scene's environment as a light, as diffuse surfaces see it.
///
/// Model:   densities over the cells of its table, an octahedral square of directions. Copies share
///          the densities.
class EnvironmentLight {
 public:
  EnvironmentLight() = default;
  /// Inputs:  as EnvironmentTable.
  explicit EnvironmentLight(const World& world, bool draft = false);

  /// Whether it lights diffuse surfaces.
  bool lights() const { return mean_luminance_ > 0; }
  float mean_luminance() const { return mean_luminance_; }
  const EnvironmentTable& table() const { return table_; }
  /// Share of its light above the mean: 0 for a constant one, 1 for a small lamp.
  float unevenness() const { return unevenness_; }

  struct Sample {
    Vec3 wi;
    float pdf;         ///< per solid angle
    std::size_t cell;  ///< of the table
  };
  /// For MIS with BSDF samples, on a surface: in proportion to radiance times cosine, with more
  /// samples where the radiance is above its mean. BSDF samples find the rest about as well.
  /// Inputs:  normal: unit; null: lit from everywhere.
  /// Source:  Karlik et al., "MIS Compensation: Optimizing Sampling Techniques in Multiple
  ///          Importance Sampling", ACM TOG 38(6), 2019.
  /// Checked: Sky.IrradianceOfTheSkyIsFoundWithFewSamples
  Sample sample(const Vec3& normal, Vec2 u) const;
  float pdf(const Vec3& normal, const Vec3& direction, std::size_t cell) const;
  /// In proportion to radiance, without MIS: for photons.
  Sample sample_alone(Vec2 u) const;

 private:
  EnvironmentTable table_;
  std::shared_ptr<const sampling::Distribution2D> in_proportion_;
  std::shared_ptr<const sampling::FacingDistribution> standing_out_;
  float mean_luminance_ = 0, unevenness_ = 0;
};

}  // namespace oriel
