// SPDX-License-Identifier: Apache-2.0
// Rounded edges compared with the normals of a fillet, shown by a material that outputs its bump.
#include "bsdf/terminator.h"
#include "support/probe.h"

namespace oriel::testing {
namespace roundcorners_test {

/// "test_normal": a material with the emission (n + 1) / 2 for its input vector n.
struct TestNormal {
  Vec3 normal;
};
constexpr ParamSpec kTestNormalRows[] = {{ORIEL_PARAM(TestNormal, normal)}};
constexpr ShaderSpec kTestNormal = {
    .name = "test_normal",
    .library = "test",
    .apply = kApplyMaterial,
    .params = kTestNormalRows,
    .params_size = sizeof(TestNormal),
    .material =
        {
            .fill =
                [](const Call& call, Closure& closure) {
                  closure.emission = (call.as<TestNormal>().normal + Vec3(1)) * .5f;
                },
        },
};

const Registry& registry() {
  static const Registry all = test_registry_with({&kTestNormal});
  return all;
}

/// A scene whose materials show mia_roundcorners of these parameters.
SceneText rounded(const std::string& parameters, const std::string& before = {}) {
  SceneText scene;
  if (!before.empty()) scene.statement(before);
  scene.statement(
      fmt::format("shader \"round\" \"mia_roundcorners\" ( {} )\n"
                  "material \"m\" \"test_normal\" ( \"normal\" = \"round\" ) end material\n"
                  "material \"n\" \"test_normal\" ( \"normal\" = \"round\" ) end material",
                  parameters));
  return scene;
}

/// The vector shown at a point of a face with this normal, seen from a little aside.
struct Shown {
  explicit Shown(const SceneText& scene) : probe(scene.str(), registry()) {}
  Vec3 at(const Vec3& p, const Vec3& normal) const {
    const Measured m = probe.onto(p, normal, 25, 64, .01f);
    EXPECT_LT(max_component(m.error), 1e-6f) << "not the same for all random numbers";
    probes = m.each(m.counts.probe);
    return m.mean * 2 - Rgb(1);
  }
  Probe probe;
  mutable double probes = 0;
};

void expect_vector(const Vec3& actual, const Vec3& expected, const std::string& name,
                   float tolerance = 1e-4f) {
  EXPECT_LT(length(actual - expected), tolerance)
      << name << ": " << text_of(actual) << " against " << text_of(expected);
}

/// Normal of the fillet at distance d from an edge where n turns by `turn` radians along `across`.
Vec3 fillet(const Vec3& n, const Vec3& across, float d, float radius, float turn) {
  // Seen from the axis of the cylinder, which lies under the place where it touches.
  const float height = radius / std::tan(turn / 2);
  return normalize(n * height + across * std::max(0.0f, radius - d));
}

const float kDistances[] = {.0004f, .01f, .03f, .05f, .08f, .099f, .101f, .2f, .4f};

// acceptance: C1
TEST(RoundCorners, RightAngledEdgesHaveTheNormalsOfTheirFillet) {
  SceneText scene = rounded("\"radius\" .1, \"bump_mode\" 6");
  scene.box("m", Vec3(0), Vec3(1));
  const Shown shown(scene);
  float last = 2;
  for (const float d : kDistances) {
    const Vec3 n = shown.at(Vec3(1 - d, .5f, 1), kUp);
    expect_vector(n, fillet(kUp, Vec3(1, 0, 0), d, .1f, kPi / 2), fmt::format("at {}", d));
    const float tilt = std::atan2(n.x, n.z);
    EXPECT_LE(tilt, last + 1e-4f) << d;
    last = tilt;
    EXPECT_LE(shown.probes, 17);
  }
  // Both faces agree at the edge, on half of the angle; three at a corner.
  const Vec3 half = normalize(Vec3(1, 0, 1));
  expect_vector(shown.at(Vec3(1 - 1e-4f, .5f, 1), kUp), half, "edge", 2e-3f);
  expect_vector(shown.at(Vec3(1, .5f, 1 - 1e-4f), Vec3(1, 0, 0)), half, "edge's other face", 2e-3f);
  const Vec3 third = normalize(Vec3(1));
  expect_vector(shown.at(Vec3(1 - 2e-4f, 1 - 3e-4f, 1), kUp), third, "corner", 5e-3f);
}

// acceptance: C1
TEST(RoundCorners, FlatterAndSteeperEdgesTurnByHalfTheirAngleToo) {
  for (const float degrees : {30.0f, 60.0f, 90.0f, 120.0f})
    for (const bool inward : {false, true}) {
      // A plate from x = -1 to 0 and an adjacent one, tilted down or up.
      const float a = degrees * kPi / 180 * (inward ? 1.0f : -1.0f);
      const Vec3 along(std::cos(a), 0, std::sin(a)), y(0, 2, 0);
      SceneText scene = rounded("\"radius\" .1, \"bump_mode\" 6");
      scene.polygon("m", {Vec3(-1, -2, 0), -y, y, Vec3(-1, 2, 0)})
          .polygon("m", {-y, along - y, along + y, y});
      const Shown shown(scene);
      const Vec3 across(inward ? -1.0f : 1.0f, 0, 0);
      for (const float d : kDistances) {
        // A wall that leans over hides the edge, and the rays begin a little below the surface.
        if (d < .01f && (inward || degrees > 90)) continue;
        expect_vector(shown.at(Vec3(-d, .3f, 0), kUp), fillet(kUp, across, d, .1f, std::abs(a)),
                      fmt::format("{} degrees, {} at {}", degrees, inward ? "in" : "out", d));
      }
    }
}

TEST(RoundCorners, OneKindOfEdgesIsLeftSharpOnRequest) {
  // A step: a floor up to x = 0, a wall up to z = 1, and a shelf from there.
  const char* kNames[] = {"all", "standing out", "turning in"};
  for (const int edges : {0, 1, 2}) {
    SceneText scene = rounded(fmt::format("\"radius\" .1, \"bump_mode\" 6, \"edges\" {}", edges));
    scene.polygon("m", {Vec3(-1, 0, 0), Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(-1, 1, 0)})
        .polygon("m", {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(0, 1, 0)})
        .polygon("m", {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(0, 1, 1)});
    const Shown shown(scene);
    const Vec3 x(1, 0, 0);
    for (const float d : {.01f, .04f, .08f}) {
      const auto expected = [&](const Vec3& n, const Vec3& across, bool acts) {
        return acts ? fillet(n, across, d, .1f, kPi / 2) : n;
      };
      const std::string where = fmt::format("{}, at {}", kNames[edges], d);
      expect_vector(shown.at(Vec3(-d, .5f, 0), kUp), expected(kUp, -x, edges != 1),
                    "floor, " + where);
      expect_vector(shown.at(Vec3(0, .5f, d), -x), expected(-x, kUp, edges != 1),
                    "wall's foot, " + where);
      expect_vector(shown.at(Vec3(0, .5f, 1 - d), -x), expected(-x, kUp, edges != 2),
                    "wall's top, " + where);
      expect_vector(shown.at(Vec3(d, .5f, 1), kUp), expected(kUp, -x, edges != 2),
                    "shelf, " + where);
    }
    // Half of the rays are spared.
    shown.at(Vec3(-.5f, .5f, 0), kUp);
    EXPECT_LE(shown.probes, edges == 0 ? 9 : 5) << kNames[edges];
  }
}

TEST(RoundCorners, TexturesMakeTheRadius) {
  // Left half 26 / 255, right half 51 / 255.
  const std::string picture =
      "color texture \"width\" [2 1 1] '1a33'\n"
      "shader \"place\" \"mib_texture_vector\" ( \"select\" -1, \"selspace\" 2 )\n"
      "shader \"map\" \"mib_texture_lookup\" ( \"tex\" \"width\", \"coord\" = \"place\" )";
  SceneText scene = rounded("\"radius\" = \"map\", \"bump_mode\" 6", picture);
  // The plate's own x, 0..1, is the picture's u; its edge runs along x at y = 0.
  scene.polygon("m", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
      .polygon("m", {Vec3(0, 0, 0), Vec3(0, 0, -1), Vec3(1, 0, -1), Vec3(1, 0, 0)});
  const Shown shown(scene);
  const float narrow = 26.0f / 255, wide = 51.0f / 255;
  for (const float d : {.02f, .06f, .09f, .15f, .25f}) {
    // Far from the middle and the ends, where the two are mixed.
    expect_vector(shown.at(Vec3(.25f, d, 0), kUp), fillet(kUp, Vec3(0, -1, 0), d, narrow, kPi / 2),
                  fmt::format("narrow, at {}", d), 2e-3f);
    expect_vector(shown.at(Vec3(.75f, d, 0), kUp), fillet(kUp, Vec3(0, -1, 0), d, wide, kPi / 2),
                  fmt::format("wide, at {}", d), 2e-3f);
  }
}

// acceptance: C1
TEST(RoundCorners, InstancesAndTessellationDoNotMatter) {
  // The cube of twelve triangles as 6 x 16 x 16 x 2, then turned, moved and half as large.
  constexpr int kN = 16;
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  for (int axis = 0; axis < 3; ++axis)
    for (const float w : {0.0f, 1.0f}) {
      const int first = static_cast<int>(points.size());
      for (int i = 0; i <= kN; ++i)
        for (int j = 0; j <= kN; ++j) {
          Vec3 p;
          p[axis] = w;
          p[(axis + 1) % 3] = static_cast<float>(i) / kN;
          p[(axis + 2) % 3] = static_cast<float>(j) / kN;
          points.push_back(p);
        }
      for (int i = 0; i < kN; ++i)
        for (int j = 0; j < kN; ++j) {
          const int a = first + i * (kN + 1) + j, b = a + kN + 1;
          std::vector<int> t[] = {{a, b, b + 1}, {a, b + 1, a + 1}};
          for (auto& f : t) {
            if (w == 0) std::reverse(f.begin(), f.end());
            faces.push_back(f);
          }
        }
    }
  const float c = std::cos(.4f), s = std::sin(.4f);
  // World to object: turned about z, then twice as large.
  const std::string transform =
      fmt::format("transform {} {} 0 0  {} {} 0 0  0 0 2 0  3 1 2 1", 2 * c, 2 * s, -2 * s, 2 * c);
  SceneText scene = rounded("\"radius\" .1, \"bump_mode\" 6");
  scene.mesh("m", points, faces, {}, transform);
  const Shown shown(scene);
  const auto to_world = [&](const Vec3& p) {
    const Vec3 q = (p - Vec3(3, 1, 2)) * .5f;
    return Vec3(c * q.x + s * q.y, -s * q.x + c * q.y, q.z);
  };
  const Vec3 across(c, -s, 0);
  for (const float d : kDistances)
    expect_vector(shown.at(to_world(Vec3(1 - 2 * d, .47f, 1)), kUp),
                  fillet(kUp, across, d, .1f, kPi / 2), fmt::format("at {}", d), 3e-4f);
}

// acceptance: C1
TEST(RoundCorners, SmoothSurfacesKeepTheirNormalsAndTheirCreasesAreRounded) {
  SceneText scene = rounded("\"radius\" .1, \"bump_mode\" 6");
  SceneText plain = rounded("\"radius\" 0, \"bump_mode\" 6");
  // A sphere and a cylinder with a flat lid.
  constexpr int kN = 64;
  std::vector<Vec3> points, normals;
  std::vector<std::vector<int>> faces;
  std::vector<int> lid;
  for (int i = 0; i < kN; ++i) {
    const float a = kTwoPi * static_cast<float>(i) / kN;
    const Vec3 d(std::cos(a), std::sin(a), 0);
    for (const float z : {-1.0f, 0.0f}) {
      points.push_back(d + kUp * z);
      normals.push_back(d);
    }
    const int j = (i + 1) % kN;
    faces.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
  }
  for (int i = 0; i < kN; ++i) {
    lid.push_back(static_cast<int>(points.size()));
    points.push_back(points[2 * static_cast<std::size_t>(i) + 1]);
    normals.push_back(kUp);
  }
  faces.push_back(lid);
  for (SceneText* s : {&scene, &plain})
    s->sphere("m", Vec3(4, 0, 0), .5f, 64).mesh("m", points, faces, normals);
  const Shown shown(scene), untouched(plain);
  for (int i = 0; i < 40; ++i) {
    const float z = 1.8f * (static_cast<float>(i) + .5f) / 40 - .9f,
                phi = 2.4f * static_cast<float>(i);
    const float r = std::sqrt(1 - z * z);
    const Vec3 d(r * std::cos(phi), r * std::sin(phi), z);
    expect_vector(shown.at(Vec3(4, 0, 0) + d * .5f, d), untouched.at(Vec3(4, 0, 0) + d * .5f, d),
                  fmt::format("sphere, {}", text_of(d)), 1e-6f);
    const Vec3 side = normalize(Vec3(d.x, d.y, 0));
    const Vec3 middle = side * std::cos(kPi / kN) - kUp * .5f;
    expect_vector(shown.at(middle, side), untouched.at(middle, side),
                  fmt::format("cylinder, {}", text_of(side)), 1e-6f);
    for (const float below : {.02f, .06f})
      expect_vector(shown.at(side - kUp * below, side), fillet(side, kUp, below, .1f, kPi / 2),
                    fmt::format("cylinder below its lid, {}", text_of(side)), .02f);
    for (const float within : {.02f, .06f})
      expect_vector(shown.at(side * (1 - within), kUp), fillet(kUp, side, within, .1f, kPi / 2),
                    fmt::format("lid, {}", text_of(side)), .04f);
  }
}

// acceptance: C2
TEST(RoundCorners, OtherMaterialsCountOnlyWhereAllowed) {
  for (const bool allowed : {false, true}) {
    SceneText scene =
        rounded(fmt::format("\"radius\" .1, \"bump_mode\" 6, \"allow_different_materials\" {}",
                            allowed ? "on" : "off"));
    // A lid of n over sides of m, and a wall of n on a floor of m.
    scene.polygon("n", {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)})
        .polygon("m", {Vec3(1, 0, 0), Vec3(1, 0, -1), Vec3(1, 1, -1), Vec3(1, 1, 0)})
        .polygon("n", {Vec3(0, 0, -1), Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 1, -1)})
        .polygon("m", {Vec3(5, 0, 0), Vec3(6, 0, 0), Vec3(6, 1, 0), Vec3(5, 1, 0)})
        .polygon("n", {Vec3(6, 0, 0), Vec3(6, 0, 1), Vec3(6, 1, 1), Vec3(6, 1, 0)});
    const Shown shown(scene);
    const auto expected = [&](const Vec3& across, bool acts) {
      return acts ? fillet(kUp, across, .03f, .1f, kPi / 2) : kUp;
    };
    const Vec3 x(1, 0, 0);
    expect_vector(shown.at(Vec3(.97f, .5f, 0), kUp), expected(x, allowed), "against another");
    expect_vector(shown.at(Vec3(.03f, .5f, 0), kUp), expected(-x, true), "against its own");
    expect_vector(shown.at(Vec3(5.97f, .5f, 0), kUp), expected(-x, allowed), "inward, another");
  }
}

// acceptance: C3
TEST(RoundCorners, NineModesTakeAndGiveTheirVectors) {
  // An object that is turned by 90 degrees about z and stretched: see bump_cases_test.cpp.
  const auto plate = [](const std::string& parameters) {
    SceneText scene =
        rounded(parameters, "shader \"tilt\" \"test_tilt\" ( \"normal\" -.3 .1 1.8 )");
    scene
        .mesh("m",
              {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0), Vec3(1, -1, -1),
               Vec3(1, 1, -1)},
              {{0, 1, 2, 3}, {1, 4, 5, 2}}, {}, "transform 0 -1 0 0  .5 0 0 0  0 0 1 0  0 0 0 1")
        .camera("focal 1 aperture 1 aspect 1 resolution 8 8",
                "0 -1 0 0  1 0 0 0  0 0 1 0  0 0 0 1");
    return scene;
  };
  // Object x runs along world y, where the edge is at 2; object y against world x.
  const Vec3 at(.2f, 1.96f, 0), across(0, 1, 0);
  const Vec3 in_world[] = {Vec3(-.3f, .1f, .8f), Vec3(-.3f, .1f, .8f), Vec3(-.1f, -.15f, .8f),
                           Vec3(-.1f, -.3f, .8f)};
  for (const bool near : {false, true})
    for (int mode = 1; mode <= 8; ++mode) {
      const bool adds = mode <= 4;
      const Vec3 bumped = normalize(in_world[(mode - 1) % 4] + (adds ? kUp : Vec3(0)));
      const Vec3 n = near ? normalize(bumped + across * (1 - .04f / .1f)) : bumped;
      // What comes out is the input of a second shader that shows it as the world's normal.
      SceneText scene =
          plate(fmt::format("\"radius\" .1, \"bump_mode\" {}, \"bump_vector\" -.3 .1 .8", mode));
      const Shown shown(scene);
      const Vec3 v = shown.at(near ? at : Vec3(.2f, .1f, 0), kUp);
      Vec3 world = v;
      if ((mode - 1) % 4 == 2) world = Vec3(-v.y, v.x / 2, v.z);
      if ((mode - 1) % 4 == 3) world = Vec3(-v.y, v.x, v.z);
      if (adds) world += kUp;
      expect_vector(normalize(world), n, fmt::format("mode {}, near {}", mode, near));
    }
  // Nothing to add where nothing acts.
  expect_vector(Shown(plate("\"radius\" .1, \"bump_mode\" 3")).at(Vec3(.2f, .1f, 0), kUp), Vec3(0),
                "far from edges");
}

