// SPDX-License-Identifier: Apache-2.0
// Portal lights compared with quadrature, closed forms and path tracing.
#include "support/portal_scenes.h"

namespace oriel::testing {
namespace portal_test {

struct Spot {
  const char* name;
  Vec3 position, normal;
};
const Spot kSpots[] = {{"floor", Vec3(2, .3f, 0), kUp},
                       {"floor below the window", Vec3(.3f, 0, 0), kUp},
                       {"ceiling", Vec3(1.5f, -.5f, 3), -kUp},
                       {"right wall", Vec3(1, -1.5f, 1.2f), Vec3(0, 1, 0)},
                       {"left wall", Vec3(3, 1.5f, .6f), Vec3(0, -1, 0)},
                       {"back wall", Vec3(4, .6f, 1), Vec3(-1, 0, 0)}};

void expect_within(const std::string& name, const Measured& m, const Rgb& exact, float share) {
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(m.mean[k], exact[k], 4 * m.error[k] + 2e-4f * exact[k]) << name << ' ' << k;
    EXPECT_NEAR(m.mean[k], exact[k], share * exact[k]) << name << ' ' << k;
  }
  figure(name, exact.x, m.mean.x, m.error.x);
}

// acceptance: L1
TEST(Portal, SkyThroughTheWindowReachesEveryWall) {
  for (const char* environment : {kSky, kLamps})
    for (const int n : {1, 4}) {
      SceneText scene = room(environment, 1);
      Probe probe = probe_of(add_window(scene, n, "\"cutoff_threshold\" 0"));
      probe.direct_only();
      for (const Spot& s : kSpots)
        expect_within(
            fmt::format("{}, {} portals, {}", environment == kSky ? "sky" : "lamps", n * n, s.name),
            probe.onto(s.position, s.normal, 20, 1 << 15, .1f),
            by_quadrature(probe.world(), s.position, s.normal), .01f);
    }
}

// acceptance: L1, L2
TEST(Portal, PathsWithAndWithoutItAreTheSame) {
  for (const char* environment : {kSky, kLamps}) {
    const SceneText open = room(environment, .5f);
    SceneText closed = open, split = open;
    add_window(closed);
    add_window(split, 4, "\"cutoff_threshold\" 0");
    const Probe a = probe_of(open), b = probe_of(closed), c = probe_of(split);
    const std::string name = environment == kSky ? "sky, " : "lamps, ";
    for (const Spot& s :
         {kSpots[0], kSpots[5], Spot{"front wall", Vec3(0, 0, .5f), Vec3(1, 0, 0)}}) {
      const Measured brute = a.onto(s.position, s.normal, 20, 1 << 16, .1f);
      const Measured one = b.onto(s.position, s.normal, 20, 1 << 14, .1f);
      expect_same(name + s.name, one, brute, .03f);
      expect_same(name + s.name + ", 16", c.onto(s.position, s.normal, 20, 1 << 14, .1f), one,
                  .03f);
    }
  }
}

TEST(Portal, UncoveredOpeningsAreSampledByRays) {
  const Opening o;
  const float middle = (o.y0 + o.y1) / 2;
  for (const char* environment : {kSky, kLamps}) {
    const SceneText open = room(environment, .8f);
    SceneText half = open;
    add_portal(half, "half", Vec3(0, (o.y0 + middle) / 2, (o.z0 + o.z1) / 2), middle - o.y0,
               o.z1 - o.z0, "\"cutoff_threshold\" 0");
    const Probe a = probe_of(open), b = probe_of(half);
    // The front wall has light from other walls alone.
    for (const Spot& s : {kSpots[5], Spot{"front wall", Vec3(0, 0, .5f), Vec3(1, 0, 0)}})
      expect_same(std::string(environment == kSky ? "sky, " : "lamps, ") + s.name,
                  b.onto(s.position, s.normal, 20, 1 << 16, .1f),
                  a.onto(s.position, s.normal, 20, 1 << 16, .1f), .03f);
  }
}

// acceptance: L1
TEST(Portal, EvenLightFollowsTheFormFactorByEachEstimator) {
  const auto card = [](const std::string& more) {
    SceneText scene;
    scene.uniform_sky(1).lambert("card", 1).square("card", Vec3(1, 0, 0), .01f, Vec3(-1, 0, 0));
    // Nothing but the window in front of the card.
    add_portal(scene, "window", Vec3(0), 2, 2, more);
    return scene;
  };
  for (const std::string& more : {std::string(), std::string("\"use_custom_environment\" on"),
                                  std::string("\"reverse\" on, \"multiplier\" 0")})
    for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
      Probe probe = probe_of(card(more));
      const bool reversed = more.find("reverse") != more.npos;
      if (reversed) {
        // What shines the other way neither lights the card nor keeps the sky from it.
        expect_exact("reversed",
                     probe.estimator(e).onto(Vec3(1, 0, 0), Vec3(-1, 0, 0), 0, 1 << 14, .05f), 1);
        continue;
      }
      expect_exact(
          "2x2 at 1, direct",
          probe.estimator(e).direct_only().onto(Vec3(1, 0, 0), Vec3(-1, 0, 0), 0,
                                                e == Estimator::BsdfOnly ? 64 : 1 << 16, .05f),
          e == Estimator::BsdfOnly ? 0 : .5541264f, .004f);
      Probe whole = probe_of(card(more));
      expect_exact("window and the sky around it",
                   whole.estimator(e).onto(Vec3(1, 0, 0), Vec3(-1, 0, 0), 0, 1 << 16, .05f), 1,
                   .004f);
    }
}

