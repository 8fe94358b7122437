// SPDX-License-Identifier: Apache-2.0
// Displacement shaders on meshes with known displaced shape; environments of materials.
#include <cmath>
#include <functional>

#include "prepare/testing/prepared_scene.h"
#include "sampling/warp.h"
#include "support/expect_near.h"
#include "support/probe.h"

namespace oriel::testing {
namespace displacement_test {

/// "test_height": base + slope . object position + wave sin(20 u) of texture space 0 (u is 0
/// without one), and nothing where it is not asked for displacement.
struct TestHeight {
  float base;
  Vec3 slope;
  float wave;
};
constexpr ParamSpec kTestHeightRows[] = {{ORIEL_PARAM(TestHeight, base)},
                                         {ORIEL_PARAM(TestHeight, slope)},
                                         {ORIEL_PARAM(TestHeight, wave)}};
constexpr ShaderSpec kTestHeight = {
    .name = "test_height",
    .library = "test",
    .apply = kApplyTexture,
    .params = kTestHeightRows,
    .params_size = sizeof(TestHeight),
    .result = ParamType::Scalar,
    .result_size = sizeof(float),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<TestHeight>();
          const ShadingPoint& point = call.point;
          const bool asked = point.ray_kind == RayKind::Displace && point.to_object;
          const float u = point.texture_spaces > 0 ? point.tex[0].x : 0;
          *static_cast<float*>(result) =
              asked ? p.base + dot(p.slope, transform_point(point.position, *point.to_object)) +
                          p.wave * std::sin(20 * u)
                    : 0;
        },
};

const Registry& height_registry() {
  static const Registry registry([] {
    std::vector<const ShaderSpec*> specs = builtin_shaders().all();
    specs.push_back(&kTestHeight);
    return specs;
  }());
  return registry;
}

/// Sheets of n x n squares with normals and texture coordinates, none shared between sheets.
struct Sheets {
  std::string vectors, vertices, polygons;
  int n = 8, count = 0;

  /// A sheet from `corner` along u and v; its front and normals along u x v. `label` gives the
  /// material of the square (i, j).
  Sheets& add(
      const Vec3& corner, const Vec3& u, const Vec3& v,
      const std::function<int(int, int)>& label = [](int, int) { return 0; }) {
    const Vec3 normal = normalize(cross(u, v));
    const int side = n + 1, base = count;
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < side; ++i) {
        const float s = static_cast<float>(i) / static_cast<float>(n),
                    t = static_cast<float>(j) / static_cast<float>(n);
        vectors += fmt::format("{}\n{}\n{} {} 0\n", text_of(corner + u * s + v * t),
                               text_of(normal), s, t);
        vertices += fmt::format("v {} n {} t {}\n", 3 * count, 3 * count + 1, 3 * count + 2);
        ++count;
      }
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = base + j * side + i;
        polygons +=
            fmt::format("p {} {} {} {} {}\n", label(i, j), a, a + 1, a + side + 1, a + side);
      }
    return *this;
  }
  std::string object(const std::string& flags = {}) const {
    return fmt::format(
        "object \"sheets\" visible on shadow on trace on tagged on {}\ngroup\n{}{}{}end group\n"
        "end object\n",
        flags, vectors, vertices, polygons);
  }
};

/// The unit square on z = 0, front up.
Sheets plane() { return Sheets().add(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0)); }

/// The cube from 0 to 1, front outside, its edges split.
Sheets cube() {
  const Vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  return Sheets()
      .add(Vec3(0), y, x)
      .add(z, x, y)
      .add(Vec3(0), x, z)
      .add(y, z, x)
      .add(Vec3(0), z, y)
      .add(x, y, z);
}

std::string displaced_material(const std::string& name, const std::string& height) {
  return fmt::format(
      "material \"{}\" \"mib_illum_lambert\" ( \"diffuse\" 1 1 1 ) displace {} end material\n",
      name, height);
}

std::string height(const std::string& parameters) {
  return fmt::format("\"test_height\" ( {} )", parameters);
}

/// "m", for the square that these scenes have further down, and a second one.
const std::string kPlain =
    "material \"m\" \"mib_illum_lambert\" ( ) end material\n"
    "material \"other\" \"mib_illum_lambert\" ( ) end material\n";

/// `elements` and one instance of the object with materials "lifted" and "other", placed by
/// `transform`.
struct Displaced : testing::PreparedScene {
  explicit Displaced(const std::string& elements, const std::string& options = {},
                     const std::string& transform = {})
      : PreparedScene(
            testing::scene_text(
                kPlain + elements +
                    fmt::format(
                        "instance \"sheets_i\" \"sheets\" {} material [ \"lifted\" \"other\" ] "
                        "end instance\n",
                        transform),
                "\"sheets_i\"", {}, options),
            height_registry()) {
    EXPECT_NE(world, nullptr) << messages();
  }

