// SPDX-License-Identifier: Apache-2.0
// Caustics of path-traced pictures against closed forms, paths without photons, and photon maps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bsdf/fresnel.h"
#include "render/session.h"
#include "scenes.h"
#include "support/picture.h"
#include "transport/manifold/specular_chain.h"
#include "transport/photon/photon_aim.h"
#include "transport/photon/photon_trace.h"

namespace oriel::cross_method {
namespace caustics_test {

using testing::kUp;
using testing::Probe;
using testing::RenderedScene;

constexpr const char* kOptions = "trace depth 8 8 12 photon trace depth 8 8 12 shadow segments";
constexpr const char* kSolid =
    "\"reflectivity\" 1, \"transparency\" 1, \"diffuse_weight\" 0, \"refr_ior\" 1.5, "
    "\"brdf_fresnel\" on, \"do_refractive_caustics\" on";
constexpr const char* kWater =
    "\"reflectivity\" 1, \"transparency\" 1, \"diffuse_weight\" 0, \"refr_ior\" 1.33, "
    "\"brdf_fresnel\" on, \"do_refractive_caustics\" on";
constexpr const char* kMetal =
    "\"reflectivity\" .8, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" 1, \"brdf_90_degree_refl\" "
    "1, "
    "\"brdf_fresnel\" off";

SceneText caustic_scene(const std::string& options = "") {
  return SceneText(std::string(kOptions) + " caustic on " + options);
}

/// A camera above a place of the floor that sees a square of side 2 `half`. `up`: one below a place
/// of a ceiling instead.
void look_at_floor(SceneText& scene, const Vec3& place, float half, bool up = false,
                   float height = 1) {
  const float z = up ? place.z - height : place.z + height;
  scene.camera(fmt::format("focal {} aperture {} aspect 1 resolution 16 16", height, 2 * half),
               up ? fmt::format("-1 0 0 0  0 1 0 0  0 0 -1 0  {} {} {} 1", place.x, -place.y, z)
                  : fmt::format("1 0 0 0  0 1 0 0  0 0 1 0  {} {} {} 1", -place.x, -place.y, -z));
}

SessionSettings samples(std::uint32_t count) {
  SessionSettings settings;
  settings.budget.samples = count;
  return settings;
}

float rendered(SceneText scene, const std::string& method, std::uint32_t count = 64) {
  scene.method(method);
  return RenderedScene(scene, samples(count)).mean().y;
}

/// A picture by paths alone, that have no photons.
testing::Measured brute_force(SceneText& scene, int count) { return Probe(scene).picture(count); }

std::string infinite(const Vec3& direction) {
  return "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction " +
         testing::text_of(direction);
}

/// A visible lamp that is small compared with the floor of the scenes, 16 x 16.
constexpr const char* kLamp =
    "\"physical_light\" ( \"color\" 300 300 300 ) origin 0 0 4 direction 0 0 -1 "
    "disc 0 0 -1 .5 3 3";

/// A mirror on the ground that reflects the sun to a ceiling.
SceneText mirror_below_ceiling(float albedo) {
  SceneText scene = caustic_scene();
  scene.lambert("ceiling", albedo)
      .material("mirror", kMetal)
      .square("mirror", Vec3(0), 1, kUp)
      .square("ceiling", Vec3(2.2f, 0, 2), 1.2f, -kUp)
      .light("sun", infinite(Vec3(1, 0, -1)));
  look_at_floor(scene, Vec3(2, 0, 2), .3f, true);
  return scene;
}

TEST(CausticPictures, SendTwoPhotonsForEachPathButTwoMillionInSmallPictures) {
  // Nearly all photons miss the ceiling, so that the number of emitted photons is the limit.
  SceneText scene = caustic_scene("\"guiding\" off");
  scene.lambert("ceiling", .5f)
      .material("mirror", kMetal)
      .square("mirror", Vec3(0), 1, kUp)
      .square("ceiling", Vec3(2, 0, 2), .03f, -kUp)
      .light("sun", infinite(Vec3(1, 0, -1)))
      .camera("focal 1 aperture 1 aspect 1 resolution 64 64", "1 0 0 0 0 1 0 0 0 0 1 0 -2 0 -1 1");
  const auto rays_before = [&](std::uint32_t count) {
    const Probe probe(scene);
    RenderSession session(probe.world(), samples(count));
    session.run();
    return static_cast<double>(session.rays_before());
  };
  EXPECT_NEAR(rays_before(488) / rays_before(1), 2. * 488 * 64 * 64 / 2e6, .05);
}

// acceptance: Q3
TEST(CausticPictures, MirrorThrowsTheSunOnACeiling) {
  const SceneText scene = mirror_below_ceiling(.5f);
  const double exact = .5 * .8 * std::numbers::sqrt2 / 2;
  for (const char* method : {"path", "path+cache"})
    EXPECT_NEAR(rendered(scene, method, 16), exact, .01 * exact) << method;
}

// acceptance: Q3
TEST(CausticPictures, WaterRefractsTheSunOnTheFloorOfAPool) {
  // The floor is nearly black, so that light between floor and surface does not count.
  SceneText scene = caustic_scene();
  scene.lambert("floor", .004f)
      .material("water", kWater)
      .square("floor", Vec3(0), 8, kUp)
      .square("water", Vec3(0, 0, 2), 8, kUp)
      .light("sun", infinite(Vec3(1, 0, -1)));
  // The camera is below the surface.
  look_at_floor(scene, Vec3(0), 1);
  // Through a horizontal surface the flux on a horizontal floor changes by reflection alone.
  const double cosine = std::numbers::sqrt2 / 2;
  const double exact = .004 * cosine * (1 - bsdf::fresnel_dielectric(float(cosine), 1.33f));
  EXPECT_NEAR(rendered(scene, "path", 16), exact, .01 * exact);
}

// acceptance: Q3
TEST(CausticPictures, PanesAndThinWallsKeepTransparentShadows) {
  const auto below = [](const std::string& options, const std::string& glass, float thickness) {
    SceneText scene(std::string(kOptions) + " " + options);
    scene.lambert("floor", .5f)
        .square("floor", Vec3(0), 8, kUp)
        .material("glass", std::string(kSolid) + glass)
        .box("glass", Vec3(-5, -5, 1), Vec3(5, 5, 1 + thickness))
        .light("sun", infinite(Vec3(.3f, 0, -1)));
    look_at_floor(scene, Vec3(0), .5f);
    return rendered(scene, "path", 16);
  };
  for (const char* glass : {"", ", \"thin_walled\" on"}) {
    const float open = below("", glass, .02f);
    EXPECT_GT(open, .3f);
    // With caustics the light that is reflected twice between the two faces counts as well.
    const double ratio = below("caustic on", glass, .02f) / open;
    EXPECT_GT(ratio, .998) << glass;
    EXPECT_LT(ratio, 1.01) << glass;
  }
}

/// Largest relative deviation of a pixel.
double deviation(SceneText scene, double exact) {
  const RenderedScene picture(scene, samples(4));
  EXPECT_GT(picture.session().learned_bytes(), 1000u) << "the memory of chains is reported";
  double most = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) most = std::max(most, std::abs(picture.at(x, y).r / exact - 1));
  return most;
}

// acceptance: Q3
TEST(CausticPictures, LightByMirrorsAndLevelWaterHasNoNoise) {
  // Photons alone deviate by 30 %.
  EXPECT_LT(deviation(mirror_below_ceiling(.004f), .004 * .8 * std::numbers::sqrt2 / 2), .002);

  // A point above water: rays at small angles a from the vertical reach the floor at the distance
  // (height + depth / index) a. The light does not decay with the distance from the point to the
  // water.
  SceneText pool = caustic_scene();
  pool.lambert("floor", .004f)
      .material("water", kWater)
      .square("floor", Vec3(0), 8, kUp)
      .square("water", Vec3(0, 0, 2), 8, kUp)
      .light("lamp", "\"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 0 5");
  look_at_floor(pool, Vec3(0), .02f);
  const double height = 3, spread = (height + 2 / 1.33) / height;
  const double passed = 1 - bsdf::fresnel_dielectric(1, 1.33f);
  EXPECT_LT(deviation(pool, .004 * passed / (spread * spread)), .005);
}

TEST(SpecularChains, DerivativesAreThoseOfDifferences) {
  SceneText scene = caustic_scene();
  scene.material("thing", kSolid).sphere("thing", Vec3(0, 0, 2), 1, 64);
  const Probe probe(scene);
  const ChainReceiver from{Vec3(.1f, .2f, 0), kUp, 1e-5f, 0};
  ChainKind kind;
  kind.count = 2;
  kind.refracted = 3;
  kind.instance[0] = kind.instance[1] = 0;
  kind.eta[0] = 1.5f;
  kind.eta[1] = 1 / 1.5f;
  const Vec3 first = normalize(Vec3(.1f, -.05f, 1));
  const Frame frame(first);
  SpecularChain chain, before, after;
  RayCounts counts;
  ASSERT_TRUE(trace_chain(probe.world(), from, kind, first, chain, counts));
  const float step = 2e-3f;
  for (int k = 0; k < 2; ++k) {
    const Vec3 side = (k == 0 ? frame.s : frame.t) * step;
    ASSERT_TRUE(trace_chain(probe.world(), from, kind, normalize(first - side), before, counts));
    ASSERT_TRUE(trace_chain(probe.world(), from, kind, normalize(first + side), after, counts));
    // The facets of the sphere are flat.
    const Vec3 turn = (after.direction - before.direction) / (2 * step);
    const Vec3 by = (after.position - before.position) / (2 * step);
    EXPECT_LT(length(chain.turn[k] - turn), .02f * length(turn)) << k;
    EXPECT_LT(length(chain.by[k] - by), .02f * length(by)) << k;
  }
}

/// A slab of water with waves above, and air below.
void add_waves(SceneText& scene) {
  constexpr int kSide = 60;
  constexpr float kHalf = 3;
  std::vector<Vec3> points, normals;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i <= kSide; ++i)
    for (int j = 0; j <= kSide; ++j) {
      const float x = kHalf * (2.0f * i / kSide - 1), y = kHalf * (2.0f * j / kSide - 1);
      const float a = 3 * x + y, b = 4 * y - 2 * x;
      points.emplace_back(x, y, .8f + .06f * (std::sin(a) + std::sin(b)));
      const float by_x = .06f * (3 * std::cos(a) - 2 * std::cos(b));
      const float by_y = .06f * (std::cos(a) + 4 * std::cos(b));
      normals.push_back(normalize(Vec3(-by_x, -by_y, 1)));
    }
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j) {
      const int a = i * (kSide + 1) + j, b = a + kSide + 1;
      faces.push_back({a, b, b + 1, a + 1});
    }
  scene.material("water", kWater)
      .mesh("water", points, faces, normals)
      .square("water", Vec3(0, 0, .5f), kHalf, -kUp);
}

