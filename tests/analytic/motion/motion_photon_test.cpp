// SPDX-License-Identifier: Apache-2.0
// Photons of moving lights and on moving objects: the map is the mean over the shutter, and agrees
// with path tracing within 4 standard errors (one failure in 16000 by chance).
#include "base/parallel.h"
#include "motion_scenes.h"
#include "transport/indirect_caches.h"
#include "transport/photon/photon_trace.h"

namespace oriel::testing {
namespace motion_photon_test {

constexpr const char* kOptions =
    "trace depth 8 8 12 shadow segments caustic on motion steps 6 shutter 1";

struct Irradiance {
  double mean = 0, error = 0;
};
Irradiance spread(const std::vector<double>& each) {
  Irradiance e;
  const auto n = static_cast<double>(each.size());
  for (const double x : each) e.mean += x / n;
  for (const double x : each) e.error += (x - e.mean) * (x - e.mean);
  e.error = std::sqrt(e.error / (n - 1) / n);
  return e;
}

/// A square of side 2 `half` on a horizontal floor, which may go somewhere.
struct Place {
  Vec3 centre;
  float half, albedo;
  Vec3 way{0};
};

/// Its mean irradiance by all light but the direct, from paths at all times.
Irradiance by_paths(const Probe& probe, const Place& place, std::uint32_t samples,
                    const PathSettings& settings = {}) {
  constexpr int kGroups = 32;
  std::vector<double> means(kGroups);
  parallel_for(kGroups, [&](std::size_t g) {
    RayCounts counts;
    for (std::uint32_t i = 0; i < samples / kGroups; ++i) {
      sampling::Sampler sampler(static_cast<int>(g), 11, i);
      const float time = probe.world().shutter.at(sampler.next_1d());
      const Vec2 at = (sampler.next_2d() * 2 - Vec2(1)) * place.half;
      const Vec3 centre = place.centre + place.way * time;
      const Camera::Ray eye{centre + Vec3(at.x, at.y, .01f), -kUp, 1, 0, 0, time};
      sampling::Sampler other = sampler;
      const Rgb all = trace_path(probe.world(), eye, Vec2(0), settings, sampler, counts).radiance;
      const Rgb direct =
          trace_path(probe.world(), eye, Vec2(0), {.indirect = false}, other, counts).radiance;
      means[g] += static_cast<double>((all - direct).y * kPi / place.albedo) * kGroups / samples;
    }
  });
  return spread(means);
}

/// From photons on it, which are noted where it is in the middle of the shutter.
Irradiance by_photons(const Probe& probe, const Place& place, std::uint64_t emitted) {
  constexpr std::size_t kMaps = 16;
  std::vector<double> means(kMaps);
  for (std::size_t i = 0; i < kMaps; ++i) {
    PhotonSettings settings;
    settings.each = {.global = {.emit = emitted / kMaps}, .caustic = {.emit = emitted / kMaps}};
    settings.depth = {200, 200, 200};
    settings.seed = static_cast<std::uint32_t>(i);
    RayCounts counts;
    const PhotonMaps maps = trace_photons(probe.world(), settings, counts);
    for (const PhotonMap* map : {&maps.global, &maps.caustic})
      for (const Photon& p : map->photons()) {
        const Vec3 d = p.position - place.centre - place.way * .5f;
        if (p.normal.z > .9f && std::abs(d.z) < 1e-3f && std::abs(d.x) < place.half &&
            std::abs(d.y) < place.half)
          means[i] += static_cast<double>(p.power.y / sqr(2 * place.half));
      }
  }
  return spread(means);
}

void expect_agreement(const std::string& name, const SceneText& scene, const Place& place,
                      float noise = .015f, std::uint32_t paths = 1 << 16,
                      std::uint64_t photons = 1 << 18) {
  const Probe probe(scene);
  const Irradiance a = by_paths(probe, place, paths), b = by_photons(probe, place, photons);
  const double error = std::hypot(a.error, b.error);
  EXPECT_GT(a.mean, 0) << name;
  EXPECT_LT(error, static_cast<double>(noise) * a.mean) << name << ": too noisy";
  EXPECT_NEAR(b.mean, a.mean, 4 * error) << name;
  figure("moving: " + name, a.mean, b.mean, error);
}

std::string physical(float energy) {
  return fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} )", energy);
}

constexpr const char* kPanel = " origin 0 0 0 direction 0 0 -1 rectangle 1 0 0 0 1 0 3 3";