/// A ray inside of a path's first diffuse bounce.
Rgb gathered(const Probe& probe, const Vec3& from, const Vec3& direction) {
  ShadingPoint point;
  point.position = from;
  point.normal = point.geometric_normal = direction;
  point.world = &probe.world();
  sampling::Sampler sampler;
  RayCounts counts;
  return trace_gather_ray(probe.world(), point, direction, std::numeric_limits<float>::infinity(),
                          {}, sampler, counts)
      .radiance;
}

// acceptance: L2
TEST(Portal, EndsGatherRaysFromInsideAndNoOthers) {
  SceneText scene = room("\"test_sky\" ( \"above\" 2 3 4, \"below\" 2 3 4 )", .5f);
  scene
      .material("mirror",
                "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
                "\"brdf_90_degree_refl\" 1")
      .square("mirror", Vec3(3, 0, 1.5f), .5f, Vec3(-1, 0, 0))
      .material("pane",
                "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"thin_walled\" on")
      .square("pane", Vec3(1, 0, 1.5f), .5f, Vec3(1, 0, 0));
  const Probe without = probe_of(scene), with = probe_of(add_window(scene));
  const Rgb sky(2, 3, 4);
  const Vec3 inside(.5f, 0, 1.5f), out(-1, 0, 0), outside(-2, 0, 1.5f);
  EXPECT_EQ(gathered(without, inside, out), sky);
  EXPECT_EQ(gathered(with, inside, out), Rgb(0));
  // From outside it passes: the glimpse of the floor is the same kind of light as without.
  const Vec3 down = normalize(Vec3(1, 0, -.6f));
  EXPECT_GT(gathered(with, outside, down).y, 0);
  expect_exact("eye", with.ray(inside, out, 64), sky);
  expect_exact("mirror", with.ray(Vec3(2, .1f, 1.5f), Vec3(1, 0, 0), 64), sky);
  expect_exact("glass", with.ray(Vec3(1.5f, .1f, 1.5f), out, 64), sky);
}

// acceptance: L2
TEST(Portal, LightFromInsideComesOut) {
  // A card outside before the window of a dark room with a glowing back wall.
  const auto outside = [](bool portal) {
    SceneText scene = room("\"test_sky\" ( \"above\" 0 0 0, \"below\" 0 0 0 )", 0);
    scene.emitter("glow", 1)
        .polygon("glow", {Vec3(3.9f, -1.5f, 0), Vec3(3.9f, -1.5f, 3), Vec3(3.9f, 1.5f, 3),
                          Vec3(3.9f, 1.5f, 0)})
        .lambert("card", 1)
        .square("card", Vec3(-1, 0, 1.5f), .01f, Vec3(1, 0, 0));
    if (portal) add_window(scene);
    return probe_of(scene).onto(Vec3(-1, 0, 1.5f), Vec3(1, 0, 0), 0, 1 << 15, .05f);
  };
  expect_same("glow through the back of a portal", outside(true), outside(false), .01f);
}

/// A card that faces a unit window at a distance of 1, in an even environment.
struct Bench {
  SceneText scene;
  explicit Bench(const std::string& parameters, float radiance = 1) {
    if (radiance > 0) scene.uniform_sky(radiance);
    scene.lambert("card", 1).square("card", Vec3(1, 0, 0), .01f, Vec3(-1, 0, 0));
    add_portal(scene, "window", Vec3(0), 1, 1, parameters);
  }
  Measured direct() const {
    return probe_of(scene).direct_only().onto(Vec3(1, 0, 0), Vec3(-1, 0, 0), 0, 1 << 14, .05f);
  }
};
/// Form factor of the unit square at 1.
constexpr float kForm = .7522747f / kPi;

