// SPDX-License-Identifier: Apache-2.0
// Scattering media: shaders/physics/parti_volume.cpp.
#include "cases.h"
#include "other_stages.h"

namespace oriel::effects {
namespace other_volumes {
namespace {

using namespace other_stages;

/// Four units of air before a wall of radiance 1, under suns of a red and a green 2 that shine in a
/// direction.
Stage air(const std::string& sun, const Vec3& view = Vec3(0, 0, -1)) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.emitter("glow", 1).square("glow", Vec3(0, 0, -4), 50, kUp);
    scene.light("red", "\"mib_light_infinite\" ( \"color\" 2 0 0 ) direction " + sun);
    scene.light("green", "\"mib_light_infinite\" ( \"color\" 0 2 0 ) direction " + sun);
    scene.camera("focal 1 aperture 1 aspect 1 resolution 32 32 volume " + call);
    return Probe(scene.str()).direct_only().ray(Vec3(0), view, 4096);
  };
}

const std::string kAside = "1 0 0", kTowardEye = "0 0 1";
constexpr float kExtinction = .25f;
const float kKept = std::exp(-kExtinction * 4);

/// Henyey and Greenstein's phase function times 4 pi.
float phase(float cosine, float g) {
  return (1 - g * g) / std::pow(1 + g * g - 2 * g * cosine, 1.5f);
}

/// What is left of the wall and, of what is taken from a sun of colour 2, that share. A colour is
/// irradiance over pi, an even phase 1 / 4 pi.
Rgb seen(const Rgb& share, float turned = 1) {
  const Rgb sun = Rgb(2, 2, 0) * (turned / 4);
  return Rgb(kKept) + sun * share * (1 - kKept);
}

Cases cases() {
  Cases all;
  const std::string name = "parti_volume.", thin = "extinction .25, ";
  const std::string half = thin + "scatter .5 .5 .5 1, ";
  all.push_back(gives(name + "extinction", air(kAside), "",
                      {{"0", Rgb(1)}, {".25", Rgb(kKept)}, {".5", Rgb(kKept * kKept)}}));
  all.push_back(gives(name + "scatter", air(kAside), thin,
                      {{"0 0 0 1", Rgb(kKept)}, {".5 .25 1 1", seen(Rgb(.5f, .25f, 1))}}));
  // A right angle does not show the sign; light toward the eye is scattered forward.
  const auto lobe = [&](const char* parameter, const std::string& others) {
    const Given aside[] = {{"0", seen(Rgb(.5f))}, {".6", seen(Rgb(.5f), phase(0, .6f))}};
    const Given toward[] = {{"-.6", seen(Rgb(.5f), phase(1, -.6f))},
                            {"0", seen(Rgb(.5f))},
                            {".6", seen(Rgb(.5f), phase(1, .6f))}};
    return both(
        gives(name + parameter, air(kAside), half + others, {std::begin(aside), std::end(aside)}),
        gives(name + parameter, air(kTowardEye), half + others,
              {std::begin(toward), std::end(toward)}));
  };
  all.push_back(lobe("g1", "r 1, g2 .3"));
  all.push_back(lobe("g2", "r 0, g1 .3"));
  const float first = phase(1, .6f), second = phase(1, -.3f);
  all.push_back(gives(name + "r", air(kTowardEye), half + "g1 .6, g2 -.3",
                      {{"0", seen(Rgb(.5f), second)},
                       {".25", seen(Rgb(.5f), .25f * first + .75f * second)},
                       {"1", seen(Rgb(.5f), first)}}));
  // Upward at 45 degrees the medium ends at its height, along y.
  const Stage upward = air(kAside, Vec3(0, 1, -1));
  const auto left = [](float length) { return Rgb(std::exp(-kExtinction * length)); };
  const float root = std::sqrt(2.f);
  all.push_back(
      gives(name + "mode", upward, thin + "height 1", {{"0", left(4 * root)}, {"1", left(root)}}));
  all.push_back(both(gives(name + "height", upward, thin + "mode 1",
                           {{"-1", Rgb(1)}, {"1", left(root)}, {"2", left(2 * root)}}),
                     gives(name + "height", air(kAside, Vec3(0, -1, -1)), thin + "mode 1",
                           {{"-1", left(3 * root)}, {"1", left(4 * root)}})));
  all.push_back(gives(name + "lights", air(kAside), half,
                      {{"[ ]", seen(Rgb(.5f))},
                       {"[ \"red_i\" ]", seen(Rgb(.5f, 0, 0))},
                       {"[ \"green_i\", \"red_i\" ]", seen(Rgb(.5f))}}));
  return all;
}

}  // namespace
}  // namespace other_volumes

Cases other_volume_cases() { return other_volumes::cases(); }

}  // namespace oriel::effects
