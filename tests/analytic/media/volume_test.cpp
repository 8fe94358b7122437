// SPDX-License-Identifier: Apache-2.0
// Media with multiple scattering, and attenuation of light.
#include <array>
#include <numeric>

#include "support/probe.h"
#include "transport/photon/photon_trace.h"

namespace oriel::testing {
namespace volume_test {

const Vec3 kUp(0, 1, 0);  // the medium ends along y

const char* const kSun = "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction 0 -1 0";

/// A medium up to a height above a black ground; a sun from straight above with irradiance pi.
SceneText slab(float depth, float albedo, float g, const char* light = kSun) {
  SceneText scene;
  return scene.material("black", "\"reflectivity\" 0, \"diffuse\" 0 0 0")
      .square("black", Vec3(0), 4000, kUp)
      .light("sun", light)
      .camera(fmt::format("focal 1 aperture 1 aspect 1 resolution 32 32 volume \"parti_volume\" ( "
                          "\"mode\" 1, \"height\" {}, \"extinction\" 1, \"scatter\" {} {} {}, "
                          "\"r\" 1, \"g1\" {} )",
                          depth, albedo, albedo, albedo, g));
}

/// Chandrasekhar's H of an even phase function, by its integral equation in the form that converges
/// for all albedos: 1 / H(mu) = sqrt(1 - w) + w / 2 int_0^1 H(m) m / (mu + m) dm.
/// Source: Chandrasekhar, "Radiative Transfer", 1960, section 38.
double chandrasekhar_h(double albedo, double mu) {
  constexpr int kCells = 400;
  std::array<double, kCells> h;
  h.fill(1);
  const auto at = [&](double x) {
    double sum = 0;
    for (int i = 0; i < kCells; ++i) {
      const double m = (i + .5) / kCells;
      sum += h[static_cast<std::size_t>(i)] * m / (x + m) / kCells;
    }
    return 1 / (std::sqrt(1 - albedo) + albedo / 2 * sum);
  };
  for (int k = 0; k < 60; ++k) {
    std::array<double, kCells> next;
    for (int i = 0; i < kCells; ++i) next[static_cast<std::size_t>(i)] = at((i + .5) / kCells);
    for (int i = 0; i < kCells; ++i) {
      const auto j = static_cast<std::size_t>(i);
      h[j] = (h[j] + next[j]) / 2;
    }
  }
  return at(mu);
}

TEST(ScatteringMedium, DeepMediumReflectsAsChandrasekharFound) {
  EXPECT_NEAR(chandrasekhar_h(1, 1), 2.9078, .005);  // his table XI
  for (const float albedo : {.5f, .9f}) {
    const Probe probe(slab(30, albedo, 0));
    for (const float degrees : {0.0f, 60.0f}) {
      // Of a flux pi F straight down, radiance w / 4 F mu0 / (mu + mu0) H(mu) H(mu0).
      const double mu = std::cos(double(degrees) * M_PI / 180);
      const double exact =
          albedo / 4 / (1 + mu) * chandrasekhar_h(albedo, 1) * chandrasekhar_h(albedo, mu);
      expect_exact(fmt::format("albedo {}, seen at {} degrees", albedo, degrees),
                   probe.onto(Vec3(0, 30, 0), kUp, degrees, 1 << 14, 1), static_cast<float>(exact),
                   .03f);
    }
  }
}

/// What a slab sends up, and lets down to its ground, of light from straight above: photons one by
/// one, by their optical depth alone.
struct Shares {
  double up = 0, down = 0;
};
Shares walk_slab(float depth, float albedo, float g, int photons) {
  Shares s;
  for (int i = 0; i < photons; ++i) {
    sampling::Sampler u(3, 5, static_cast<std::uint32_t>(i), 77);
    double z = 0, mu = 1;  // down from the top
    for (int k = 0; k < 500; ++k) {
      z -= mu * std::log(1 - double(u.next_1d()));
      if (z < 0 || z > double(depth)) break;
      if (u.next_1d() >= albedo) {
        mu = 0;
        break;
      }
      const double x = double(u.next_1d()), gg = double(g);
      double c = 1 - 2 * x;
      if (g != 0) {
        const double a = (1 - gg * gg) / (1 - gg + 2 * gg * x);
        c = (1 + gg * gg - a * a) / (2 * gg);
      }
      const double phi = 2 * M_PI * double(u.next_1d());
      mu = mu * c + std::sqrt(std::max(0.0, (1 - mu * mu) * (1 - c * c))) * std::cos(phi);
      mu = std::clamp(mu, -1.0, 1.0);
    }
    if (mu != 0 && z < 0) s.up += 1.0 / photons;
    if (mu != 0 && z > double(depth)) s.down += 1.0 / photons;
  }
  return s;
}

TEST(ScatteringMedium, SlabTransmissionMatchesPhotons) {
  for (const float g : {0.0f, .75f, -.4f})
    for (const float albedo : {.6f, 1.0f}) {
      const float depth = 2;
      const Shares exact = walk_slab(depth, albedo, g, 1 << 17);
      // A card on the ground, too small to affect the medium, viewed from a short distance.
      SceneText scene = slab(depth, albedo, g);
      scene.lambert("card", 1).square("card", Vec3(0, 1e-3f, 0), .005f, kUp);
      const Measured m = Probe(scene).onto(Vec3(0, 1e-3f, 0), kUp, 0, 1 << 15, 1e-3f);
      const double error = std::sqrt(exact.down * (1 - exact.down) / (1 << 17));
      EXPECT_NEAR(m.mean.x, exact.down, 4 * std::hypot(double(m.error.x), error) + .004)
          << "albedo " << albedo << ", g " << g;
      EXPECT_LT(m.error.x, .02f);
      figure(fmt::format("slab, albedo {}, g {}", albedo, g), exact.down, double(m.mean.x),
             double(m.error.x));
    }
}

TEST(ScatteringMedium, PhotonsScatterLikePaths) {
  for (const float g : {0.0f, .75f}) {
    const float depth = 2, albedo = .9f;
    const Shares exact = walk_slab(depth, albedo, g, 1 << 17);
    // All but straight down: photons of a sun would pass beside the ground.
    const Probe probe(slab(depth, albedo, g,
                           "\"physical_light\" ( \"color\" 1 1 1 ) origin 0 3 0 direction 0 -1 0 "
                           "spread .99995"));
    PhotonSettings settings{.depth = {200, 200, 200}};
    settings.each.global.emit = 1 << 15;
    PhotonBalance balance;
    RayCounts counts;
    trace_photons(probe.world(), settings, counts, &balance);
    EXPECT_NEAR(balance.escaped.x / balance.emitted.x, exact.up, .01) << g;
    EXPECT_NEAR(balance.escaped.x + balance.absorbed.x + balance.stopped.x, balance.emitted.x,
                1e-4 * balance.emitted.x);
  }
}

TEST(ScatteringMedium, FurnaceIsUniform) {
  // A surrounding sky, a medium without absorption and a white ground: uniform radiance.
  SceneText scene;
  scene.lambert("white", 1)
      .square("white", Vec3(0), 4000, kUp)
      .uniform_sky(1)
      .camera(
          "focal 1 aperture 1 aspect 1 resolution 32 32 volume \"parti_volume\" ( \"mode\" 1, "
          "\"height\" 2, \"extinction\" .7, \"scatter\" 1 1 1, \"r\" .5, \"g1\" .6, "
          "\"g2\" -.3 )");
  const Probe probe(scene);
  expect_exact("down", probe.ray(Vec3(0, 5, 0), Vec3(0, -1, .2f), 1 << 14), 1.0f, .03f);
  expect_exact("up", probe.ray(Vec3(0, .5f, 0), Vec3(0, 1, .2f), 1 << 14), 1.0f, .03f);
}

TEST(ScatteringMedium, LampsNearTheRayHaveLittleNoise) {
  // A point lamp of intensity I at a height above the ray: single scattering is sigma I / (4 pi)
  // int exp(-sigma (t + d)) / d^2 dt, d the distance to the lamp.
  const double extinction = .1, length = 12;
  for (const double height : {.1, .5, 3.0}) {
    SceneText scene;
    scene.material("black", "\"reflectivity\" 0, \"diffuse\" 0 0 0")
        .square("black", Vec3(0, 0, -12), 50, Vec3(0, 0, 1))
        .light("lamp", fmt::format("\"physical_light\" ( \"color\" 4 4 4 ) origin 0 {} -5", height))
        .camera(
            "focal 1 aperture 1 aspect 1 resolution 32 32 volume \"parti_volume\" ( "
            "\"extinction\" .1, \"scatter\" 1 1 1 )");
    double exact = 0;
    constexpr int kCells = 100000;
    for (int i = 0; i < kCells; ++i) {
      const double t = length * (i + .5) / kCells, d = std::hypot(t - 5, height);
      exact +=
          extinction / (4 * M_PI) * std::exp(-extinction * (t + d)) / (d * d) * length / kCells;
    }
    const Measured m = Probe(scene).direct_only().ray(Vec3(0), Vec3(0, 0, -1), 4096);
    expect_exact(fmt::format("height {}", height), m, static_cast<float>(exact), .03f);
    // Of one sample, a relative deviation of about one half; by transmittance alone 5 at .1.
    EXPECT_LT(m.error.x * 64, static_cast<float>(exact)) << height;
  }
}

/// Point lamps and narrow spots beside the -z axis, in fog: those numbered from `from` to `to` - 1.
SceneText lamps_in_fog(int from, int to, bool listed) {
  SceneText scene;
  scene.material("black", "\"reflectivity\" 0, \"diffuse\" 0 0 0")
      .square("black", Vec3(0, 0, -12), 50, Vec3(0, 0, 1));
  std::string names;
  for (int i = from; i < to; ++i) {
    const float z = -.4f * static_cast<float>(i) - .8f,
                height = .3f + .4f * static_cast<float>(i % 3);
    // A spot lights at most .4 scene units of the axis.
    scene.light(fmt::format("lamp{}", i),
                i % 2 == 0
                    ? fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} ) origin 0 {1} {2}",
                                  1 + i % 5, height, z)
                    : fmt::format("\"physical_light\" ( \"color\" 30 30 30, \"cone\" .95 ) "
                                  "origin 0 {} {} direction 0 -1 0 spread .95",
                                  height / 2, z));
    names += fmt::format("{}\"lamp{}_i\"", i > from ? ", " : "", i);
  }
  return scene.camera(fmt::format(
      "focal 1 aperture 1 aspect 1 resolution 32 32 volume \"parti_volume\" ( \"extinction\" .1, "
      "\"scatter\" 1 1 1, \"r\" .5, \"g1\" .4{} )",
      listed ? fmt::format(", \"lights\" [ {} ]", names) : std::string()));
}

