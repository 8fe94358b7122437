// SPDX-License-Identifier: Apache-2.0
// Planes of a room and the openings in them. Private to find_openings.cpp.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "geom/mesh.h"
#include "lights/openings.h"

namespace oriel {

/// A ray from a surface of a room to what it hits.
struct RoomRay {
  Vec3 from{0}, direction{0};
  Vec3 normal{0};  ///< unit, of the surface that it hits
  float t = 0;     ///< infinite: it reaches the environment
  bool escapes() const { return std::isinf(t); }
  Vec3 end() const { return from + direction * t; }
};

struct RoomPlane {
  Vec3 normal{0};
  float offset = 0;
  int hits = 0;
};

/// Planes of many hits, most hits first, and the planes of the box around all hits.
std::vector<RoomPlane> room_planes(const std::vector<RoomRay>& rays, const geom::Box3& box);

/// A rectangle on a plane, in its coordinates.
struct OpeningCandidate {
  Vec2 low{0}, high{0};
  int rays = 0;
  float score = 0;  ///< rays times rays per area
  bool holds(const Vec2& at) const {
    return at.x >= low.x && at.x <= high.x && at.y >= low.y && at.y <= high.y;
  }
};

/// A plane with a grid of cells over the extent of the room. `side`: 1 for rays along the normal of
/// the plane, -1 for rays against it.
class OpeningPlane {
 public:
  /// Inputs:  planes: of the room; edges of openings are parallel to one of them.
  OpeningPlane(const RoomPlane& plane, const std::vector<RoomPlane>& planes, const geom::Box3& box);

  /// The point where a ray crosses the plane.
  std::optional<Vec2> crossing(const RoomRay& ray, float side) const;
  /// Whether the ray ends at a surface in the plane.
  bool ends_at(const RoomRay& ray) const;
  Vec2 coordinates(const Vec3& p) const { return Vec2(dot(p, u_), dot(p, v_)); }

  /// The component of cells with the highest score; score 0 if there is none.
  OpeningCandidate best(const std::vector<RoomRay>& rays,
                        const std::vector<std::uint32_t>& escaping, float side) const;
  /// Share of the rays to the candidate, or to a surface in it, that reach the environment.
  float clear_share(const OpeningCandidate& c, float side, const std::vector<RoomRay>& rays) const;
  OpeningRectangle rectangle(const OpeningCandidate& c, float side) const;

 private:
  int cell_of(const Vec2& at) const;

  RoomPlane plane_;
  Vec3 u_, v_;
  Vec2 low_, size_;
  float tolerance_;
};

}  // namespace oriel
