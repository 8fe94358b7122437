// SPDX-License-Identifier: Apache-2.0
// Photon maps compared with closed forms of closed rooms, glass and mirrors, and with path tracing.
#include "transport/photon/photon_trace.h"

#include <algorithm>
#include <cstring>

#include "base/parallel.h"
#include "bsdf/fresnel.h"
#include "support/probe.h"

namespace oriel::testing {
namespace photon_test {

std::string physical(float energy) {
  return fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} )", energy);
}

std::string glass(const std::string& more) {
  return "\"reflectivity\" 1, \"transparency\" 1, \"diffuse_weight\" 0, \"refr_ior\" 1.5, "
         "\"brdf_fresnel\" on" +
         (more.empty() ? "" : ", " + more);
}

double power_of(const PhotonMap& map) {
  double sum = 0;
  for (const Photon& p : map.photons()) sum += p.power.y;
  return sum;
}

LightPhotons emitting(std::uint64_t global, std::uint64_t caustic = 0) {
  return {.global = {.emit = global}, .caustic = {.emit = caustic}};
}

const scene::TraceDepth kDeep{200, 200, 200};

struct Traced {
  PhotonMaps maps;
  PhotonBalance balance;
  RayCounts counts;
};
Traced trace(const Probe& probe, const PhotonSettings& settings) {
  Traced t;
  t.maps = trace_photons(probe.world(), settings, t.counts, &t.balance);
  return t;
}

void expect_balanced(const PhotonBalance& b) {
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(b.absorbed[k] + b.escaped[k] + b.stopped[k], b.emitted[k], 1e-6 * b.emitted[k]);
}

// acceptance: H3
TEST(PhotonTrace, EnergyIsStoredAbsorbedOrEscapes) {
  SceneText scene;
  // A room of coloured walls with a hole, a shelf, and an off-centre light.
  scene.material("red", "\"reflectivity\" 0, \"diffuse\" .8 .5 .3")
      .lambert("grey", .6f)
      .polygon("red", {Vec3(-2, -2, -2), Vec3(2, -2, -2), Vec3(2, 2, -2), Vec3(-2, 2, -2)})
      .polygon("grey", {Vec3(-2, -2, -2), Vec3(-2, 2, -2), Vec3(-2, 2, 2), Vec3(-2, -2, 2)})
      .polygon("red", {Vec3(2, -2, -2), Vec3(2, -2, 2), Vec3(2, 2, 2), Vec3(2, 2, -2)})
      .polygon("grey", {Vec3(-2, 2, -2), Vec3(2, 2, -2), Vec3(2, 2, 2), Vec3(-2, 2, 2)})
      .square("grey", Vec3(.5f, 0, -1), .7f, kUp)
      .light("lamp", physical(10) + " origin .3 .4 .5");
  const Traced t = trace(Probe(scene), {.each = emitting(1 << 17), .depth = kDeep});
  expect_balanced(t.balance);
  EXPECT_NEAR(t.balance.emitted.y, 10 * kPi, 1e-4);
  EXPECT_GT(t.balance.escaped.y, .1 * t.balance.emitted.y);
  // What walls absorb is (1 - albedo) of what falls on them: first hits and stored photons.
  SceneText closed;
  closed.lambert("grey", .6f).box("grey", Vec3(-2), Vec3(2), true);
  closed.light("lamp", physical(10) + " origin .3 .4 .5");
  const Traced c = trace(Probe(closed), {.each = emitting(1 << 17), .depth = kDeep});
  expect_balanced(c.balance);
  EXPECT_EQ(c.balance.escaped.y, 0);
  const double flux = c.balance.emitted.y;
  EXPECT_NEAR((flux + power_of(c.maps.global)) * .4, flux, .004 * flux);
  EXPECT_TRUE(c.maps.caustic.empty());
}

// acceptance: H3
TEST(PhotonTrace, IntegratingCubeHasItsMeanIndirectIlluminance) {
  const struct {
    float albedo;
    double indirect;
  } kCases[] = {{.2f, 26.0417}, {.5f, 104.1667}, {.8f, 416.667}, {.9f, 937.5}};
  for (const auto& c : kCases) {
    SceneText scene;
    scene.lambert("grey", c.albedo).box("grey", Vec3(-2), Vec3(2), true);
    // 10000 lm: a physical light sends pi times its colour.
    scene.light("lamp", physical(10000 / kPi) + " origin 0 0 0");
    const Traced t = trace(Probe(scene), {.each = emitting(1 << 17), .depth = kDeep});
    const double mean = power_of(t.maps.global) / 96;
    // Bounces of a photon are geometric: their number has the deviation sqrt(albedo) / (1 - it).
    const double error = 10000 / 96.0 * std::sqrt(c.albedo) / (1 - c.albedo) / std::sqrt(1 << 17);
    EXPECT_NEAR(mean, c.indirect, 4 * error) << c.albedo;
    EXPECT_NEAR(t.balance.emitted.y / 96, 104.1667, 1e-2);
    figure(fmt::format("integrating cube, albedo {}", c.albedo), c.indirect, mean, error);
  }
}

