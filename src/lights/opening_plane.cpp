// SPDX-License-Identifier: Apache-2.0
#include "lights/opening_plane.h"

#include <algorithm>
#include <array>

#include "base/frame.h"

namespace oriel {
namespace {

/// Planes are the same within 2 degrees and this share of the size of the room.
constexpr float kSameNormal = 0.9994f, kSameOffset = 0.01f;
/// Hits that are assigned to planes, planes that they may found, and planes that are returned.
constexpr std::size_t kHitsForPlanes = 4096, kMaxPlanes = 256, kPlanesTried = 24;
/// Walls are perpendicular if the cosine is smaller.
constexpr float kPerpendicular = 0.05f;
/// Cells of a plane along each side.
constexpr int kCells = 64;
/// Share of the cells of a rectangle that are open, at least.
constexpr float kMinFill = 0.6f;

using Cells = std::array<int, std::size_t{kCells} * kCells>;

/// Labels the component of open cells (0) around `first`. Returns their number.
int label_component(Cells& cells, int first, int label) {
  std::vector<int> waiting{first};
  cells[static_cast<std::size_t>(first)] = label;
  int count = 0;
  while (!waiting.empty()) {
    const int at = waiting.back(), x = at % kCells, y = at / kCells;
    waiting.pop_back();
    ++count;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, kCells - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, kCells - 1); ++u) {
        int& next = cells[static_cast<std::size_t>(v) * kCells + static_cast<std::size_t>(u)];
        if (next != 0) continue;
        next = label;
        waiting.push_back(v * kCells + u);
      }
  }
  return count;
}

}  // namespace

std::vector<RoomPlane> room_planes(const std::vector<RoomRay>& rays, const geom::Box3& box) {
  const float tolerance = kSameOffset * length(box.size());
  const std::size_t step = std::max<std::size_t>(1, rays.size() / kHitsForPlanes);
  std::vector<RoomPlane> found;
  for (std::size_t i = 0; i < rays.size(); i += step) {
    const RoomRay& ray = rays[i];
    if (ray.escapes()) continue;
    const Vec3 end = ray.end();
    const auto same = [&](const RoomPlane& p) {
      return std::abs(dot(p.normal, ray.normal)) > kSameNormal &&
             std::abs(dot(p.normal, end) - p.offset) < tolerance;
    };
    const auto p = std::find_if(found.begin(), found.end(), same);
    if (p != found.end())
      ++p->hits;
    else if (found.size() < kMaxPlanes)
      found.push_back({ray.normal, dot(ray.normal, end), 1});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const RoomPlane& a, const RoomPlane& b) { return a.hits > b.hits; });
  found.resize(std::min(found.size(), kPlanesTried));
  for (int axis = 0; axis < 3; ++axis)
    for (const Vec3 corner : {Vec3(box.min), Vec3(box.max)}) {
      Vec3 normal(0);
      normal[axis] = 1;
      found.push_back({normal, corner[axis], 0});
    }
  return found;
}

OpeningPlane::OpeningPlane(const RoomPlane& plane, const std::vector<RoomPlane>& planes,
                           const geom::Box3& box)
    : plane_(plane), tolerance_(kSameOffset * length(box.size())) {
  const auto wall = std::find_if(planes.begin(), planes.end(), [&](const RoomPlane& p) {
    return std::abs(dot(p.normal, plane.normal)) < kPerpendicular;
  });
  v_ = wall == planes.end()
           ? Frame(plane.normal).s
           : normalize(wall->normal - plane.normal * dot(wall->normal, plane.normal));
  u_ = cross(v_, plane.normal);
  low_ = coordinates(box.min);
  Vec2 high = low_;
  for (int i = 1; i < 8; ++i) {
    const Vec2 at = coordinates(Vec3(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                                     i & 4 ? box.max.z : box.min.z));
    low_ = Vec2(std::min(low_.x, at.x), std::min(low_.y, at.y));
    high = Vec2(std::max(high.x, at.x), std::max(high.y, at.y));
  }
  size_ = Vec2(std::max(high.x - low_.x, tolerance_), std::max(high.y - low_.y, tolerance_));
}

