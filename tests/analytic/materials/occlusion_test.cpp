// SPDX-License-Identifier: Apache-2.0
// Ambient occlusion: closed forms of unoccluded fractions, and the kinds of light it affects.
#include <limits>

#include "support/probe.h"
#include "transport/path/occlusion.h"

namespace oriel::testing {
namespace occlusion_test {

/// Half the side of what stands for an infinite plane. Floors are small: rays leave a surface as
/// far as its corners' rounding asks.
constexpr float kFar = 200, kFloor = .01f;

/// A white Lambert floor with those occlusion parameters.
SceneText floor_with(const std::string& occlusion) {
  SceneText scene;
  scene.lambert("floor", 1, "\"ao_on\" on, " + occlusion).square("floor", Vec3(0), kFloor, kUp);
  return scene;
}

/// Ambient light 1 alone, black where occluded: the picture is the share of free sky.
std::string ambient_alone(float distance) {
  return fmt::format(
      "\"ao_do_details\" 0, \"ao_ambient\" 1 1 1, \"ao_dark\" 0 0 0, \"ao_distance\" {}", distance);
}

Measured directly_below(const SceneText& scene, float height, int samples = 65536) {
  return Probe(scene).direct_only().onto(Vec3(0), kUp, 30, samples, .5f * height);
}

/// Occluded share under an infinite slab at height h, k = h / D: a direction of cosine c meets it
/// at h / c, so it is the integral of (1 - k / c) 2 c dc over c from k to 1.
float slab_occlusion(float k) { return k < 1 ? (1 - k) * (1 - k) : 0; }

/// Occluded share beside an infinite wall at x, k = x / D. Cosine-distributed directions have their
/// component toward the wall distributed as (2 / pi) sqrt(1 - s^2): the integral of
/// (1 - k / s) times that over s from k to 1.
float corner_occlusion(float k) {
  if (k >= 1) return 0;
  const float q = std::sqrt(1 - k * k);
  return 2 / kPi * (.5f * (std::acos(k) + k * q) - k * std::log((1 + q) / k));
}

// acceptance: O1
TEST(Occlusion, SlabMatchesItsClosedForm) {
  constexpr float kHeight = .4f;
  for (const float k : {.05f, .25f, .5f, .8f, .95f}) {
    SceneText scene = floor_with(ambient_alone(kHeight / k));
    scene.lambert("slab", 0).square("slab", Vec3(0, 0, kHeight), kFar, -kUp);
    expect_exact(fmt::format("free sky under a slab at {} of the distance", k),
                 directly_below(scene, kHeight), 1 - slab_occlusion(k));
  }
}

// acceptance: O1
TEST(Occlusion, CornerMatchesItsClosedForm) {
  constexpr float kAside = .4f;
  for (const float k : {.02f, .1f, .3f, .6f, .9f}) {
    SceneText scene = floor_with(ambient_alone(kAside / k));
    scene.lambert("wall", 0).polygon(
        "wall", {Vec3(-kAside, -kFar, -1), Vec3(-kAside, kFar, -1), Vec3(-kAside, kFar, kFar),
                 Vec3(-kAside, -kFar, kFar)});
    expect_exact(fmt::format("free sky beside a wall at {} of the distance", k),
                 directly_below(scene, kAside), 1 - corner_occlusion(k));
  }
}

// acceptance: O1
TEST(Occlusion, EndsAtItsDistance) {
  // All of the slab is farther than the distance: nothing is occluded, without any noise.
  for (const float k : {1.001f, 2.0f, 100.0f}) {
    SceneText scene = floor_with(ambient_alone(.4f / k));
    scene.lambert("slab", 0).square("slab", Vec3(0, 0, .4f), kFar, -kUp);
    EXPECT_EQ(directly_below(scene, .4f, 4096).mean, Rgb(1)) << k;
  }
}

// acceptance: O1
TEST(Occlusion, DistanceZeroIsAnyDistance) {
  // Without a distance each surface counts fully, however far it is.
  SceneText slab = floor_with(ambient_alone(0));
  slab.lambert("slab", 0).square("slab", Vec3(0, 0, 5), 1e6f, -kUp);
  EXPECT_NEAR(directly_below(slab, 5, 4096).mean.x, 0, 1e-6f);
  SceneText wall = floor_with(ambient_alone(0));
  constexpr float kEnd = 1e5f;
  wall.lambert("wall", 0).polygon("wall", {Vec3(-5, -kEnd, -1), Vec3(-5, kEnd, -1),
                                           Vec3(-5, kEnd, kEnd), Vec3(-5, -kEnd, kEnd)});
  expect_exact("free sky beside a wall, any distance", directly_below(wall, 1), .5f);
}

// acceptance: O1
TEST(Occlusion, ShortRaysIgnoreDistantObjects) {
  // Balls all around, none near: short rays do not look at them, which saves their time.
  SceneText scene;
  scene.lambert("grey", .5f).square("grey", Vec3(0), kFar, kUp);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j)
      scene.sphere("grey", Vec3(float(i) * 2 - 5, float(j) * 2 - 5, 2 + .1f * float(i)), .95f, 12);
  const Probe probe(scene);
  RayCounts counts;
  const auto share = [&](float distance, int i) {
    ShadingPoint point;
    point.position = Vec3(float(i % 20) * .4f - 4, float(i / 20) * .4f - 4, 0);
    point.normal = point.geometric_normal = kUp;
    point.world = &probe.world();
    sampling::Sampler sampler(i, 0, 0);
    return free_share(probe.world(), point, kUp, distance, 64, sampler, counts);
  };
  for (int i = 0; i < 400; ++i) {
    EXPECT_EQ(share(.2f, i), 1) << i;
    EXPECT_LT(share(0, i), 1) << i;
  }
  EXPECT_EQ(counts.probe, 2 * 400u * 64);
}

// acceptance: O1
TEST(Occlusion, SamplesAreTheMaximumRaysPerPixel) {
  for (const int samples : {1, 16, 64}) {
    SceneText scene = floor_with(fmt::format("\"ao_samples\" {}, {}", samples, ambient_alone(10)));
    const Probe probe(scene);
    for (const float paths : {1.0f, 4.0f, 256.0f}) {
      RayCounts counts;
      const int traced = static_cast<int>(paths);
      for (int i = 0; i < traced; ++i) {
        sampling::Sampler sampler(3, 4, static_cast<std::uint32_t>(i));
        const PathSettings settings{.indirect = false, .paths_of_pixel = paths};
        trace_path(probe.world(), {Vec3(0, 0, 1), -kUp, 1, 0, 0}, Vec2(0), settings, sampler,
                   counts);
      }
      // One ray of each path at least.
      EXPECT_EQ(counts.probe, static_cast<std::uint64_t>(std::max(samples, traced)))
          << samples << " samples, " << paths << " paths";
    }
  }
}

/// A floor of albedo .6 under an emissive slab of radiance 1, with a point light between them.
struct UnderSlab {
  static constexpr float kHeight = .4f, kAlbedo = .6f;
  /// The slab is .4 of the distance away: share of free sky.
  static constexpr float kDistance = 1;
  static constexpr float kFree = 1 - (1 - kHeight) * (1 - kHeight);