/// Mean irradiance of a square on a horizontal floor by all light but the direct.
struct Indirect {
  Rgb paths{0}, error{0}, photons{0};
};
Indirect indirect_on(const SceneText& scene, const Vec3& centre, float half, float albedo,
                     std::uint64_t emitted) {
  Indirect sum;
  const Probe probe(scene);
  // Places all over the square, in groups whose spread is the error.
  constexpr int kGroups = 32, kSamples = 4096;
  std::vector<Rgb> means(kGroups, Rgb(0));
  parallel_for(kGroups, [&](std::size_t g) {
    RayCounts counts;
    for (std::uint32_t i = 0; i < kSamples; ++i) {
      sampling::Sampler sampler(static_cast<int>(g), 11, i);
      const Vec2 at = sampler.next_2d() * 2 - Vec2(1);
      const Camera::Ray eye{centre + Vec3(at.x * half, at.y * half, .05f), -kUp, 1, 0, 0};
      sampling::Sampler other = sampler;
      const Rgb all = trace_path(probe.world(), eye, Vec2(0), {}, sampler, counts).radiance;
      const Rgb direct =
          trace_path(probe.world(), eye, Vec2(0), {.indirect = false}, other, counts).radiance;
      means[g] += (all - direct) * (kPi / albedo / kSamples);
    }
  });
  for (const Rgb& m : means) sum.paths += m / kGroups;
  for (const Rgb& m : means) sum.error += (m - sum.paths) * (m - sum.paths);
  for (int k = 0; k < 3; ++k) sum.error[k] = std::sqrt(sum.error[k] / (kGroups - 1) / kGroups);
  const Traced t = trace(probe, {.each = emitting(emitted, emitted), .depth = kDeep});
  for (const PhotonMap* map : {&t.maps.global, &t.maps.caustic})
    for (const Photon& p : map->photons()) {
      const Vec3 d = p.position - centre;
      if (p.normal.z > .9f && std::abs(d.z) < 1e-3f && std::abs(d.x) < half && std::abs(d.y) < half)
        sum.photons += p.power / sqr(2 * half);
    }
  return sum;
}

void expect_same_indirect(const std::string& name, const Indirect& i, float tolerance) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(2.5f * i.error[k], tolerance * i.paths[k]) << name << ": too noisy";
    EXPECT_NEAR(i.photons[k], i.paths[k], tolerance * i.paths[k]) << name << " channel " << k;
  }
  figure("indirect by paths and photons, " + name, i.paths.y, i.photons.y, i.error.y);
}

// acceptance: H3
TEST(PhotonTrace, PhotonsAndPathsGiveTheSameIndirectLight) {
  const std::pair<const char*, std::string> kLights[] = {
      {"rectangle", physical(100) + " origin 0 0 1.9 direction 0 0 -1 rectangle 1 0 0 0 1 0 3 3"},
      {"point without decay",
       "\"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin .5 -1 1.5"}};
  for (const auto& [name, light] : kLights) {
    SceneText scene;
    scene.lambert("white", .7f)
        .material("green", "\"reflectivity\" 0, \"diffuse\" .2 .7 .3")
        .box("white", Vec3(-2), Vec3(2), true)
        .box("green", Vec3(-1, .2f, -1.999f), Vec3(0, 1.2f, -.5f))
        // Coarse and smooth: shading normals far from the triangles'.
        .sphere("green", Vec3(1, .8f, -1.2f), .7f, 6)
        .light("lamp", light);
    expect_same_indirect(name, indirect_on(scene, Vec3(1, -.5f, -2), .6f, .7f, 1 << 19), .03f);
  }
}