  /// The first surface below (x, y, 3).
  geom::SurfacePoint below(float x, float y) const { return along(Vec3(x, y, 3), Vec3(0, 0, -1)); }
  geom::SurfacePoint along(const Vec3& origin, const Vec3& direction) const {
    geom::Ray ray;
    ray.org = origin;
    ray.dir = direction;
    geom::Hit hit;
    geom::SurfacePoint point{};
    if (world->accel->intersect(ray, hit))
      world->accel->interpolate(hit, point);
    else
      ADD_FAILURE() << "nothing is there";
    return point;
  }
};

constexpr float kRoundingOfPlaces = 2e-6f;

// acceptance: B5
TEST(Displacement, AConstantMovesASurfaceByThatAmountOfObjectUnits) {
  const std::string elements =
      displaced_material("lifted", height("\"base\" .25")) + plane().object();
  const Displaced s(elements);
  EXPECT_EQ(s.messages(), "");
  EXPECT_EQ(s.report.binding.shaders.at("test_height"), 1);
  const Displaced twice(elements, {}, "transform .5 0 0 0 0 .5 0 0 0 0 .5 0 0 0 0 1");
  for (const float x : {.01f, .3f, .77f, .99f})
    for (const float y : {.02f, .4f, .98f}) {
      expect_near(s.below(x, y).p, Vec3(x, y, .25f), kRoundingOfPlaces);
      expect_near(s.below(x, y).ns, Vec3(0, 0, 1), 1e-6f);
      expect_near(twice.below(2 * x, 2 * y).p, Vec3(2 * x, 2 * y, .5f), kRoundingOfPlaces);
    }
}

// acceptance: B5
TEST(Displacement, ShadersOfAListAddUp) {
  const Displaced s(
      displaced_material("lifted", height("\"base\" .25") + " " + height("\"base\" -.1")) +
      plane().object());
  EXPECT_NEAR(s.below(.3f, .6f).p.z, .15f, kRoundingOfPlaces);
}

// acceptance: B5
TEST(Displacement, NormalsTurnWithTheSurface) {
  const Displaced s(displaced_material("lifted", height("\"slope\" .5 .2 0")) + plane().object());
  const Vec3 normal = normalize(Vec3(-.5f, -.2f, 1));
  for (const float x : {.01f, .3f, .77f, .99f}) {
    EXPECT_NEAR(s.below(x, .4f).p.z, .5f * x + .2f * .4f, kRoundingOfPlaces);
    expect_near(s.below(x, .4f).ns, normal, 1e-5f);
  }
}

// acceptance: B5
TEST(Displacement, ATextureActsThroughItsChainOfShaders) {
  // Texel centres at 1/8, 3/8, 5/8, 7/8 of a ramp: between them a plane of slope 4/3, and squares
  // of 1/8 meet them.
  const Displaced s(
      "color texture \"ramp\" [4 1 1] '0055aaff'\n"
      "shader \"place\" \"mib_texture_vector\" ( \"select\" 0 )\n"
      "shader \"map\" \"mib_texture_remap\" ( \"input\" = \"place\" )\n"
      "shader \"ramp_s\" \"mib_texture_lookup\" ( \"tex\" \"ramp\", \"coord\" = \"map\" )\n" +
      displaced_material("lifted", "= \"ramp_s\"") + plane().object());
  EXPECT_EQ(s.messages(), "");
  EXPECT_EQ(s.report.binding.shaders.at("mib_texture_lookup"), 1);
  for (const float x : {.26f, .4f, .5f, .61f, .74f}) {
    EXPECT_NEAR(s.below(x, .3f).p.z, (x - .125f) * 4 / 3, 1e-5f) << x;
    expect_near(s.below(x, .3f).ns, normalize(Vec3(-4.0f / 3, 0, 1)), 1e-4f);
  }
}

// acceptance: B5
TEST(Displacement, ASphereGrowsAndKeepsItsNormals) {
  constexpr int kRings = 24;
  SceneText shape;
  shape.sphere("m", Vec3(0), 1, kRings);
  const std::string all = shape.str();
  const std::size_t begin = all.find("group\n"), end = all.find("end object");
  const std::string text = "object \"sheets\" visible on shadow on trace on " +
                           all.substr(begin, end - begin) + "end object\n";
  const Displaced s(displaced_material("lifted", height("\"base\" .5")) + text);
  for (int i = 0; i < 400; ++i) {
    sampling::Sampler sampler(i, 11, 0);
    const Vec3 d = sampling::sample_uniform_sphere(sampler.next_2d());
    const geom::SurfacePoint p = s.along(Vec3(0), d);
    // Between vertices a facet lies inside its sphere by the sagitta of 7.5 degrees and no more.
    EXPECT_LE(length(p.p), 1.5f + kRoundingOfPlaces);
    EXPECT_GE(length(p.p), 1.5f * (1 - 2 * sqr(std::sin(kPi / kRings / 2)) * 2));
    expect_near(p.ns, normalize(p.p), 2e-3f);
  }
}