/// What the diffuse component sees of a sun along x, at a point of a box near its edge.
AovValues lit(const std::string& bump, const std::string& round) {
  SceneText scene;
  scene.statement("shader \"tilt\" \"test_tilt\" ( \"normal\" .6 0 .8 )")
      .statement("shader \"round\" \"mia_roundcorners\" ( " + round + " )")
      .material("m",
                "\"diffuse\" 1 1 1, \"reflectivity\" .5, \"brdf_0_degree_refl\" 1, "
                "\"brdf_90_degree_refl\" 1, " +
                    bump)
      .environment("\"test_sky\" ( \"above\" 1 1 1, \"up\" 1 0 .7 )")
      .box("m", Vec3(0), Vec3(1))
      .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction -.6 0 -.8");
  return Probe(scene.str(), registry())
      .outputs()
      .direct_only()
      .onto(Vec3(.95f, .5f, 1), kUp, 25, 64, .01f)
      .outputs;
}

/// What the sun brings to a normal n of the box's upper face, over what it brings to the face's
/// own.
float sunlight(const Vec3& n) {
  const Vec3 sun(.6f, 0, .8f);
  return dot(n, sun) * bsdf::soft_terminator(kUp, n, sun) / .8f;
}

// acceptance: C3, C4
TEST(RoundCorners, ActAsOverallBumpWithoutDiffuseBumpsAndPassOnOthers) {
  const std::string radius = "\"radius\" .1, \"bump_mode\" ";
  const AovValues plain = lit("\"bump_mode\" 5", "");
  // Round corners in mode 0 move the normal themselves, which an input of vectors takes as well.
  AovValues first;
  for (const int mode : {0, 1, 2, 3, 5, 6, 7}) {
    AovValues o = lit(fmt::format("\"overall_bump\" = \"round\", \"no_diffuse_bump\" on, "
                                  "\"bump_mode\" {}",
                                  mode ? mode : 5),
                      radius + std::to_string(mode));
    if (mode == 0) first = o;
    EXPECT_NEAR(o[Aov::Diffuse].x / AovValues(plain)[Aov::Diffuse].x,
                sunlight(normalize(Vec3(.5f, 0, 1))), 1e-4f)
        << mode;
    EXPECT_LT(length(o[Aov::Reflection] - first[Aov::Reflection]), 1e-4f) << mode;
  }
  // As standard bump, and in the old input, they spare the diffuse component on request.
  for (const char* bump :
       {"\"standard_bump\" = \"round\", \"bump_mode\" 5", "\"bump\" \"round\", \"bump_mode\" 0"})
    EXPECT_EQ(lit(std::string(bump) + ", \"no_diffuse_bump\" on", radius + "0")[Aov::Diffuse],
              AovValues(plain)[Aov::Diffuse])
        << bump;
  // The bump shader passes through, and its result is rounded.
  AovValues passed = lit("\"bump\" \"round\", \"bump_mode\" 0", "\"bump\" \"tilt\"");
  EXPECT_NEAR(passed[Aov::Diffuse].x / AovValues(plain)[Aov::Diffuse].x,
              sunlight(Vec3(.6f, 0, .8f)), 1e-4f);
  AovValues both = lit("\"bump\" \"round\", \"bump_mode\" 0", radius + "0, \"bump\" \"tilt\"");
  EXPECT_NEAR(both[Aov::Diffuse].x / AovValues(plain)[Aov::Diffuse].x,
              sunlight(normalize(Vec3(1.1f, 0, .8f))), 1e-4f);
}

TEST(RoundCorners, ATextureMayDriveTheRadius) {
  SceneText scene = rounded("\"radius\" = \"wide\", \"bump_mode\" 6",
                            "shader \"wide\" \"test_place\" ( \"scale\" 0 .6 0 )");
  scene.box("m", Vec3(0), Vec3(1));
  const Shown shown(scene);
  for (const float y : {.3f, .5f, .7f})
    for (const float d : {.03f, .07f, .12f})
      expect_vector(shown.at(Vec3(1 - d, y, 1), kUp),
                    fillet(kUp, Vec3(1, 0, 0), d, .2f * y, kPi / 2), fmt::format("{} {}", y, d));
}

}  // namespace roundcorners_test
}  // namespace oriel::testing