// acceptance: H3
TEST(PhotonTrace, PhotonsAndPathsGiveTheSameCaustics) {
  const struct {
    const char* name;
    std::string material;
    Vec3 lo, hi;  // of the box that makes the caustic
  } kCases[] = {
      {"glossy",
       "\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" 1, "
       "\"brdf_90_degree_refl\" 1, \"brdf_fresnel\" off, \"refl_gloss\" .5",
       Vec3(-.8f, -1, .05f), Vec3(-.5f, 1, 2)},
      {"glossy by Fresnel over diffuse",
       "\"reflectivity\" 1, \"diffuse\" .5 .4 .3, "
       "\"refr_ior\" 1.8, \"brdf_fresnel\" on, "
       "\"refl_gloss\" .6",
       Vec3(-.8f, -1, .05f), Vec3(-.5f, 1, 2)},
      {"mirror",
       "\"reflectivity\" .8, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" 1, "
       "\"brdf_90_degree_refl\" 1, \"brdf_fresnel\" off",
       Vec3(-.8f, -1, .05f), Vec3(-.5f, 1, 2)},
      {"glass", glass("\"do_refractive_caustics\" on"), Vec3(-1.5f, -1.5f, .3f),
       Vec3(1.5f, 1.5f, .7f)},
  };
  for (const auto& c : kCases) {
    SceneText scene("trace depth 8 8 12 shadow segments caustic on");
    // Paths that find the light by refracted rays, as photons do.
    scene.method("scene")
        .lambert("floor", .5f)
        .material("thing", c.material)
        .square("floor", Vec3(0), 2, kUp)
        .box("thing", c.lo, c.hi)
        .light("lamp",
               physical(100) +
                   " origin 1 0 2 direction -1 0 -1 rectangle "
                   "1.2 0 -1.2 0 1.6 0 3 3",
               "visible on");
    expect_same_indirect(c.name, indirect_on(scene, Vec3(0), .4f, .5f, 1 << 19), .05f);
  }
}

// acceptance: T7, H3
TEST(PhotonTrace, OpaqueThingsReflectWhicheverWayTheirNormalsPoint) {
  // A narrow spot meets an opaque plate; what it reflects comes down on
  // the floor: Fresnel's share of index 1.5.
  const auto share = [](const Vec3& normal) {
    SceneText scene("trace depth 8 8 12 shadow segments caustic on");
    scene.lambert("floor", .5f)
        .square("floor", Vec3(0), 20, kUp)
        .material("plate",
                  "\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_fresnel\" on, "
                  "\"refr_ior\" 1.5, \"transparency\" 0")
        .square("plate", Vec3(0, 0, 2), .5f, normal)
        .light("lamp",
               physical(10) + " origin -1.7320508 0 3 direction 1.7320508 0 -1 spread .9999");
    const Traced t = trace(Probe(scene), {.each = emitting(0, 1 << 16)});
    return power_of(t.maps.caustic) / t.balance.emitted.y;
  };
  // The plate is tilted so that the light continues downward.
  const Vec3 along = normalize(Vec3(1.7320508f, 0, -1)), onward = normalize(Vec3(.2f, 0, -1));
  const Vec3 normal = normalize(onward - along);
  const float exact = bsdf::fresnel_dielectric(-dot(along, normal), 1.5f);
  const double front = share(normal), back = share(-normal);
  EXPECT_NEAR(front, exact, .02f * exact);
  EXPECT_NEAR(back, exact, .02f * exact);
}

// acceptance: H3
TEST(PhotonTrace, PhotonShaderReplacesTheSurface) {
  // Of what falls on a black plate its photon shader scatters .3 and mirrors .5 into the open.
  const auto escaped = [](const std::string& photon) {
    SceneText scene;
    scene
        .statement(
            "material \"plate\" \"mia_material_x\" ( \"diffuse_weight\" 0, "
            "\"reflectivity\" 0 ) " +
            photon + " end material")
        .square("plate", Vec3(0), 5, kUp)
        .light("lamp", physical(10) + " origin 0 0 3 direction 0 0 -1 spread .99");
    const Traced t = trace(Probe(scene), {.each = emitting(1 << 14)});
    expect_balanced(t.balance);
    return t.balance.escaped.y / t.balance.emitted.y;
  };
  const double error = std::sqrt(.8 * .2 / (1 << 14));
  EXPECT_EQ(escaped(""), 0);
  for (const std::string shader :
       {"mib_photon_basic\" ( \"diffuse\" .3 .3 .3, \"specular\" .5 .5 .5 )",
        "dgs_material_photon\" ( \"diffuse\" .3 .3 .3, \"specular\" .5 .5 .5 )",
        "mia_material_x\" ( \"diffuse\" .6 .6 .6, \"reflectivity\" .5, \"brdf_fresnel\" off, "
        "\"brdf_0_degree_refl\" 1, \"brdf_90_degree_refl\" 1 )"})
    EXPECT_NEAR(escaped("photon \"" + shader), .8, 4 * error) << shader;
}

