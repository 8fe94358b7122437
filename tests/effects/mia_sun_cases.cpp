// SPDX-License-Identifier: Apache-2.0
// The physical sun: shaders/architectural/mia_physicalsun.cpp. Figures are those of Preetham,
// Shirley and Smits 1999 at three wavelengths, turbidity 2 + haze: lux on a surface facing the sun.
#include <fmt/format.h>

#include <algorithm>

#include "base/math.h"
#include "cases.h"
#include "color/luminance.h"
#include "lights/photon_source.h"
#include "mia_stages.h"

namespace oriel::effects {
namespace mia_sun {

const std::string kLux = "rgb_unit_conversion 1 1 1";
/// At 45 degrees, 30 and the zenith in clear air.
const Rgb kHalf(97918, 92459, 75174), kLow(87398, 80868, 62537), kHigh(106147, 101684, 85668);

/// What a white Lambert surface that faces the sun shows: the sun's lux, at that height.
Stage facing_sun(const Vec3& to_sun) {
  const Stage level = light("direction " + text_of(-to_sun), Vec3(0), 64);
  return [=](const std::string& call) {
    Measured m = level(call);
    m.mean /= to_sun.z;
    m.error /= to_sun.z;
    return m;
  };
}

/// The share of the sun at the zenith that is seen at x units from the foot of a board's edge that
/// is 10 units above the ground, x > 0.
Stage beside_board(float x) {
  return [=](const std::string& call) {
    const auto shown = [&](bool board) {
      SceneText scene;
      scene.lambert("white", 1).square("white", Vec3(0), 5, Vec3(0, 0, 1));
      if (board) scene.square("white", Vec3(-5, 0, 10), 5, Vec3(0, 0, 1));
      scene.light("sun", call + " direction 0 0 -1");
      return Probe(scene.str(), known_shaders())
          .direct_only()
          .onto(Vec3(x, 0, 0), Vec3(0, 0, 1), 30, 4096);
    };
    const Measured whole = shown(false);
    Measured part = shown(true);
    part.mean /= whole.mean;
    part.error /= whole.mean;
    return part;
  };
}
/// Radius on the ground of the cone of true sunlight from 10 units above.
const float kPenumbra = 10 * math::tan(.00465f);
/// The share of a disc of radius 1 on one side of a line, u from its middle.
Rgb share_of_disc(float u) {
  if (u >= 1) return Rgb(1);
  return Rgb(.5f + (u * std::sqrt(1 - sqr(u)) + math::asin(u)) / kPi);
}

/// Where the photons of the sun at the zenith pass the plane z = 0, in a scene 6 units wide, and
/// their power.
struct Beam {
  Vec3 low{1e9f}, high{-1e9f};
  Rgb flux{0};
};
Beam beam_of(const std::string& parameters, const std::string& energy = "7 7 7") {
  SceneText scene;
  scene.lambert("grey", .5f).box("grey", Vec3(-3), Vec3(3), true);
  scene.light("sun", call_of("mia_physicalsun", kLux + ", samples 0, " + parameters) +
                         " direction 0 0 -1 energy " + energy);
  const Probe probe(scene.str(), known_shaders());
  const Light& sun = probe.world().lights.at(0);
  const PhotonSource source(probe.world(), sun, sun.photons.emission);
  Beam beam;
  constexpr int kPhotons = 4096;
  for (int i = 0; i < kPhotons; ++i) {
    sampling::Sampler s(0, 0, static_cast<std::uint32_t>(i));
    const Vec2 u = s.next_2d();
    const EmittedPhoton photon = source.emit(u, s.next_2d());
    const Vec3 p = photon.origin - photon.direction * (photon.origin.z / photon.direction.z);
    for (int k = 0; k < 2; ++k) {
      beam.low[k] = std::min(beam.low[k], p[k]);
      beam.high[k] = std::max(beam.high[k], p[k]);
    }
    beam.flux += source.power(photon, photon.origin.z) / float(kPhotons);
  }
  return beam;
}
void expect_beam(const Beam& beam, const Vec3& low, const Vec3& high) {
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(beam.low[k], low[k], .01f);
    EXPECT_NEAR(beam.high[k], high[k], .01f);
  }
}

void add_photons(Cases& all) {
  const std::string name = "mia_physicalsun.";
  // Photons fill the box; where both corners are 0 it is the whole scene.
  all.push_back(shows(name + "photon_bbox_min", [] {
    const std::string high = "photon_bbox_max 1 2 .1, ";
    expect_beam(beam_of(high + "photon_bbox_min 0 0 0"), Vec3(0), Vec3(1, 2, 0));
    expect_beam(beam_of(high + "photon_bbox_min -1.5 .5 -.1"), Vec3(-1.5f, .5f, 0), Vec3(1, 2, 0));
  }));
  all.push_back(shows(name + "photon_bbox_max", [] {
    expect_beam(beam_of("photon_bbox_max 1 2 .1"), Vec3(0), Vec3(1, 2, 0));
    expect_beam(beam_of("photon_bbox_max 2.5 .5 .1"), Vec3(0), Vec3(2.5f, .5f, 0));
    const Beam whole = beam_of("photon_bbox_max 0 0 0");
    for (int k = 0; k < 2; ++k) {
      EXPECT_LT(whole.low[k], -2.9f);
      EXPECT_GT(whole.high[k], 2.9f);
    }
  }));
  // On: the light's own, lux over the two square metres of the box. Off: as its element says. A
  // colour c brings pi c.
  all.push_back(shows(name + "automatic_photon_energy", [] {
    const std::string box = "photon_bbox_max 1 2 .1, automatic_photon_energy ";
    for (const char* energy : {"7 7 7", "3 2 1"})
      expect_about(beam_of(box + "on", energy).flux, kHigh * (2 * kPi));
    expect_about(beam_of(box + "on, multiplier 3").flux, kHigh * (6 * kPi));
    expect_about(beam_of(box + "off, saturation 0", "7 7 7").flux, Rgb(7 * kPi));
    expect_about(beam_of(box + "off, saturation 0, multiplier 3", "14 14 14").flux, Rgb(14 * kPi));
  }));
}

void add_shadows(Cases& all) {
  const std::string name = "mia_physicalsun.";
  const float x = .5f * kPenumbra;
  all.push_back(gives_about(name + "shadow_softness", beside_board(x), kLux,
                            {{"0", Rgb(1)},
                             {".5", Rgb(1)},
                             {"1", share_of_disc(.5f)},
                             {"2", share_of_disc(.25f)},
                             {"10", share_of_disc(.05f)}},
                            .02f));
  // Hard without samples, else as soft with any count.
  all.push_back(gives_about(name + "samples", beside_board(x), kLux,
                            {{"0", Rgb(1)}, {"1", share_of_disc(.5f)}, {"8", share_of_disc(.5f)}},
                            .02f));
}

void add_colour(Cases& all) {
  const std::string name = "mia_physicalsun.";
  const Stage half = facing_sun(toward(45));
  all.push_back(gives_about(name + "on", half, kLux, {{"on", kHalf}, {"off", Rgb(0)}}));
  all.push_back(gives_about(name + "multiplier", half, kLux,
                            {{"0", Rgb(0)}, {"1", kHalf}, {"2.5", kHalf * 2.5f}}));
  all.push_back(gives_about(
      name + "rgb_unit_conversion", half, "",
      {{"1 1 1", kHalf}, {"2 1 .5", kHalf * Rgb(2, 1, .5f)}, {"0 0 0", kHalf / 80000}}));
  all.push_back(gives_about(name + "haze", half, kLux,
                            {{"0", kHalf},
                             {"1", Rgb(86524, 80257, 63192)},
                             {"8", Rgb(36396, 29800, 18744)},
                             {"15", Rgb(15310, 11065, 5559)}}));
  // It softens shadows too: less of the sun is seen on the lit side of the edge's foot.
  all.back() =
      both(all.back(), falls(name + "haze", beside_board(.5f * kPenumbra), kLux, {"0", "5", "15"}));
  all.push_back(
      gives_about(name + "redblueshift", half, kLux,
                  {{"0", kHalf}, {".3", kHalf * Rgb(1.3f, 1, .7f)}, {"-1", kHalf * Rgb(0, 1, 2)}}));
  const float y = luminance(kHalf);
  all.push_back(gives_about(
      name + "saturation", half, kLux,
      {{"0", Rgb(y)}, {".5", (kHalf + Rgb(y)) * .5f}, {"1", kHalf}, {"2", kHalf * 2.0f - Rgb(y)}}));
  // Moved by a tenth of the height, the horizon is 30 degrees below a sun at 45, or above it.
  const Vec3 sun = toward(45);
  const float moved = 10 * (sun.z - sun.x * math::tan(kPi / 6));
  all.push_back(gives_about(
      name + "horizon_height", half, kLux,
      {{"0", kHalf}, {fmt::format("{}", moved), kLow}, {"7.08", Rgb(0)}, {"-2000", kHigh}}));
  // The other axis is 30 degrees from this sun.
  const Vec3 slanted(std::sqrt(.25f), .5f, std::sqrt(.5f));
  all.push_back(
      gives_about(name + "y_is_up", facing_sun(slanted), kLux, {{"off", kHalf}, {"on", kLow}}));
  all.push_back(gives_about(name + "illuminance_mode", half,
                            kLux + ", direct_normal_illuminance 50000",
                            {{"0", kHalf}, {"1", kHalf * (50000 / y)}}));
  all.push_back(
      gives_about(name + "direct_normal_illuminance", half, kLux + ", illuminance_mode 1",
                  {{"0", Rgb(0)}, {"1000", kHalf * (1000 / y)}, {"90000", kHalf * (90000 / y)}}));
  // The colour of 5900 K instead of the historic one, both of 127500 lux above the atmosphere.
  const auto of_lux = [](const Rgb& c) { return c / luminance(c); };
  const Rgb warmer = of_lux(Rgb(1, .8916f, .8526f)) / of_lux(Rgb(1, .992f, .911f));
  all.push_back(
      gives_about(name + "flags", half, kLux, {{"0", kHalf}, {"1", kHalf * warmer}}, .01f));
}

}  // namespace mia_sun

Cases mia_sun_cases() {
  Cases all;
  mia_sun::add_colour(all);
  mia_sun::add_shadows(all);
  mia_sun::add_photons(all);
  return all;
}

}  // namespace oriel::effects