  Measured total;
  AovValues parts;

  explicit UnderSlab(const std::string& occlusion, const std::string& glow = "1 1 1",
                     bool lamp = true) {
    SceneText scene;
    scene.lambert("floor", kAlbedo, fmt::format("\"ao_distance\" {}, {}", kDistance, occlusion))
        .square("floor", Vec3(0), kFloor, kUp)
        .material("slab", "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" " + glow)
        .square("slab", Vec3(0, 0, kHeight), kFar, -kUp);
    if (lamp)
      scene.light("lamp", fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} ) origin 0 0 .3",
                                      4 * kPi * .09f));
    const Probe probe(scene);
    total = probe.onto(Vec3(0), kUp, 30, 65536, .25f);
    constexpr int kPaths = 4096;
    for (int i = 0; i < kPaths; ++i) {
      sampling::Sampler sampler(1, 2, static_cast<std::uint32_t>(i));
      PathRecord one(RecordRequest{.aovs = true});
      RayCounts counts;
      trace_path(probe.world(), {Vec3(.1f, 0, .25f), normalize(Vec3(-.1f, 0, -.25f)), 1, 0, 0},
                 Vec2(0), {}, one, sampler, counts);
      for (std::size_t c = 0; c < kAovs; ++c)
        parts.result[c] += one.aovs->result[c] / static_cast<float>(kPaths);
    }
  }
};

