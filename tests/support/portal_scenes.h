// SPDX-License-Identifier: Apache-2.0
// Rooms with a window under a sky, for tests of portal lights, and irradiance of the window by
// quadrature.
#pragma once

#include <limits>

#include "support/probe.h"

namespace oriel::testing {

/// "test_lamps": a gradient and a small bright spot; rays that do not gather see one more.
struct TestLamps {
  Rgba low, high, lamp;
  Vec3 toward;
  float width;
  Rgba hidden;
};
inline constexpr ParamSpec kTestLampsRows[] = {
    {ORIEL_PARAM(TestLamps, low), .fallback = {.2f, .3f, .1f}},
    {ORIEL_PARAM(TestLamps, high), .fallback = {.5f, 1, 2}},
    {ORIEL_PARAM(TestLamps, lamp), .fallback = {300, 200, 100}},
    {ORIEL_PARAM(TestLamps, toward), .fallback = {-.8f, -.3f, .25f}},
    {ORIEL_PARAM(TestLamps, width), .fallback = {.03f}},
    {ORIEL_PARAM(TestLamps, hidden)}};
inline constexpr ShaderSpec kTestLamps = {
    .name = "test_lamps",
    .library = "test",
    .apply = kApplyEnvironment,
    .params = kTestLampsRows,
    .params_size = sizeof(TestLamps),
    .value =
        [](const Call& call, void* result) {
          const auto& p = call.as<TestLamps>();
          const Vec3 d = call.point.ray_direction;
          const float away = length(d - normalize(p.toward)) / p.width;
          Rgba c = p.low + (p.high - p.low) * (.5f + .5f * d.z) + p.lamp * std::exp(-away * away);
          if (call.point.ray_kind != RayKind::FinalGather) c += p.hidden;
          *static_cast<Rgba*>(result) = c;
        },
};

inline const Registry& registry() {
  static const Registry all = test_registry_with({&kTestLamps});
  return all;
}
inline Probe probe_of(const SceneText& scene) { return Probe(scene.str(), registry()); }

inline constexpr const char* kSky =
    "\"mia_physicalsky\" ( \"sun_direction\" -.6 -.5 .5, \"haze\" 1, \"ground_color\" .2 .3 .1 )";
inline constexpr const char* kLamps = "\"test_lamps\" ( )";

/// A rectangle around `centre` that looks along +x, w wide in y and h high in z, in the light's x/y
/// plane and moved by the instance; its own z goes along +x.
inline void add_portal(SceneText& scene, const std::string& name, const Vec3& centre, float w,
                       float h, const std::string& parameters = {}) {
  scene.light(name,
              fmt::format("\"mia_portal_light\" ( {} ) origin 0 0 0 rectangle {} 0 0 0 {} 0 3 3",
                          parameters, w, h),
              fmt::format("visible on transform 0 0 1 0  1 0 0 0  0 1 0 0  {} {} {} 1", -centre.y,
                          -centre.z, -centre.x));
}

/// The opening of the room, at x = 0.
struct Opening {
  float y0 = -.6f, y1 = .8f, z0 = .9f, z1 = 2.1f;
};

/// A room of 4 x 3 x 3 with the opening in the wall at x = 0.
inline SceneText room(const std::string& environment, float albedo, const Opening& o = {},
                      const std::string& options = "trace depth 8 8 12 shadow segments") {
  SceneText scene(options);
  scene.environment(environment).lambert("wall", albedo);
  const auto wall = [&](std::vector<Vec3> corners) { scene.polygon("wall", corners); };
  const float x = 4, y = 1.5f, z = 3;
  wall({Vec3(0, -y, 0), Vec3(x, -y, 0), Vec3(x, y, 0), Vec3(0, y, 0)});
  wall({Vec3(0, -y, z), Vec3(0, y, z), Vec3(x, y, z), Vec3(x, -y, z)});
  wall({Vec3(x, -y, 0), Vec3(x, -y, z), Vec3(x, y, z), Vec3(x, y, 0)});
  wall({Vec3(0, -y, 0), Vec3(0, -y, z), Vec3(x, -y, z), Vec3(x, -y, 0)});
  wall({Vec3(0, y, 0), Vec3(x, y, 0), Vec3(x, y, z), Vec3(0, y, z)});
  const auto front = [&](float y0, float z0, float y1, float z1) {
    wall({Vec3(0, y0, z0), Vec3(0, y1, z0), Vec3(0, y1, z1), Vec3(0, y0, z1)});
  };
  front(-y, 0, y, o.z0);
  front(-y, o.z1, y, z);
  front(-y, o.z0, o.y0, o.z1);
  front(o.y1, o.z0, y, o.z1);
  return scene;
}

/// Fills the opening with n x n portals.
inline SceneText& add_window(SceneText& scene, int n = 1, const std::string& parameters = {},
                             const Opening& o = {}) {
  const float w = (o.y1 - o.y0) / static_cast<float>(n), h = (o.z1 - o.z0) / static_cast<float>(n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      add_portal(scene, fmt::format("portal{}_{}", i, j),
                 Vec3(0, o.y0 + w * (static_cast<float>(i) + .5f),
                      o.z0 + h * (static_cast<float>(j) + .5f)),
                 w, h, parameters);
  return scene;
}

/// What a white card sees of the environment through the opening: a sum over its area.
inline Rgb by_quadrature(const World& world, const Vec3& p, const Vec3& n,
                         RayKind kind = RayKind::FinalGather, int steps = 384) {
  const Opening o;
  Imath::Vec3<double> sum(0.0);  // double: many small terms
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      const Vec3 q(0, lerp(o.y0, o.y1, (static_cast<float>(i) + .5f) / static_cast<float>(steps)),
                   lerp(o.z0, o.z1, (static_cast<float>(j) + .5f) / static_cast<float>(steps)));
      const Vec3 to = q - p, wi = normalize(to);
      const float cosine = dot(wi, n);
      if (cosine <= 0) continue;
      const Rgb l = rgb(environment_radiance(world.environment, world, p, wi, kind));
      sum += Imath::Vec3<double>(l * (cosine * -wi.x / dot(to, to)));
    }
  const double cell = double(o.y1 - o.y0) * double(o.z1 - o.z0) / (double(steps) * double(steps));
  return Rgb(Imath::V3f(sum * (cell / double(kPi))));
}

}  // namespace oriel::testing