TEST(PhotonTrace, MapsDoNotDependOnThreads) {
  SceneText scene("trace depth 8 8 12 shadow segments caustic on");
  scene.lambert("grey", .6f)
      .material("glass",
                "\"reflectivity\" 1, \"transparency\" 1, \"refr_ior\" 1.5, "
                "\"do_refractive_caustics\" on, \"brdf_fresnel\" on")
      .box("grey", Vec3(-2), Vec3(2), true)
      .sphere("glass", Vec3(0, 0, -1), .5f, 24)
      .light("lamp", physical(10) + " origin .3 .4 1.5")
      .light("other", physical(5) + " origin -1 .4 1.5");
  const Probe probe(scene);
  const PhotonSettings settings{.each = emitting(20000, 10000)};
  const auto limited = [&](int threads) {
    const ThreadLimit limit(threads);
    return trace(probe, settings).maps;
  };
  const PhotonMaps one = limited(1), two = limited(2);
  const auto expect_same = [](const PhotonMap& a, const PhotonMap& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.photons().data(), b.photons().data(), a.size() * sizeof(Photon)), 0);
  };
  expect_same(one.global, two.global);
  expect_same(one.caustic, two.caustic);
  EXPECT_GT(one.global.size(), 10000u);
  EXPECT_GT(one.caustic.size(), 100u);
}

TEST(PhotonTrace, CountsLimitStoredAndEmittedPhotons) {
  SceneText scene;
  scene.lambert("grey", .5f).box("grey", Vec3(-2), Vec3(2), true);
  scene.light("lamp", physical(100) + " origin 0 0 0");
  const Probe probe(scene);
  PhotonSettings settings{.each = {.global = {.store = 5000}}, .depth = kDeep};
  const Traced stored = trace(probe, settings);
  EXPECT_GE(stored.maps.global.size(), 5000u);
  EXPECT_LT(stored.maps.global.size(), 5200u);
  EXPECT_NEAR(power_of(stored.maps.global), 100 * kPi, .08 * 100 * kPi);
  settings.each.global.emit = 1000;
  EXPECT_NEAR(double(trace(probe, settings).maps.global.size()), 1000, 150);
  // No caustics to be had: given up.
  settings.each = {.caustic = {.store = 1000}};
  const Traced none = trace(probe, settings);
  EXPECT_TRUE(none.maps.caustic.empty());
  EXPECT_LT(none.balance.photons, 2 * kHopelessPhotons);
}

TEST(PhotonTrace, ProgressGrowsToOne) {
  SceneText scene;
  scene.uniform_sky(1).lambert("grey", .5f).square("grey", Vec3(0), 2, kUp);
  scene.light("lamp", physical(100) + " origin 0 0 1");
  scene.light("second", physical(50) + " origin 1 0 1");
  std::vector<double> shares;
  const ProgressMonitor monitor{
      .progress = [&](const char*, double share) { shares.push_back(share); }};
  RayCounts counts;
  const LightPhotons each = emitting(100'000);  // more than one round
  trace_photons(Probe(scene).world(), {.each = each, .environment = each, .depth = kDeep}, counts,
                nullptr, monitor);
  ASSERT_GT(shares.size(), 2u);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GT(shares.front(), 0);
  EXPECT_LT(shares.front(), 1);
  EXPECT_DOUBLE_EQ(shares.back(), 1);
}

TEST(PhotonTrace, TraceDepthEndsPhotons) {
  SceneText scene;
  scene.lambert("grey", .5f).box("grey", Vec3(-2), Vec3(2), true);
  scene.light("lamp", physical(100) + " origin 0 0 0");
  const Traced t = trace(Probe(scene), {.each = emitting(1 << 16), .depth = {2, 5, 5}});
  expect_balanced(t.balance);
  // Two diffuse bounces: a half and a quarter of the flux are stored, an eighth would go on.
  EXPECT_NEAR(power_of(t.maps.global), 75 * kPi, .02 * 75 * kPi);
  EXPECT_NEAR(t.balance.stopped.y, 12.5 * kPi, .03 * 12.5 * kPi);
}

/// A floor of 6 x 6 at z = 0 under a distant downward light; caustics are on.
SceneText lit_floor(const std::string& light) {
  SceneText scene("trace depth 8 8 12 shadow segments caustic on");
  scene.lambert("floor", .5f).square("floor", Vec3(0), 3, kUp);
  scene.light("sun", light);
  return scene;
}
const std::string kSun = "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction 0 0 -1";

/// Radius of a disc in the paraxial focus of a glass ball of radius 1, 1.5 below its centre.
constexpr double kFocus = .25;

/// Share of parallel light on the ball that reaches the disc by two refractions.
double focused_share() {
  constexpr int kSteps = 20000;
  double share = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double h = (i + .5) / kSteps;  // distance from the axis
    const double in = std::asin(h), inside = std::asin(h / 1.5);
    // The ray leaves at the angle `out` from the way down, having turned by 2 (in - inside).
    const double out = 2 * inside - in, turned = 2 * (in - inside);
    const double x = std::sin(out), z = std::cos(out);  // z down
    const double at_floor = x - std::tan(turned) * (1.5 - z);
    if (std::abs(at_floor) > kFocus) continue;
    const double r = bsdf::fresnel_dielectric(static_cast<float>(std::cos(in)), 1.5f);
    share += 2 * h * (1 - r) * (1 - r) / kSteps;
  }
  return share;
}

