// SPDX-License-Identifier: Apache-2.0
#include "lights/environment_table.h"

#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "base/parallel.h"
#include "color/luminance.h"
#include "runtime/world.h"
#include "sampling/octahedral.h"
#include "sampling/sampler.h"

namespace oriel {
namespace {

/// Cells along a side: with pictures .4 degrees, which resolves lamps in a photographed sky. A sky
/// from formulas is smooth, and a table that fits the processor's cache is faster.
constexpr std::size_t kPictureSide = 512, kFormulaSide = 256, kReportSide = 16;
/// The same of a draft.
constexpr std::size_t kDraftPictureSide = 128, kDraftFormulaSide = 64;
/// Points along each side of a cell, so that the smallest lamps are seen: .3 degrees apart, and at
/// most 1.5 pixels of a picture.
constexpr int kPoints = 3, kFewPoints = 2, kMaxPoints = 4;
constexpr double kPixelsBetween = 1.5;
/// Every so many cells along each side are tested for what else the radiance depends on.
constexpr std::size_t kTested = 4;
/// Contrast in a cell, as a share of the mean over all directions and of that of the cell, up to
/// which its mean stands for it. A cell is 1/300,000 of all directions or less.
constexpr float kMaxContrast = 0.25f, kMaxOwnContrast = 0.02f;
/// Contrast of an environment that is constant but for rounding.
constexpr float kRounding = 1e-5f;

float positive_luminance(const Rgb& c) {
  const float l = luminance(c);
  return std::isfinite(l) ? std::max(0.0f, l) : 0;
}

bool is_usable(const Rgb& c) { return is_finite(c) && c.x >= 0 && c.y >= 0 && c.z >= 0; }

/// The textures that the environment may use.
std::size_t texture_count(const World& world) {
  return std::min(world.textures.size(), world.environment_textures);
}

/// Pixels of the largest picture.
double largest_picture(const World& world) {
  double most = 0;
  for (std::size_t i = 0; i < texture_count(world); ++i) {
    const TextureNode& texture = *world.textures[i];
    most = std::max(most, static_cast<double>(texture.width()) * texture.height());
  }
  return most;
}

std::size_t side_of_table(bool pictures, bool draft) {
  if (draft) return pictures ? kDraftPictureSide : kDraftFormulaSide;
  return pictures ? kPictureSide : kFormulaSide;
}

}  // namespace

struct EnvironmentTable::Cell {
  Rgb low{0}, high{0}, mean{0};
  float luminance = 0;
  bool usable = true, by_direction = true, same_for_glossy_rays = true;
};

Rgb EnvironmentTable::evaluated(const World& world, const EnvironmentRay& ray) {
  EnvironmentRay gathered = ray;
  gathered.kind = RayKind::FinalGather;
  gathered.blurred = false;
  gathered.roughness = 0;
  return rgb(environment_radiance(world.environment, world, gathered));
}

std::size_t EnvironmentTable::cell_of(const Vec3& direction) const {
  const Vec2 uv = sampling::octahedral_uv(direction);
  const auto along = [&](float x) {
    return std::min(static_cast<std::size_t>(x * static_cast<float>(side_)), side_ - 1);
  };
  return along(uv.y) * side_ + along(uv.x);
}

EnvironmentTable::Cell EnvironmentTable::cell(const World& world, std::size_t x, std::size_t y,
                                              int points, bool tests) const {
  Cell cell;
  const auto n = static_cast<float>(points);
  for (int k = 0; k < points * points; ++k) {
    const int column = k % points, row = k / points;
    const Vec2 at(static_cast<float>(x) + (static_cast<float>(column) + 0.5f) / n,
                  static_cast<float>(y) + (static_cast<float>(row) + 0.5f) / n);
    const Vec3 direction = sampling::octahedral_direction(at / static_cast<float>(side_));
    const Rgb c = evaluated(world, {.direction = direction});
    cell.luminance += positive_luminance(c);
    cell.usable &= is_usable(c);
    cell.mean += c;
    for (int i = 0; i < 3; ++i) {
      cell.low[i] = k == 0 ? c[i] : std::min(cell.low[i], c[i]);
      cell.high[i] = k == 0 ? c[i] : std::max(cell.high[i], c[i]);
    }
    if (!tests || k > 0 || x % kTested > 0 || y % kTested > 0) continue;
    // The same direction from another place, for another pixel.
    sampling::Sampler random(static_cast<int>(x), static_cast<int>(y), 0);
    const Vec2 a = random.next_2d(), b = random.next_2d();
    // The size of the scene is not known yet: from a sixteenth of a unit to thousands.
    const float size = math::exp2(16 * b.y - 4);
    EnvironmentRay other{.origin = Vec3(a.x - 0.5f, a.y - 0.5f, b.x - 0.5f) * size,
                         .direction = direction,
                         .raster = Vec2(a.y * static_cast<float>(world.camera.width),
                                        b.y * static_cast<float>(world.camera.height))};
    cell.by_direction = evaluated(world, other) == c;
    other.kind = RayKind::Reflect;
    other.blurred = true;
    other.roughness = b.x;
    cell.same_for_glossy_rays = rgb(environment_radiance(world.environment, world, other)) == c;
  }
  cell.mean /= n * n;
  cell.luminance /= n * n;
  return cell;
}

EnvironmentTable::EnvironmentTable(const World& world, bool draft) {
  if (world.environment.empty()) return;
  const double pixels = largest_picture(world);
  const bool pictures = texture_count(world) > 0;
  detail_ = pictures ? TableDetail::Detailed : TableDetail::Smooth;
  if (draft) detail_ = TableDetail::Draft;
  side_ = world.coarse_tables ? kReportSide : side_of_table(pictures, draft);
  const double needed = std::sqrt(pixels) / (kPixelsBetween * static_cast<double>(side_));
  int points = pictures || world.coarse_tables ? kFewPoints : kPoints;
  const bool seen_all = needed <= (draft ? points : kMaxPoints);
  if (seen_all && !world.coarse_tables)
    points = std::max(points, static_cast<int>(std::ceil(needed)));
  const bool own_code =
      std::none_of(world.environment.begin(), world.environment.end(),
                   [](const ShaderNode* shader) { return shader->runs_code_of_users(); });
  std::vector<Cell> cells(side_ * side_);
  parallel_for(side_, [&](std::size_t y) {
    for (std::size_t x = 0; x < side_; ++x)
      cells[y * side_ + x] = cell(world, x, y, points, own_code);
  });
  luminances_.reserve(cells.size());
  Imath::V3d sum(0);  // double: a quarter of a million terms
  Rgb low = cells.front().low, high = cells.front().high;
  bool by_direction = true, usable = true;
  same_for_glossy_rays_ = own_code;
  for (const Cell& c : cells) {
    luminances_.push_back(c.luminance);
    by_direction &= c.by_direction;
    same_for_glossy_rays_ &= c.same_for_glossy_rays;
    usable &= c.usable;
    if (!c.usable) continue;
    sum += Imath::V3d(c.mean);
    for (int i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], c.low[i]);
      high[i] = std::max(high[i], c.high[i]);
    }
  }
  if (!own_code || !by_direction || !seen_all) return;
  const Rgb mean(Imath::V3f(sum / static_cast<double>(cells.size())));
  const auto similar = [&](const Rgb& from, const Rgb& to, const Rgb& own, float share,
                           float own_share) {
    for (int i = 0; i < 3; ++i)
      if (!(to[i] - from[i] <= std::max(share * mean[i], own_share * own[i]))) return false;
    return true;
  };
  if (usable && similar(low, high, Rgb(0), kRounding, 0)) {
    constant_ = mean;
    return;
  }
  cells_.reserve(cells.size());
  for (const Cell& c : cells) cells_.push_back(c.mean);
  const auto leave_out = [&](std::size_t x, std::size_t y) { cells_[y * side_ + x] = Rgb(-1); };
  for (std::size_t y = 0; y < side_; ++y)
    for (std::size_t x = 0; x < side_; ++x) {
      const Cell& c = cells[y * side_ + x];
      if (c.usable && similar(c.low, c.high, c.mean, kMaxContrast, kMaxOwnContrast)) continue;
      // With its neighbours, into which the edge of a lamp may reach between their points.
      for (std::size_t j = std::max<std::size_t>(y, 1) - 1; j <= std::min(y + 1, side_ - 1); ++j)
        for (std::size_t i = std::max<std::size_t>(x, 1) - 1; i <= std::min(x + 1, side_ - 1); ++i)
          leave_out(i, j);
    }
}

}  // namespace oriel
