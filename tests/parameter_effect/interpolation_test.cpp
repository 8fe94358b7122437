// SPDX-License-Identifier: Apache-2.0
// Reflections and refractions interpolated on an image grid.
#include "cases.h"
#include "prepare/testing/prepared_scene.h"
#include "render/session.h"
#include "support/picture.h"

namespace oriel::sensitivity {
namespace {

/// A rendered picture, 32 x 32: the right half of it, 4 units behind a sheet or as far in front of
/// a mirror, glows.
struct Picture {
  RayCounts rays;
  float edge = 0, beside = 0;  ///< the first image column with the emitter, the fifth
  float noise = 0;             ///< mean difference of a pixel from the one above, which sees alike

  explicit Picture(const std::string& list) {
    const bool mirror = list.find("refl_interpolate") != list.npos;
    SceneText scene;
    scene.material("m", parameters((mirror ? kMirror : kSheet) + list))
        .emitter("glow", 1)
        .square("m", Vec3(0, 0, -2), 10, kUp);
    const float z = mirror ? 2 : -6;
    scene.polygon("glow", {Vec3(0, -9, z), Vec3(9, -9, z), Vec3(9, 9, z), Vec3(0, 9, z)});
    const testing::RenderedScene rendered(scene, {.budget = {.samples = 4}});
    rays = rendered.session().rays();
    constexpr int kSize = 32;
    const auto at = [&](int x, int y) { return rendered.at(x, y).r; };
    for (int y = 0; y < kSize; ++y) {
      edge += at(16, y) / kSize;
      beside += at(20, y) / kSize;
      for (int x = 0; x < kSize && y > 0; ++x)
        noise += std::abs(at(x, y) - at(x, y - 1)) / (kSize * (kSize - 1));
    }
  }
};

const std::string kReflect = "refl_interpolate on, refl_gloss .3, ";
const std::string kRefract = "refr_interpolate on, refr_gloss .3, ";
/// Edges that nothing but the grid blurs.
const std::string kSharpReflect = "refl_interpolate on, refl_gloss_samples 0, ";
const std::string kSharpRefract = "refr_interpolate on, refr_gloss_samples 0, ";

}  // namespace

Cases interpolation_cases() {
  return {
      {"refl_interpolate",
       [] {
         const Picture off(kReflect + "refl_interpolate off"), on(kReflect);
         EXPECT_NEAR(double(off.rays.reflect), 32 * 32 * 8, 100);  // refl_gloss_samples
         EXPECT_NEAR(double(on.rays.reflect), 16 * 16 * 8, 100);  // the same, at points of the grid
         EXPECT_LT(on.noise, .7f * off.noise);                    // and yet smoother
       }},
      {"refr_interpolate",
       [] {
         const Picture off(kRefract + "refr_interpolate off"), on(kRefract);
         EXPECT_NEAR(double(off.rays.refract), 32 * 32 * 8, 100);
         EXPECT_NEAR(double(on.rays.refract), 16 * 16 * 8, 100);
         EXPECT_LT(on.noise, .7f * off.noise);
       }},
      {"intr_grid_density",
       [] {
         const std::pair<const char*, std::uint64_t> grids[] = {{"0", 64}, {"1", 32}, {"2", 16},
                                                                {"3", 11}, {"4", 8},  {"5", 7}};
         for (const auto& [density, side] : grids)
           EXPECT_EQ(Picture(kSharpReflect + "intr_grid_density " + density).rays.reflect,
                     side * side);
         // Lower resolution, less detail: an edge that was sharp is not.
         EXPECT_GT(Picture(kSharpReflect + "intr_grid_density 0").edge,
                   Picture(kSharpReflect + "intr_grid_density 5").edge + .05f);
       }},
      {"intr_refl_samples",
       [] {
         const Picture near(kSharpReflect + "intr_refl_samples 2"),
             far(kSharpReflect + "intr_refl_samples 8");
         EXPECT_NEAR(near.beside, 1, 1e-3f);
         EXPECT_LT(far.beside, .95f);  // higher smears more
         EXPECT_EQ(near.rays.reflect, far.rays.reflect);
       }},
      {"intr_refl_ddist_on",
       [] {
         const std::string list =
             kSharpReflect + "intr_refl_samples 8, intr_refl_ddist 12, intr_refl_ddist_on ";
         const Picture off(list + "off"), on(list + "on");
         EXPECT_GT(on.rays.reflect, off.rays.reflect);  // a second set of rays
         EXPECT_GT(on.beside, off.beside + .02f);       // shows near objects more sharply
       }},
      {"intr_refl_ddist",
       [] {
         const std::string list =
             kSharpReflect + "intr_refl_samples 8, intr_refl_ddist_on on, intr_refl_ddist ";
         const Picture none(list + "0"), near(list + "3"), half(list + "8"), all(list + "80");
         EXPECT_NEAR(near.beside, none.beside, 1e-3f);  // the emitter is at least 4 away
         EXPECT_GT(half.beside, near.beside + .02f);
         EXPECT_GT(all.beside, half.beside + .02f);
       }},
      {"intr_refr_samples",
       [] {
         const Picture near(kSharpRefract + "intr_refr_samples 2"),
             far(kSharpRefract + "intr_refr_samples 8");
         EXPECT_NEAR(near.beside, 1, 1e-3f);
         EXPECT_LT(far.beside, .95f);
         EXPECT_EQ(near.rays.refract, far.rays.refract);
       }},
  };
}

}  // namespace oriel::sensitivity
