// SPDX-License-Identifier: Apache-2.0
// Maya's lights: shaders/maya/maya_light.cpp.
#include <cmath>

#include "cases.h"
#include "maya_stages.h"

namespace oriel::effects {
namespace maya_light {
namespace {

/// A light's element, 2 units above the origin.
std::string element_of(const std::string& shader) {
  if (shader == "maya_directionallight") return "direction 0 0 -1";
  if (shader == "maya_spotlight") return "origin 0 0 2 direction 0 0 -1 spread .1";
  if (shader == "maya_arealight" || shader == "maya_shapelight")
    return "origin 0 0 2 direction 0 0 -1 rectangle .001 0 0 0 .001 0";
  return "origin 0 0 2";
}

/// A plate of that material 2 units below the light; `more` adds further elements.
Measured over_plate(const std::string& call, const std::string& element,
                    const std::string& material, const std::function<void(SceneText&)>& more,
                    int samples) {
  SceneText scene;
  scene.statement("material \"plate\" " + material + " end material");
  scene.square("plate", Vec3(0), 5, Vec3(0, 0, 1)).lambert("dark", 0);
  more(scene);
  scene.light("l", call + " " + element);
  return Probe(scene.str()).onto(Vec3(0), Vec3(0, 0, 1), 0, samples, .05f);
}

/// The light behind an opaque blocker, on a white Lambert surface.
Stage shadowed(const std::string& element) {
  return [=](const std::string& call) {
    return over_plate(
        call, element, "\"maya_lambert\" ( \"color\" 1 1 1, \"diffuse\" 1 )",
        [](SceneText& s) { s.square("dark", Vec3(0, 0, 1), .5f, Vec3(0, 0, 1)); }, 64);
  };
}
/// The light's highlight on a black surface, in the mirrored direction: its colour.
Stage highlight(const std::string& element) {
  return [=](const std::string& call) {
    return over_plate(
        call, element, "\"maya_phong\" ( \"color\" 0 0 0, \"specularColor\" 1 1 1 )",
        [](SceneText&) {}, 64);
  };
}

/// Rows of all lights, measured straight below where distance and cosine leave the colour as it is.
void add_common(Cases& all, const std::string& shader) {
  const std::string name = shader + ".", element = element_of(shader);
  const Stage lit = light(element), dark = shadowed(element), shiny = highlight(element);
  const Rgb tint(.2f, .4f, .6f);
  all.push_back(gives(name + "color", lit, "intensity 2",
                      {{".2 .4 .6", tint * 2.0f}, {"1 0 3", Rgb(2, 0, 6)}}));
  all.push_back(gives(name + "intensity", lit, "color .2 .4 .6",
                      {{"0", Rgb(0)}, {"1", tint}, {"2.5", tint * 2.5f}}));
  all.push_back(
      gives(name + "useRayTraceShadows", dark, "color .2 .4 .6", {{"on", Rgb(0)}, {"off", tint}}));
  all.push_back(gives(name + "shadowColor", dark, "color .2 .4 .6",
                      {{"0 0 0", Rgb(0)}, {".25 .25 .25", tint * .25f}, {"1 1 1", tint}}));
  all.push_back(
      both(gives(name + "emitDiffuse", lit, "color .2 .4 .6", {{"on", tint}, {"off", Rgb(0)}}),
           gives(name + "emitDiffuse", shiny, "color .2 .4 .6",
                 shader == "maya_ambientlight" ? std::vector<Given>{{"on", Rgb(0)}, {"off", Rgb(0)}}
                                               : std::vector<Given>{{"on", tint}, {"off", tint}})));
  if (shader != "maya_ambientlight")
    all.push_back(
        both(gives(name + "emitSpecular", shiny, "color .2 .4 .6", {{"on", tint}, {"off", Rgb(0)}}),
             gives(name + "emitSpecular", lit, "color .2 .4 .6", {{"on", tint}, {"off", tint}})));
}

/// No decay, linear, quadratic, cubic: straight below at 2 units and aside at 2 sqrt(2).
void add_decay(Cases& all, const std::string& shader) {
  const bool flat = shader == "maya_arealight" || shader == "maya_shapelight";
  const auto at = [&](const Vec3& point) {
    const float distance = std::sqrt(4 + dot(point, point)), cosine = 2 / distance;
    // The cosine to the surface's normal, and for area lights that to the light's normal.
    const float seen = flat ? cosine * cosine : cosine;
    std::vector<Given> values;
    for (int rate = 0; rate < 4; ++rate)
      values.push_back({std::to_string(rate), Rgb(8, 4, 2) * (seen / std::pow(distance, rate))});
    // The cone contains both points.
    const std::string others =
        shader == "maya_spotlight" ? "color 8 4 2, coneAngle 2.5" : "color 8 4 2";
    const Case c = gives(shader + ".decayRate", light(element_of(shader), point), others, values);
    return shows(c.parameter, c.check);
  };
  all.push_back(both(at(Vec3(0)), at(Vec3(2, 0, 0))));
}

/// Shares of a spot's light at angles from its axis.
struct Beam {
  const char *parameter, *others, *value;
  std::vector<std::pair<float, float>> shares;  ///< degrees from the axis, share
};

void add_spot(Cases& all) {
  // Maya's help: of a cone of 50 with a penumbra of 10, light decreases to 0 between 50 and 70
  // degrees of width, with one of -10 between 30 and 50, linearly.
  const std::vector<Beam> beams = {
      {"coneAngle", "", ".5235988", {{0, 1}, {14, 1}, {16, 0}}},
      {"coneAngle", "", "60", {{0, 1}, {29, 1}, {31, 0}}},
      {"coneAngle", "penumbraAngle .1745329", ".8726646", {{24, 1}, {30, .5f}, {36, 0}}},
      {"coneAngle", "penumbraAngle .1745329", "80", {{39, 1}, {45, .5f}, {51, 0}}},
      {"penumbraAngle", "coneAngle .8726646", "0", {{24, 1}, {26, 0}}},
      {"penumbraAngle", "coneAngle .8726646", ".1745329", {{24, 1}, {27.5f, .75f}, {32.5f, .25f}}},
      {"penumbraAngle", "coneAngle 50", "10", {{30, .5f}, {36, 0}}},
      {"penumbraAngle", "coneAngle .8726646", "-.1745329", {{14, 1}, {20, .5f}, {26, 0}}},
      // Factor: cosine of the angle to the axis, to the power of dropoff; the penumbra has it too.
      {"dropoff", "coneAngle 1.2", "0", {{0, 1}, {30, 1}}},
      {"dropoff", "coneAngle 1.2", "1", {{0, 1}, {30, std::cos(kPi / 6)}}},
      {"dropoff", "coneAngle 1.2", "10", {{0, 1}, {30, std::pow(std::cos(kPi / 6), 10.0f)}}},
      {"dropoff",
       "coneAngle 50, penumbraAngle 10",
       "4",
       {{30, .5f * std::pow(std::cos(kPi / 6), 4.0f)}}},
  };
  for (const Beam& beam : beams) {
    const std::string name = std::string("maya_spotlight.") + beam.parameter;
    const Case c = shows(name, [=] {
      for (const auto& [degrees, share] : beam.shares) {
        const float angle = degrees * kPi / 180;
        const Measured m = light(element_of("maya_spotlight"),
                                 Vec3(2 * std::tan(angle), 0, 0))(call_of(
            "maya_spotlight", std::string(beam.others) + ", " + beam.parameter + " " + beam.value));
        EXPECT_NEAR(m.mean.x, share * std::cos(angle), 1e-3f)
            << beam.parameter << ' ' << beam.value << " at " << degrees;
      }
    });
    add_or_join(all, c);
  }
}

/// Share of a disc beyond a straight edge `offset` radii from its centre.
float open_share(float offset) {
  const float t = std::min(1.0f, std::max(-1.0f, offset));
  return .5f - (std::asin(t) + t * std::sqrt(1 - t * t)) / kPi;
}

void add_directional(Cases& all) {
  // The blocker's edge is .05 to the side of the point, 1 above it.
  const Stage at_edge = [](const std::string& call) {
    return over_plate(
        call, element_of("maya_directionallight"),
        "\"maya_lambert\" ( \"color\" 1 1 1, \"diffuse\" 1 )",
        [](SceneText& s) { s.square("dark", Vec3(-.45f, 0, 1), .5f, Vec3(0, 0, 1)); }, 16384);
  };
  all.push_back(shows("maya_directionallight.lightAngle", [=] {
    const struct {
      const char* angle;
      float share;
    } cases[] = {{"0", 0},
                 {".08", 0},
                 {".2", open_share(.5f)},
                 {".4", open_share(.25f)},
                 {"22.918312", open_share(.25f)}};  // degrees
    for (const auto& c : cases)
      EXPECT_NEAR(
          at_edge(call_of("maya_directionallight", std::string("lightAngle ") + c.angle)).mean.x,
          c.share, .01f)
          << c.angle;
  }));
}

void add_ambient(Cases& all) {
  // 45 degrees aside. The share that comes from the light's position has the surface's cosine.
  const float cosine = std::sqrt(.5f);
  const auto at = [&](float share) { return Rgb(2, 1, .5f) * (share * cosine + 1 - share); };
  all.push_back(gives("maya_ambientlight.ambientShade",
                      light(element_of("maya_ambientlight"), Vec3(2, 0, 0)), "color 2 1 .5",
                      {{"0", at(0)}, {".45", at(.45f)}, {"1", at(1)}}));
}

}  // namespace
}  // namespace maya_light

Cases maya_light_cases() {
  using namespace maya_light;
  Cases all;
  for (const char* shader :
       {"maya_ambientlight", "maya_arealight", "maya_directionallight", "maya_pointlight",
        "maya_shapelight", "maya_spotlight", "maya_volumelight"}) {
    add_common(all, shader);
    const std::string name = shader;
    if (name != "maya_ambientlight" && name != "maya_directionallight") add_decay(all, shader);
  }
  add_directional(all);
  add_ambient(all);
  add_spot(all);
  return all;
}

}  // namespace oriel::effects
