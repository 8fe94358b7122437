// SPDX-License-Identifier: Apache-2.0
// Anisotropic highlights, and bump-mapped normals.
#include "cases.h"

namespace oriel::sensitivity {
namespace {

/// The highlight of a sun ten degrees off the vertical, seen from there: from the side of x, of y.
struct Widths {
  float x, y;
};
Widths widths(const std::string& list, const std::string& element = {}) {
  const auto toward = [&](const Vec3& side) {
    SceneText scene;
    scene.material("m",
                   parameters(kMirror + "refl_gloss .4, refl_hl_only on, anisotropy 4, " + list));
    if (element.empty()) scene.plate("m");
    scene.statement(element);
    std::string text = with_sun(scene, -normalize(kUp + side * .18f)).str();
    const std::string members = "instgroup \"world\" \"cam_i\"";
    if (!element.empty()) text.insert(text.find(members) + members.size(), " \"turned_i\"");
    return seen(Probe(text).direct_only(), 0, 64).mean.x;
  };
  return {toward(Vec3(1, 0, 0)), toward(Vec3(0, 1, 0))};
}

/// The normal that the bumps below turn to: 20 degrees toward x.
const Vec3 kTilted(.3420201f, 0, .9396926f);
const std::string kTilt = ".3420201 0 .9396926, ";

/// What the bumps of a plate turned by 90 degrees do: diffuse light of a sun straight above (the
/// cosine of the tilt), and whether the mirror shows the sky toward +x.
struct Bumped {
  float diffuse, mirror;
};
Bumped bumped(const std::string& list) {
  const auto measure = [&](const std::string& base, bool sky) {
    SceneText scene;
    scene.statement("shader \"tilt\" \"test_tilt\" ( \"normal\" .3420201 0 .9396926 )")
        .material("m", parameters(base + list))
        .polygon("m", {Vec3(-5, -5, 0), Vec3(5, -5, 0), Vec3(5, 5, 0), Vec3(-5, 5, 0)},
                 "transform 0 1 0 0 -1 0 0 0 0 0 1 0 0 0 0 1");
    if (sky) scene.half_sky(1, Vec3(1, 0, -.3f));
    const std::string text = sky ? scene.str() : with_sun(scene, -kUp).str();
    return seen(Probe(text).direct_only(), 0, 64).mean.x;
  };
  return {measure(kMatte + "diffuse 1 1 1, ", false), measure(kMirror, true)};
}
const float kCosine = kTilted.z;

/// A plate whose texture runs along y.
const std::string kTurnedPlate =
    "object \"turned\" visible trace group -5 -5 0 5 -5 0 5 5 0 -5 5 0 0 0 0 0 1 0 1 1 0 "
    "1 0 0 v 0 t 4 v 1 t 5 v 2 t 6 v 3 t 7 c 0 1 2 3 end group end object "
    "instance \"turned_i\" \"turned\" material \"m\" end instance";

}  // namespace

Cases direction_cases() {
  return {
      {"anisotropy",
       [] {
         const Widths round = widths("anisotropy 1"), wide = widths("anisotropy 4"),
                      high = widths("anisotropy .25");
         EXPECT_NEAR(round.x, round.y, 1e-4f * round.x);
         EXPECT_GT(wide.x, 4 * wide.y);
         EXPECT_NEAR(high.x, wide.y, 1e-4f * wide.x);
         EXPECT_NEAR(high.y, wide.x, 1e-4f * wide.x);
       }},
      {"anisotropy_rotation",
       [] {
         const Widths along = widths(""), quarter = widths("anisotropy_rotation .25"),
                      half = widths("anisotropy_rotation .5");
         EXPECT_NEAR(quarter.x, along.y, 1e-4f * along.x);
         EXPECT_NEAR(quarter.y, along.x, 1e-4f * along.x);
         EXPECT_NEAR(half.x, along.x, 1e-4f * along.x);
       }},
      {"anisotropy_channel",
       [] {
         const Widths object = widths("anisotropy_channel -1", kTurnedPlate),
                      texture = widths("anisotropy_channel 0", kTurnedPlate);
         EXPECT_GT(object.x, 4 * object.y);
         EXPECT_GT(texture.y, 4 * texture.x);
       }},
      {"bump",
       [] {
         const Bumped on = bumped("bump_mode 0, bump \"tilt\""), off = bumped("bump_mode 0"),
                      unused = bumped("bump_mode 5, bump \"tilt\"");
         EXPECT_NEAR(on.diffuse, kCosine, 1e-4f);
         EXPECT_EQ(on.mirror, 1);
         EXPECT_NEAR(off.diffuse, 1, 1e-4f);
         EXPECT_EQ(off.mirror, 0);
         EXPECT_NEAR(unused.diffuse, 1, 1e-4f);
       }},
      {"no_diffuse_bump",
       [] {
         for (const std::string bump : {"bump_mode 0, bump \"tilt\", ",
                                        "bump_mode 6, standard_bump .3420201 0 .9396926, "}) {
           const Bumped all = bumped(bump + "no_diffuse_bump off"),
                        coat = bumped(bump + "no_diffuse_bump on");
           EXPECT_NEAR(all.diffuse, kCosine, 1e-4f);
           EXPECT_NEAR(coat.diffuse, 1, 1e-4f);
           EXPECT_EQ(all.mirror, 1);
           EXPECT_EQ(coat.mirror, 1);
         }
       }},
      {"bump_mode",
       [] {
         const std::string vector = "overall_bump " + kTilt + "bump_mode ";
         const auto cosine_added = normalize(kTilted + kUp).z;
         EXPECT_NEAR(bumped(vector + "0").diffuse, 1, 1e-4f);  // the old bump input alone
         EXPECT_NEAR(bumped(vector + "2").diffuse, cosine_added, 1e-4f);
         EXPECT_NEAR(bumped(vector + "6").diffuse, kCosine, 1e-4f);
         EXPECT_EQ(bumped(vector + "6").mirror, 1);
         // The plate's own x is y or -y of the world.
         EXPECT_NEAR(bumped(vector + "7").diffuse, kCosine, 1e-4f);
         EXPECT_EQ(bumped(vector + "7").mirror, 0);
       }},
      {"overall_bump",
       [] {
         const Bumped b = bumped("bump_mode 6, no_diffuse_bump on, overall_bump " + kTilt);
         EXPECT_NEAR(b.diffuse, kCosine, 1e-4f);
         EXPECT_EQ(b.mirror, 1);
       }},
      {"standard_bump",
       [] {
         const Bumped b = bumped("bump_mode 6, no_diffuse_bump on, standard_bump " + kTilt);
         EXPECT_NEAR(b.diffuse, 1, 1e-4f);
         EXPECT_EQ(b.mirror, 1);
         // On top of the overall bump.
         const std::string both = "bump_mode 2, overall_bump .2 0 0, standard_bump .2 0 0";
         EXPECT_NEAR(bumped(both).diffuse,
                     normalize(normalize(Vec3(.2f, 0, 1)) + Vec3(.2f, 0, 0)).z, 1e-4f);
       }},
  };
}

}  // namespace oriel::sensitivity
