// SPDX-License-Identifier: Apache-2.0
// Displacement that makes its own triangles: heights and normals of known fields, without cracks.
#include "prepare/refine_displacement.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>

#include "prepare/testing/prepared_scene.h"
#include "sampling/sampler.h"
#include "sampling/warp.h"

namespace oriel {
namespace refine_displacement_test {

constexpr float kWaves = 9;  // per unit

/// "test_waves": height sin(9 x) cos(9 y) + slant x of the object's position.
struct TestWaves {
  float height, slant;
};
constexpr ParamSpec kTestWavesRows[] = {{ORIEL_PARAM(TestWaves, height)},
                                        {ORIEL_PARAM(TestWaves, slant)}};
constexpr ShaderSpec kTestWaves = {
    .name = "test_waves",
    .library = "test",
    .apply = kApplyTexture,
    .params = kTestWavesRows,
    .params_size = sizeof(TestWaves),
    .result = ParamType::Scalar,
    .result_size = sizeof(float),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<TestWaves>();
          const Vec3 at = transform_point(call.point.position, *call.point.to_object);
          *static_cast<float*>(result) =
              p.height * std::sin(kWaves * at.x) * std::cos(kWaves * at.y) + p.slant * at.x;
        },
};

const Registry& wave_registry() {
  static const Registry registry([] {
    std::vector<const ShaderSpec*> specs = builtin_shaders().all();
    specs.push_back(&kTestWaves);
    return specs;
  }());
  return registry;
}

std::string waves(float height, float slant = 0) {
  return fmt::format(
      "material \"m\" \"mib_illum_lambert\" ( ) end material\n"
      "material \"lifted\" \"mib_illum_lambert\" ( ) displace \"test_waves\" ( \"height\" {}, "
      "\"slant\" {} ) end material\n",
      height, slant);
}

/// The unit square on z = 0 as one polygon without normals.
std::string square(const std::string& approximation, const std::string& flags = {}) {
  return "object \"o\" visible trace shadow " + flags +
         " group 0 0 0 1 0 0 1 1 0 0 1 0 v 0 v 1 v 2 v 3 p 0 1 2 3\n" + approximation +
         "\nend group end object\n";
}

struct Waves : testing::PreparedScene {
  explicit Waves(const std::string& elements, const std::string& options = {},
                 const std::string& transform = {})
      : PreparedScene(testing::scene_text(elements + "instance \"o_i\" \"o\" " + transform +
                                              " material \"lifted\" end instance\n",
                                          "\"o_i\"", {}, options),
                      wave_registry()) {
    EXPECT_NE(world, nullptr) << messages();
  }