// acceptance: L3
TEST(Portal, StrengthTintSideAndThreshold) {
  expect_exact("plain", Bench("").direct(), kForm);
  expect_exact("tinted", Bench("\"tint_color\" .5 1 .25, \"multiplier\" 4").direct(),
               Rgb(2, 4, 1) * kForm);
  EXPECT_EQ(Bench("\"reverse\" on").direct().mean, Rgb(0));
  EXPECT_EQ(Bench("\"on\" off").direct().mean, Rgb(0));
  // Facing the middle of the window its colour is 1 / pi of the radiance, at the corners less.
  const Measured below = Bench("\"cutoff_threshold\" .1").direct();
  expect_exact("below the threshold", below, kForm);
  const Measured above = Bench("\"cutoff_threshold\" .32").direct();
  EXPECT_EQ(above.mean, Rgb(0));
  EXPECT_EQ(above.counts.shadow, 0u);
  const Measured between = Bench("\"cutoff_threshold\" .25").direct();
  EXPECT_GT(between.mean.x, .1f * kForm);
  EXPECT_LT(between.mean.x, .9f * kForm);
  EXPECT_LT(between.counts.shadow, below.counts.shadow);
  for (const bool shadows : {true, false}) {
    Bench b(shadows ? "" : "\"shadows\" off");
    b.scene.lambert("board", 0).square("board", Vec3(.5f, 0, 0), 3, Vec3(-1, 0, 0));
    const Measured m = b.direct();
    expect_exact("behind a board", m, shadows ? 0 : kForm);
  }
}

// acceptance: L4
TEST(Portal, UsesCameraOrOwnEnvironmentOrWhite) {
  const std::string own = "\"custom_environment\" \"own\"";
  const auto with_own = [&](const std::string& parameters) {
    Bench b(parameters, 3);
    SceneText scene;
    scene.statement("shader \"own\" \"test_sky\" ( \"above\" .5 2 7, \"below\" .5 2 7 )")
        .uniform_sky(3)
        .lambert("card", 1)
        .square("card", Vec3(1, 0, 0), .01f, Vec3(-1, 0, 0));
    add_portal(scene, "window", Vec3(0), 1, 1, parameters);
    b.scene = scene;
    return b.direct();
  };
  expect_exact("the camera's", with_own(own), 3 * kForm);
  expect_exact("its own", with_own("\"use_custom_environment\" on, " + own),
               Rgb(.5f, 2, 7) * kForm);
  expect_exact("white card", with_own("\"use_custom_environment\" on"), kForm);
  expect_exact("white card alone", Bench("\"use_custom_environment\" on", 0).direct(), kForm);
  EXPECT_EQ(Bench("", 0).direct().mean, Rgb(0));
}

// acceptance: L4, S9
TEST(Portal, LooksUpTheEnvironmentLikeGatherRaysByDefault) {
  const std::string lamps = "\"test_lamps\" ( \"hidden\" 1 2 3 )";
  for (const bool gather : {true, false}) {
    SceneText scene = room(lamps, 1);
    Probe probe = probe_of(add_window(scene, 1, gather ? "" : "\"lookup_using_fg_rays\" off"));
    probe.direct_only();
    const Spot& s = kSpots[0];
    expect_within(gather ? "as gather rays" : "as other rays",
                  probe.onto(s.position, s.normal, 20, 1 << 14, .1f),
                  by_quadrature(probe.world(), s.position, s.normal,
                                gather ? RayKind::FinalGather : RayKind::Environment),
                  .01f);
  }
  // The disc of the sun before the window.
  const auto floor = [](const std::string& disc, const std::string& portal) {
    SceneText scene = room("\"mia_physicalsky\" ( \"sun_direction\" -2 -.2 1.5, " + disc + " )", 1);
    return probe_of(add_window(scene, 1, portal))
        .direct_only()
        .onto(Vec3(2, .3f, 0), kUp, 20, 1 << 14, .1f)
        .mean;
  };
  const std::string bright = "\"sun_disk_intensity\" 5, \"sun_glow_intensity\" 5",
                    none = "\"sun_disk_intensity\" 0, \"sun_glow_intensity\" 0";
  const std::string off = "\"lookup_using_fg_rays\" off";
  EXPECT_EQ(floor(bright, ""), floor(none, ""));
  EXPECT_GT(floor(bright, off).x, 1.5f * floor(none, off).x);
}

