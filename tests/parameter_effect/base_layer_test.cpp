// SPDX-License-Identifier: Apache-2.0
// The second reflection layer, below the first.
#include "cases.h"

namespace oriel::sensitivity {
namespace {

/// Nothing but the second layer.
const std::string kBase = "diffuse_weight 0, reflectivity 0, refl_base 1, refl_base_color 1 1 1, ";

}  // namespace

Cases base_layer_cases() {
  return {
      {"refl_base",
       [] {
         const auto layer = [](const std::string& base, const std::string& list) {
           return seen_direct(plate_in_sky(kBase + "refl_base " + base + ", " + list), 0, 4096);
         };
         expect_color(layer("0", ""), Rgb(0));
         expect_color(layer("1", ""), Rgb(1));
         expect_times(3, layer(".25", ""), layer(".75", ""));
         // Below a first layer that reflects .5: it gets the other half.
         const std::string first = "reflectivity 1, brdf_0_degree_refl .5";
         expect_color(layer("0", first), Rgb(.5f));
         expect_color(layer(".5", first), Rgb(.75f));
       }},
      {"refl_base_color",
       [] {
         expect_color(seen_direct(plate_in_sky(kBase + "refl_base_color 1 .3 0")), Rgb(1, .3f, 0));
         expect_color(seen_direct(plate_in_sky(kBase + "refl_base_color 0 .5 1")), Rgb(0, .5f, 1));
       }},
      {"refl_base_gloss",
       [] {
         const auto gloss = [](const std::string& g) {
           return Spot(kBase + "refl_base_gloss " + g, false);
         };
         expect_color(gloss("1").centre, Rgb(1));
         expect_spread(gloss("1"), gloss(".4"));
         expect_spread(gloss(".4"), gloss(".15"));
         expect_color(Spot(kBase + "refl_gloss .15", false).centre, Rgb(1));  // the first layer's
       }},
      {"refl_base_gloss_samples",
       [] {
         const auto rays = [](const std::string& n) {
           const Measured m = seen_by_one_path(
               plate_in_sky(kBase + "refl_base_gloss .9, refl_base_gloss_samples " + n));
           return m.each(m.counts.reflect);
         };
         EXPECT_EQ(rays("4"), 4);
         EXPECT_EQ(rays("32"), 32);
         expect_color(Spot(kBase + "refl_base_gloss .15, refl_base_gloss_samples 0", false).centre,
                      Rgb(1));
       }},
      {"refl_base_bump",
       [] {
         // The sky toward +x is lit, the zenith is dark.
         const auto tilted = [](const std::string& list) {
           return seen_direct(plate("bump_mode 6, " + list).half_sky(1, Vec3(1, 0, -.3f)));
         };
         const std::string tilt = "refl_base_bump .3420201 0 .9396926";
         expect_color(tilted(kBase), Rgb(0));
         expect_color(tilted(kBase + tilt), Rgb(1));
         expect_color(tilted(kMirror + tilt), Rgb(0));  // the first layer stays as it is
       }},
  };
}

}  // namespace oriel::sensitivity
