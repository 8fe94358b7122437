// SPDX-License-Identifier: Apache-2.0
// The scene's environment as diffuse surfaces see it, in a table where that is exact enough.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/environment_ray.h"

namespace oriel {

struct World;

/// How finely an environment is tabulated.
enum class TableDetail : std::uint8_t {
  Draft,    ///< for reduced pictures
  Smooth,   ///< without small details: formulas
  Detailed  ///< with small details: pictures
};

/// Radiance of World::environment for rays of kind FinalGather.
///
/// Model:   the mean of a few points for each cell of a square of directions (octahedral.h). A cell
///          with more contrast than kMaxContrast permits is not used, nor are its neighbours: the
///          shaders are evaluated. So they are in every direction if the radiance depends on more
///          than the direction, which is tested with other origins and pixels at each cell, if the
///          pictures that are bound have more pixels than the table can look at, or if a shader of
///          a user is among them: it may read anything that the calling shader leaves it.
/// Checked: EnvironmentTable.*
class EnvironmentTable {
 public:
  EnvironmentTable() = default;
  /// Inputs:  world: with its environment bound; draft: a table of few cells, for reduced pictures.
  explicit EnvironmentTable(const World& world, bool draft = false);

  /// Cells along each side; 0 without environment.
  std::size_t side() const { return side_; }
  /// Mean luminance of each cell, row after row; removed from the table.
  std::vector<float> take_luminances() { return std::move(luminances_); }
  TableDetail detail() const { return detail_; }
  /// Whether the radiance is the same in all directions.
  bool constant() const { return constant_.has_value(); }
  /// Whether the radiance of glossy rays is the same.
  bool same_for_glossy_rays() const { return same_for_glossy_rays_; }
  /// Whether glossy rays need no more detail: a lobe covers many cells. Inputs:  pdf: density of
  /// the lobe's sample, per solid angle.
  bool is_fine_for(float pdf) const {
    return same_for_glossy_rays_ && pdf * kMinCellsOfLobe * 4 * kPi < static_cast<float>(cells());
  }

  /// The radiance along a ray; its kind is not used. Inputs:  cell: of the direction.
  Rgb radiance(const World& world, const EnvironmentRay& ray, std::size_t cell) const {
    if (constant_) return *constant_;
    if (!cells_.empty() && cells_[cell].x >= 0) return cells_[cell];
    return evaluated(world, ray);
  }
  Rgb radiance(const World& world, const EnvironmentRay& ray) const {
    return radiance(world, ray, cells_.empty() ? 0 : cell_of(ray.direction));
  }
  std::size_t cell_of(const Vec3& direction) const;

 private:
  /// A lobe that covers at least so many cells shows no difference between the means of cells and
  /// the radiance in single directions.
  static constexpr float kMinCellsOfLobe = 20;
  std::size_t cells() const { return side_ * side_; }

  struct Cell;
  /// The means of points x points. `tests`: also what else the radiance depends on.
  Cell cell(const World& world, std::size_t x, std::size_t y, int points, bool tests) const;
  static Rgb evaluated(const World& world, const EnvironmentRay& ray);

  std::size_t side_ = 0;
  TableDetail detail_ = TableDetail::Smooth;
  bool same_for_glossy_rays_ = false;
  std::optional<Rgb> constant_;
  std::vector<Rgb> cells_;  // x below 0: not usable; empty: none is
  std::vector<float> luminances_;
};

}  // namespace oriel