std::optional<Vec2> OpeningPlane::crossing(const RoomRay& ray, float side) const {
  const float speed = dot(ray.direction, plane_.normal) * side;
  const float height = (plane_.offset - dot(ray.from, plane_.normal)) * side;
  if (!(speed > 1e-4f) || !(height > 0) || !(height < ray.t * speed)) return std::nullopt;
  return coordinates(ray.from + ray.direction * (height / speed));
}

bool OpeningPlane::ends_at(const RoomRay& ray) const {
  return !ray.escapes() && std::abs(dot(ray.end(), plane_.normal) - plane_.offset) < tolerance_;
}

int OpeningPlane::cell_of(const Vec2& at) const {
  const int x = static_cast<int>(std::floor((at.x - low_.x) / size_.x * kCells));
  const int y = static_cast<int>(std::floor((at.y - low_.y) / size_.y * kCells));
  return x < 0 || y < 0 || x >= kCells || y >= kCells ? -1 : y * kCells + x;
}

OpeningCandidate OpeningPlane::best(const std::vector<RoomRay>& rays,
                                    const std::vector<std::uint32_t>& escaping, float side) const {
  struct Crossing {
    Vec2 at;
    std::size_t cell;
  };
  std::vector<Crossing> crossings;
  Cells label;
  label.fill(-1);
  for (const std::uint32_t i : escaping) {
    const auto at = crossing(rays[i], side);
    const int cell = at ? cell_of(*at) : -1;
    if (cell < 0) continue;
    crossings.push_back({*at, static_cast<std::size_t>(cell)});
    label[crossings.back().cell] = 0;
  }
  std::vector<OpeningCandidate> found;
  std::vector<int> cells;
  for (int i = 0; i < kCells * kCells; ++i) {
    if (label[static_cast<std::size_t>(i)] != 0) continue;
    found.push_back({Vec2(1e30f), Vec2(-1e30f), 0, 0});
    cells.push_back(label_component(label, i, static_cast<int>(found.size())));
  }
  for (const auto& [at, cell] : crossings) {
    OpeningCandidate& c = found[static_cast<std::size_t>(label[cell] - 1)];
    c.low = Vec2(std::min(c.low.x, at.x), std::min(c.low.y, at.y));
    c.high = Vec2(std::max(c.high.x, at.x), std::max(c.high.y, at.y));
    ++c.rays;
  }
  OpeningCandidate best;
  for (std::size_t i = 0; i < found.size(); ++i) {
    OpeningCandidate& c = found[i];
    const Vec2 extent = c.high - c.low;
    const float columns = std::floor(extent.x / size_.x * kCells) + 1,
                rows = std::floor(extent.y / size_.y * kCells) + 1;
    if (static_cast<float>(cells[i]) < kMinFill * columns * rows) continue;
    const float area = std::max(extent.x, tolerance_) * std::max(extent.y, tolerance_);
    c.score = static_cast<float>(c.rays) * static_cast<float>(c.rays) / area;
    if (c.score > best.score) best = c;
  }
  return best;
}

float OpeningPlane::clear_share(const OpeningCandidate& c, float side,
                                const std::vector<RoomRay>& rays) const {
  int clear = 0, all = 0;
  for (const RoomRay& ray : rays) {
    const auto at = crossing(ray, side);
    const bool through = at && c.holds(*at);
    if (!through && !(ends_at(ray) && c.holds(coordinates(ray.end())))) continue;
    ++all;
    clear += through && ray.escapes();
  }
  return all == 0 ? 0 : static_cast<float>(clear) / static_cast<float>(all);
}

OpeningRectangle OpeningPlane::rectangle(const OpeningCandidate& c, float side) const {
  const Vec3 on_plane = plane_.normal * plane_.offset;
  return {on_plane + u_ * c.low.x + v_ * c.low.y, u_ * (c.high.x - c.low.x),
          v_ * (c.high.y - c.low.y), plane_.normal * -side};
}

}  // namespace oriel