  const geom::Mesh& mesh() const {
    for (std::uint32_t i = 0; i < world->accel->instance_count(); ++i)
      if (world->instances[world->accel->instance(i).user].name == "o_i")
        return world->accel->mesh(world->accel->instance(i).mesh);
    ADD_FAILURE() << "the object is not there";
    return world->accel->mesh(world->accel->instance(0).mesh);
  }
  /// The first surface below (x, y, 3); z of NAN when there is none.
  geom::SurfacePoint below(float x, float y) const {
    geom::Ray ray;
    ray.org = Vec3(x, y, 3);
    ray.dir = Vec3(0, 0, -1);
    geom::Hit hit;
    geom::SurfacePoint point{};
    point.p.z = NAN;
    if (world->accel->intersect(ray, hit)) world->accel->interpolate(hit, point);
    return point;
  }
};

/// The largest deviations of height and normal over the square.
struct Deviation {
  float place = 0, normal = 0;
};

Deviation deviation(const Waves& scene, float height) {
  Deviation worst;
  for (int i = 0; i < 4000; ++i) {
    sampling::Sampler sampler(i, 3, 0);
    const Vec2 at = sampler.next_2d();
    // The boundary has triangles on one side only, and normals of first order there.
    const float x = .1f + .8f * at.x, y = .1f + .8f * at.y;
    const geom::SurfacePoint p = scene.below(x, y);
    const float wave = height * std::sin(kWaves * x) * std::cos(kWaves * y);
    const float du = height * kWaves * std::cos(kWaves * x) * std::cos(kWaves * y);
    const float dv = -height * kWaves * std::sin(kWaves * x) * std::sin(kWaves * y);
    worst.place = std::max(worst.place, std::abs(p.p.z - wave));
    worst.normal = std::max(worst.normal, length(p.ns - normalize(Vec3(-du, -dv, 1))));
  }
  return worst;
}

/// The number of triangle sides that do not belong to exactly two triangles.
int open_sides(const geom::Mesh& mesh) {
  std::map<std::array<float, 6>, int> sides;
  for (const geom::Triangle& t : mesh.triangles)
    for (const auto& [a, b] : {std::pair{t.a, t.b}, {t.b, t.c}, {t.c, t.a}}) {
      Vec3 p = mesh.positions[a], q = mesh.positions[b];
      if (std::array{q.x, q.y, q.z} < std::array{p.x, p.y, p.z}) std::swap(p, q);
      ++sides[{p.x, p.y, p.z, q.x, q.y, q.z}];
    }
  int open = 0;
  for (const auto& [side, count] : sides) open += count != 2;
  return open;
}

// acceptance: B5
TEST(DisplacementDetail, PlacesAndNormalsConvergeWithTheSquareOfTheEdges) {
  constexpr float kHeight = .05f;
  std::vector<Deviation> worst;
  for (const float length : {.1f, .05f, .025f})
    worst.push_back(deviation(
        Waves(waves(kHeight) + square(fmt::format("approximate displace length {} 0 9", length))),
        kHeight));
  // Halving the edges quarters both, once they resolve the wave.
  for (std::size_t i = 1; i < worst.size(); ++i) {
    EXPECT_GT(worst[i - 1].place / worst[i].place, 3.4f) << i;
    EXPECT_LT(worst[i - 1].place / worst[i].place, 4.6f) << i;
    EXPECT_GT(worst[i - 1].normal / worst[i].normal, 3.0f) << i;
  }
  // h^2 / 8 of the second derivative across, for edges of 1/64 along the axes.
  EXPECT_LT(worst[2].place, 2 * kHeight * kWaves * kWaves / 8 / 64 / 64 * 1.5f);
}

// acceptance: B5
TEST(DisplacementDetail, PolygonsWithoutApproximationKeepTheirVertices) {
  EXPECT_EQ(Waves(waves(.05f) + square("")).mesh().triangles.size(), 2u);
  EXPECT_EQ(
      Waves(waves(.05f) + square("approximate displace parametric 3")).mesh().triangles.size(),
      2u * 64);
  EXPECT_EQ(Waves(waves(.05f) + square("approximate parametric 2")).mesh().triangles.size(),
            2u * 16)
      << "their own, when there is none for displacement";
  EXPECT_EQ(Waves(waves(.05f) + square("approximate displace parametric 3"), "displace off")
                .mesh()
                .triangles.size(),
            2u);
}

// acceptance: B5
TEST(DisplacementDetail, DistanceIsMetWithFewerTrianglesThanEvenOnes) {
  constexpr float kHeight = .05f, kDistance = .001f;
  const Waves measured(waves(kHeight) + square("approximate displace distance .001 0 8"));
  EXPECT_LT(deviation(measured, kHeight).place, 2 * kDistance);
  EXPECT_LT(measured.mesh().triangles.size(), 2u << 12);
  EXPECT_GT(measured.mesh().triangles.size(), 2u << 6);
}

TEST(DisplacementDetail, MaxEndsItBeforeThereAreMoreTriangles) {
  const Waves s(waves(.05f) + square("approximate displace length .001 0 9 max 600"));
  EXPECT_EQ(s.mesh().triangles.size(), 2u * 256);
  EXPECT_EQ(s.messages(), "") << "as it was asked for";
}

// acceptance: B5
TEST(DisplacementDetail, LengthsInPixelsFollowTheDistanceFromTheCamera) {
  // Seen by a camera at the origin that looks down -z.
  const auto count = [](float distance) {
    return Waves(waves(.01f) + square("approximate displace fine view length .5"), {},
                 fmt::format("transform 1 0 0 0 0 1 0 0 0 0 1 0 0 0 {} 1", distance))
        .mesh()
        .triangles.size();
  };
  const std::size_t near_by = count(2), far_away = count(8);
  EXPECT_GE(near_by, far_away * 8) << near_by << " " << far_away;
  EXPECT_GT(far_away, 2u);
}

// acceptance: B5
TEST(DisplacementDetail, ASubdivisionSurfaceStaysClosedAndSmooth) {
  const Waves s(
      waves(.05f, .1f) +
      "object \"o\" visible trace shadow group 1 0 0 -1 0 0 0 1 0 0 -1 0 0 0 1 0 0 -1\n"
      "v 0 v 1 v 2 v 3 v 4 v 5 subdivision surface \"s\" p 0 2 4 p 2 1 4 p 1 3 4 p 3 0 4 p 2 0 5 "
      "p 1 2 5 p 3 1 5 p 0 3 5 end subdivision surface\n"
      "approximate subdivision surface parametric 2 \"s\"\n"
      "approximate displace length .03 0 7 \"s\" end group end object\n");
  EXPECT_EQ(s.messages(), "");
  EXPECT_GT(s.mesh().triangles.size(), 10000u);
  EXPECT_EQ(open_sides(s.mesh()), 0);
  for (int i = 0; i < 20000; ++i) {
    sampling::Sampler sampler(i, 5, 0);
    geom::Ray ray;
    ray.dir = sampling::sample_uniform_sphere(sampler.next_2d());
    ray.tfar = 2;
    geom::Hit hit;
    ASSERT_TRUE(s.world->accel->intersect(ray, hit));
    geom::SurfacePoint p{};
    s.world->accel->interpolate(hit, p);
    EXPECT_GT(dot(p.ns, p.ng), .97f);
  }
}

// acceptance: B5
TEST(DisplacementDetail, SharpEdgesOfPolygonsStaySharpAndDoNotOpen) {
  const Waves s(
      waves(.02f, .05f) +
      "object \"o\" visible trace shadow group 0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1\n"
      "v 0 v 1 v 2 v 3 v 4 v 5 v 6 v 7 p 0 3 2 1 p 4 5 6 7 p 0 1 5 4 p 1 2 6 5 p 2 3 7 6 p 3 0 4 "
      "7\n"
      "approximate displace length .05 0 9 end group end object\n");
  EXPECT_EQ(open_sides(s.mesh()), 0);
  // Near an edge both sides keep about their own direction.
  EXPECT_GT(s.below(.99f, .5f).ns.z, .9f);
}

}  // namespace refine_displacement_test
}  // namespace oriel
