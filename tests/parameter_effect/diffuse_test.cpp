// SPDX-License-Identifier: Apache-2.0
// Diffuse light, energy distribution, light selection.
#include "cases.h"

namespace oriel::sensitivity {
namespace {

/// A matte plate under a red and a green sun.
Measured two_suns(const std::string& list) {
  SceneText scene;
  for (const auto& [name, color] : {std::pair{"red", "1 0 0"}, std::pair{"green", "0 1 0"}})
    scene.light(name,
                fmt::format("\"mib_light_infinite\" ( \"color\" {} ) direction 0 0 -1", color));
  scene.material("m", parameters(kMatte + "diffuse 1 1 1, " + list)).plate("m");
  return seen_direct(scene);
}

}  // namespace

Cases diffuse_cases() {
  return {
      {"diffuse_weight",
       [] {
         const auto weight = [](const char* w) {
           return seen_direct(plate_in_sun(kMatte + "diffuse_weight " + w));
         };
         expect_color(weight("0"), Rgb(0));
         expect_times(3, weight(".25"), weight(".75"));
       }},
      {"diffuse",
       [] {
         expect_color(seen_direct(plate_in_sun(kMatte + "diffuse 1 .5 .25")), Rgb(1, .5f, .25f));
         // Reflection takes from it.
         expect_more(seen_direct(plate_in_sun("diffuse 1 1 1, reflectivity .1")),
                     seen_direct(plate_in_sun("diffuse 1 1 1, reflectivity .9")));
       }},
      {"diffuse_roughness",
       [] {
         // Lit from the viewer, the edge over the centre: flatter where rougher.
         const auto edge = [](const std::string& roughness) {
           const float a = 75 * kPi / 180;
           const std::string list = kMatte + "diffuse_roughness " + roughness;
           Measured m = seen_direct(plate_in_sun(list, Vec3(std::sin(a), 0, -std::cos(a))), 75);
           m.mean /= seen_direct(plate_in_sun(list)).mean;
           return m;
         };
         EXPECT_NEAR(edge("0").mean.x, std::cos(75 * kPi / 180), 1e-4f);  // Lambert
         expect_rising({edge("0"), edge(".5"), edge("1")});
       }},
      {"brdf_conserve_energy",
       [] {
         const std::string list = "diffuse 1 1 1, reflectivity 1, brdf_0_degree_refl 1, ";
         expect_color(seen(plate_in_sky(list + "brdf_conserve_energy on")), Rgb(1));
         expect_color(seen(plate_in_sky(list + "brdf_conserve_energy off")), Rgb(2));
       }},
      {"additional_color",
       [] {
         const Measured plain = seen_direct(plate_in_sun(kMatte));
         expect_color(seen_direct(plate_in_sun(kMatte + "additional_color .5 1 2")),
                      plain.mean + Rgb(.5f, 1, 2));
       }},
      {"mode",
       [] {
         const std::string list = "lights [ \"green_i\" ], mode ";
         expect_color(two_suns(list + "0"), Rgb(0, 1, 0));
         expect_color(two_suns(list + "1"), Rgb(0, 1, 0));
         expect_color(two_suns(list + "2"), Rgb(1, 0, 0));
         expect_color(two_suns(list + "4"), Rgb(1, 1, 0));
       }},
      {"lights",
       [] {
         expect_color(two_suns("mode 1, lights [ \"red_i\" ]"), Rgb(1, 0, 0));
         expect_color(two_suns("mode 1, lights [ \"green_i\" ]"), Rgb(0, 1, 0));
         expect_color(two_suns("mode 1"), Rgb(0));
       }},
  };
}

}  // namespace oriel::sensitivity