/// A ring of metal that mirrors inside.
void add_ring(SceneText& scene) {
  constexpr int kSides = 128;
  std::vector<Vec3> points, normals;
  std::vector<std::vector<int>> faces;
  for (int i = 0; i < kSides; ++i) {
    const float angle = kTwoPi * static_cast<float>(i) / kSides;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    for (const float z : {.05f, .6f}) {
      points.push_back(out + Vec3(0, 0, z));
      normals.push_back(-out);
    }
    const int a = 2 * i, b = 2 * ((i + 1) % kSides);
    faces.push_back({a, a + 1, b + 1, b});
  }
  scene.material("metal", kMetal).mesh("metal", points, faces, normals);
}

struct Case {
  const char* name;
  void (*build)(SceneText& scene);
  Vec3 place;
  float half;
  double blur = .02;  ///< difference by the blur of photon maps
};
std::ostream& operator<<(std::ostream& out, const Case& c) { return out << c.name; }

class Caustics : public ::testing::TestWithParam<Case> {
 protected:
  static SceneText scene(const std::string& lamp, const std::string& flags = "") {
    SceneText scene = caustic_scene();
    scene.lambert("floor", .5f).square("floor", Vec3(0), 8, kUp).light("lamp", lamp, flags);
    GetParam().build(scene);
    look_at_floor(scene, GetParam().place, GetParam().half, false, 2.5f);
    return scene;
  }
};

