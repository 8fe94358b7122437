// SPDX-License-Identifier: Apache-2.0
// Rounded corners: shaders/architectural/mia_roundcorners.cpp. Within the radius of an edge the
// normal is that of a cylinder that touches both faces.
#include <fmt/format.h>

#include "cases.h"
#include "mia_stages.h"

namespace oriel::effects {
namespace mia_corners {

/// "test_normal": the vector that a shader returns, or the normal as it leaves it; 3 is added, for
/// light is not negative.
struct TestNormal {
  ShaderRef shader;
  bool normal;
};
constexpr float kMore = 3;
constexpr ParamSpec kTestNormalRows[] = {{ORIEL_PARAM(TestNormal, shader)},
                                         {ORIEL_PARAM(TestNormal, normal)}};
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
                  const auto& p = call.as<TestNormal>();
                  const Vec3 returned = p.shader.node->vector(call.point);
                  closure.emission = (p.normal ? call.point.normal : returned) + Vec3(kMore);
                },
        },
};
const Registry& known() {
  static const Registry registry([] {
    std::vector<const ShaderSpec*> specs = known_shaders().all();
    specs.push_back(&kTestNormal);
    return specs;
  }());
  return registry;
}

/// Edges of a plate whose surface has its material "m" and lies at z = 0.
enum class Edge {
  Out,    ///< at y = 2, where the plate turns down
  In,     ///< at y = -2, next to a vertical wall
  Other,  ///< at x = 1, where a plate of material "n" turns down
};

/// The vector that the shader returns, or the normal that it leaves, so far from an edge. World y
/// is half of the object's x, and the camera's x; world x is their -y.
Stage beside(Edge edge, float distance, bool normal = false) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.statement("shader \"tilt\" \"test_tilt\" ( \"normal\" .6 0 .8 )")
        .statement("shader \"wide\" \"test_show\" ( \"scalar\" .05 )")
        .statement("shader \"seen\" " + call);
    for (const char* name : {"m", "n"})
      scene.statement(
          fmt::format("material \"{}\" \"test_normal\" ( \"shader\" \"seen\", \"normal\" {} ) "
                      "end material",
                      name, normal ? "on" : "off"));
    const std::string turned = "transform 0 -1 0 0  .5 0 0 0  0 0 1 0  0 0 0 1";
    scene
        .mesh("m",
              {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0), Vec3(1, -1, -1),
               Vec3(1, 1, -1), Vec3(-1, -1, 1), Vec3(-1, 1, 1)},
              {{0, 1, 2, 3}, {1, 4, 5, 2}, {0, 3, 7, 6}}, {}, turned)
        .mesh("n", {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, -1, -1), Vec3(-1, -1, -1)},
              {{1, 0, 3, 2}}, {}, turned)
        .camera("focal 1 aperture 1 aspect 1 resolution 8 8",
                "0 -1 0 0  1 0 0 0  0 0 1 0  0 0 0 1");
    const Vec3 at = edge == Edge::Out  ? Vec3(.2f, 2 - distance, 0)
                    : edge == Edge::In ? Vec3(.2f, -2 + distance, 0)
                                       : Vec3(1 - distance, .2f, 0);
    return Probe(scene.str(), known()).onto(at, kUp, 25, 64, .01f);
  };
}

/// The normal at that distance from a right-angled edge toward which it turns.
Vec3 rounded(const Vec3& normal, const Vec3& across, float distance, float radius) {
  return distance < radius ? normalize(normal + across * (1 - distance / radius)) : normal;
}
Rgb shown(const Vec3& v) { return Rgb(v) + Rgb(kMore); }
Case corner(const std::string& parameter, Stage stage, const std::string& others,
            std::vector<Given> values) {
  for (Given& each : values) each.expected = shown(each.expected);
  return gives_about("mia_roundcorners." + parameter, std::move(stage), others, std::move(values),
                     1e-4f);
}

const Vec3 kY(0, 1, 0);
constexpr float kNear = .03f;

/// A vector of the world as the object's normals, or the camera's, have it.
Vec3 in_space(const Vec3& world, int mode) {
  if (mode % 4 == 3) return Vec3(2 * world.y, -world.x, world.z);
  if (mode % 4 == 0) return Vec3(world.y, -world.x, world.z);
  return world;
}