// acceptance: O2
TEST(Occlusion, DetailsMultiplyIndirectLightAlone) {
  using S = UnderSlab;
  UnderSlab off("\"ao_on\" off");
  expect_exact("floor under a glowing slab and a lamp", off.total, 2 * S::kAlbedo);
  for (const float dark : {0.0f, .2f, .7f}) {
    UnderSlab on(fmt::format("\"ao_on\" on, \"ao_do_details\" 1, \"ao_dark\" {0} {0} {0}", dark));
    const float open = S::kFree + dark * (1 - S::kFree);
    expect_exact(fmt::format("indirect light occluded, dark {}", dark), on.total,
                 S::kAlbedo * (1 + open));
    EXPECT_EQ(on.parts[Aov::Diffuse], off.parts[Aov::Diffuse])
        << "direct light is untouched, to the last bit";
    EXPECT_GT(on.parts[Aov::Diffuse].x, .5f * S::kAlbedo);
    EXPECT_NEAR(on.parts[Aov::Indirect].x / off.parts[Aov::Indirect].x, open, .02f * open);
  }
}

// acceptance: O2
TEST(Occlusion, DetailsDimTheSkyInAllEstimators) {
  // A black wall hides half of a uniform sky; the rest is dimmed by the distance of the wall.
  constexpr float kAside = .4f, kDark = .3f, kEnd = 1e5f;
  const float free = 1 - corner_occlusion(kAside);
  for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
    SceneText scene = floor_with(
        fmt::format("\"ao_do_details\" 1, \"ao_distance\" 1, \"ao_dark\" {0} {0} {0}", kDark));
    scene.uniform_sky(1).lambert("wall", 0).polygon(
        "wall", {Vec3(-kAside, -kEnd, -1), Vec3(-kAside, kEnd, -1), Vec3(-kAside, kEnd, kEnd),
                 Vec3(-kAside, -kEnd, kEnd)});
    expect_exact(fmt::format("sky beside a wall, dimmed, estimator {}", static_cast<int>(e)),
                 Probe(scene).estimator(e).onto(Vec3(0), kUp, 30, 65536, .2f),
                 .5f * (free + kDark * (1 - free)));
  }
}

// acceptance: O3
TEST(Occlusion, ColouredDetailsShowNeighboursLessTheDarkness) {
  using S = UnderSlab;
  const Vec3 glow(1, .5f, .25f);
  for (const float dark : {0.0f, .2f, 1.0f}) {
    const UnderSlab on(
        fmt::format("\"ao_on\" on, \"ao_do_details\" 2, \"ao_dark\" {0} {0} {0}", dark),
        text_of(glow), false);
    const float share = S::kFree + (1 - dark) * (1 - S::kFree);
    expect_exact(fmt::format("neighbours' colours, dark {}", dark), on.total,
                 glow * (S::kAlbedo * share));
  }
}

// acceptance: O3
TEST(Occlusion, DarknessOfColoursIsByChannel) {
  using S = UnderSlab;
  const UnderSlab on("\"ao_on\" on, \"ao_do_details\" 2, \"ao_dark\" 0 .5 1", "1 1 1", false);
  Rgb expected;
  for (int k = 0; k < 3; ++k)
    expected[k] = S::kAlbedo * (S::kFree + (1 - .5f * static_cast<float>(k)) * (1 - S::kFree));
  expect_exact("darkness by channel", on.total, expected);
}

// acceptance: O3
TEST(Occlusion, EmissiveBallBrightensTheFloorBelow) {
  const auto floor_below = [](int details) {
    SceneText scene = floor_with(
        fmt::format("\"ao_do_details\" {}, \"ao_distance\" 2, \"ao_dark\" .1 .1 .1", details));
    scene.uniform_sky(.2f).emitter("glow", 3).sphere("glow", Vec3(-.1f, 0, .6f), .5f, 32);
    return Probe(scene).onto(Vec3(0), kUp, 80, 65536, .4f);
  };
  const Measured none = floor_below(0), dark = floor_below(1), colours = floor_below(2);
  // Details 1 has a dark spot under the emitter, details 2 has none.
  EXPECT_LT(dark.mean.x, .75f * none.mean.x);
  EXPECT_GT(colours.mean.x, 1.25f * dark.mean.x);
  EXPECT_GT(colours.mean.x, .9f * none.mean.x);
  figure("glowing ball: details 1 over none", .4, dark.mean.x / none.mean.x, 0);
  figure("glowing ball: details 2 over none", 1, colours.mean.x / none.mean.x, 0);
}

