// SPDX-License-Identifier: Apache-2.0
#include "support/test_shaders.h"

#include <vector>

namespace oriel::testing {
namespace {

/// "test_sky": one colour in the half space of `up`, another in the other.
struct TestSky {
  Rgba above, below;
  Vec3 up;
};
constexpr ParamSpec kTestSkyRows[] = {{ORIEL_PARAM(TestSky, above)},
                                      {ORIEL_PARAM(TestSky, below)},
                                      {ORIEL_PARAM(TestSky, up), .fallback = {0, 0, 1}}};
constexpr ShaderSpec kTestSky = {
    .name = "test_sky",
    .library = "test",
    .apply = kApplyEnvironment,
    .params = kTestSkyRows,
    .params_size = sizeof(TestSky),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<TestSky>();
          *static_cast<Rgba*>(result) =
              dot(call.point.ray_direction, p.up) >= 0 ? p.above : p.below;
        },
};

/// "test_direction": the ray direction as a colour around .5.
constexpr ShaderSpec kTestDirection = {
    .name = "test_direction",
    .library = "test",
    .apply = kApplyEnvironment,
    .value =
        [](const Call& call, void* result) {
          const Vec3 c = call.point.ray_direction * 0.5f + Vec3(0.5f);
          *static_cast<Rgba*>(result) = Rgba(c.x, c.y, c.z, 1);
        },
};

/// "test_place": the point in world space as a colour, to show the hit position.
struct TestPlace {
  Vec3 scale;
};
constexpr ParamSpec kTestPlaceRows[] = {{ORIEL_PARAM(TestPlace, scale), .fallback = {1, 1, 1}}};
constexpr ShaderSpec kTestPlace = {
    .name = "test_place",
    .library = "test",
    .apply = kApplyTexture,
    .params = kTestPlaceRows,
    .params_size = sizeof(TestPlace),
    .value =
        [](const Call& call, void* result) {
          const Vec3 p = call.point.position * call.as<TestPlace>().scale;
          *static_cast<Rgba*>(result) = Rgba(p.x, p.y, p.z, 1);
        },
};

/// "test_tilt": a bump shader, which turns the normal itself and returns nothing.
struct TestTilt {
  Vec3 normal;
};
constexpr ParamSpec kTestTiltRows[] = {{ORIEL_PARAM(TestTilt, normal)}};
constexpr ShaderSpec kTestTilt = {
    .name = "test_tilt",
    .library = "test",
    .apply = kApplyTexture,
    .params = kTestTiltRows,
    .params_size = sizeof(TestTilt),
    .value =
        [](const Call& call, void* result) {
          call.point.normal = normalize(call.as<TestTilt>().normal);
          *static_cast<Rgba*>(result) = Rgba(0);
        },
};

}  // namespace

const Registry& test_registry() {
  static const Registry registry([] {
    std::vector<const ShaderSpec*> specs = builtin_shaders().all();
    specs.push_back(&kTestSky);
    specs.push_back(&kTestDirection);
    specs.push_back(&kTestPlace);
    specs.push_back(&kTestTilt);
    return specs;
  }());
  return registry;
}

Registry test_registry_with(std::initializer_list<const ShaderSpec*> more) {
  std::vector<const ShaderSpec*> specs = test_registry().all();
  specs.insert(specs.end(), more);
  return Registry(specs);
}

}  // namespace oriel::testing