// acceptance: T9
TEST(PhotonTrace, RefractiveCausticsDecideBetweenBentAndStraight) {
  for (const bool bends : {false, true}) {
    SceneText scene = lit_floor(kSun);
    scene.material("glass", glass(bends ? "\"do_refractive_caustics\" on" : ""))
        .sphere("glass", Vec3(0, 0, 1.5f), 1, 64);
    const Traced t =
        trace(Probe(scene), {.globillum = false, .each = emitting(0, 1 << 17), .depth = kDeep});
    double under = 0, elsewhere = 0;
    for (const Photon& p : t.maps.caustic.photons()) {
      const float r = std::hypot(p.position.x, p.position.y);
      (r < kFocus ? under : elsewhere) += p.power.y;
    }
    const double arriving = kPi * kPi;  // through the sphere's outline of radius 1
    const double exact = bends ? focused_share() : 0;
    // Of straight photons one percent is reflected inside of the ball and arrives there.
    EXPECT_NEAR(under / arriving, exact, bends ? .01 : .02);
    EXPECT_EQ(elsewhere > 0, true);
    figure(bends ? "share in the focus of a ball" : "share of straight light in the caustic map",
           exact, under / arriving, 0);
  }
}

// acceptance: T9
TEST(PhotonTrace, APaneOfGlassPassesItsTransmittanceRefracted) {
  SceneText scene = lit_floor(kSun);
  scene
      .material("glass", glass("\"do_refractive_caustics\" on, \"refr_falloff_on\" on, "
                               "\"refr_falloff_dist\" .5, \"refr_falloff_color_on\" on, "
                               "\"refr_falloff_color\" .5 .5 .5"))
      .box("glass", Vec3(-1, -1, 1), Vec3(1, 1, 1.25f));
  const Traced t =
      trace(Probe(scene), {.globillum = false, .each = emitting(0, 1 << 18), .depth = kDeep});
  // Normal incidence: 4 % at each face, a quarter of a unit at half per half unit.
  const double f = .04, a = std::sqrt(.5);
  const double through = (1 - f) * (1 - f) * a / (1 - f * f * a * a);
  double sum = 0;
  for (const Photon& p : t.maps.caustic.photons())
    if (std::abs(p.position.x) < 1.0001f && std::abs(p.position.y) < 1.0001f) sum += p.power.y;
  const double exact = through * 4 * kPi;
  EXPECT_NEAR(sum, exact, .01 * exact);
  figure("pane by photons", exact, sum, 0);
  const Rgb e = t.maps.caustic.irradiance(Vec3(0), kUp, {.count = 2000, .radius = .7f});
  EXPECT_NEAR(e.x, through * kPi, .08 * through * kPi);
}