// acceptance: L5
TEST(Portal, TransparencyIsForTheViewAlone) {
  const std::string sky = "\"test_sky\" ( \"above\" 2 3 4, \"below\" 2 3 4 )";
  const auto at = [&](const std::string& parameters, bool floor, float gloss = 1) {
    SceneText scene = room(sky, .5f);
    scene
        .material("mirror", fmt::format("\"diffuse_weight\" 0, \"reflectivity\" 1, "
                                        "\"brdf_0_degree_refl\" 1, \"brdf_90_degree_refl\" 1, "
                                        "\"refl_gloss\" {}",
                                        gloss))
        .square("mirror", Vec3(3, 0, 1.5f), .5f, Vec3(-1, 0, 0));
    const Probe probe = probe_of(add_window(scene, 1, parameters));
    return std::array{floor ? probe.onto(Vec3(2, .3f, 0), kUp, 20, 1 << 15, .1f) : Measured{},
                      probe.ray(Vec3(1, 0, 1.5f), Vec3(-1, 0, 0), 64),
                      probe.ray(Vec3(2, .1f, 1.5f), Vec3(1, 0, 0), gloss < 1 ? 1 << 14 : 64)};
  };
  const Rgb l(2, 3, 4);
  const std::string half = "\"transparency\" .5 .5 .25";
  const Rgb seen = l * Rgb(.5f, .5f, .25f);
  const auto plain = at("", true);
  expect_exact("view", plain[1], l);
  for (const bool visible : {false, true}) {
    const std::string on = visible ? ", \"visible\" on" : "";
    const auto gel = at(half + on, true);
    expect_same("floor behind a gel", gel[0], plain[0], .01f);
    expect_exact("view through a gel", gel[1], seen);
    expect_exact("mirrored through a gel", gel[2], seen);
    const auto white = at("\"transparency\" 1 1 1, \"tint_color\" 2 2 2" + on, false);
    // A visible surface has the radiance of its emission; a hidden one shows the sky.
    expect_exact("strong portal seen", white[1], visible ? l * 2 : l);
    expect_exact("strong portal mirrored", white[2], visible ? l * 2 : l);
    // In a glossy surface window and room are seen together; the room does not change.
    const auto black = at("\"transparency\" 0 0 0" + on, false, .4f),
               one = at(on.empty() ? "" : on.substr(2), false, .4f);
    const auto glossy = at(half + on, false, .4f);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(glossy[2].mean[k], lerp(black[2].mean[k], one[2].mean[k], k < 2 ? .5f : .25f),
                  4 * (glossy[2].error[k] + one[2].error[k] + black[2].error[k]));
    EXPECT_GT(one[2].mean.x, 1.2f * black[2].mean.x);
  }
}

// Glossy surfaces count the window once, in all estimators.
// acceptance: L2, L5
TEST(Portal, GlossySurfacesShowTheWindowOnce) {
  const auto seen = [](bool portal, const std::string& parameters, Estimator e) {
    SceneText scene = room(kLamps, .3f);
    scene
        .material("gloss",
                  "\"diffuse\" .3 .3 .3, \"reflectivity\" .6, \"brdf_0_degree_refl\" .6, "
                  "\"refl_gloss\" .3")
        .square("gloss", Vec3(2, 0, .5f), .5f, kUp);
    if (portal) add_window(scene, 1, parameters);
    return probe_of(scene).estimator(e).ray(Vec3(3.2f, .2f, 1.2f), Vec3(-1.2f, -.2f, -.7f),
                                            portal ? 1 << 16 : 1 << 18);
  };
  const Measured open = seen(false, "", Estimator::Mis);
  for (const char* parameters : {"", "\"visible\" on"})
    expect_same(std::string("glossy floor, ") + parameters, seen(true, parameters, Estimator::Mis),
                open, .01f);
  expect_same("glossy floor, light samples", seen(true, "", Estimator::LightOnly), open, .03f);
}

// acceptance: L6
TEST(Portal, ShadowRaysBeginInsideOrOutside) {
  const auto card = [](float board, const std::string& parameters) {
    Bench b(parameters);
    b.scene.lambert("board", 0).square("board", Vec3(board, 0, 0), 5, Vec3(1, 0, 0));
    return probe_of(b.scene).direct_only().onto(Vec3(1, 0, 0), Vec3(-1, 0, 0), 0, 1 << 14, .05f);
  };
  expect_exact("board outside", card(-.2f, ""), kForm);
  expect_exact("board outside, reached", card(-.2f, "\"shadow_ray_extension\" .5"), 0);
  expect_exact("board outside, out of reach", card(-.6f, "\"shadow_ray_extension\" .5"), kForm);
  expect_exact("board inside", card(.2f, ""), 0);
  expect_exact("board inside, skipped", card(.2f, "\"shadow_ray_extension\" -.5"), kForm);
  expect_exact("board inside, not skipped", card(.6f, "\"shadow_ray_extension\" -.3"), 0);
  // Paths give the same next to it: rays that end at the portal add nothing.
  Bench b("\"shadow_ray_extension\" -.1");
  expect_exact("whole sky", probe_of(b.scene).onto(Vec3(1, 0, 0), Vec3(-1, 0, 0), 0, 1 << 16, .05f),
               1);
}

}  // namespace portal_test
}  // namespace oriel::testing