// acceptance: O3
TEST(Occlusion, RedWallTintsTheFloorBesideIt) {
  // A lit red wall in a grey sky.
  const auto beside = [](int details) {
    SceneText scene = floor_with(
        fmt::format("\"ao_do_details\" {}, \"ao_distance\" 1, \"ao_dark\" 0 0 0", details));
    scene.uniform_sky(.3f)
        .material("red", "\"reflectivity\" 0, \"diffuse\" .9 0 0")
        .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction -1 0 0")
        .polygon("red", {Vec3(-.2f, -9, 0), Vec3(-.2f, 9, 0), Vec3(-.2f, 9, 9), Vec3(-.2f, -9, 9)});
    return Probe(scene).onto(Vec3(0), kUp, 30, 65536, .3f);
  };
  const Measured dark = beside(1), colours = beside(2);
  const auto tint = [](const Measured& m) { return m.mean.x / m.mean.z; };
  EXPECT_GT(colours.mean.x, 1.15f * dark.mean.x) << "red light that details 1 takes away";
  EXPECT_GT(tint(colours), 1.1f);
  EXPECT_GT(tint(colours), .97f * tint(dark));
  figure("red over blue beside a red wall, details 1", 0, tint(dark), 0);
  figure("red over blue beside a red wall, details 2", 0, tint(colours), 0);
}

// acceptance: O4
TEST(Occlusion, AmbientLightIsAttenuatedByIt) {
  for (const int details : {0, 1, 2}) {
    SceneText scene;
    scene
        .lambert(
            "floor", .5f,
            fmt::format("\"ao_on\" on, \"ao_do_details\" {}, \"ao_distance\" 1, \"ao_dark\" .2 "
                        ".5 1, \"ao_ambient\" .8 .4 .2",
                        details))
        .square("floor", Vec3(0), kFloor, kUp)
        .lambert("slab", 0)
        .square("slab", Vec3(0, 0, .4f), kFar, -kUp);
    const float occluded = slab_occlusion(.4f);
    const Rgb open = Rgb(1 - occluded) + Rgb(.2f, .5f, 1) * occluded;
    expect_exact(fmt::format("ambient light, details {}", details), directly_below(scene, .4f),
                 open * Rgb(.8f, .4f, .2f) * .5f);
  }
}

// acceptance: O4
TEST(Occlusion, NeedsIndirectOrAmbientLight) {
  const auto picture = [](const std::string& occlusion) {
    SceneText scene;
    scene.uniform_sky(1)
        .material("m", "\"reflectivity\" .3, \"refl_gloss\" .4, " + occlusion)
        .square("m", Vec3(0, 0, -2), 1, kUp)
        .box("m", Vec3(-.4f, -.4f, -2), Vec3(.2f, .3f, -1.6f))
        .light("lamp", "\"physical_light\" ( \"color\" 20 20 20 ) origin 1 1 0");
    return Probe(scene).direct_only().picture(8192);
  };
  const Measured off = picture("\"ao_on\" off");
  for (const int details : {0, 1, 2}) {
    const Measured on = picture(fmt::format("\"ao_on\" on, \"ao_do_details\" {}", details));
    EXPECT_EQ(on.mean, off.mean) << details;
    EXPECT_EQ(on.counts.probe, 0u) << details;
    EXPECT_EQ(on.counts.rays(), off.counts.rays()) << details;
  }
  const Measured ambient = picture("\"ao_on\" on, \"ao_ambient\" .1 .1 .1");
  EXPECT_GT(ambient.mean.x, off.mean.x);
  EXPECT_GT(ambient.counts.probe, 0u);
}

// acceptance: O4
TEST(Occlusion, IsAbsentWithoutSamplesOrWhenOff) {
  const auto picture = [](const std::string& occlusion) {
    SceneText scene;
    scene.uniform_sky(1).lambert("m", .7f, occlusion).box("m", Vec3(-1, -1, -3), Vec3(1, 1, -2));
    return Probe(scene).picture(4096);
  };
  const Measured plain = picture("\"ao_on\" off, \"ao_ambient\" 1 1 1, \"ao_do_details\" 2");
  const Measured none = picture("\"ao_on\" on, \"ao_ambient\" 1 1 1, \"ao_samples\" 0");
  EXPECT_EQ(plain.counts.probe + none.counts.probe, 0u);
  EXPECT_EQ(plain.mean, none.mean);
}

// acceptance: O5
TEST(Occlusion, DarkIsTheMultiplierInAClosedBox) {
  const Rgb dark(.2f, .6f, 1);
  const auto in_box = [](const std::string& occlusion) {
    SceneText scene;
    scene.emitter("wall", 1)
        .box("wall", Vec3(-1), Vec3(1), true)
        .lambert("card", .5f, occlusion)
        .square("card", Vec3(0, 0, -.9f), .3f, kUp);
    return Probe(scene).onto(Vec3(0, 0, -.9f), kUp, 20, 4096);
  };
  expect_exact("card in a glowing box", in_box("\"ao_on\" off"), .5f, 1e-4f);
  expect_exact("card in a glowing box, occluded",
               in_box("\"ao_on\" on, \"ao_distance\" 0, \"ao_dark\" .2 .6 1"), dark * .5f, 1e-4f);
  // A reach far beyond the box: all is occluded but the 1e-6 that walls are away of it.
  expect_exact("card in a glowing box, far reach",
               in_box("\"ao_on\" on, \"ao_distance\" 1e6, \"ao_dark\" .2 .6 1"), dark * .5f, 1e-4f);
}