// acceptance: Q3
TEST_P(Caustics, EqualPathsWithoutPhotons) {
  SceneText text = scene(kLamp, "visible on");
  const testing::Measured exact = brute_force(text, 3 << 20);
  const float mean = rendered(text, "path");
  EXPECT_LE(exact.error.y, .005f * exact.mean.y) << "too noisy";
  EXPECT_NEAR(mean / exact.mean.y, 1, .01 + 3 * exact.error.y / exact.mean.y);
  testing::figure(GetParam().name, exact.mean.y, mean, exact.error.y);
}

// acceptance: Q3
TEST_P(Caustics, EqualPhotonMapsUnderAPoint) {
  const SceneText text =
      scene("\"mib_light_point\" ( \"color\" 20 20 20, \"shadow\" on ) origin 0 0 4");
  // The search is noisy at foci.
  const float photons = rendered(text, "fg+photons"), paths = rendered(text, "path", 256);
  EXPECT_NEAR(paths / photons, 1, GetParam().blur);
  SceneText direct = text;
  EXPECT_GT(paths, 1.02f * brute_force(direct, 1 << 16).mean.y) << "no caustic in view";
}

INSTANTIATE_TEST_SUITE_P(
    CausticPictures, Caustics,
    ::testing::Values(
        Case{"glass_ball",
             [](SceneText& s) {
               s.material("thing", kSolid).sphere("thing", Vec3(0, 0, 1.2f), .8f, 64);
             },
             // The ball shows its focal spot enlarged.
             Vec3(0), 1.2f, .045},
        Case{"block",
             [](SceneText& s) {
               s.material("thing", kSolid).box("thing", Vec3(.2f, -.6f, .1f), Vec3(1, .6f, 1.3f));
             },
             Vec3(.9f, 0, 0), 1.2f},
        Case{"metal_wall",
             [](SceneText& s) {
               s.material("thing", kMetal).box("thing", Vec3(1.4f, -1, .05f), Vec3(1.6f, 1, 1.5f));
             },
             Vec3(.7f, 0, 0), .6f},
        Case{"waves", add_waves, Vec3(.2f, .1f, 0), .7f},
        Case{"ring", add_ring, Vec3(.85f, 0, 0), .12f}),
    [](const auto& i) { return std::string(i.param.name); });