// acceptance: T4, T11
TEST(PhotonTrace, NestedMediaAbsorbOverTheirOwnThickness) {
  const auto gel = [](float per_unit) {
    return fmt::format(
        "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"refr_ior\" 1, "
        "\"do_refractive_caustics\" on, \"refr_falloff_on\" on, \"refr_falloff_dist\" 1, "
        "\"refr_falloff_color_on\" on, \"refr_falloff_color\" {0} {0} {0}",
        std::exp(-per_unit));
  };
  // A layer of .5 below one of .75; the surface between them belongs to the upper one.
  SceneText scene = lit_floor(kSun);
  scene.material("lower", gel(.5f))
      .material("upper", gel(.8f))
      .square("lower", Vec3(0, 0, .5f), 1, -kUp)
      .square("upper", Vec3(0, 0, 1), 1, -kUp)
      .square("upper", Vec3(0, 0, 1.75f), 1, kUp);
  const Traced t =
      trace(Probe(scene), {.globillum = false, .each = emitting(0, 1 << 18), .depth = kDeep});
  expect_balanced(t.balance);
  const double exact = std::exp(-.5 * .5 - .8 * .75) * 4 * kPi;
  EXPECT_NEAR(power_of(t.maps.caustic), exact, .02 * exact);
}

TEST(PhotonTrace, MirrorsMakeCausticsAndDiffuseBouncesDoNot) {
  SceneText scene("trace depth 8 8 12 shadow segments caustic on");
  // The light shines on a mirror that reflects it to the wall.
  scene.lambert("wall", .5f)
      .material("mirror",
                "\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" 1, "
                "\"brdf_90_degree_refl\" 1, \"brdf_fresnel\" off")
      .square("mirror", Vec3(0), 1, Vec3(1, 0, 1))
      .polygon("wall", {Vec3(3, -3, -3), Vec3(3, -3, 3), Vec3(3, 3, 3), Vec3(3, 3, -3)})
      .light("sun", kSun);
  const Traced t = trace(Probe(scene), {.each = emitting(1 << 16, 1 << 16), .depth = kDeep});
  expect_balanced(t.balance);
  EXPECT_TRUE(t.maps.global.empty());
  // The mirror's outline from above is 2 by sqrt 2.
  const double flux = kPi * 2 * std::sqrt(2.0);
  EXPECT_NEAR(power_of(t.maps.caustic), flux, .01 * flux);
  for (const Photon& p : t.maps.caustic.photons()) {
    EXPECT_NEAR(p.position.x, 3, 1e-4f);
    EXPECT_LT(p.normal.x, -.999f);
    EXPECT_GT(p.direction.x, .999f);
  }
}

TEST(PhotonTrace, CutOutsLetTheirSharePassAsDirectLight) {
  SceneText scene = lit_floor(kSun);
  scene.method("scene")
      .material("pane",
                "\"reflectivity\" 0, \"diffuse_weight\" 0, \"transparency\" 1, "
                "\"refr_color\" .8 .8 .8, \"thin_walled\" on, "
                "\"do_refractive_caustics\" on, \"cutout_opacity\" .25")
      .square("pane", Vec3(0, 0, 1), 1, kUp);
  const Traced t =
      trace(Probe(scene), {.globillum = false, .each = emitting(0, 1 << 18), .depth = kDeep});
  expect_balanced(t.balance);
  // A quarter meets the pane; what passes beside it is direct light, in no map.
  const double exact = .25 * .8 * 4 * kPi;
  EXPECT_NEAR(power_of(t.maps.caustic), exact, .02 * exact);
}

TEST(PhotonTrace, TranslucentSheetsStoreOnTheSideThatIsLit) {
  SceneText scene("trace depth 8 8 12 shadow segments");
  scene.lambert("white", .8f)
      .material("paper",
                "\"reflectivity\" 0, \"diffuse\" 1 1 1, \"transparency\" 1, "
                "\"refr_translucency\" on, \"refr_trans_weight\" 1, "
                "\"refr_trans_color\" .5 .5 .5, \"thin_walled\" on")
      .square("paper", Vec3(0, 0, 1), 1, kUp)
      .square("white", Vec3(0), 3, kUp)
      .light("sun", kSun);
  const Traced t = trace(Probe(scene), {.each = emitting(1 << 16), .depth = kDeep});
  expect_balanced(t.balance);
  double above = 0, below = 0, floor = 0;
  for (const Photon& p : t.maps.global.photons()) {
    if (p.position.z < .5f)
      floor += p.power.y;
    else
      (p.normal.z > 0 ? above : below) += p.power.y;
  }
  // From above comes direct light only, which is in no map; from below the floor's.
  EXPECT_EQ(above, 0);
  EXPECT_GT(below, .5 * kPi);
  EXPECT_GT(floor, .5 * 4 * kPi * .5);
}

}  // namespace photon_test
}  // namespace oriel::testing
