// SPDX-License-Identifier: Apache-2.0
// Conditions for lights to emit photons: energy statement, switched on, above the horizon.
#include "render/session.h"
#include "support/picture.h"
#include "support/portal_scenes.h"
#include "transport/photon/photon_trace.h"

namespace oriel::testing {
namespace photon_energy_test {

/// A floor with a wall, under open sky.
SceneText corner() {
  SceneText scene;
  scene.lambert("grey", .5f).uniform_sky(1);
  scene.square("grey", Vec3(0, 0, -3), 3, kUp).square("grey", Vec3(0, 3, 0), 3, Vec3(0, -1, 0));
  return scene.square("grey", Vec3(0, -3, 0), 3, Vec3(0, 1, 0));
}

/// Photons of the only light that are stored there, after a bounce at least.
std::size_t photons(const std::string& element, bool by_energy, const std::string& instance = {}) {
  const Probe probe = probe_of(corner().light("lamp", element, instance));
  PhotonSettings settings;
  settings.each.global.emit = 200;
  settings.by_energy = by_energy;
  RayCounts counts;
  return trace_photons(probe.world(), settings, counts).global.photons().size();
}

const std::string kPoint = "\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 1 ";
/// Straight from where that light is on its way through the box.
std::string sun(const std::string& parameters, const std::string& direction = "0 0 -1") {
  return "\"mia_physicalsun\" ( " + parameters + " ) direction " + direction + " ";
}
std::string portal(const std::string& parameters) {
  return "\"mia_portal_light\" ( " + parameters + " ) origin 0 0 0 rectangle 1 0 0 0 1 0 3 3 ";
}
const std::string kVisible = "visible on";
const std::string kAutomatic = "\"automatic_photon_energy\" on";

TEST(PhotonEnergy, ScenesThatAskForPhotonsGetThemOfLightsWithEnergy) {
  EXPECT_EQ(photons(kPoint, true), 0u);
  EXPECT_GT(photons(kPoint + "energy 1 1 1", true), 0u);
  EXPECT_EQ(photons(kPoint + "energy 0 0 0", true), 0u);
  EXPECT_GT(photons(kPoint + "energy 0 0 .1", true), 0u);
  // If selected by name, photons compute the existing light in another way.
  EXPECT_GT(photons(kPoint, false), 0u);
  EXPECT_EQ(photons(kPoint + "energy 0 0 0", false), 0u);
}

// Manual 2.5, automatic_photon_energy: "it does, however, need a nonzero energy value or photon
// emission is disabled".
// acceptance: S14, S15
TEST(PhotonEnergy, OfTheSunIsAutomaticWrittenOrNone) {
  for (const bool by_energy : {true, false}) {
    EXPECT_GT(photons(sun(kAutomatic) + "energy 1 1 1", by_energy), 0u);
    EXPECT_GT(photons(sun(kAutomatic), by_energy), 0u);
    EXPECT_EQ(photons(sun(kAutomatic) + "energy 0 0 0", by_energy), 0u);
    EXPECT_GT(photons(sun("") + "energy 1 1 1", by_energy), 0u);
    EXPECT_EQ(photons(sun("\"on\" off") + "energy 1 1 1", by_energy), 0u);
    EXPECT_EQ(photons(sun("\"multiplier\" 0") + "energy 1 1 1", by_energy), 0u);
    EXPECT_EQ(photons(sun("\"on\" off, " + kAutomatic) + "energy 1 1 1", by_energy), 0u);
    // It shines upward: the sun has set.
    EXPECT_EQ(photons(sun("", "1 0 .1") + "energy 1 1 1", by_energy), 0u);
    EXPECT_EQ(photons(sun("\"y_is_up\" on", "0 1 -.1") + "energy 1 1 1", by_energy), 0u);
    EXPECT_GT(photons(sun("\"y_is_up\" on", "0 -1 -.1") + "energy 1 1 1", by_energy), 0u);
  }
  EXPECT_EQ(photons(sun(""), true), 0u);
}

// acceptance: L3, L7
TEST(PhotonEnergy, OfAPortalIsThatOfTheSkyBehindItUnlessItIsOff) {
  for (const bool by_energy : {true, false}) {
    EXPECT_GT(photons(portal(""), by_energy, kVisible), 0u);
    EXPECT_GT(photons(portal("") + "energy 1 1 1", by_energy, kVisible), 0u);
    EXPECT_EQ(photons(portal("") + "energy 0 0 0", by_energy, kVisible), 0u);
    EXPECT_EQ(photons(portal("\"on\" off") + "energy 1 1 1", by_energy, kVisible), 0u);
    EXPECT_EQ(photons(portal("\"multiplier\" 0") + "energy 1 1 1", by_energy, kVisible), 0u);
  }
}

// acceptance: L3, S15
TEST(PhotonEnergy, MultipliersSidesAndTintsActOnPhotons) {
  const auto light_of = [](const std::string& element, const std::string& instance) {
    return probe_of(corner().light("lamp", element, instance));
  };
  const auto flux = [&](const std::string& element, const std::string& instance = {}) {
    const Probe probe = light_of(element, instance);
    const Light& light = probe.world().lights[0];
    return PhotonSource(probe.world(), light, light.photons.emission).estimate_flux(1 << 14);
  };
  // A Lambertian card of radiance 1 (in pixel units) and area 1 sends pi.
  const std::string all = "\"cutoff_threshold\" 0";
  EXPECT_NEAR(flux(portal(all), kVisible).y, kPi, .02f * kPi);
  const Rgb tinted = flux(portal(all + ", \"tint_color\" .5 1 .25, \"multiplier\" 4"), kVisible);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(tinted[k], Rgb(2, 4, 1)[k] * kPi, .08f * kPi);
  // It shines to +z of its space, reversed to -z; shadows that are off stop no photons.
  for (const char* way : {"", "\"reverse\" on", "\"shadows\" off"}) {
    const Probe probe = light_of(portal(way), kVisible);
    const EmittedPhoton photon =
        PhotonSource(probe.world(), probe.world().lights[0]).emit(Vec2(.3f), Vec2(.6f));
    EXPECT_GT(photon.direction.z * (std::string(way) == "\"reverse\" on" ? -1 : 1), 0) << way;
  }
  const std::string units = kAutomatic + ", \"rgb_unit_conversion\" 1 1 1";
  const Rgb one = flux(sun(units)), three = flux(sun(units + ", \"multiplier\" 3"));
  EXPECT_NEAR(three.y / one.y, 3, 2e-3f);
  // The sun is the same whichever axis is up, as its direction turns along.
  const Rgb low = flux(sun(units, "0 1 -.5")),
            turned = flux(sun(units + ", \"y_is_up\" on", "0 -.5 1"));
  EXPECT_NEAR(low.y / turned.y, 1, 2e-3f);
  EXPECT_LT(low.y, .99f * one.y);
}

/// A scene that enables photons itself, and its diagnostics.
std::vector<Diagnostic> said_of(const std::string& lights, const std::string& method) {
  const std::string text =
      "options \"opt\" object space trace on globillum on " + method +
      " end options camera \"cam\" focal 1 aperture 1 aspect 1 resolution 4 4 end camera instance "
      "\"cam_i\" \"cam\" end instance material \"m\" \"mia_material_x\" ( ) end material "
      "object \"o\" visible on trace on group -9 -9 -5 9 -9 -5 0 9 -5 v 0 v 1 v 2 c 0 1 2 end "
      "group "
      "end object instance \"o_i\" \"o\" material \"m\" end instance " +
      lights +
      "instgroup \"world\" \"cam_i\" \"o_i\" \"a_i\" \"b_i\" end instgroup render \"world\" "
      "\"cam_i\" \"opt\"\n";
  Diagnostics diagnostics;
  for (int frame = 0; frame < 2; ++frame)
    RenderedScene(text, {.budget = {.samples = 1}, .diagnostics = &diagnostics});
  return diagnostics.all();
}

TEST(PhotonEnergy, LightsWithoutEnergyAreReportedOnce) {
  const auto lights = [](const std::string& energy) {
    return "light \"a\" " + kPoint + energy + " end light light \"b\" " + kPoint + energy +
           " end light instance \"a_i\" \"a\" end instance instance \"b_i\" \"b\" end instance ";
  };
  const std::vector<Diagnostic> said = said_of(lights(""), "");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].code, "OR-RN-067");
  EXPECT_NE(said[0].message.find("\"a_i\" and 1 more"), std::string::npos) << said[0].message;
  EXPECT_TRUE(said_of(lights("energy 1 1 1"), "").empty());
  EXPECT_TRUE(said_of(lights("energy 0 0 0"), "").empty());
  EXPECT_TRUE(said_of(lights(""), "\"indirect\" \"photons\"").empty());
}

}  // namespace photon_energy_test
}  // namespace oriel::testing
