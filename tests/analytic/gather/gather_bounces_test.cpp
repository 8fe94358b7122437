// SPDX-License-Identifier: Apache-2.0
// Placement of the records of further bounces.
#include "transport/gather/gather_bounces.h"

#include "base/parallel.h"
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

/// n x n points on the floor of a box from -1 to 1.
std::vector<GatherPoint> floor_points(const World& world, int n) {
  std::vector<GatherPoint> points;
  const auto at = [&](int i) {
    return (2 * static_cast<float>(i) + 1) / static_cast<float>(n) - 1;
  };
  for (int i = 0; i < n * n; ++i)
    points.push_back(floor_point(world, Vec3(at(i % n), at(i / n), -1)));
  return points;
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
  int in_rooms[2] = {0, 0};
  for (const GatherPoint& p : bounces.points) ++in_rooms[p.point.position.x > there.x / 2];
  EXPECT_GT(in_rooms[0], 20);
  EXPECT_GT(in_rooms[1], 20);
}

// Wide land around a room hardly changes the radii, while the scene is 400 times as large.
TEST(GatherBounces, RadiiFollowTheSpaceThatIsSeen) {
  const auto radii_of = [](bool land) {
    SceneText scene;
    scene.lambert("grey", .7f).box("grey", Vec3(-1), Vec3(1), true);
    if (land) scene.square("grey", Vec3(0, 0, -2), 500, kUp);
    const Probe probe(scene);
    GatherSettings settings = gather_settings({}, probe.world().accel->bounds());
    settings.path.diffuse_bounces = 1;
    settings.rays = 16;
    const std::vector<GatherPoint> seen = floor_points(probe.world(), 20);
    RayCounts counts;
    return gather_bounces(probe.world(), seen, settings, 1, counts, {}).query.radii;
  };
  const GatherRadii room = radii_of(false), on_land = radii_of(true);
  EXPECT_NEAR(on_land.min / room.min, 1, .3);
  EXPECT_NEAR(on_land.max / room.max, 1, .3);
  EXPECT_EQ(room.min, .02f * std::sqrt(12.0f)) << "the diagonal of the room";
}

TEST(GatherBounces, RecordsAreTheSameForAnyNumberOfThreads) {
  SceneText scene;
  scene.lambert("grey", .7f).box("grey", Vec3(-1), Vec3(1), true);
  scene.light("lamp", "\"physical_light\" ( \"color\" 10 10 10 ) origin 0 .3 .2");
  const Probe probe(scene);
  GatherSettings settings = gather_settings({}, probe.world().accel->bounds());
  settings.path.diffuse_bounces = PathSettings::kAllBounces;
  settings.rays = 32;
  std::vector<GatherPoint> seen;
  for (int i = 0; i < 300; ++i)
    seen.push_back(
        floor_point(probe.world(), Vec3(.06f * (i % 30) - .9f, .18f * (i / 30) - .9f, -1)));
  struct Result {
    std::vector<GatherRecord> records;
    RayCounts counts;
  };
  const auto gathered = [&](int threads) {
    const ThreadLimit limit(threads);
    Result result;
    result.records =
        gather_bounces(probe.world(), seen, settings, 1, result.counts, {}).cache.records();
    return result;
  };
  const Result one = gathered(1);
  EXPECT_GT(one.records.size(), 100u);
  EXPECT_GT(one.counts.gather, 32 * one.records.size());
  for (const int threads : {2, 3}) {
    const Result more = gathered(threads);
    EXPECT_EQ(more.counts.gather, one.counts.gather);
    EXPECT_EQ(more.counts.shadow, one.counts.shadow);
    ASSERT_EQ(more.records.size(), one.records.size());
    for (std::size_t i = 0; i < one.records.size(); ++i) {
      EXPECT_EQ(more.records[i].position, one.records[i].position) << i;
      EXPECT_EQ(more.records[i].irradiance, one.records[i].irradiance) << i;
    }
  }
}

/// Photons that give all walls of the box from -1 to 1 the same irradiance.
PhotonMap even_photons(float irradiance) {
  constexpr int kSide = 50;
  const float power = irradiance * 4 / (kSide * kSide);
  std::vector<Photon> photons;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f})
      for (int i = 0; i < kSide * kSide; ++i) {
        Photon p;
        p.position[axis] = side;
        p.position[(axis + 1) % 3] = (2.0f * (i % kSide) + 1) / kSide - 1;
        p.position[(axis + 2) % 3] = (2.0f * (i / kSide) + 1) / kSide - 1;
        p.normal = Vec3(0);
        p.normal[axis] = -side;
        p.direction = -p.normal;
        p.power = Rgb(power);
        photons.push_back(p);
      }
  return PhotonMap(std::move(photons));
}

