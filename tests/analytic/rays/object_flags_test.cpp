// SPDX-License-Identifier: Apache-2.0
// Object flags: rays that objects emit, and photons at objects.
#include "support/probe.h"
#include "transport/gather/gather_points.h"
#include "transport/photon/photon_trace.h"

namespace oriel::testing {
namespace object_flags_test {

/// A square of side 2 `half` at height z, its front up, with flags of its instance.
SceneText& add_plate(SceneText& scene, const std::string& material, float z, float half,
                     const std::string& flags) {
  return scene.polygon(
      material,
      {Vec3(-half, -half, z), Vec3(half, -half, z), Vec3(half, half, z), Vec3(-half, half, z)},
      flags);
}
/// A box that looks inside, with flags.
SceneText& add_room(SceneText& scene, const std::string& material, float half,
                    const std::string& flags) {
  std::vector<Vec3> p;
  p.reserve(8);
  for (int i = 0; i < 8; ++i)
    p.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  return scene.mesh(
      material, p,
      {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}, {},
      flags);
}

const char* const kMirror =
    "\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" 1, "
    "\"brdf_90_degree_refl\" 1, \"brdf_fresnel\" off";
const char* const kGrey = "\"reflectivity\" 0, \"diffuse\" .6 .6 .6";
/// Glass that does not bend, as far as rays are concerned.
const char* const kGel =
    "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"refr_ior\" 1";

/// Radiance of a plate from above, in uniform light of 1 from above and .5 from below.
Measured seen(const std::string& material, const std::string& flags, bool sun = false) {
  SceneText scene;
  scene.environment("\"test_sky\" ( \"above\" 1 1 1, \"below\" .5 .5 .5, \"up\" 0 0 1 )");
  scene.material("m", material);
  add_plate(scene, "m", 0, 50, flags);
  if (sun) scene.light("sun", "\"mib_light_infinite\" ( \"color\" .25 .25 .25 ) direction 0 0 -1");
  return Probe(scene).onto(Vec3(0), kUp, 20, 4096);
}

TEST(ObjectFlags, WithoutSendingReflectionRaysAnObjectShowsNone) {
  for (const char* gloss : {"", ", \"refl_gloss\" .5"}) {
    const std::string mirror = std::string(kMirror) + gloss;
    // Of a glossy lobe some is lost below the horizon and between facets.
    EXPECT_GT(seen(mirror, "").mean.x, .9f) << gloss;
    expect_exact("no reflection sent", seen(mirror, "reflection 8"), 0);
    EXPECT_GT(seen(mirror, "refraction 8 transparency 8 finalgather 8").mean.x, .9f) << gloss;
  }
}

TEST(ObjectFlags, WithoutSendingRefractionOrTransparencyRaysItIsBlackBehind) {
  const std::string solid = kGel, thin = solid + ", \"thin_walled\" on";
  expect_exact("solid", seen(solid, ""), .5f);
  expect_exact("solid, no refraction sent", seen(solid, "refraction 8"), 0);
  expect_exact("solid, no transparency sent", seen(solid, "transparency 8"), .5f);
  expect_exact("thin", seen(thin, ""), .5f);
  expect_exact("thin, no refraction sent", seen(thin, "refraction 8"), .5f);
  expect_exact("thin, no transparency sent", seen(thin, "transparency 8"), 0);
}

TEST(ObjectFlags, WithoutSendingGatherRaysAnObjectHasDirectLightAlone) {
  expect_exact("sky and sun", seen(kGrey, "", true), .6f * 1.25f);
  expect_exact("sun alone", seen(kGrey, "finalgather 8", true), .6f * .25f);
  expect_exact("all of it", seen(kGrey, "reflection 8 refraction 8", true), .6f * 1.25f);
}

TEST(ObjectFlags, ObjectsInvisibleToRaysAreNotHit) {
  // An emissive plate over another one.
  const auto below = [](const std::string& material, const std::string& flags) {
    SceneText scene;
    scene.uniform_sky(1).emitter("glow", 4).material("m", material);
    add_plate(scene, "m", 0, .5f, "");
    add_plate(scene, "glow", 1, 1000, flags);
    return Probe(scene).onto(Vec3(0), kUp, 20, 4096);
  };
  EXPECT_NEAR(below(kMirror, "").mean.x, 4, 1e-4);
  EXPECT_NEAR(below(kMirror, "reflection 4 shadow 4").mean.x, 1, 1e-4);
  EXPECT_NEAR(below(kMirror, "finalgather 4").mean.x, 4, 1e-4);
  EXPECT_NEAR(below(kGrey, "").mean.x, .6f * 4, .01f);
  EXPECT_NEAR(below(kGrey, "reflection 4").mean.x, .6f * 4, .01f);
  EXPECT_NEAR(below(kGrey, "finalgather 4 shadow 4").mean.x, .6f, .01f);
}

const char* const kGlossy =
    "\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" 1, \"refl_gloss\" .3";
/// Seen by no rays but those of shadows.
const char* const kUnseen = "reflection 4 refraction 4 transparency 4 finalgather 4";

/// A plate below a black plate with flags, or none, lit from above.
Measured below_black(const std::string& material, const std::string& flags, bool sky) {
  SceneText scene;
  scene.material("m", material).lambert("black", 0);
  add_plate(scene, "m", 0, 50, "");
  if (!flags.empty()) add_plate(scene, "black", .9f, 4, flags);
  if (sky)
    scene.uniform_sky(1);
  else
    scene.light("lamp",
                "\"physical_light\" ( \"color\" 4 4 4 ) origin 0 0 1 "
                "direction 0 0 -1 rectangle 2 0 0 0 2 0");
  return Probe(scene).onto(Vec3(0), kUp, 20, 1 << 15);
}

// acceptance: H3
TEST(ObjectFlags, LightPassesObjectsThatCastNoShadow) {
  for (const char* material : {kGlossy, kGrey}) {
    const Measured open = below_black(material, "", false);
    EXPECT_GT(open.mean.x, .05f) << material;
    expect_same(material, below_black(material, "shadow 4", false), open);
    // The environment is no light: rays see the plate in its place.
    const Measured under = below_black(material, "shadow 4", true);
    EXPECT_LT(under.mean.x, .1f * below_black(material, "", true).mean.x) << material;
  }
}

// acceptance: H3
TEST(ObjectFlags, ObjectsInvisibleToRaysCastFullShadows) {
  for (const char* material : {kGlossy, kGrey}) {
    expect_exact(material, below_black(material, kUnseen, false), 0);
    expect_same(material, below_black(material, kUnseen, true), below_black(material, "", true));
  }
}

struct Traced {
  PhotonMaps maps;
  PhotonBalance balance;
  double flux() const { return balance.emitted.y; }
};
double power_of(const PhotonMap& map) {
  double sum = 0;
  for (const Photon& p : map.photons()) sum += p.power.y;
  return sum;
}
/// A light in a cell of tinted refracting sheets, or of nothing, in a room of albedo 1/2.
struct Room {
  std::string options, cell_flags, room_flags;
  bool cell = false;
};
SceneText text_of(const Room& r) {
  SceneText scene("trace depth 8 8 12 shadow on caustic on " + r.options);
  scene.lambert("grey", .5f).material("gel", std::string(kGel) + ", \"do_refractive_caustics\" on");
  add_room(scene, "grey", 2, r.room_flags);
  if (r.cell) add_room(scene, "gel", 1, r.cell_flags);
  return scene.light("lamp", "\"physical_light\" ( \"color\" 10 10 10 ) origin .3 .2 .1");
}
Traced trace(const Room& room, bool global, bool caustic) {
  PhotonSettings settings{.globillum = global, .caustics = caustic, .depth = {200, 200, 200}};
  if (global) settings.each.global.emit = 1 << 16;
  if (caustic) settings.each.caustic.emit = 1 << 16;
  Traced t;
  RayCounts counts;
  t.maps = trace_photons(Probe(text_of(room)).world(), settings, counts, &t.balance);
  return t;
}

// acceptance: H3
TEST(ObjectFlags, GlobalPhotonsFollowTheFlagsOfEachObject) {
  // Albedo 1/2: direct light is in no map, and as much falls in again from the walls.
  const Traced usual = trace({}, true, false);
  EXPECT_NEAR(power_of(usual.maps.global), usual.flux(), .02 * usual.flux());
  const Traced excluded = trace({.room_flags = "globillum off"}, true, false);
  EXPECT_TRUE(excluded.maps.global.empty());
  EXPECT_NEAR(excluded.balance.escaped.y, excluded.flux(), 1e-3 * excluded.flux());
  const Traced casts_none = trace({.room_flags = "globillum 4"}, true, false);
  EXPECT_TRUE(casts_none.maps.global.empty());
  EXPECT_NEAR(casts_none.balance.stopped.y, .5 * casts_none.flux(), .02 * casts_none.flux());
  const Traced receives_none = trace({.room_flags = "globillum 8"}, true, false);
  EXPECT_TRUE(receives_none.maps.global.empty());
  EXPECT_NEAR(receives_none.balance.absorbed.y, receives_none.flux(), 1e-3 * usual.flux());
  // Those of the other kind change nothing.
  const Traced other = trace({.room_flags = "caustic off caustic 12"}, true, false);
  EXPECT_EQ(power_of(other.maps.global), power_of(usual.maps.global));
}

// acceptance: H3
TEST(ObjectFlags, CausticPhotonsFollowTheFlagsOfEachObject) {
  // All light reaches the room refracted, half of it is absorbed there.
  const Traced usual = trace({.cell = true}, false, true);
  EXPECT_NEAR(power_of(usual.maps.caustic), usual.flux(), .01 * usual.flux());
  const Traced excluded = trace({.cell_flags = "caustic off", .cell = true}, false, true);
  EXPECT_TRUE(excluded.maps.caustic.empty());
  EXPECT_NEAR(excluded.balance.absorbed.y, .5 * excluded.flux(), .02 * excluded.flux());
  const Traced casts_none = trace({.cell_flags = "caustic 4", .cell = true}, false, true);
  EXPECT_TRUE(casts_none.maps.caustic.empty());
  EXPECT_NEAR(casts_none.balance.stopped.y, casts_none.flux(), 1e-3 * casts_none.flux());
  const Traced receives_none = trace({.room_flags = "caustic 8", .cell = true}, false, true);
  EXPECT_TRUE(receives_none.maps.caustic.empty());
  EXPECT_NEAR(receives_none.balance.absorbed.y, .5 * usual.flux(), .02 * usual.flux());
  const Traced other = trace(
      {.cell_flags = "globillum off", .room_flags = "globillum 12", .cell = true}, false, true);
  EXPECT_EQ(power_of(other.maps.caustic), power_of(usual.maps.caustic));
}

// acceptance: H3
TEST(ObjectFlags, EachMapFollowsItsOwnFlagsWhereBothAreMade) {
  const struct {
    Room room;
    double global, caustic;  // shares of the flux
  } kCases[] = {
      {{.cell = true}, 1, 1},
      {{.cell_flags = "caustic off", .cell = true}, 1, 0},
      {{.cell_flags = "caustic 4", .cell = true}, 1, 0},
      {{.cell_flags = "globillum off", .cell = true}, 1, 1},
      {{.cell_flags = "globillum 4", .cell = true}, 0, 1},
      {{.room_flags = "globillum 8", .cell = true}, 0, 1},
      {{.room_flags = "caustic 8", .cell = true}, 1, 0},
  };
  for (const auto& c : kCases) {
    const Traced t = trace(c.room, true, true);
    const std::string name = c.room.cell_flags + ", " + c.room.room_flags;
    EXPECT_NEAR(power_of(t.maps.global) / t.flux(), c.global, .02) << name;
    EXPECT_NEAR(power_of(t.maps.caustic) / t.flux(), c.caustic, .01) << name;
  }
}

TEST(ObjectFlags, OptionsApplyToObjectsWithoutFlags) {
  EXPECT_TRUE(trace({.options = "globillum 8"}, true, false).maps.global.empty());
  EXPECT_TRUE(trace({.options = "globillum 4"}, true, false).maps.global.empty());
  EXPECT_FALSE(trace({.options = "globillum 3"}, true, false).maps.global.empty());
  EXPECT_FALSE(trace({.options = "caustic 12"}, true, false).maps.global.empty());
  EXPECT_FALSE(trace({.options = "globillum 12", .room_flags = "globillum 3"}, true, false)
                   .maps.global.empty());
  EXPECT_TRUE(trace({.options = "caustic 8", .cell = true}, false, true).maps.caustic.empty());
  EXPECT_FALSE(trace({.options = "caustic 8", .room_flags = "caustic 2", .cell = true}, false, true)
                   .maps.caustic.empty());
}

/// Onto a wall of the room.
Rgb wall(const Room& room, const IndirectCaches& maps) {
  const Probe probe(text_of(room));
  sampling::Sampler sampler(0, 0, 0);
  RayCounts counts;
  const Camera::Ray eye{Vec3(0, 0, -1.9f), Vec3(0, 0, -1), 1, 0, 0};
  PathSettings settings{.maps = &maps};
  const Rgb all = trace_path(probe.world(), eye, Vec2(0), settings, sampler, counts).radiance;
  settings.maps = nullptr;
  settings.indirect = false;
  return all - trace_path(probe.world(), eye, Vec2(0), settings, sampler, counts).radiance;
}

TEST(ObjectFlags, MapsAreReadWhereObjectsReceive) {
  const Traced t = trace({.cell = true}, true, true);
  IndirectCaches global;
  global.global = &t.maps.global;
  global.global_lookup = {.count = 500, .radius = .5f};
  const Rgb from_global = wall({}, global);
  EXPECT_GT(from_global.x, 0);
  EXPECT_EQ(wall({.room_flags = "globillum 8"}, global), Rgb(0));
  EXPECT_EQ(wall({.room_flags = "globillum 4 caustic 12 finalgather 8"}, global), from_global);
  IndirectCaches caustic;
  caustic.caustic = &t.maps.caustic;
  caustic.caustic_lookup = {.count = 500, .radius = .5f};
  // Without gather rays nothing comes beside the map.
  const Rgb from_caustic = wall({.room_flags = "finalgather 8"}, caustic);
  EXPECT_GT(from_caustic.x, 0);
  EXPECT_EQ(wall({.room_flags = "finalgather 8 caustic 8"}, caustic), Rgb(0));
  EXPECT_EQ(wall({.room_flags = "finalgather 8 globillum 12"}, caustic), from_caustic);
}

TEST(ObjectFlags, WithoutSendingGatherRaysNothingIsGatheredOrReadAtAnObject) {
  const auto points_of = [](const Probe& probe) {
    std::vector<GatherPoint> points;
    sampling::Sampler sampler(0, 0, 0);
    RayCounts counts;
    visit_gather_points(probe.world(), Vec2(16, 16), {}, sampler, counts, points);
    return points;
  };
  const Probe usual(text_of({})), silent(text_of({.room_flags = "finalgather 8"}));
  const auto points = points_of(usual);
  ASSERT_EQ(points.size(), 1u);
  EXPECT_TRUE(points_of(silent).empty());

  RayCounts counts;
  const geom::Box3 box = usual.world().accel->bounds();
  const GatherSettings settings = gather_settings(usual.world().options, box);
  GatherCache cache;
  const GatherRecord record = gather_at(usual.world(), points[0], settings, {0, 0, 0}, counts);
  cache.insert({&record, 1});
  IndirectCaches maps;
  maps.gather = &cache;
  maps.query = gather_query(usual.world().options.finalgather, settings.radii);
  EXPECT_GT(wall({}, maps).x, 0);
  EXPECT_EQ(wall({.room_flags = "finalgather 8"}, maps), Rgb(0));
}

}  // namespace object_flags_test
}  // namespace oriel::testing
