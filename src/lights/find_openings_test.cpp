// SPDX-License-Identifier: Apache-2.0
#include "lights/find_openings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/frame.h"
#include "base/parallel.h"
#include "lights/environment_light.h"
#include "runtime/world.h"

namespace oriel {
namespace find_openings_test {

void white_sky(const Call&, void* result) { *static_cast<Rgba*>(result) = Rgba(1); }
const ShaderSpec kWhiteSky{.name = "white_sky", .library = "test", .value = white_sky};

/// A room of 4 x 5 x 3 around the origin, turned by `turn`, with a camera that looks along -y.
class Room {
 public:
  explicit Room(float turn = 0) : sine_(std::sin(turn)), cosine_(std::cos(turn)) {
    world_.accel = std::make_unique<geom::Accel>();
    world_.environment = {&sky_};
    world_.camera.aperture = 1.5f;
    // Camera x, y, -z are -x, z, -y of the room.
    const Vec3 x = turned({-1, 0, 0}), y = turned({0, 0, 1}), z = turned({0, 1, 0});
    const Vec3 at = turned({.3f, 2, .2f});
    world_.camera.to_world =
        Mat4(x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, at.x, at.y, at.z, 1);
    wall(2, -1.5f, 4, 5, {});
    wall(1, 2.5f, 4, 3, {});
  }
  Vec3 turned(const Vec3& p) const {
    return {cosine_ * p.x - sine_ * p.y, sine_ * p.x + cosine_ * p.y, p.z};
  }
  /// A rectangle perpendicular to an axis.
  void rectangle(int axis, float at, const Vec2& low, const Vec2& high,
                 std::uint32_t mask = geom::RayMask::All) {
    const int u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
    geom::Mesh mesh;
    for (int i = 0; i < 4; ++i) {
      Vec3 p(0);
      p[axis] = at;
      p[u] = i == 0 || i == 3 ? low.x : high.x;
      p[v] = i < 2 ? low.y : high.y;
      mesh.positions.push_back(turned(p));
    }
    mesh.positions.emplace_back();
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    world_.accel->add_instance({.mesh = world_.accel->add_mesh(std::move(mesh)), .mask = mask});
  }
  struct Hole {
    Vec2 low, high;
  };
  /// A wall around the axis, with a column of wall left and right of each hole.
  void wall(int axis, float at, float width, float height, std::vector<Hole> holes) {
    float left = -width / 2;
    for (const Hole& hole : holes) {
      rectangle(axis, at, {left, -height / 2}, {hole.low.x, height / 2});
      rectangle(axis, at, {hole.low.x, -height / 2}, {hole.high.x, hole.low.y});
      rectangle(axis, at, {hole.low.x, hole.high.y}, {hole.high.x, height / 2});
      left = hole.high.x;
    }
    rectangle(axis, at, {left, -height / 2}, {width / 2, height / 2});
  }
  Openings openings() {
    world_.accel->commit();
    return find_openings(world_, EnvironmentLight(world_));
  }
  World& world() { return world_; }

 private:
  World world_;
  const ShaderNode sky_{kWhiteSky};
  float sine_, cosine_;
};

const Room::Hole kWindow{{-1, -.5f}, {.5f, 1}}, kDoor{{1, -1.5f}, {1.8f, .8f}};

/// The remaining walls: left and right, ceiling, and the wall that the camera sees.
void close(Room& room, std::vector<Room::Hole> left, std::vector<Room::Hole> far = {}) {
  room.wall(0, -2, 5, 3, std::move(left));
  room.wall(0, 2, 5, 3, {});
  room.wall(2, 1.5f, 4, 5, {});
  room.wall(1, -2.5f, 4, 3, std::move(far));
}

/// The largest distance between a corner of the hole and the closest one of the rectangle.
float difference(const Room& room, const OpeningRectangle& r, int axis, float at,
                 const Room::Hole& hole) {
  float largest = 0;
  for (int i = 0; i < 4; ++i) {
    Vec3 p(0);
    p[axis] = at;
    p[axis == 0 ? 1 : 0] = i & 1 ? hole.high.x : hole.low.x;
    p[2] = i & 2 ? hole.high.y : hole.low.y;
    p = room.turned(p);
    float closest = 1e30f;
    for (const Vec3& c :
         {r.corner, r.corner + r.edge_u, r.corner + r.edge_v, r.corner + r.edge_u + r.edge_v})
      closest = std::min(closest, length(c - p));
    largest = std::max(largest, closest);
  }
  return largest;
}

TEST(FindOpenings, FindsAWindowAndADoorInARoomThatIsTurned) {
  for (const float turn : {0.0f, .6f}) {
    Room room(turn);
    close(room, {kWindow}, {kDoor});
    const Openings openings = room.openings();
    ASSERT_EQ(openings.rectangles().size(), 2u) << turn;
    for (const OpeningRectangle& r : openings.rectangles()) {
      const bool window = std::abs(dot(r.inward, room.turned({1, 0, 0}))) > .9f;
      EXPECT_LT(window ? difference(room, r, 0, -2, kWindow) : difference(room, r, 1, -2.5f, kDoor),
                .1f);
      EXPECT_GT(dot(r.inward, Vec3(0) - r.corner), 0) << "faces the room";
    }
  }
}

TEST(FindOpenings, PanesAreIgnored) {
  Room room;
  close(room, {kWindow});
  room.rectangle(0, -2.05f, kWindow.low, kWindow.high, geom::RayMask::ShadowTransparent);
  const Openings openings = room.openings();
  ASSERT_EQ(openings.rectangles().size(), 1u);
  EXPECT_LT(difference(room, openings.rectangles()[0], 0, -2, kWindow), .1f);
}

TEST(FindOpenings, ThereAreNoneWithPortalsInClosedRoomsAndOutdoors) {
  Room closed;
  close(closed, {});
  EXPECT_TRUE(closed.openings().empty());
  EXPECT_TRUE(Room().openings().empty()) << "two walls alone";
  Room with_portal;
  close(with_portal, {kWindow});
  Light& light = with_portal.world().lights.emplace_back();
  light.portal = std::make_unique<Portal>();
  EXPECT_TRUE(with_portal.openings().empty());
}

// Small pictures have fewer rays.
TEST(FindOpenings, SmallPicturesFindTheSameOpenings) {
  Room room;
  room.world().camera.width = 60;
  room.world().camera.height = 40;
  close(room, {kWindow}, {kDoor});
  const Openings openings = room.openings();
  ASSERT_EQ(openings.rectangles().size(), 2u);
  for (const OpeningRectangle& r : openings.rectangles())
    EXPECT_LT(std::abs(r.inward.x) > .9f ? difference(room, r, 0, -2, kWindow)
                                         : difference(room, r, 1, -2.5f, kDoor),
              .2f);
}

TEST(FindOpenings, AreTheSameForAnyNumberOfThreads) {
  const auto corner = [](int threads) {
    const ThreadLimit limit(threads);
    Room room;
    close(room, {kWindow}, {kDoor});
    return room.openings().rectangles().at(0).corner;
  };
  EXPECT_EQ(corner(1), corner(3));
}

}  // namespace find_openings_test
}  // namespace oriel