// acceptance: B5
TEST(Displacement, SplitEdgesMoveTogetherAndStaySplit) {
  const Displaced s(
      displaced_material("lifted", height("\"base\" .1, \"wave\" .05, \"slope\" .05 .1 -.07")) +
      cube().object());
  int escaped = 0;
  constexpr int kRays = 200000;
  for (int i = 0; i < kRays; ++i) {
    sampling::Sampler sampler(i, 5, 0);
    const Vec2 a = sampler.next_2d(), b = sampler.next_2d();
    geom::Ray ray;
    ray.org = Vec3(.5f) + Vec3(a.x - .5f, a.y - .5f, b.x - .5f) * .8f;
    ray.dir = sampling::sample_uniform_sphere(sampler.next_2d());
    // The square of the scene is further away: only near objects matter.
    ray.tfar = 3;
    geom::Hit hit;
    escaped += !s.world->accel->intersect(ray, hit);
  }
  EXPECT_EQ(escaped, 0);
  // Without bumps, near an edge: each side leans to it by what the corner row moves less, not more.
  const Displaced smooth(displaced_material("lifted", height("\"base\" .02")) + cube().object());
  const Vec3 top = smooth.along(Vec3(.98f, .5f, 3), Vec3(0, 0, -1)).ns;
  const Vec3 side = smooth.along(Vec3(3, .5f, .98f), Vec3(-1, 0, 0)).ns;
  EXPECT_GT(top.z, .98f);
  EXPECT_GT(side.x, .98f);
}

// acceptance: B5
TEST(Displacement, ASeamOfCoordinatesAloneStaysSmooth) {
  // Amounts differ on both sides of x = 1: sin 20 and sin 0; normals are written alike.
  Sheets sheets;
  sheets.add(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  sheets.add(Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0));
  const Displaced s(displaced_material("lifted", height("\"wave\" .05")) + sheets.object());
  const geom::SurfacePoint left = s.below(1 - 1e-4f, .55f), right = s.below(1 + 1e-4f, .55f);
  EXPECT_NEAR(left.p.z, .05f * std::sin(20.0f) / 2, 1e-4f);
  EXPECT_NEAR(right.p.z, left.p.z, 1e-4f);
  EXPECT_GT(dot(left.ns, right.ns), .99999f);
  EXPECT_LT(dot(left.ng, right.ng), .99f);
}

// acceptance: B5
TEST(Displacement, OnlySlotsWhoseMaterialDisplacesMove) {
  Sheets sheets;
  sheets.add(Vec3(0), Vec3(1, 0, 0), Vec3(0, 1, 0), [](int i, int) { return i < 4 ? 0 : 1; });
  const Displaced s(displaced_material("lifted", height("\"base\" .25")) + sheets.object());
  EXPECT_NEAR(s.below(.2f, .5f).p.z, .25f, kRoundingOfPlaces);
  EXPECT_NEAR(s.below(.49f, .5f).p.z, .25f, kRoundingOfPlaces);
  // The first square of the other material joins both.
  EXPECT_NEAR(s.below(.5625f, .51f).p.z, .125f, 1e-5f);
  EXPECT_EQ(s.below(.7f, .5f).p.z, 0);
}

// acceptance: B5
TEST(Displacement, InstancesWithOtherDisplacementHaveMeshesOfTheirOwn) {
  std::string elements = kPlain + displaced_material("lifted", height("\"base\" .25")) +
                         displaced_material("low", height("\"base\" .1")) + plane().object();
  const char* const materials[] = {"lifted", "low", "other", "lifted"};
  const float expected[] = {.25f, .1f, 0, .25f};
  std::string members;
  for (int i = 0; i < 4; ++i) {
    elements += fmt::format(
        "instance \"i{0}\" \"sheets\" transform 1 0 0 0 0 1 0 0 0 0 1 0 {1} 0 0 1 material [ "
        "\"{2}\" ] end instance\n",
        i, -2 * i, materials[i]);
    members += fmt::format("\"i{}\" ", i);
  }
  const testing::PreparedScene s(testing::scene_text(elements, members), height_registry());
  ASSERT_NE(s.world, nullptr);
  EXPECT_EQ(s.messages(), "");
  const geom::Accel& accel = *s.world->accel;
  std::vector<geom::MeshId> mesh(4);
  for (int i = 0; i < 4; ++i) {
    geom::Ray ray;
    ray.org = Vec3(2.0f * static_cast<float>(i) + .4f, .3f, 3);
    ray.dir = Vec3(0, 0, -1);
    geom::Hit hit;
    ASSERT_TRUE(accel.intersect(ray, hit));
    EXPECT_NEAR(3 - hit.t, expected[i], 1e-5f) << i;
    mesh[static_cast<std::size_t>(i)] = accel.instance(hit.instance).mesh;
  }
  EXPECT_EQ(mesh[0], mesh[3]);
  EXPECT_NE(mesh[0], mesh[1]);
  EXPECT_NE(mesh[0], mesh[2]);
  EXPECT_NE(mesh[1], mesh[2]);
}