// Second bounces are not dimmed again: occlusion is a detail of what the camera sees.
TEST(Occlusion, ActsBeforeTheFirstDiffuseBounceAlone) {
  const auto seen = [](const std::string& floor, const std::string& wall) {
    SceneText scene;
    scene.lambert("wall", .5f, "\"additional_color\" 1 1 1, \"ao_distance\" 0, " + wall)
        .box("wall", Vec3(-1), Vec3(1), true)
        .lambert("card", .5f, floor)
        .square("card", Vec3(0, 0, -.9f), .3f, kUp);
    return Probe(scene).onto(Vec3(0, 0, -.9f), kUp, 20, 16384);
  };
  const Measured plain = seen("\"ao_on\" off", "\"ao_on\" off");
  const Measured walls = seen("\"ao_on\" off", "\"ao_on\" on");
  EXPECT_EQ(walls.mean, plain.mean);
  EXPECT_EQ(walls.counts.probe, 0u);
}

// acceptance: B3, O1
TEST(Occlusion, CutOutSurfacesOccludeByTheirShareAlone) {
  for (const float opacity : {0.0f, .5f, 1.0f}) {
    SceneText scene;
    scene
        .lambert("floor", 1,
                 "\"ao_on\" on, \"ao_do_details\" 0, \"ao_distance\" 1, \"ao_dark\" 0 0 0, "
                 "\"ao_ambient\" 1 1 1")
        .square("floor", Vec3(0), .01f, kUp)
        .lambert("slab", 0, fmt::format("\"cutout_opacity\" {}", opacity))
        .square("slab", Vec3(0, 0, .4f), 200, -kUp);
    // Of the hemisphere (1 - .4)^2 counts as near, where the slab exists.
    expect_exact(fmt::format("free sky under a slab of opacity {}", opacity),
                 Probe(scene).direct_only().onto(Vec3(0), kUp, 30, 65536, .2f), 1 - opacity * .36f);
  }
  // Nothing is there: details change nothing.
  for (const int details : {1, 2}) {
    SceneText scene;
    scene.uniform_sky(1)
        .lambert("floor", 1,
                 fmt::format("\"ao_on\" on, \"ao_do_details\" {}, \"ao_distance\" 1, "
                             "\"ao_dark\" 0 0 0",
                             details))
        .square("floor", Vec3(0), .01f, kUp)
        .lambert("slab", 0, "\"cutout_opacity\" 0")
        .square("slab", Vec3(0, 0, .4f), 200, -kUp);
    expect_exact(fmt::format("sky through a slab that is cut out, details {}", details),
                 Probe(scene).onto(Vec3(0), kUp, 30, 65536, .2f), 1);
  }
}

// acceptance: O3, E1
TEST(Occlusion, ColouredDetailsWithoutDarknessAreTheLightThatIsThere) {
  // With ao_dark 0 nothing is taken away and nothing may be added.
  const auto beside_lamp = [](const char* on) {
    SceneText scene;
    scene
        .lambert("floor", 1,
                 fmt::format("\"ao_on\" {}, \"ao_do_details\" 2, \"ao_distance\" 10, \"ao_dark\" 0 "
                             "0 0",
                             on))
        .square("floor", Vec3(0), .01f, kUp)
        .emitter("lamp", 1)
        .square("lamp", Vec3(0, 0, .5f), .15f, -kUp);
    return Probe(scene).onto(Vec3(0), kUp, 60, 262144, .2f);
  };
  expect_same("small glowing square, details 2", beside_lamp("on"), beside_lamp("off"), .01f);
}

// acceptance: O5
TEST(Occlusion, DarknessAboveOneIsClamped) {
  SceneText scene;
  scene
      .lambert("floor", .6f,
               "\"ao_on\" on, \"ao_do_details\" 2, \"ao_distance\" 1, \"ao_dark\" 0 1.5 0")
      .square("floor", Vec3(0), .01f, kUp)
      .emitter("slab", 1)
      .square("slab", Vec3(0, 0, .1f), 200, -kUp);
  EXPECT_GE(Probe(scene).onto(Vec3(0), kUp, 30, 4096, .05f).mean.y, 0);
}

}  // namespace occlusion_test
}  // namespace oriel::testing
