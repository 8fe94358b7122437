// SPDX-License-Identifier: Apache-2.0
// Placement of the records of further bounces.
#include "transport/gather/gather_bounces.h"

#include "support/probe.h"
#include "transport/indirect_caches.h"

namespace oriel::testing {
namespace gather_bounces_test {

/// A point in the middle of the floor of a box.
GatherPoint floor_point(const World& world, const Vec3& place) {
  GatherPoint p;
  p.point.world = &world;
  p.point.position = place;
  p.point.normal = p.point.geometric_normal = p.normal = Vec3(0, 0, 1);
  return p;
}

// Two closed rooms: no ray leads from one to the other.
TEST(GatherBounces, VisibleRoomsHaveRecordsForAnyPointCount) {
  SceneText scene;
  const Vec3 there(20, 0, 0);
  scene.lambert("grey", .5f);
  scene.box("grey", Vec3(-1), Vec3(1), true).box("grey", there - Vec3(1), there + Vec3(1), true);
  scene.light("lamp", "\"physical_light\" ( \"color\" 10 10 10 ) origin 0 0 0");
  const Probe probe(scene);
  GatherSettings settings = gather_settings({}, probe.world().accel->bounds());
  settings.path.diffuse_bounces = 1;
  settings.rays = 16;
  const GatherPoint here = floor_point(probe.world(), Vec3(0, 0, -1));
  const GatherPoint other = floor_point(probe.world(), there - Vec3(0, 0, 1));
  std::vector<GatherPoint> seen(4000, here);
  seen.insert(seen.end(), 1000, other);
  RayCounts counts;
  const Bounces bounces = gather_bounces(probe.world(), seen, settings, 1, counts, {});
  EXPECT_EQ(bounces.held, 1);
  for (const GatherPoint& p : {here, other})
    EXPECT_TRUE(bounces.cache.interpolate(query_at(bounces.query, p.point, p.normal)))
        << p.point.position.x;
}

}  // namespace gather_bounces_test
}  // namespace oriel::testing
