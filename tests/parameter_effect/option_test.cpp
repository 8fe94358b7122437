// SPDX-License-Identifier: Apache-2.0
// Cut-outs, sides, alpha and outputs.
#include "cases.h"

namespace oriel::sensitivity {

Cases option_cases() {
  return {
      {"backface_cull",
       [] {
         const auto from_behind = [](const std::string& cull, bool in_mirror) {
           SceneText scene;
           scene.emitter("glow", 1)
               .square("glow", -kUp, 5, kUp)
               .material("m", parameters(kMatte + "diffuse_weight 0, backface_cull " + cull));
           if (!in_mirror) return seen_direct(scene.square("m", Vec3(0), 5, -kUp));
           scene.material("mirror", parameters(kMirror)).square("mirror", Vec3(0), .1f, kUp);
           return seen_direct(scene.square("glow", kUp * 2.0f, 5, -kUp).square("m", kUp, 5, kUp));
         };
         expect_color(from_behind("off", false), Rgb(0));
         expect_color(from_behind("on", false), Rgb(1));
         expect_color(from_behind("on", true), Rgb(0));  // for the camera alone
       }},
      {"propagate_alpha",
       [] {
         const auto alpha = [](const std::string& propagate) {
           return seen_direct(plate(kSheet + "transparency .75, propagate_alpha " + propagate))
               .alpha;
         };
         EXPECT_EQ(alpha("off"), 1);
         EXPECT_NEAR(alpha("on"), .25f, 1e-4f);  // nothing behind it
       }},
      {"cutout_opacity",
       [] {
         const auto over_glow = [](const std::string& opacity) {
           return seen_direct(plate(kMatte + "diffuse_weight 0, cutout_opacity " + opacity)
                                  .emitter("glow", 1)
                                  .square("glow", -kUp, 5, kUp),
                              0, 4096);
         };
         expect_color(over_glow("1"), Rgb(0));
         expect_color(over_glow(".25"), Rgb(.75f));
         expect_color(over_glow("0"), Rgb(1));
         // Only what exists shines.
         const std::string half = kMirror + "additional_color 1 1 1, cutout_opacity ";
         expect_rising({seen_direct(plate(half + "0")), seen_direct(plate(half + ".5"), 0, 4096),
                        seen_direct(plate(half + "1"))});
       }},
      {"multiple_outputs",
       [] {
         const auto parts = [](const std::string& on) {
           return seen(Probe(plate_in_sun(kMatte + "multiple_outputs " + on)).outputs(), 0, 64);
         };
         Measured on = parts("on"), off = parts("off");
         EXPECT_EQ(on.mean, off.mean);  // "result" is written either way
         EXPECT_NEAR(on.outputs[Aov::Diffuse].x, .5f, 1e-4f);
         EXPECT_NEAR(on.outputs.level_of(Aov::Diffuse).x, .5f, 1e-4f);
         EXPECT_EQ(off.outputs[Aov::Diffuse], Rgb(0));
         EXPECT_EQ(off.outputs.level_of(Aov::Diffuse), Rgb(0));
       }},
  };
}

}  // namespace oriel::sensitivity
