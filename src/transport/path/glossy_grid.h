// SPDX-License-Identifier: Apache-2.0
// Interpolated glossy reflection and refraction: traced on a grid over the picture, smoothed.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/checkpoint_file.h"
#include "runtime/world.h"
#include "transport/counts.h"

namespace oriel {

struct PathSettings;

/// What one grid point sees.
struct GridPoint {
  int instance = -1;  ///< -1: nothing that interpolates
  const Material* material = nullptr;
  Vec3 normal{0};
  std::optional<Rgb> reflection, refraction;  ///< full strength, before level
  float alpha = 1;                            ///< of what the refraction shows
};

/// Grids over the picture, one for each density that a material asks for.
///
/// Model:   at each grid point the first surface's glossy lobe is followed with as many rays as the
///          material asks for. A look-up takes the N x N points about the pixel that lie on the
///          same material of the same instance and face the same way, weighed by a tent. Light
///          sources without a visible shape are highlights and are not interpolated.
/// Inputs:  density: 0..5 as the manual counts them: 2, 1, 1/2, 1/3, 1/4, 1/5 points for a pixel.
/// Source:  manual 1.6.9.
/// Checked: tests/analytic/materials/interpolation_test.cpp
class GlossyGrid {
 public:
  static constexpr int kDensities = 6;
  /// Grid points along one pixel.
  static float resolution(int density);

  GlossyGrid() = default;
  /// Fills the grids of all materials of the world by paths as those of the picture.
  GlossyGrid(const World& world, const PathSettings& paths, std::uint32_t seed, RayCounts& counts);

  void save(CheckpointWriter& out, const World& world) const;
  /// Reads what save() wrote for the same world. Errors:  CheckpointError.
  void restore(CheckpointReader& in, const World& world);

  bool empty() const { return grids_.empty(); }
  int width(int density) const;
  int height(int density) const;

  /// A smoothed value: light and, of refractions, its alpha.
  struct Smooth {
    Rgb light{0};
    float alpha = 0;
  };
  /// Nothing where no grid point fits.
  ///
  /// Inputs:  raster: as Camera::ray takes it; n: points along each side, 1 = the nearest.
  std::optional<Smooth> reflection(Vec2 raster, int density, int n, int instance,
                                   const Material& material, const Vec3& normal) const {
    return look_up(&GridPoint::reflection, raster, density, n, instance, material, normal);
  }
  std::optional<Smooth> refraction(Vec2 raster, int density, int n, int instance,
                                   const Material& material, const Vec3& normal) const {
    return look_up(&GridPoint::refraction, raster, density, n, instance, material, normal);
  }

 private:
  struct Grid {
    int width = 0, height = 0;
    std::vector<GridPoint> points;
  };
  std::optional<Smooth> look_up(std::optional<Rgb> GridPoint::*value, Vec2 raster, int density,
                                int n, int instance, const Material& material,
                                const Vec3& normal) const;

  std::vector<Grid> grids_;  ///< by density; empty when no material interpolates
};

}  // namespace oriel
