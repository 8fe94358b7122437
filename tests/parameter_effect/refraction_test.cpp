// SPDX-License-Identifier: Apache-2.0
// Transparency, translucency, and transmission through solids and sheets.
#include "cases.h"

namespace oriel::sensitivity {
namespace {

/// A plate before a wall of radiance 1.
Measured before_wall(const std::string& list) {
  return seen_direct(plate(list).emitter("wall", 1).square("wall", -kUp, 5, kUp), 30);
}

/// Where a view from 45 degrees meets the plane z = -2 behind a slab one thick: 2 if unbent.
float place_behind_slab(const std::string& list) {
  SceneText scene;
  scene.material("m", parameters(kGlass + list))
      .box("m", Vec3(-5, -5, -1), Vec3(5, 5, 0))
      .statement("shader \"place\" \"test_place\" ( \"scale\" 1 0 0 )")
      .material("target", parameters(kMatte + "diffuse_weight 0, additional_color = \"place\""))
      .square("target", Vec3(0, 0, -2), 5, kUp);
  return seen_direct(scene, 45).mean.x;
}

/// A sheet lit from behind by a sun alone.
Measured sunlit_from_behind(const std::string& list) {
  return seen_direct(plate_in_sun(kSheet + list, kUp));
}

/// A card below a slab of the material, under a sun or a glowing ceiling. `method`: that of
/// indirect light; paths bring no caustics and leave shadows transparent.
Measured card_below(const std::string& list, bool sun, const std::string& options,
                    const std::string& method = "path") {
  SceneText scene("trace depth 8 8 12 shadow on " + options);
  scene.method(method)
      .material("m", parameters(kGlass + list))
      .lambert("card", 1)
      .square("card", Vec3(0), .5f, kUp)
      .box("m", Vec3(-50, -50, .6f), Vec3(50, 50, .7f));
  if (sun) return seen_direct(with_sun(scene, -kUp));
  return seen(Probe(scene.emitter("glow", 1).square("glow", Vec3(0, 0, 2), 50, -kUp)));
}

}  // namespace

Cases refraction_cases() {
  return {
      {"transparency",
       [] {
         expect_times(3, before_wall(kSheet + "transparency .25"),
                      before_wall(kSheet + "transparency .75"));
         // The diffuse component gets the rest.
         expect_times(3, seen_direct(plate_in_sun(kMatte + "transparency .75")),
                      seen_direct(plate_in_sun(kMatte + "transparency .25")));
       }},
      {"refr_color",
       [] { expect_color(before_wall(kSheet + "refr_color 1 .5 .25"), Rgb(1, .5f, .25f)); }},
      {"refr_gloss",
       [] {
         const auto gloss = [](const std::string& g) {
           return Spot(kSheet + "refr_gloss " + g, true);
         };
         const Spot clear = gloss("1"), frosted = gloss(".4"), opal = gloss(".15");
         expect_color(clear.centre, Rgb(1));
         expect_color(clear.beside, Rgb(0));
         expect_spread(clear, frosted);
         expect_spread(frosted, opal);
       }},
      {"refr_ior",
       [] {
         EXPECT_NEAR(place_behind_slab("refr_ior 1"), 2, 1e-3f);
         for (const float ior : {1.3f, 1.8f})  // Snell's law
           EXPECT_NEAR(place_behind_slab(fmt::format("refr_ior {}", ior)),
                       1 + std::tan(std::asin(std::sqrt(.5f) / ior)), 1e-3f);
       }},
      {"refr_gloss_samples",
       [] {
         const auto rays = [](const std::string& n) {
           const Measured m =
               seen_by_one_path(plate_in_sky(kSheet + "refr_gloss .9, refr_gloss_samples " + n));
           return m.each(m.counts.refract);
         };
         EXPECT_EQ(rays("4"), 4);
         EXPECT_EQ(rays("32"), 32);
         expect_color(Spot(kSheet + "refr_gloss .15, refr_gloss_samples 0", true).centre, Rgb(1));
       }},
      {"refr_translucency",
       [] {
         const std::string half = "refr_trans_weight .5, refr_translucency ";
         expect_times(.5f, before_wall(kSheet + half + "off"), before_wall(kSheet + half + "on"));
         expect_more(sunlit_from_behind(half + "on"), sunlit_from_behind(half + "off"));
       }},
      {"refr_trans_color",
       [] {
         const std::string all = "refr_translucency on, refr_trans_weight 1, refr_trans_color ";
         expect_color(sunlit_from_behind(all + "1 .5 .25"), Rgb(1, .5f, .25f));
       }},
      {"refr_trans_weight",
       [] {
         // Less of what lies behind, more of the light that falls on the back.
         const std::string list = "refr_translucency on, refr_trans_weight ";
         for (const auto& [less, more] : {std::pair{"0", ".5"}, std::pair{".5", "1"}}) {
           expect_more(before_wall(kSheet + list + less), before_wall(kSheet + list + more));
           expect_more(sunlit_from_behind(list + more), sunlit_from_behind(list + less));
         }
         expect_color(before_wall(kSheet + list + "1"), Rgb(0));
       }},
      {"thin_walled",
       [] {
         EXPECT_NEAR(place_behind_slab("refr_ior 1.5, thin_walled on"), 2, 1e-3f);
         EXPECT_LT(place_behind_slab("refr_ior 1.5, thin_walled off"), 1.6f);
       }},
      {"skip_inside_refl",
       [] {
         // From inside of glass; 41.8 degrees is the angle of total reflection.
         const auto reflected = [](const std::string& skip, float degrees) {
           SceneText scene;
           scene.uniform_sky(1)
               .material("m", parameters(kGlass +
                                         "reflectivity 1, brdf_fresnel on, refr_ior 1.5, "
                                         "skip_inside_refl " +
                                         skip))
               .square("m", Vec3(0), 5, -kUp);
           const Measured m = seen_direct(scene, degrees, 4096);
           return m.each(m.counts.reflect);
         };
         EXPECT_EQ(reflected("on", 20), 0);
         EXPECT_GT(reflected("off", 20), .02);
         EXPECT_EQ(reflected("on", 50), 1);
         EXPECT_EQ(reflected("off", 50), 1);
       }},
      {"do_refractive_caustics",
       [] {
         const auto sunlit = [](const std::string& refractive, const std::string& options) {
           return card_below("do_refractive_caustics " + refractive, true, options, "scene");
         };
         expect_color(sunlit("off", "caustic on"), Rgb(1));
         expect_color(sunlit("on", "caustic on"), Rgb(0));
         expect_color(card_below("do_refractive_caustics on", true, "caustic on"), Rgb(1));
         expect_color(sunlit("on", "caustic off"), Rgb(1));  // only when caustics are on
         // What the shadow lost arrives refracted.
         EXPECT_GT(card_below("do_refractive_caustics on", false, "caustic on").mean.x, .9f);
       }},
  };
}

}  // namespace oriel::sensitivity