// acceptance: B5
TEST(Displacement, OptionsSwitchItOff) {
  const std::string elements =
      displaced_material("lifted", height("\"base\" .25")) + plane().object();
  EXPECT_EQ(Displaced(elements, "displace off").below(.4f, .4f).p.z, 0);
  EXPECT_NEAR(Displaced(elements, "displace on").below(.4f, .4f).p.z, .25f, kRoundingOfPlaces);
}

// acceptance: B5
TEST(Displacement, MaxDisplaceClampsAndIsReported) {
  const std::string material = displaced_material("lifted", height("\"base\" .25"));
  const Displaced object(material + plane().object("max displace .1"));
  EXPECT_NEAR(object.below(.4f, .4f).p.z, .1f, kRoundingOfPlaces);
  const Diagnostic* d = object.only("OR-RN-031");
  ASSERT_NE(d, nullptr) << object.messages();
  EXPECT_NE(d->message.find("reaches 0.25"), std::string::npos) << d->message;

  const Displaced options(displaced_material("lifted", height("\"base\" -.25")) + plane().object(),
                          "max displace .2");
  EXPECT_NEAR(options.below(.4f, .4f).p.z, -.2f, kRoundingOfPlaces);
  EXPECT_NE(options.only("OR-RN-031"), nullptr);

  // The object's own limit comes first, and one that is not reached is silent.
  const Displaced wide(material + plane().object("max displace .3"), "max displace .2");
  EXPECT_NEAR(wide.below(.4f, .4f).p.z, .25f, kRoundingOfPlaces);
  EXPECT_EQ(wide.messages(), "");
}

TEST(Displacement, ShadersWithoutAValueAreReportedAndMoveNothing) {
  const Displaced material(displaced_material("lifted", "\"mia_material_x\" ( )") +
                           plane().object());
  EXPECT_NE(material.only("OR-RT-030"), nullptr) << material.messages();
  EXPECT_EQ(material.below(.4f, .4f).p.z, 0);
  const Displaced unknown(displaced_material("lifted", "\"no_such_shader\" ( )") +
                          plane().object());
  EXPECT_NE(unknown.only("OR-RT-001"), nullptr) << unknown.messages();
  EXPECT_EQ(unknown.below(.4f, .4f).p.z, 0);
}

// acceptance: B5
TEST(MaterialEnvironment, IsReflectedByThatMaterialOnly) {
  const std::string mirror =
      "\"mia_material_x\" ( \"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1 )";
  SceneText scene;
  scene.uniform_sky(.25f)
      .statement("material \"own\" " + mirror +
                 " environment \"test_sky\" ( \"above\" 3 2 1, \"below\" 3 2 1 ) end material")
      .statement("material \"plain\" " + mirror + " end material")
      .emitter("glow", 7)
      .square("own", Vec3(0), 1, Vec3(0, 0, 1))
      .square("plain", Vec3(4, 0, 0), 1, Vec3(0, 0, 1))
      .square("glow", Vec3(0, 50, 50), 5, Vec3(0, -1, -1));
  const Probe probe(scene);
  const auto at = [&](const Vec3& p, const Vec3& direction) {
    return probe.ray(p - direction * .5f, direction, 64).mean;
  };
  const Vec3 down = normalize(Vec3(.3f, 0, -1));
  EXPECT_LT((at(Vec3(0), down) - Rgb(3, 2, 1)).length(), 1e-4f);
  EXPECT_LT((at(Vec3(4, 0, 0), down) - Rgb(.25f)).length(), 1e-4f);
  // Objects come before any environment, and the camera sees the scene's.
  EXPECT_LT((at(Vec3(0), normalize(Vec3(0, 1, -1))) - Rgb(7)).length(), 1e-3f);
  EXPECT_LT((probe.ray(Vec3(0, 0, 1), Vec3(0, 0, 1), 64).mean - Rgb(.25f)).length(), 1e-5f);
}

}  // namespace displacement_test
}  // namespace oriel::testing