TEST(ScatteringMedium, SomeOfManyLampsBringTheLightOfAll) {
  constexpr int kLamps = 24, kAllAsked = 4;
  const auto measure = [](const SceneText& scene, int samples) {
    return Probe(scene).direct_only().ray(Vec3(0), Vec3(0, 0, -1), samples);
  };
  Measured all;
  for (int i = 0; i < kLamps; i += kAllAsked) {
    const Measured some = measure(lamps_in_fog(i, i + kAllAsked, false), 1 << 17);
    all.mean += some.mean;
    all.error = Rgb(std::hypot(all.error.x, some.error.x));
  }
  for (const bool listed : {false, true}) {
    const Measured chosen = measure(lamps_in_fog(0, kLamps, listed), 1 << 20);
    const float error = std::hypot(chosen.error.x, all.error.x);
    EXPECT_NEAR(chosen.mean.x, all.mean.x, 3.5f * error) << (listed ? "listed" : "all");
    EXPECT_LT(error, .01f * all.mean.x) << "too noisy to show anything";
    figure(listed ? "lamps of a list" : "lamps", all.mean.x, chosen.mean.x, error);
  }
}

TEST(VolumeNodes, FogMayFadeLightRays) {
  const auto lit = [](const char* lightrays) {
    SceneText scene;
    scene.lambert("card", 1)
        .square("card", Vec3(0), 1, kUp)
        .light("lamp", "\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 2 0")
        .camera(fmt::format("focal 1 aperture 1 aspect 1 resolution 32 32 volume \"mib_volume\" ( "
                            "\"max\" 8, \"lightrays\" {} )",
                            lightrays));
    return Probe(scene).direct_only().onto(Vec3(0), kUp, 0, 64, .8f);
  };
  expect_exact("off", lit("off"), .9f, .01f);
  expect_exact("on", lit("on"), .9f * .75f, .01f);
}