void add_bump(Cases& all) {
  const std::string radius = "radius .1";
  // The old bump shader moves the normal of mode 0, and of no other.
  const Vec3 tilted(.6f, 0, .8f);
  all.push_back(both(
      corner(
          "bump", beside(Edge::Out, kNear, true), radius,
          {{"\"\"", rounded(kUp, kY, kNear, .1f)}, {"\"tilt\"", rounded(tilted, kY, kNear, .1f)}}),
      corner("bump", beside(Edge::Out, .5f, true), radius, {{"\"\"", kUp}, {"\"tilt\"", tilted}})));
  all.back() = both(all.back(), corner("bump", beside(Edge::Out, kNear), radius + ", bump_mode 6",
                                       {{"\"\"", rounded(kUp, kY, kNear, .1f)},
                                        {"\"tilt\"", rounded(kUp, kY, kNear, .1f)}}));
  // What comes in is added (1-4) or a whole normal (5-8), of the world, the object or the camera;
  // so is what comes out.
  const Vec3 world(-.3f, .1f, .8f);
  for (const float distance : {kNear, .5f}) {
    std::vector<Given> moved = {{"0", rounded(kUp, kY, distance, .1f)}},
                       returned = {{"0", Vec3(0)}};
    for (int mode = 1; mode <= 8; ++mode) {
      moved.push_back({std::to_string(mode), kUp});  // left alone
      const Vec3 bumped = rounded(mode <= 4 ? kUp : Vec3(0, 0, 1), kY, distance, .1f);
      returned.push_back({std::to_string(mode), in_space(mode <= 4 ? bumped - kUp : bumped, mode)});
    }
    for (const Case& c : {corner("bump_mode", beside(Edge::Out, distance, true), radius, moved),
                          corner("bump_mode", beside(Edge::Out, distance), radius, returned)})
      if (all.back().parameter == c.parameter)
        all.back() = both(all.back(), c);
      else
        all.push_back(c);
  }
  const std::size_t modes = all.size();
  for (int mode = 0; mode <= 8; ++mode)
    for (const float distance : {kNear, .5f}) {
      const Vec3 bumped = normalize(mode <= 4 ? kUp + world : world);
      // The edge moves the bumped normal as it moves the plate's own.
      const Vec3 n = distance < .1f ? normalize(bumped + kY * (1 - distance / .1f)) : bumped;
      const Vec3 plain = rounded(kUp, kY, distance, .1f);
      const auto out = [&](const Vec3& v) {
        return mode == 0 ? Vec3(0) : in_space(mode <= 4 ? v - kUp : v, mode);
      };
      const Case c = corner("bump_vector", beside(Edge::Out, distance),
                            fmt::format("{}, bump_mode {}", radius, mode),
                            {{"0 0 0", out(plain)}, {text_of(in_space(world, mode)), out(n)}});
      if (all.size() == modes)
        all.push_back(c);
      else
        all.back() = both(all.back(), c);
    }
}

}  // namespace mia_corners

Cases mia_roundcorners_cases() {
  using namespace mia_corners;
  Cases all;
  const auto wide = [](float radius) { return rounded(kUp, kY, kNear, radius); };
  all.push_back(corner("radius", beside(Edge::Out, kNear), "bump_mode 6",
                       {{"0", kUp},
                        {".02", kUp},
                        {".05", wide(.05f)},
                        {".3", wide(.3f)},
                        {"= \"wide\"", wide(.05f)}}));
  const std::string world = "radius .1, bump_mode 6";
  all.push_back(both(corner("allow_different_materials", beside(Edge::Other, kNear), world,
                            {{"off", kUp}, {"on", rounded(kUp, Vec3(1, 0, 0), kNear, .1f)}}),
                     corner("allow_different_materials", beside(Edge::Out, kNear), world,
                            {{"off", wide(.1f)}, {"on", wide(.1f)}})));
  // All, convex and concave edges: at the latter the normal turns to that of the wall.
  const Vec3 in = rounded(kUp, kY, kNear, .1f);
  all.push_back(
      both(corner("edges", beside(Edge::Out, kNear), world,
                  {{"0", wide(.1f)}, {"1", wide(.1f)}, {"2", kUp}}),
           corner("edges", beside(Edge::In, kNear), world, {{"0", in}, {"1", kUp}, {"2", in}})));
  add_bump(all);
  return all;
}

}  // namespace oriel::effects
