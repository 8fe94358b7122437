// SPDX-License-Identifier: Apache-2.0
// Limits of reflections and refractions: distance, depth, contribution.
#include "cases.h"

namespace oriel::sensitivity {
namespace {

/// A mirror that shows an emitter of radiance 1 at distance 1, red sky beyond.
Measured glow_in_mirror(const std::string& list) {
  return seen_direct(plate(kMirror + "refl_falloff_on on, " + list)
                         .environment("\"test_sky\" ( \"above\" 1 0 0, \"below\" 1 0 0 )")
                         .emitter("glow", 1)
                         .square("glow", kUp, 5, -kUp));
}

/// An emitter of radiance 1 behind one unit of a medium without refraction.
Measured glow_in_block(const std::string& list) {
  SceneText scene;
  scene.material("m", parameters(kGlass + "refr_ior 1, refr_falloff_on on, " + list))
      .box("m", Vec3(-5, -5, -1), Vec3(5, 5, 0))
      .emitter("glow", 1)
      .square("glow", Vec3(0, 0, -2), 5, kUp);
  return seen_direct(scene);
}

/// Four parallel sheets in front of an emitter of radiance 1.
Measured glow_behind_sheets(const std::string& list) {
  SceneText scene;
  scene.material("m", parameters(kSheet + list)).emitter("glow", 1);
  for (int i = 0; i < 4; ++i) scene.square("m", Vec3(0, 0, -.1f * static_cast<float>(i)), 5, kUp);
  return seen_direct(scene.square("glow", -kUp, 5, kUp));
}

/// Reflection rays of a path between two mirrors.
double rays_between_mirrors(const std::string& list) {
  const Measured m = seen_direct(plate(kMirror + list).square("m", kUp, 5, -kUp));
  return m.each(m.counts.reflect);
}

}  // namespace

Cases limit_cases() {
  return {
      {"refl_falloff_on",
       [] {
         const std::string list = "refl_falloff_dist 2, refl_falloff_on ";
         expect_color(glow_in_mirror(list + "off"), Rgb(1));
         // Half way there, half of the environment.
         expect_color(glow_in_mirror(list + "on"), Rgb(1, .5f, .5f));
       }},
      {"refl_falloff_dist",
       [] {
         const std::string list = "refl_falloff_dist ";
         expect_rising({glow_in_mirror(list + ".5"), glow_in_mirror(list + "1.5"),
                        glow_in_mirror(list + "5")},
                       1);
         expect_color(glow_in_mirror(list + ".5"), Rgb(1, 0, 0));
       }},
      {"refl_falloff_color_on",
       [] {
         const std::string list = "refl_falloff_dist .5, refl_falloff_color 0 0 1, ";
         expect_color(glow_in_mirror(list + "refl_falloff_color_on off"), Rgb(1, 0, 0));
         expect_color(glow_in_mirror(list + "refl_falloff_color_on on"), Rgb(0, 0, 1));
       }},
      {"refl_falloff_color",
       [] {
         const std::string list = "refl_falloff_dist .5, refl_falloff_color_on on, ";
         expect_color(glow_in_mirror(list + "refl_falloff_color 0 .5 1"), Rgb(0, .5f, 1));
       }},
      {"refl_depth",
       [] {
         EXPECT_EQ(rays_between_mirrors("refl_depth 1"), 1);
         EXPECT_EQ(rays_between_mirrors("refl_depth 4"), 4);
         EXPECT_EQ(rays_between_mirrors("refl_depth 0"), 8);  // the scene's
         // Beyond it highlights only, as with refl_hl_only: here of what a mirror shows.
         const auto in_mirror = [](const std::string& list) {
           SceneText scene =
               with_sun(plate(kMirror + "refl_gloss .3, " + list), normalize(Vec3(.18f, 0, -1)));
           scene.material("first", parameters(kMirror)).square("first", kUp * .5f, .05f, -kUp);
           return Probe(scene).direct_only().ray(kUp * .25f, kUp, 64);
         };
         const Measured deep = in_mirror("refl_depth 1");
         EXPECT_EQ(deep.counts.reflect, 64u);
         EXPECT_GT(deep.mean.x, .1f);
         EXPECT_EQ(deep.mean, in_mirror("refl_hl_only on").mean);
       }},
      {"refl_cutoff",
       [] {
         const auto rays = [](const std::string& cutoff) {
           return seen_direct(plate_in_sky(kMirror + "reflectivity .2, refl_cutoff " + cutoff))
               .counts.reflect;
         };
         EXPECT_EQ(rays(".1"), 64u);
         EXPECT_EQ(rays(".3"), 0u);
       }},
      {"refr_falloff_on",
       [] {
         const std::string list = "refr_falloff_dist 2, refr_falloff_on ";
         expect_color(glow_in_block(list + "off"), Rgb(1));
         expect_color(glow_in_block(list + "on"), Rgb(.5f));
       }},
      {"refr_falloff_dist",
       [] {
         const std::string list = "refr_falloff_dist ";
         expect_rising(
             {glow_in_block(list + ".5"), glow_in_block(list + "1.5"), glow_in_block(list + "5")});
         expect_color(glow_in_block(list + ".5"), Rgb(0));
         // The colour at that distance, squared at twice the distance.
         const std::string absorbed =
             "refr_falloff_color_on on, refr_falloff_color .5 .5 .5, refr_falloff_dist ";
         expect_color(glow_in_block(absorbed + "1"), Rgb(.5f));
         expect_color(glow_in_block(absorbed + ".5"), Rgb(.25f));
       }},
      {"refr_falloff_color_on",
       [] {
         const std::string list =
             "refr_falloff_dist .5, refr_falloff_color .5 .5 1, refr_falloff_color_on ";
         expect_color(glow_in_block(list + "off"), Rgb(0));  // black, and the rays stop
         expect_color(glow_in_block(list + "on"), Rgb(.25f, .25f, 1));
       }},
      {"refr_falloff_color",
       [] {
         expect_color(glow_in_block("refr_falloff_dist 1, refr_falloff_color_on on, "
                                    "refr_falloff_color .25 .5 1"),
                      Rgb(.25f, .5f, 1));
       }},
      {"refr_depth",
       [] {
         expect_color(glow_behind_sheets("refr_depth 5"), Rgb(1));
         expect_color(glow_behind_sheets("refr_depth 3"), Rgb(0));  // black beyond
         EXPECT_EQ(glow_behind_sheets("refr_depth 3").counts.refract, 3u * 64);
         // 0 is the scene's depth, which shows the environment instead.
         const auto in_sky = [](const char* depth) {
           SceneText scene("trace depth 2 2 2 shadow on");
           scene.uniform_sky(1).material("m", parameters(kSheet + depth));
           for (const float z : {0.0f, -.1f, -.2f}) scene.square("m", Vec3(0, 0, z), 5, kUp);
           return seen_direct(scene);
         };
         expect_color(in_sky("refr_depth 0"), Rgb(1));
         expect_color(in_sky("refr_depth 2"), Rgb(0));
       }},
      {"refr_cutoff",
       [] {
         // Each sheet passes half: 1/2, 1/4, 1/8, 1/16 of the pixel.
         const std::string half = "transparency .5, refr_cutoff ";
         EXPECT_EQ(glow_behind_sheets(half + ".05").counts.refract, 4u * 64);
         EXPECT_EQ(glow_behind_sheets(half + ".2").counts.refract, 2u * 64);
         expect_more(glow_behind_sheets(half + ".05"), glow_behind_sheets(half + ".2"));
       }},
  };
}

}  // namespace oriel::sensitivity
