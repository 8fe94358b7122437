// SPDX-License-Identifier: Apache-2.0
// Stand-ins for shaders of hosts: what scenes of theirs become, and that they are reported.
#include "probe.h"
#include "runtime/closure.h"
#include "runtime/material.h"

namespace oriel {
namespace {

/// As Maya's translator writes: no declaration at hand, an engine around the surface.
const std::string kScene =
    "shader \"phong1\" \"maya_phong\" ( \"color\" .5 .5 .5, \"diffuse\" .8, "
    "\"transparency\" .25 .25 .25, \"specularColor\" .5 .5 .5, \"reflectivity\" .4, "
    "\"incandescence\" .1 0 0 )\n"
    "shader \"engine\" \"maya_shadingengine\" ( \"surfaceShader\" = \"phong1.outColor\" )\n"
    "shader \"dark\" \"maya_shadow\" ( \"transparency\" .25 .25 .25 )\n"
    "material \"m\" = \"engine\" shadow = \"dark\" photon = \"engine\" end material\n";

TEST(HostShaders, MayasSurfacesBecomeTheirParts) {
  const ProbeScene s(kScene);
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  ShadingPoint point;
  point.world = s.world.get();
  Closure c;
  shade(*s.material("m"), point, c);
  ASSERT_EQ(c.count, 4);
  // A mirror of .2 leaves .8; a quarter of that is seen through.
  EXPECT_NEAR(c.lobes[0].level.x, .8f * .75f * .5f * .8f, 1e-6f);
  EXPECT_EQ(c.lobes[1].kind, LobeKind::ThinTransmission);
  EXPECT_NEAR(c.lobes[1].level.x, .2f, 1e-6f);
  EXPECT_EQ(c.lobes[2].kind, LobeKind::Mirror);
  EXPECT_NEAR(c.lobes[2].level.x, .2f, 1e-6f);
  EXPECT_EQ(c.lobes[3].kind, LobeKind::PhongHighlight);
  EXPECT_FLOAT_EQ(c.emission.x, .1f);
}

TEST(HostShaders, TheirParametersAreReportedAsApproximated) {
  const ProbeScene s(kScene);
  EXPECT_EQ(s.report.binding.approximated.count("maya_phong.color"), 0u) << "as declared";
  EXPECT_EQ(s.report.binding.approximated.count("maya_phong.transparency"), 1u);
  EXPECT_EQ(s.report.binding.approximated.count("maya_shadow.transparency"), 1u);
}

TEST(HostShaders, MayasLightsShine) {
  const ProbeScene s(kScene +
                         "light \"l\" \"maya_spotlight\" ( \"color\" 1 .5 .25, \"intensity\" 2, "
                         "\"decayRate\" 2 ) origin 0 0 0 direction 0 0 -1 spread .9 end light\n"
                         "instance \"l_i\" \"l\" end instance\n",
                     "\"l_i\"");
  EXPECT_TRUE(s.diagnostics.all().empty()) << s.messages();
  ASSERT_EQ(s.world->lights.size(), 1u);
  ShadingPoint point;
  point.position = Vec3(0, 0, -2);
  const auto sample = sample_light(s.world->lights[0], point, Vec2(.5f));
  ASSERT_TRUE(sample.has_value());
  // A Lambert surface shows colour x cos, which is irradiance over pi.
  EXPECT_NEAR(sample->irradiance.x / kPi, 2.0f / 4, 1e-4f);
  EXPECT_NEAR(sample->irradiance.z / kPi, .5f / 4, 1e-4f);
}

}  // namespace
}  // namespace oriel
