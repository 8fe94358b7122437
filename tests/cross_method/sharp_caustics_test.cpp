// SPDX-License-Identifier: Apache-2.0
// Which objects scatter light of which lights as photons.
#include "transport/photon/sharp_caustics.h"

#include "scenes.h"
#include "support/probe.h"
#include "transport/photon/photon_trace.h"

namespace oriel::cross_method {
namespace sharp_caustics_test {

using testing::kUp;
using testing::Probe;

// Shadow rays do not pass glass without shadow shader, so that paths bring its light.
TEST(SharpCaustics, PhotonsDoNotPassFrostedGlassWithoutShadowShader) {
  SceneText scene = SceneText("trace depth 8 8 12 caustic on");
  scene.lambert("white", .5f)
      .statement(
          "material \"frosted\" \"mia_material\" ( \"reflectivity\" 1, \"transparency\" 1, "
          "\"diffuse_weight\" 0, \"refr_ior\" 1.5, \"refr_gloss\" .4, \"refl_gloss\" .4, "
          "\"brdf_fresnel\" on, \"thin_walled\" on ) end material")
      .square("white", Vec3(0), 8, kUp)
      .square("frosted", Vec3(0, 0, 1), 8, kUp)
      .square("white", Vec3(0, 0, 4), 8, -kUp)
      .light("lamp", "\"mib_light_point\" ( \"color\" 4 4 4, \"shadow\" on ) origin .5 0 2.5");
  const Probe probe(scene);
  const SharpCaustics found(probe.world(), CausticLights::RarelyFound);
  PhotonSettings settings;
  settings.globillum = false;
  settings.sharp = &found;
  settings.each.caustic = {2000, 40000};
  RayCounts counts;
  const PhotonMap map = trace_photons(probe.world(), settings, counts).caustic;
  EXPECT_EQ(map.size(), 2000u);
  for (const Photon& photon : map.photons()) ASSERT_NEAR(photon.position.z, 4, 1e-3f);
}

/// How photons bring the light of one lamp by a triangle of satin metal.
unsigned ways_of_satin(const std::string& lamp, const std::string& more = "",
                       const std::string& flags = "",
                       const std::string& surface = kSatin + std::string(".18")) {
  SceneText scene("trace depth 8 8 12 caustic off");
  scene.lambert("floor", .5f)
      .material("satin", surface + more)
      .square("floor", Vec3(0), 8, kUp)
      .light("lamp", lamp)
      .polygon("satin", {Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(0, 1, 1)}, flags);
  const Probe probe(scene);
  const SharpCaustics found(probe.world(), CausticLights::RarelyFound);
  return found.ways_of(0) & found.ways_by(1);
}

TEST(SharpCaustics, BringGlossOnlyWhereSamplesFollowTheirRules) {
  const std::string point = "\"mib_light_point\" ( \"color\" 4 4 4, \"shadow\" on ) origin 0 0 4";
  EXPECT_EQ(ways_of_satin(point), unsigned{kByGloss});
  EXPECT_EQ(ways_of_satin(point, "", "", kVarnish), unsigned{kByGloss});
  EXPECT_EQ(ways_of_satin("\"mib_light_point\" ( \"color\" 4 4 4, \"shadow\" off ) origin 0 0 4"),
            0u)
      << "light without shadows passes objects";
  EXPECT_EQ(
      ways_of_satin(physical("9 9 9") + " origin 0 0 4 direction 0 0 -1 rectangle 9 0 0 0 9 0"), 0u)
      << "samples of a large lamp have little noise";
  EXPECT_EQ(ways_of_satin(point, ", \"refl_falloff_on\" on, \"refl_falloff_dist\" 2"), 0u);
  EXPECT_EQ(ways_of_satin(point, ", \"refl_hl_only\" on"), 0u);
  EXPECT_EQ(ways_of_satin(point, "", "shadow off"), 0u);
}

}  // namespace sharp_caustics_test
}  // namespace oriel::cross_method
