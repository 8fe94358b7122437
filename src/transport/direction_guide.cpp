// SPDX-License-Identifier: Apache-2.0
#include "transport/direction_guide.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace oriel {
namespace {

/// What the node above counts, in points; .5 to 1.5 differ little.
constexpr float kWeightAbove = 0.5f;

/// The entry of increasing shares that contains u, and where in it, both as a coordinate.
struct Found {
  std::size_t index;
  float coordinate;
};
Found find_share(const float* until, float u) {
  std::size_t i = 0;
  for (std::size_t k = 0; k + 1 < kGuideSide; ++k) i += until[k] <= u ? 1 : 0;
  const float from = i > 0 ? until[i - 1] : 0, size = until[i] - from;
  const float within = size > 0 ? clamp((u - from) / size, 0, 0x1.fffffep-1f) : 0.5f;
  return {i, (static_cast<float>(i) + within) / kGuideSide};
}

}  // namespace

std::size_t guide_cell(const Vec2& at) {
  const auto along = [](float x) {
    return static_cast<std::size_t>(clamp(x * kGuideSide, 0, kGuideSide - 1));
  };
  return along(at.y) * kGuideSide + along(at.x);
}

Frame guide_frame(const Vec3& normal) {
  Vec3 tangent(0);
  tangent[static_cast<int>((main_side(normal) / 2 + 1) % 3)] = 1;
  return Frame::along(normal, tangent);
}

GuideDensity::GuideDensity(const GuideSquare& light) {
  double sum = 0;  // double: shares must add up to 1
  for (const float l : light) sum += static_cast<double>(l);
  const float scale = sum > 0 ? static_cast<float>((1 - kUnguided) * kGuideCells / sum) : 0;
  for (std::size_t i = 0; i < kGuideCells; ++i)
    density_[i] = sum > 0 ? kUnguided + scale * light[i] : 1;
  sum_up();
}

GuideDensity GuideDensity::of_values(const GuideSquare& density) {
  GuideDensity guide;
  guide.density_ = density;
  guide.sum_up();
  return guide;
}

/// The shares that follow from the density.
void GuideDensity::sum_up() {
  double rows = 0;
  for (std::size_t row = 0; row < kGuideSide; ++row) {
    const auto begin = density_.begin() + static_cast<std::ptrdiff_t>(row * kGuideSide);
    const double of_row = std::accumulate(begin, begin + kGuideSide, 0.0);
    double until = 0;
    for (std::size_t i = row * kGuideSide; i < (row + 1) * kGuideSide; ++i)
      until_[i] = static_cast<float>((until += static_cast<double>(density_[i])) / of_row);
    rows_until_[row] = static_cast<float>((rows += of_row) / kGuideCells);
  }
}

Vec2 GuideDensity::sample(const Vec2& u, float& density) const {
  const Found row = find_share(rows_until_.data(), u.y);
  const Found column = find_share(&until_[row.index * kGuideSide], u.x);
  density = density_[row.index * kGuideSide + column.index];
  return Vec2(column.coordinate, row.coordinate);
}

LocalGuide DirectionGuide::at(const Vec3& position, const Vec3& normal) const {
  return {densities_[tree_.find(position, normal)], guide_frame(normal)};
}

DirectionGuide::DirectionGuide(const geom::Box3& bounds, std::span<const GuidePoint> points) {
  std::vector<SurfaceTree::Point> places;
  places.reserve(points.size());
  for (const GuidePoint& p : points) places.push_back({p.position, p.normal});
  tree_ = SurfaceTree(bounds, places);
  // The mean of the points and of the light above.
  const auto light_of = [&](std::span<const std::uint32_t> indices, const GuideSquare& above) {
    GuideSquare light;
    for (std::size_t k = 0; k < kGuideCells; ++k) light[k] = kWeightAbove * above[k];
    for (const std::uint32_t i : indices)
      for (std::size_t k = 0; k < kGuideCells; ++k) light[k] += points[i].light[k];
    const float scale = 1 / (static_cast<float>(indices.size()) + kWeightAbove);
    for (float& l : light) l *= scale;
    return light;
  };
  for (const GuideSquare& light : tree_.values(GuideSquare{}, light_of))
    densities_.emplace_back(light);
  tree_.forget_points();
}

void DirectionGuide::set_densities(const std::vector<GuideSquare>& values) {
  densities_.clear();
  densities_.reserve(values.size());
  for (const GuideSquare& density : values) densities_.push_back(GuideDensity::of_values(density));
}

bool DirectionGuide::is_valid() const {
  const auto is_density = [](float value) {
    return value >= GuideDensity::kUnguided && value <= kGuideCells;
  };
  return tree_.is_valid() && densities_.size() == tree_.cells() &&
         std::all_of(densities_.begin(), densities_.end(), [&](const GuideDensity& density) {
           return std::all_of(density.values().begin(), density.values().end(), is_density);
         });
}

}  // namespace oriel
