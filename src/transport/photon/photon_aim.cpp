// SPDX-License-Identifier: Apache-2.0
#include "transport/photon/photon_aim.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.h"

namespace oriel {
namespace {

/// Cells along each side of the square.
constexpr std::uint32_t kSide = 128;

/// The lower corner of a cell, in cells.
Vec2 corner_of(std::uint32_t cell) {
  const std::uint32_t x = cell % kSide, y = cell / kSide;
  return Vec2(static_cast<float>(x), static_cast<float>(y));
}

/// With more spheres the lines are not tested.
constexpr std::size_t kMostSpheres = 256;
/// Share of the square from which on all of it is used.
constexpr float kWorthAiming = 0.7f;
/// Places in the unit square that stand for all of it.
constexpr Vec2 kCorners[] = {
    {0.5f, 0.5f}, {0, 0}, {0.99999f, 0}, {0, 0.99999f}, {0.99999f, 0.99999f}};

struct Line {
  Vec3 origin{0}, direction{0};
  Vec3 at(float t) const { return origin + direction * t; }
};

}  // namespace

PhotonAim::PhotonAim(const PhotonSource& source, const std::vector<SharpCaustics::Sphere>& spheres)
    : by_place_(source.is_endless()) {
  if (spheres.size() > kMostSpheres || !source.can_be_aimed()) return;
  const auto line = [&](const Vec2& chosen, const Vec2& other) {
    const EmittedPhoton photon =
        by_place_ ? source.emit(chosen, other) : source.emit(other, chosen);
    return Line{photon.origin, photon.direction};
  };
  using Lines = std::array<Line, std::size(kCorners)>;
  const auto meets = [&](std::uint32_t cell) {
    const Vec2 low = corner_of(cell);
    // By the cell's middle and corners, and by the other random numbers.
    Lines of_cell, beside;
    for (std::size_t k = 0; k < std::size(kCorners); ++k) {
      of_cell[k] = line((low + kCorners[k]) / static_cast<float>(kSide), kCorners[0]);
      beside[k] = line((low + kCorners[0]) / static_cast<float>(kSide), kCorners[k]);
    }
    const Line& middle = of_cell[0];
    for (const SharpCaustics::Sphere& sphere : spheres) {
      const auto most_aside = [&](const Lines& lines, float t) {
        float most = 0;
        for (const Line& l : lines) most = std::max(most, length(l.at(t) - middle.at(t)));
        return most;
      };
      // The light itself may be in the sphere.
      const float from = std::max(dot(sphere.centre - middle.origin, middle.direction), 0.0f);
      const float distance = length(middle.at(from) - sphere.centre) - sphere.radius;
      if (distance <= most_aside(of_cell, from) + most_aside(beside, from + sphere.radius))
        return true;
    }
    return false;
  };
  std::vector<std::uint8_t> used(std::size_t{kSide} * kSide);
  parallel_for(kSide, [&](std::size_t row) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      const std::uint32_t cell = static_cast<std::uint32_t>(row) * kSide + x;
      used[cell] = meets(cell);
    }
  });
  for (std::uint32_t cell = 0; cell < used.size(); ++cell)
    if (used[cell]) cells_.push_back(cell);
  share_ = static_cast<float>(cells_.size()) / static_cast<float>(used.size());
  if (share_ > kWorthAiming) *this = PhotonAim();
}

void PhotonAim::aim(Vec2& u_place, Vec2& u_direction) const {
  if (cells_.empty()) return;
  Vec2& u = by_place_ ? u_place : u_direction;
  const float scaled = u.x * static_cast<float>(cells_.size());
  const auto index = std::min(static_cast<std::size_t>(scaled), cells_.size() - 1);
  const float rest = std::min(scaled - static_cast<float>(index), 0.99999994f);
  u = (corner_of(cells_[index]) + Vec2(rest, u.y)) / static_cast<float>(kSide);
}

}  // namespace oriel
