// SPDX-License-Identifier: Apache-2.0
// Shadow catchers compared with closed forms.
#include "support/probe.h"

namespace oriel::testing {
namespace shadow_catchers_test {

/// A floor of that material at z = 0 under a sun from above and a square blocker over x > 0; behind
/// the floor is a sky of radiance .5 and alpha 0.
std::string floor_of(const std::string& material) {
  return SceneText("trace depth 4 4 8 shadow segments")
      .statement("material \"floor\" " + material + " end material")
      .lambert("blocker", 0)
      .square("floor", Vec3(0), 10, Vec3(0, 0, 1))
      .square("blocker", Vec3(5, 0, 4), 4, Vec3(0, 0, -1))
      .light("sun", "\"mib_light_infinite\" ( \"color\" 3 3 3, \"shadow\" on ) direction 0 0 -1")
      .environment("\"test_sky\" ( \"above\" .5 .5 .5 0, \"below\" .5 .5 .5 0 )")
      .str();
}
Measured seen(const std::string& material, float x) {
  return Probe(floor_of(material)).onto(Vec3(x, 0, 0), Vec3(0, 0, 1), 0, 256);
}

TEST(ShadowCatchers, UseBackgroundDarkensTheBackgroundInShadows) {
  for (const float mask : {1.0f, .25f}) {
    const std::string shader = fmt::format(
        "\"adskMayaUseBackground\" ( \"specularColor\" 0 0 0, \"shadowMask\" {} )", mask);
    const Measured lit = seen(shader, -5), dark = seen(shader, 5);
    EXPECT_NEAR(lit.mean.x, .5f, 1e-4f);
    EXPECT_NEAR(lit.alpha, 0, 1e-4f);
    EXPECT_NEAR(dark.mean.x, .5f * (1 - mask), 1e-4f) << mask;
    EXPECT_NEAR(dark.alpha, mask, 1e-4f) << "the shadow is what covers the background";
  }
}

TEST(ShadowCatchers, UseBackgroundReflects) {
  // Straight from above, the blocker's black is in the mirror over x > 0, elsewhere the sky.
  const char* shader =
      "\"maya_usebackground\" ( \"specularColor\" .5 .5 .5, \"reflectivity\" .5, "
      "\"shadowMask\" 0 )";
  EXPECT_NEAR(seen(shader, -5).mean.x, .5f, 2e-2f);
  EXPECT_NEAR(seen(shader, 5).mean.x, .5f * .75f, 2e-2f);
}

TEST(ShadowCatchers, MatteShadowBlendsItsColours) {
  const char* shader =
      "\"mip_matteshadow\" ( \"background\" .8 .8 .8 1, \"shadows\" .1 .1 .1 1, \"ambient\" .25 "
      ".25 .25, \"some_later_parameter\" 3 )";
  EXPECT_NEAR(seen(shader, -5).mean.x, .8f, 1e-4f);
  EXPECT_NEAR(seen(shader, 5).mean.x, .25f * .8f + .75f * .1f, 1e-4f);
  const char* off = "\"mip_matteshadow\" ( \"background\" .8 .8 .8 .5, \"catch_shadows\" off )";
  EXPECT_NEAR(seen(off, 5).mean.x, .8f, 1e-4f);
  EXPECT_NEAR(seen(off, 5).alpha, .5f, 1e-4f) << "returned with its alpha";
}

}  // namespace shadow_catchers_test
}  // namespace oriel::testing