TEST(MovingPhotons, OfALightAndBehindABlockerMatchPathTracing) {
  const struct {
    const char* name;
    std::string element, flags, blocker_flags;
  } kCases[] = {
      // It grows as well, to twice its size.
      {"lamp", physical(100) + kPanel,
       "transform " + shift(-1.3f, 0, 1.9f) +
           " motion transform .5 0 0 0 0 .5 0 0 0 0 .5 0 -.4 -.25 -.5 1",
       ""},
      // Its distance determines its strength on the way.
      {"lamp without decay", "\"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 0 0",
       "transform " + shift(-1, -1, 1.5f) + " motion transform " + shift(1, 1.5f, -1), ""},
      {"blocker", physical(100) + kPanel, "transform " + shift(0, 0, 1.9f), moves_by(2.4f, .5f)},
  };
  for (const auto& c : kCases) {
    SceneText scene(kOptions);
    scene.lambert("white", .7f).lambert("dark", .1f).box("white", Vec3(-2), Vec3(2), true);
    // Most of the downward photons of the light hit this object while it is present.
    scene.polygon("dark", {{-2, -.8f, .8f}, {-.4f, -.8f, .8f}, {-.4f, .8f, .8f}, {-2, .8f, .8f}},
                  c.blocker_flags);
    scene.light("lamp", c.element, c.flags);
    expect_agreement(c.name, scene, {Vec3(1, -.5f, -2), .9f, .7f});
  }
}

TEST(MovingPhotons, OnAMovingPlateAreFoundWhereverItIs) {
  SceneText scene(kOptions);
  const Vec3 way(2.2f, .3f, 1);
  scene.lambert("white", .7f).box("white", Vec3(-2), Vec3(2), true);
  scene.polygon("white", {{-1.8f, -.7f, -1}, {-.4f, -.7f, -1}, {-.4f, .7f, -1}, {-1.8f, .7f, -1}},
                moves_by(way.x, way.y, way.z));
  scene.light("lamp", physical(100) + kPanel, "transform " + shift(0, 0, 1.9f));
  const Place inside{Vec3(-1.1f, 0, -1), .45f, .7f, way};
  expect_agreement("plate", scene, inside, .02f, 1 << 15, 1 << 18);
  // And as pictures read them, at any time.
  const Probe probe(scene);
  RayCounts counts;
  const PhotonMaps photons = trace_photons(
      probe.world(), {.each = {.global = {.emit = 1 << 18}}, .depth = {200, 200, 200}}, counts);
  IndirectCaches maps;
  maps.global = &photons.global;
  maps.global_lookup = {.count = 400, .radius = .2f};
  PathSettings settings;
  settings.maps = &maps;
  const Irradiance read = by_paths(probe, inside, 1 << 12, settings);
  const Irradiance all = by_paths(probe, inside, 1 << 15);
  // 400 photons of a map that has no second one: its own error beside that of the paths.
  EXPECT_NEAR(read.mean, all.mean, 4 * std::hypot(read.error, all.error) + .01 * all.mean);
}

TEST(MovingPhotons, OfASunThatTurnsStillCoverTheScene) {
  SceneText scene(kOptions);
  scene.lambert("white", .7f)
      .square("white", Vec3(0), 2, kUp)
      .square("white", Vec3(1, 0, 1), 1, Vec3(-1, 0, 0));
  // Rotated about a distant axis at the origin of its instance.
  Mat4 from, to;
  from.setTranslation(Imath::V3f(100, -50, 20));
  to.setAxisAngle(Imath::V3f(0, 1, 0), -1.0f);
  std::string flags;
  for (const Mat4& m : {from.inverse(), (to * from).inverse()}) {
    flags += flags.empty() ? " transform" : " motion transform";
    for (int i = 0; i < 16; ++i) flags += fmt::format(" {}", m[i / 4][i % 4]);
  }
  scene.light("sun", "\"mib_light_infinite\" ( \"color\" 2 2 2, \"shadow\" on ) direction .9 .2 -1",
              flags);
  expect_agreement("sun", scene, {Vec3(.2f, 0, 0), .7f, .7f}, .02f);
}

TEST(MovingPhotons, CausticsOfAMovingMirrorAreTheMeanOfPaths) {
  SceneText scene(kOptions);
  scene.lambert("floor", .5f)
      .material("mirror",
                "\"reflectivity\" .8, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" 1, "
                "\"brdf_90_degree_refl\" 1, \"brdf_fresnel\" off")
      .square("floor", Vec3(0), 2, kUp)
      .polygon("mirror", {{-1.2f, -1, .05f}, {-1.2f, 1, .05f}, {-1.2f, 1, 2}, {-1.2f, -1, 2}},
               moves_by(.7f, .4f))
      .light("lamp",
             physical(100) + " origin 1 0 2 direction -1 0 -1 rectangle 1.2 0 -1.2 0 1.6 0 3 3",
             "visible on");
  expect_agreement("mirror", scene, {Vec3(.3f, 0, 0), .4f, .5f}, .03f);
}

}  // namespace motion_photon_test
}  // namespace oriel::testing
