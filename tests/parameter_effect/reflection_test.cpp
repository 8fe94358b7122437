// SPDX-License-Identifier: Apache-2.0
// Reflections and highlights: level, colour, blur, angle curve, no double counting.
#include "cases.h"

namespace oriel::sensitivity {
namespace {

/// The sky of radiance 1 in a plate that only reflects: its level at that angle.
Measured level(const std::string& list, float degrees = 0) {
  return seen_direct(plate_in_sky("diffuse_weight 0, reflectivity 1, " + list), degrees);
}

/// A plate with a highlight or reflection of a light, visible or not.
Measured under_lamp(const std::string& list, bool visible) {
  SceneText scene = plate(kMirror + "refl_gloss .3, " + list);
  scene.light("lamp",
              "\"physical_light\" ( \"color\" 40 40 40 ) origin 1 0 1 direction 0 0 -1 "
              "rectangle 1 0 0 0 1 0 3 3",
              visible ? "visible on" : "");
  return seen_direct(scene, 40, 16384);
}

}  // namespace

Cases reflection_cases() {
  return {
      {"reflectivity",
       [] {
         expect_times(2, level("reflectivity .3"), level("reflectivity .6"));
         // The diffuse component gets the rest.
         expect_more(seen_direct(plate_in_sun("brdf_0_degree_refl 1, reflectivity .3")),
                     seen_direct(plate_in_sun("brdf_0_degree_refl 1, reflectivity .6")));
       }},
      {"refl_color",
       [] {
         expect_color(level("brdf_0_degree_refl 1, refl_color 1 .5 .25"), Rgb(1, .5f, .25f));
         expect_color(level("brdf_0_degree_refl .5, refl_color 1 .5 0"), Rgb(.5f, .25f, 0));
       }},
      {"refl_gloss",
       [] {
         const auto gloss = [](const std::string& g) {
           return Spot(kMirror + "refl_gloss " + g, false);
         };
         const Spot mirror = gloss("1"), satin = gloss(".4"), dull = gloss(".15");
         expect_color(mirror.centre, Rgb(1));
         expect_color(mirror.beside, Rgb(0));
         expect_spread(mirror, satin);
         expect_spread(satin, dull);
       }},
      {"refl_gloss_samples",
       [] {
         const auto rays = [](const std::string& n) {
           const Measured m =
               seen_by_one_path(plate_in_sky(kMirror + "refl_gloss .9, refl_gloss_samples " + n));
           return m.each(m.counts.reflect);
         };
         EXPECT_EQ(rays("4"), 4);
         EXPECT_EQ(rays("32"), 32);
         // 0: a perfect mirror for any gloss.
         expect_color(Spot(kMirror + "refl_gloss .15, refl_gloss_samples 0", false).centre, Rgb(1));
       }},
      {"refl_hl_only",
       [] {
         const std::string glossy = kMirror + "refl_gloss .3, refl_hl_only ";
         const Measured full = seen_direct(plate_in_sky(glossy + "off"), 30, 4096);
         const Measured only = seen_direct(plate_in_sky(glossy + "on"), 30, 4096);
         EXPECT_GT(full.counts.reflect, 4000u);  // a few are lost below the horizon
         EXPECT_EQ(only.counts.reflect, 0u);
         expect_more(full, only);
         // Highlights stay.
         const Measured sun = seen_direct(plate_in_sun(glossy + "off"));
         EXPECT_GT(sun.mean.x, 0);
         expect_equal(seen_direct(plate_in_sun(glossy + "on")), sun);
       }},
      {"refl_is_metal",
       [] {
         const std::string red = "diffuse 1 .5 0, brdf_0_degree_refl 1, refl_is_metal ";
         expect_color(level(red + "off"), Rgb(1));
         expect_color(level(red + "on"), Rgb(1, .5f, 0));
       }},
      {"brdf_fresnel",
       [] {
         // Reflectivity from refr_ior instead of the curve.
         const std::string curve = "brdf_0_degree_refl .2, brdf_fresnel ";
         expect_color(level(curve + "off, refr_ior 1.5"), Rgb(.2f));
         expect_color(level(curve + "on, refr_ior 1.5"), Rgb(.04f));
         expect_rising({level(curve + "on", 0), level(curve + "on", 60), level(curve + "on", 80)});
       }},
      {"brdf_0_degree_refl",
       [] {
         expect_color(level("brdf_0_degree_refl .3"), Rgb(.3f));
         expect_color(level("brdf_0_degree_refl .9"), Rgb(.9f));
       }},
      {"brdf_90_degree_refl",
       [] {
         const std::string at = "brdf_0_degree_refl .1, brdf_90_degree_refl ";
         expect_rising({level(at + ".1", 85), level(at + ".5", 85), level(at + "1", 85)});
         expect_equal(level(at + ".1"), level(at + "1"));  // no effect when facing the viewer
       }},
      {"brdf_curve",
       [] {
         const std::string at = "brdf_0_degree_refl .2, brdf_curve ";
         expect_rising({level(at + "10", 60), level(at + "5", 60), level(at + "2", 60)});
         expect_color(level(at + "2", 60), Rgb(.2f + .8f * .25f));
       }},
      {"single_env_sample",
       [] {
         const auto looked_up = [](const std::string& single) {
           const Measured m = seen_by_one_path(plate_in_sky(
               kMirror + "refl_gloss .9, refl_gloss_samples 16, single_env_sample " + single));
           EXPECT_EQ(m.each(m.counts.reflect), 16);
           return m.each(m.counts.environment);
         };
         EXPECT_EQ(looked_up("on"), 1);
         EXPECT_GE(looked_up("off"), 16);
       }},
      {"no_visible_area_hl",
       [] {
         const Measured reflected = under_lamp("no_visible_area_hl on", true);
         expect_times(2, reflected, under_lamp("no_visible_area_hl off", true));
         expect_equal(under_lamp("no_visible_area_hl on", false), reflected);
       }},
      {"hl_vs_refl_balance",
       [] {
         const Measured highlight = under_lamp("", false);
         expect_times(2, highlight, under_lamp("hl_vs_refl_balance 2", false));
         expect_times(.5f, highlight, under_lamp("hl_vs_refl_balance .5", false));
         // Unchanged reflections of lights and of surfaces.
         expect_equal(under_lamp("hl_vs_refl_balance 2", true), under_lamp("", true));
         expect_color(level("brdf_0_degree_refl 1, hl_vs_refl_balance 2"), Rgb(1));
       }},
  };
}

}  // namespace oriel::sensitivity