// In a closed box of albedo a, where caustics bring an irradiance of 1 to all walls, other walls
// bring a + a^2 + ... = a / (1 - a).
TEST(GatherBounces, AllBouncesOfCausticsAreHeld) {
  constexpr float kAlbedo = .6f;
  SceneText scene;
  scene.lambert("grey", kAlbedo).box("grey", Vec3(-1), Vec3(1), true);
  const Probe probe(scene);
  const PhotonMap caustic = even_photons(1);
  IndirectCaches maps;
  maps.caustic = &caustic;
  maps.caustic_lookup = {.count = 20, .radius = .3f};
  GatherSettings settings = gather_settings({}, probe.world().accel->bounds());
  settings.path.diffuse_bounces = PathSettings::kAllBounces;
  settings.path.maps = &maps;
  settings.rays = 200;
  const std::vector<GatherPoint> seen = floor_points(probe.world(), 10);
  RayCounts counts;
  const Bounces bounces = gather_bounces(probe.world(), seen, settings, 1, counts, {});
  ASSERT_FALSE(bounces.cache.records().empty());
  double mean = 0;
  for (const GatherRecord& record : bounces.cache.records())
    mean += record.irradiance.y / static_cast<double>(bounces.cache.records().size());
  // Estimates at edges are too dark, and records at edges too few.
  EXPECT_NEAR(mean, kAlbedo / (1 - kAlbedo), .12);
}

// The same irradiance whether rays add what coarse records hold, or keep it as reads: on walls that
// are seen directly, in a mirror, through a translucent sheet, and by coloured light of two layers.
TEST(GatherBounces, KeptReadsGiveTheRecordAgain) {
  SceneText scene("trace depth 8 8 12 \"light group warm\" \"lamp_i\"");
  scene.lambert("grey", .7f)
      .material("red", "\"reflectivity\" 0, \"diffuse\" .7 .2 .1")
      .material("mirror", "\"reflectivity\" .8, \"refl_gloss\" 1, \"diffuse\" .1 .1 .1")
      .material("sheet",
                "\"reflectivity\" 0, \"diffuse\" .8 .8 .7, \"transparency\" .6, "
                "\"refr_translucency\" on, \"refr_trans_weight\" 1, \"refr_trans_color\" .9 .9 .8, "
                "\"thin_walled\" on")
      .box("grey", Vec3(-1), Vec3(1), true)
      .polygon("red",
               {Vec3(-.99f, -1, -1), Vec3(-.99f, 1, -1), Vec3(-.99f, 1, 1), Vec3(-.99f, -1, 1)})
      .polygon("mirror",
               {Vec3(.99f, -1, -1), Vec3(.99f, -1, 1), Vec3(.99f, 1, 1), Vec3(.99f, 1, -1)})
      .polygon("sheet", {Vec3(-.5f, .3f, -.9f), Vec3(.5f, .3f, -.9f), Vec3(.5f, .3f, .5f),
                         Vec3(-.5f, .3f, .5f)})
      .light("lamp", "\"physical_light\" ( \"color\" 10 8 6 ) origin 0 -.5 .8")
      .light("other", "\"physical_light\" ( \"color\" 1 2 4 ) origin .3 .6 .6");
  const Probe probe(scene);
  const World& world = probe.world();
  GatherSettings settings = gather_settings({}, world.accel->bounds());
  settings.path.diffuse_bounces = PathSettings::kAllBounces;
  settings.rays = 100;
  std::vector<GatherPoint> points;
  for (const float x : {-.8f, -.3f, .2f, .7f})
    for (const float y : {-.6f, .1f, .6f}) points.push_back(floor_point(world, Vec3(x, y, -1)));
  RayCounts counts;
  const Bounces bounces = gather_bounces(world, points, settings, 1, counts, {});
  IndirectCaches maps;
  maps.bounces = &bounces.cache;
  maps.bounces_query = bounces.query;
  maps.bounces_held = bounces.held;
  settings.path.maps = &maps;
  settings.rays = 4000;
  for (const GatherPoint& p : points) {
    const sampling::Sampler stream(1, 2, 3);
    const GatherRecord added = gather_at(world, p, settings, stream, counts);
    const GatherRays rays = trace_gather_rays(world, p, settings, stream, counts, true);
    EXPECT_TRUE(rays.complete);
    const GatherRecord again = gathered_record(world, p, settings, rays, &bounces.cache);
    const GatherRecord without = gathered_record(world, p, settings, rays);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(again.irradiance[c] / added.irradiance[c], 1, .02) << p.point.position.x;
      EXPECT_LT(without.irradiance[c], .8f * again.irradiance[c]) << "much of it was read";
    }
    ASSERT_EQ(again.shares.size(), added.shares.size());
    for (std::size_t k = 0; k < again.shares.size(); ++k)
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(again.shares[k][c], added.shares[k][c], .02f) << k;
  }
}

}  // namespace gather_bounces_test
}  // namespace oriel::testing