/// Along -z to a lamp of radiance 3 at a distance of 4, in a mirror or not.
Measured lamp_in(const char* volume, bool mirrored) {
  const float z = mirrored ? 1 : -4;  // at a distance of 3 from a mirror at z = -2
  SceneText scene;
  scene
      .light("lamp",
             fmt::format("\"physical_light\" ( \"color\" 12 12 12 ) origin 0 0 {} direction 0 0 {} "
                         "rectangle 1 0 0 0 1 0 3 3",
                         z, mirrored ? -1 : 1),
             "visible on")
      .camera(fmt::format("focal 1 aperture 1 aspect 1 resolution 32 32 volume {}", volume));
  if (mirrored)
    scene
        .material("mirror",
                  "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
                  "\"refl_gloss\" 1")
        .square("mirror", Vec3(0, 0, -2), 5, Vec3(0, 0, 1));
  return Probe(scene).ray(Vec3(0), Vec3(0, 0, -1), 1 << 14);
}

TEST(VolumeNodes, VisibleLightsAreInTheMedium) {
  for (const bool mirrored : {false, true}) {
    // Of both stretches, 2 and 3 in the mirror.
    const float depth = mirrored ? 5 : 4;
    const auto fog = [](float d) { return d / 10; };
    const float seen = mirrored ? (1 - fog(2)) * (1 - fog(3)) : 1 - fog(4);
    expect_exact("smoke", lamp_in("\"parti_volume\" ( \"extinction\" .2 )", mirrored),
                 3 * std::exp(-.2f * depth), .01f);
    expect_exact("fog", lamp_in("\"mib_volume\" ( \"color\" .5 .5 .5, \"max\" 10 )", mirrored),
                 3 * seen + .5f * (1 - seen), .01f);
  }
}