/// A glass ball in a room, below a lamp that rays find.
SceneText lit_ball(const std::string& options, const std::string& glass) {
  SceneText scene = start("\"indirect\" \"path\" " + options);
  room(scene);
  scene.light("lamp", physical("40 36 30") + " origin 0 1.49 -3 rectangle 1.2 0 0 0 0 1.2 3 3",
              "visible on");
  scene.material("glass", glass).sphere("glass", Vec3(0, -.7f, -3), .7f, 64);
  return scene;
}

/// Expects the light of pictures with and without photons to be equal in 16 blocks and as a mean.
/// `of`: the scene with these options.
void expect_photons_keep_light(SceneText (*of)(const std::string& options), const char* options,
                               double of_block, double of_mean) {
  // Enough paths to learn.
  constexpr std::uint32_t kSamples = 660;
  const auto blocks = [](const RenderedScene& picture) {
    std::vector<Rgb> means(16, Rgb(0));
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 40; ++x)
        means[static_cast<std::size_t>(y / 10 * 4 + x / 10)] += rgb(picture.at(x, y)) / 100;
    return means;
  };
  const RenderedScene photons(of(options), samples(kSamples));
  const RenderedScene rays(of(std::string(options) + " \"guiding\" off"), samples(kSamples));
  EXPECT_GT(photons.session().learned_bytes(), 1000 * sizeof(Photon)) << "no photons";
  const auto a = blocks(photons), b = blocks(rays);
  Rgb sums[2] = {Rgb(0), Rgb(0)};
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].y / b[i].y, 1, of_block) << options << ", block " << i;
    sums[0] += a[i], sums[1] += b[i];
  }
  EXPECT_NEAR(sums[0].y / sums[1].y, 1, of_mean) << options;
  testing::figure(options, sums[1].y, sums[0].y, 0);
}

// acceptance: Q3
TEST(CausticPictures, PhotonsOfALargeLampKeepTheLightThatRaysFind) {
  const auto ball = [](const std::string& options) {
    const bool bends = options.find("caustic on") != std::string::npos;
    return lit_ball(options, bends ? kSolid
                                   : "\"reflectivity\" 1, \"transparency\" 1, "
                                     "\"diffuse_weight\" 0, \"refr_ior\" 1.5, "
                                     "\"brdf_fresnel\" on");
  };
  for (const char* options : {"caustic on", "caustic off"})
    expect_photons_keep_light(ball, options, .02, .004);
}

/// A room with two balls of satin metal, lit by `lamp`.
SceneText satin_room(const std::string& options, const std::string& gloss, const std::string& lamp,
                     const std::string& flags = "") {
  SceneText scene = start(options);
  room(scene);
  scene.light("lamp", lamp, flags)
      .material("satin", kSatin + gloss)
      .sphere("satin", Vec3(0, -.8f, -3), .6f, 32)
      .sphere("satin", Vec3(-1.2f, .6f, -3), .3f, 32);
  return scene;
}

