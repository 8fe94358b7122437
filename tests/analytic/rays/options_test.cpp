// SPDX-License-Identifier: Apache-2.0
// One-sided walls, weight and rays of indirect light, light lists.
#include "support/probe.h"

namespace oriel::testing {
namespace options_test {

// acceptance: P5
TEST(MagicWall, IsInvisibleToTheCameraFromBehindOnly) {
  for (const bool culled : {false, true}) {
    // The wall at y = 1 faces into the room (-y); the emissive end wall is behind it.
    const auto room = [&] {
      SceneText scene;
      scene.uniform_sky(.125f)
          .material("wall", fmt::format("\"reflectivity\" 0, \"diffuse_weight\" 0, "
                                        "\"additional_color\" .5 .5 .5, \"backface_cull\" {}",
                                        culled ? "on" : "off"))
          .emitter("end", 2)
          .square("wall", Vec3(0, 1, 0), 3, Vec3(0, -1, 0));
      return scene;
    };
    const float through = culled ? 2 : .5f;
    SceneText seen = room();
    seen.square("end", Vec3(0, -1, 0), 3, Vec3(0, 1, 0));
    const Probe probe(seen);
    expect_exact("from behind", probe.ray(Vec3(0, 3, 0), Vec3(0, -1, 0), 64), through);
    expect_exact("from the front", probe.ray(Vec3(0, 0, 0), Vec3(0, 1, 0), 64), .5f);
    // Nothing but the wall: what shows is the background, alpha and all.
    const Probe bare(room());
    const Measured background = bare.ray(Vec3(0, 3, 0), Vec3(0, -1, 0), 64);
    expect_exact("into the background", background, culled ? .125f : .5f);

    // A mirror and a pane show the back that the camera does not see.
    SceneText mirrored = room();
    mirrored
        .material("mirror", "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1")
        .square("mirror", Vec3(0, 4, 0), 3, Vec3(0, -1, 0));
    expect_exact("back of the wall in a mirror",
                 Probe(mirrored).ray(Vec3(0, 3, 0), Vec3(0, 1, 0), 64), .5f);
    SceneText glazed = room();
    glazed
        .material("pane",
                  "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, "
                  "\"thin_walled\" on")
        .square("pane", Vec3(0, 2, 0), 3, Vec3(0, 1, 0));
    expect_exact("back of the wall through a pane",
                 Probe(glazed).ray(Vec3(0, 3, 0), Vec3(0, -1, 0), 64), .5f);
    // The reverse order: what lies behind the wall is seen through both.
    SceneText order = room();
    order
        .material("pane",
                  "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, "
                  "\"refr_color\" .5 .5 .5, \"thin_walled\" on")
        .square("pane", Vec3(0, 0, 0), 3, Vec3(0, 1, 0))
        .square("end", Vec3(0, -1, 0), 3, Vec3(0, 1, 0));
    expect_exact("a pane behind the wall", Probe(order).ray(Vec3(0, 3, 0), Vec3(0, -1, 0), 64),
                 culled ? 1 : .5f);
  }
}

// acceptance: P5
TEST(MagicWall, ShadowsAndBouncesFromBothSides) {
  // A ceiling over a card; culled or not, the card is lit alike.
  const auto card = [](const char* cull, const Vec3& ceiling_normal, const char* sun) {
    SceneText scene;
    scene.lambert("card", 1)
        .lambert("ceiling", .8f, fmt::format("\"backface_cull\" {}", cull))
        .square("card", Vec3(0), .02f, kUp)
        .square("ceiling", Vec3(0, 0, 1), .9f, ceiling_normal)
        .half_sky(1, kUp)
        .light("sun", fmt::format("\"mib_light_infinite\" ( \"color\" 2 2 2, \"shadow\" on ) "
                                  "direction {}",
                                  sun));
    return Probe(scene).onto(Vec3(0), kUp, 15, 1 << 16, .1f);
  };
  for (const Vec3& normal : {kUp, -kUp}) {
    const std::string side = normal.z > 0 ? ", front away" : ", front toward the card";
    const Measured shadowed = card("on", normal, "0 0 -1");
    expect_same("card under the wall, sun behind it" + side, shadowed,
                card("off", normal, "0 0 -1"), .01f);
    // Open sky around the square of half side .9 at 1: the sun would add 2.
    EXPECT_LT(shadowed.mean.x, .75f);
    expect_same("card lit by what the wall reflects" + side, card("on", normal, "0 .3 1"),
                card("off", normal, "0 .3 1"), .01f);
    EXPECT_GT(card("on", normal, "0 .3 1").mean.x, shadowed.mean.x + .5f);
  }
}

/// A card with a light, a sky and an emitter, split into parts of its radiance.
Measured lit_card(const std::string& more, Estimator e = Estimator::Mis) {
  SceneText scene;
  scene.uniform_sky(.4f)
      .material("card",
                "\"diffuse\" .8 .6 .4, \"reflectivity\" .3, \"brdf_0_degree_refl\" 1, " + more)
      .emitter("glow", 2)
      .square("card", Vec3(0), .02f, kUp)
      .square("glow", Vec3(1, 0, 1), 1, Vec3(-1, 0, 0))
      .light("lamp", "\"mib_light_point\" ( \"color\" .7 .7 .7 ) origin -.5 0 1");
  Probe probe(scene);
  return probe.estimator(e).outputs().onto(Vec3(0), kUp, 10, 1 << 14, .1f);
}

// acceptance: P6
TEST(IndirectMultiplier, ScalesIndirectLightAndNothingElse) {
  for (const Estimator e : {Estimator::Mis, Estimator::LightOnly, Estimator::BsdfOnly}) {
    Measured plain = lit_card("\"indirect_multiplier\" 1", e);
    EXPECT_GT(plain.outputs[Aov::Indirect].x, .1f);
    EXPECT_GT(plain.outputs[Aov::Diffuse].x, .1f);
    EXPECT_GT(plain.outputs[Aov::Reflection].x, .05f);
    for (const float by : {0.0f, .5f, 3.0f}) {
      Measured m = lit_card(fmt::format("\"indirect_multiplier\" {}", by), e);
      for (int k = 0; k < 3; ++k) {
        EXPECT_NEAR(m.outputs[Aov::Indirect][k], by * plain.outputs[Aov::Indirect][k], 1e-5f * by);
        for (const Aov c : {Aov::Diffuse, Aov::Reflection, Aov::Specular})
          EXPECT_NEAR(m.outputs[c][k], plain.outputs[c][k], 1e-6f);
        EXPECT_NEAR(m.mean[k] - plain.mean[k], (by - 1) * plain.outputs[Aov::Indirect][k], 1e-5f);
      }
      figure(fmt::format("indirect light times {}", by), by,
             m.outputs[Aov::Indirect].x / plain.outputs[Aov::Indirect].x, 0);
    }
  }
}

// acceptance: P6
TEST(GatherQuality, IsRawWithoutAWeightElseTheProductButOne) {
  struct Case {
    float quality, weight;
    double rays;
  };
  for (const Case& c : {Case{1, 1, 1}, Case{3, 0, 3}, Case{7, 0, 7}, Case{1, 5, 5}, Case{0, 5, 1},
                        Case{.5f, 1, 1}, Case{.5f, 6, 3}, Case{4, 1, 4}, Case{2, .25f, 1}}) {
    SceneText scene;
    scene.uniform_sky(1)
        .lambert("card", .5f,
                 fmt::format("\"fg_quality\" {}, \"fg_quality_w\" {}", c.quality, c.weight))
        .square("card", Vec3(0), 1, kUp);
    const Measured m = Probe(scene).onto(Vec3(0), kUp, 0, 1024);
    EXPECT_EQ(m.each(m.counts.gather), c.rays) << c.quality << ' ' << c.weight;
    EXPECT_NEAR(m.mean.x, .5f, .002f);
  }
  // Beside another lobe a ray of its own; below 1 and raw, a smaller share of paths.
  const auto share = [](float quality) {
    SceneText scene;
    scene.uniform_sky(1)
        .material("card",
                  fmt::format("\"diffuse\" 1 1 1, \"reflectivity\" .5, \"brdf_0_degree_refl\" 1, "
                              "\"fg_quality_w\" 0, \"fg_quality\" {}",
                              quality))
        .square("card", Vec3(0), 1, kUp);
    const Measured m = Probe(scene).onto(Vec3(0), kUp, 0, 1 << 14);
    expect_exact(fmt::format("card of quality {}", quality), m, 1, .02f);
    return m.each(m.counts.gather);
  };
  EXPECT_EQ(share(1), 1);
  EXPECT_NEAR(share(.25f), .2, .01);
}

// acceptance: P6
TEST(GatherQuality, MayBeMapped) {
  // fg_quality 0..1 along x with weight 5: 1 to 5 rays, never fewer.
  SceneText scene;
  scene.uniform_sky(1)
      .statement("shader \"place\" \"test_place\" ( \"scale\" 1 1 1 )")
      .material("card", "\"reflectivity\" 0, \"fg_quality\" = \"place\", \"fg_quality_w\" 5")
      .square("card", Vec3(0), 4, kUp);
  const Probe probe(scene);
  // A colour gives a scalar by the mean of its channels: x / 3.
  for (const auto& [x, rays] : {std::pair{.3f, 1.0}, std::pair{1.8f, 3.0}, std::pair{3.0f, 5.0}}) {
    const Measured m = probe.onto(Vec3(x, 0, 0), kUp, 0, 64);
    EXPECT_EQ(m.each(m.counts.gather), rays) << x;
  }
}

// acceptance: P7
TEST(LightLists, EachModeShowsItsLights) {
  // Red, green and blue suns; the list of the material holds the blue one, the instance's link
  // the red one.
  const auto lit = [](const std::string& arguments, const std::string& link) {
    SceneText scene;
    const char* colours[] = {"1 0 0", "0 1 0", "0 0 1"};
    const char* names[] = {"red", "green", "blue"};
    for (int i = 0; i < 3; ++i)
      scene.light(names[i], fmt::format("\"mib_light_infinite\" ( \"color\" {} ) direction 0 0 -1",
                                        colours[i]));
    scene.material("card", "\"diffuse\" 1 1 1, \"reflectivity\" 0" + arguments)
        .polygon("card", {Vec3(-1, -1, 0), Vec3(1, -1, 0), Vec3(1, 1, 0), Vec3(-1, 1, 0)}, link);
    return Probe(scene).onto(Vec3(0), kUp, 20, 64);
  };
  const std::string list = ", \"lights\" [ \"blue_i\" ], \"mode\" ";
  const std::string linked = "light [ \"red_i\" ]", unlinked = "light \"exclusive\" [ \"red_i\" ]";
  const Rgb red(1, 0, 0), green(0, 1, 0), blue(0, 0, 1), all(1);
  struct Case {
    const char* name;
    std::string arguments, link;
    Rgb exact;
  };
  const Case cases[] = {{"list, mode 0", list + "0", "", blue},
                        {"list, mode 1", list + "1", "", blue},
                        {"list, mode 2", list + "2", "", red + green},
                        {"list, mode 4", list + "4", "", all},
                        {"no list, mode 0", ", \"mode\" 0", "", all},
                        {"no list, mode 1", ", \"mode\" 1", "", Rgb(0)},
                        {"no list, mode 2", ", \"mode\" 2", "", all},
                        {"no list, mode 4", ", \"mode\" 4", "", all},
                        {"linked, mode 0", ", \"mode\" 0", linked, red},
                        {"linked, mode 4", ", \"mode\" 4", linked, red},
                        {"exclusive link, mode 4", ", \"mode\" 4", unlinked, green + blue},
                        {"list over link, mode 0", list + "0", linked, blue},
                        {"list over link, mode 1", list + "1", linked, blue},
                        {"link over list, mode 4", list + "4", linked, red}};
  for (const Case& c : cases) expect_exact(c.name, lit(c.arguments, c.link), c.exact);
}

}  // namespace options_test
}  // namespace oriel::testing
