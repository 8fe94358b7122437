// SPDX-License-Identifier: Apache-2.0
// Indirect light: weight, rays, ambient occlusion.
#include "cases.h"

namespace oriel::sensitivity {
namespace {

/// Gather rays of one path from a plate in the sky.
double gathered(const std::string& list) {
  const Measured m = seen(Probe(plate_in_sky(kMatte + list)), 0, 1024);
  return m.each(m.counts.gather);
}

/// A white floor in a corner, at .4 from a wall of this radiance, under a uniform sky of 1.
Measured corner(const std::string& list, float glow = 0) {
  SceneText scene;
  scene.uniform_sky(1)
      .material("floor", parameters(kMatte + "diffuse 1 1 1, ao_on on, ao_dark 0 0 0, " + list))
      .square("floor", Vec3(0), .01f, kUp)
      .emitter("wall", glow)
      .square("wall", Vec3(.4f, 0, 0), 20, Vec3(-1, 0, 0));
  return seen(Probe(scene).paths_of_pixel(1), 0, 8192);
}

}  // namespace

Cases occlusion_cases() {
  return {
      {"indirect_multiplier",
       [] {
         const std::string list = kMatte + "indirect_multiplier ";
         expect_times(2, seen(plate_in_sky(list + "1")), seen(plate_in_sky(list + "2")));
         expect_color(seen(plate_in_sky(list + "0")), Rgb(0));
         // Direct light as before.
         expect_equal(seen_direct(plate_in_sun(list + "2")), seen_direct(plate_in_sun(kMatte)));
       }},
      {"fg_quality",
       [] {
         EXPECT_EQ(gathered("fg_quality 1"), 1);
         EXPECT_EQ(gathered("fg_quality 4"), 4);
         expect_equal(seen(plate_in_sky(kMatte + "fg_quality 4")),
                      seen(plate_in_sky(kMatte + "fg_quality 1")));
       }},
      {"fg_quality_w",
       [] {
         EXPECT_EQ(gathered("fg_quality 2, fg_quality_w 0"), 2);  // raw
         EXPECT_EQ(gathered("fg_quality 2, fg_quality_w 3"), 6);  // the product
         EXPECT_EQ(gathered("fg_quality 0, fg_quality_w 5"), 1);  // which is 1 at least
       }},
      {"ao_on",
       [] {
         const Measured off = corner("ao_on off");
         EXPECT_EQ(off.counts.probe, 0u);
         expect_more(off, corner("ao_on on"));
       }},
      {"ao_samples",
       [] {
         const Measured few = corner("ao_samples 4"), many = corner("ao_samples 32");
         EXPECT_EQ(few.each(few.counts.probe), 4);
         EXPECT_EQ(many.each(many.counts.probe), 32);
         expect_equal(few, many);
       }},
      {"ao_distance",
       [] {
         // More distant objects occlude as well: darker.
         expect_rising(
             {corner("ao_distance 20"), corner("ao_distance 1"), corner("ao_distance .5")});
         expect_equal(corner("ao_distance .3"), corner("ao_on off"));
       }},
      {"ao_dark",
       [] {
         expect_rising({corner("ao_dark 0 0 0"), corner("ao_dark .5 .5 .5")});
         expect_equal(corner("ao_dark 1 1 1"), corner("ao_on off"));
         const Measured red = corner("ao_dark 1 0 0");
         EXPECT_GT(red.mean.x, 1.5f * red.mean.y);
       }},
      {"ao_ambient",
       [] {
         expect_rising({corner(""), corner("ao_ambient .5 .5 .5"), corner("ao_ambient 1 1 1")});
         // Attenuated by the occlusion: less than all of it.
         const Measured none = corner("ao_do_details 0"),
                        one = corner("ao_do_details 0, ao_ambient 1 1 1");
         EXPECT_GT(one.mean.x - none.mean.x, .4f);
         EXPECT_LT(one.mean.x - none.mean.x, .7f);
       }},
      {"ao_do_details",
       [] {
         const Measured none = corner("ao_do_details 0", 3), dark = corner("ao_do_details 1", 3),
                        colors = corner("ao_do_details 2", 3);
         expect_equal(none, corner("ao_on off", 3));
         expect_rising({dark, colors});
         EXPECT_LT(dark.mean.x, .7f * none.mean.x);    // a dark corner next to a bright wall
         EXPECT_GT(colors.mean.x, .9f * none.mean.x);  // which lights it again
       }},
  };
}

}  // namespace oriel::sensitivity