// acceptance: Q3
TEST(CausticPictures, PhotonsOfSmallLightsKeepTheLightOfSatinMetal) {
  // One ball is below a pane.
  const auto point = [](const std::string& options) {
    SceneText scene = satin_room(
        options, ".18", "\"mib_light_point\" ( \"color\" 4 4 4, \"shadow\" on ) origin .8 1 -2.4");
    scene
        .material("pane",
                  "\"reflectivity\" 1, \"transparency\" 1, \"diffuse_weight\" 0, "
                  "\"refr_ior\" 1.5, \"thin_walled\" on, \"brdf_fresnel\" on")
        .box("pane", Vec3(-.6f, .2f, -3.6f), Vec3(.9f, .22f, -2));
    return scene;
  };
  // Narrow lobes, so that rays find the lamp as well.
  const auto disc = [](const std::string& options) {
    return satin_room(
        options, ".28",
        physical("400 400 400") + " origin .3 1.3 -2.8 direction .1 -1 -.1 disc .1 -1 -.1 .25 2 2",
        "visible on");
  };
  expect_photons_keep_light(point, "caustic off", .02, .004);
  expect_photons_keep_light(disc, "caustic on", .03, .002);
}

// Sunlit surfaces are sampled as lights, too; their glossy caustics belong to photons.
// acceptance: Q3
TEST(CausticPictures, PhotonsOfTheSunKeepTheLightOfSatinMetal) {
  const auto sunlit = [](const std::string& options) {
    SceneText scene = sunlit_room(options);
    scene.material("satin", kSatin + std::string(".18"))
        .sphere("satin", Vec3(-.3f, -.9f, -3), .5f, 32);
    return scene;
  };
  expect_photons_keep_light(sunlit, "caustic off", .06, .015);
}

// The varnish of a floor reflects a twentieth of the sun to walls, and more to grazing views.
// acceptance: Q3
TEST(CausticPictures, PhotonsOfTheSunKeepTheLightOfVarnish) {
  const auto sunlit = [](const std::string& options) {
    SceneText scene = sunlit_room(options);
    scene.material("varnish", kVarnish)
        .box("varnish", Vec3(-1.2f, -1.5f, -4), Vec3(1.2f, -1.4f, -2));
    return scene;
  };
  expect_photons_keep_light(sunlit, "caustic off", .03, .006);
}

TEST(PhotonAim, SendsAllLightThatMeetsTheSpheres) {
  // Two small mirrors far away: the flux that they receive is known.
  const Vec3 beside(.9f, .4f, 1);
  const double cosine = 3 / std::hypot(.9, .4, 3);  // from the lamps to the mirror beside
  const double of_point = .04 * std::numbers::pi * (1 + cosine);
  const struct {
    const char* light;
    double flux;  ///< on mirrors of side .2
  } kCases[] = {{"\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 4", of_point},
                {"\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction .6 0 -.8",
                 .04 * .8 * std::numbers::pi * 2},
                {"\"mib_light_spot\" ( \"color\" 1 1 1 ) origin 0 0 4 direction .1 0 -1 spread .8",
                 of_point}};
  for (const auto& c : kCases) {
    SceneText scene = caustic_scene();
    scene.lambert("floor", .5f)
        .material("mirror", kMetal)
        .square("floor", Vec3(0), 8, kUp)
        .square("mirror", Vec3(0, 0, 1), .1f, kUp)
        .square("mirror", beside, .1f, kUp)
        .light("lamp", c.light);
    const Probe probe(scene);
    const SharpCaustics sharp(probe.world());
    ASSERT_FALSE(sharp.empty());
    const PhotonAim aim(PhotonSource(probe.world(), probe.world().lights[0]), sharp.spheres(0));
    EXPECT_LT(aim.share(), .04f) << c.light;
    PhotonSettings settings;
    settings.globillum = false;
    settings.sharp = &sharp;
    settings.each.caustic = {.emit = 1 << 17};
    RayCounts counts;
    PhotonBalance balance;
    trace_photons(probe.world(), settings, counts, &balance);
    EXPECT_NEAR(balance.escaped.y, .8 * c.flux, .01 * c.flux) << c.light;
  }
}

}  // namespace caustics_test
}  // namespace oriel::cross_method