TEST(VolumeNodes, VisibleLightsAreBehindScatteredLight) {
  // A thin medium between the eye and the front of the lamp, whose light it scatters once.
  const float extinction = .01f, distance = 4;
  constexpr int kCells = 200, kSide = 40;
  double scattered = 0;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kSide * kSide; ++j) {
      const double z = distance * (i + .5) / kCells;
      const double x = (j % kSide + .5) / kSide - .5, y = (j / kSide + .5) / kSide - .5;
      const double d2 = x * x + y * y + z * z;
      scattered += double(extinction) / (4 * M_PI) * 3 * z / (d2 * std::sqrt(d2)) * distance /
                   kCells / (kSide * kSide);
    }
  const Measured m = lamp_in("\"parti_volume\" ( \"extinction\" .01, \"scatter\" 1 1 1 )", false);
  expect_exact("fog", m, 3 * std::exp(-extinction * distance) + static_cast<float>(scattered),
               .002f);
}

SceneText marched(const char* shader, const char* parameters) {
  SceneText scene;
  return scene.statement(shader)
      .emitter("glow", .5f)
      .square("glow", Vec3(0, 0, -4), 50, Vec3(0, 0, 1))
      .camera(fmt::format("focal 1 aperture 1 aspect 1 resolution 32 32 "
                          "volume \"mib_ray_marcher\" ( \"shader\" \"s\", {} )",
                          parameters));
}
Measured along_z(const SceneText& scene) {
  return Probe(scene).direct_only().ray(Vec3(0), Vec3(0, 0, -1), 64);
}

TEST(RayMarcher, IntegratesAShaderAlongTheRay) {
  const char* const kPlace = "shader \"s\" \"test_place\" ( \"scale\" 0 0 -.25 )";
  // int_0^4 z / 4 dz = 2, plus the emission of .5; the trapezoid rule is exact for any step.
  for (const char* parameters : {"\"num\" 0", "\"num\" 2", "\"num\" 7", "\"distance\" .3"})
    expect_exact(parameters, along_z(marched(kPlace, parameters)), Rgb(.5f, .5f, 2.5f));
}

TEST(RayMarcher, RefinesWhereNeighboursDiffer) {
  // Light behind z = -1.3 alone: a stretch of 2.7 of 1.
  const char* const kStep =
      "shader \"p\" \"test_place\" ( \"scale\" 0 0 -.2 ) "
      "shader \"s\" \"mib_texture_checkerboard\" ( \"coord\" = \"p\", \"xsize\" 1, "
      "\"ysize\" 1, \"zsize\" .26, "
      "\"color001\" 1 1 1 )";
  const auto error = [&](const char* parameters) {
    return std::abs(along_z(marched(kStep, parameters)).mean.x - .5f - 2.7f);
  };
  EXPECT_GT(error("\"num\" 2"), .1f);
  EXPECT_LT(error("\"num\" 2, \"subdiv\" 12, \"contrast\" .1 .1 .1"), 2e-3f);
  EXPECT_LT(error("\"num\" 2, \"distance\" .001"), 2e-3f);
  // Differences below the contrast are left alone.
  EXPECT_GT(error("\"num\" 2, \"subdiv\" 12, \"contrast\" 2 2 2"), .1f);
}

}  // namespace volume_test
}  // namespace oriel::testing
