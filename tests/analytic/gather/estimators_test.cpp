// SPDX-License-Identifier: Apache-2.0
// Three estimators of the light in one scene must give the same image.
#include "support/probe.h"

namespace oriel::testing {
namespace estimators_test {

SceneText room(const std::string& lamp_flags) {
  const std::string glossy = "\"diffuse\" .6 .4 .2, \"reflectivity\" .5, \"refl_gloss\" ";
  SceneText scene("trace depth 8 8 12 shadow segments");
  scene.lambert("wall", .6f)
      .material("plastic", glossy + ".2, \"brdf_fresnel\" off")
      .material("metal",
                "\"diffuse\" .9 .7 .4, \"refl_is_metal\" on, \"reflectivity\" .9, "
                "\"brdf_0_degree_refl\" .9, \"refl_gloss\" .3, \"anisotropy\" 3")
      .material(
          "pane",
          "\"diffuse_weight\" 0, \"reflectivity\" 1, \"refl_gloss\" 1, \"transparency\" 1, "
          "\"refr_ior\" 1.5, \"brdf_fresnel\" on, \"thin_walled\" on, \"refr_color\" .8 .9 .8")
      .material("frosted",
                "\"diffuse_weight\" 0, \"reflectivity\" .3, \"refl_gloss\" .2, \"transparency\" 1, "
                "\"refr_gloss\" .2, \"refr_ior\" 1.5, \"refr_falloff_on\" on, "
                "\"refr_falloff_dist\" .5, \"refr_falloff_color_on\" on, "
                "\"refr_falloff_color\" .5 .8 .6")
      // A room that is open to the sky on one side.
      .polygon("wall", {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)})
      .polygon("wall", {Vec3(-1, -1, 2), Vec3(-1, 1, 2), Vec3(1, 1, 2), Vec3(1, -1, 2)})
      .polygon("wall", {Vec3(-1, 1, 0), Vec3(1, 1, 0), Vec3(1, 1, 2), Vec3(-1, 1, 2)})
      .polygon("wall", {Vec3(-1, -1, 0), Vec3(-1, 1, 0), Vec3(-1, 1, 2), Vec3(-1, -1, 2)})
      .box("plastic", Vec3(-.8f, .1f, 0), Vec3(-.3f, .6f, .8f))
      .sphere("metal", Vec3(.45f, .4f, .4f), .4f, 32)
      .box("frosted", Vec3(-.2f, -.6f, 0), Vec3(.2f, -.3f, .4f))
      .polygon("pane", {Vec3(.4f, -.8f, .05f), Vec3(.9f, -.2f, .05f), Vec3(.9f, -.2f, 1.2f),
                        Vec3(.4f, -.8f, 1.2f)})
      .light("lamp",
             "\"physical_light\" ( \"color\" 6 6 6 ) origin 0 0 1.9 direction 0 0 -1 "
             "rectangle .8 0 0 0 .8 0 3 3",
             lamp_flags)
      .half_sky(.4f, Vec3(1, 0, 0))
      .camera("focal 1.2 aperture 1 aspect 1 resolution 32 32",
              "1 0 0 0  0 0 -1 0  0 1 0 0  0 -1 -3.2 1");
  return scene;
}

// acceptance: H8
TEST(Estimators, LightSamplesLobesAndBothShowTheSamePicture) {
  for (const char* lamp : {"", "visible on"}) {
    Probe probe(room(lamp));
    struct Part {
      const char* name;
      int x0, y0, x1, y1;
    };
    for (const Part part :
         {Part{"metal ball", 18, 8, 22, 12}, Part{"plastic box", 7, 6, 12, 14},
          Part{"frosted block", 14, 3, 18, 7}, Part{"behind the pane", 24, 6, 27, 16},
          Part{"whole picture", 0, 0, 32, 32}}) {
      const auto measure = [&](Estimator e) {
        return probe.estimator(e).pixels(part.x0, part.y0, part.x1, part.y1, 1 << 16);
      };
      const Measured both = measure(Estimator::Mis);
      const std::string name = fmt::format("{}{}", part.name, *lamp ? ", lamp visible" : "");
      expect_same(name + ": light samples", measure(Estimator::LightOnly), both, .025f);
      expect_same(name + ": lobes", measure(Estimator::BsdfOnly), both, .025f);
      EXPECT_GT(both.mean.x, .02f) << name;
    }
  }
}

TEST(Estimators, LightsWithoutShadowsPassBlockers) {
  for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
    SceneText scene("trace depth 4 4 4 shadow off");
    scene.lambert("card", 1)
        .lambert("dark", 0)
        .square("card", Vec3(0), 1, Vec3(0, 0, 1))
        .square("dark", Vec3(0, 0, .8f), 5, Vec3(0, 0, -1))
        .light("lamp",
               "\"physical_light\" ( \"color\" 12.566371 12.566371 12.566371 ) origin 0 0 1 "
               "direction 0 0 -1 rectangle 1 0 0 0 1 0 3 3");
    expect_exact(fmt::format("lamp without shadows, estimator {}", static_cast<int>(e)),
                 Probe(scene).estimator(e).onto(Vec3(0), Vec3(0, 0, 1), 10, 4096, .05f), .7522747f);
  }
  // The sky is no light that shadows could be switched off for.
  SceneText sky("trace depth 4 4 4 shadow off");
  sky.uniform_sky(1)
      .lambert("card", .5f)
      .lambert("dark", 0)
      .square("card", Vec3(0), .01f, Vec3(0, 0, 1))
      .square("dark", Vec3(0, 0, .5f), 2000, Vec3(0, 0, -1));
  EXPECT_LT(Probe(sky).onto(Vec3(0), Vec3(0, 0, 1), 10, 4096, .05f).mean.x, .001f);
}

}  // namespace estimators_test
}  // namespace oriel::testing
