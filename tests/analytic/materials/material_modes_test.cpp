// SPDX-License-Identifier: Apache-2.0
// Statements of the material chapter of the manual about combinations of parameters and modes.
#include "bsdf/fresnel.h"
#include "runtime/texture_direction.h"
#include "support/picture.h"
#include "transport/photon/photon_trace.h"
#include "transport/surface.h"

namespace oriel::testing {
namespace material_modes_test {

/// "test_lean": a bump shader that leans the normal it finds, and returns it as a vector.
struct TestLean {
  Vec3 by;
};
constexpr ParamSpec kTestLeanRows[] = {{ORIEL_PARAM(TestLean, by)}};
constexpr ShaderSpec kTestLean = {
    .name = "test_lean",
    .library = "test",
    .apply = kApplyTexture,
    .params = kTestLeanRows,
    .params_size = sizeof(TestLean),
    .result = ParamType::Vector,
    .result_size = sizeof(Vec3),
    .value =
        [](const Call& call, void* result) {
          *static_cast<Vec3*>(result) = normalize(call.point.normal + call.as<TestLean>().by);
        },
};

const Registry& registry() {
  static const Registry all = test_registry_with({&kTestLean});
  return all;
}

constexpr const char* kMirror =
    "\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_0_degree_refl\" 1, "
    "\"brdf_90_degree_refl\" 1";

// acceptance: B2, C4
TEST(BumpInputs, TheSecondIsAddedOnTopOfTheFirst) {
  const Vec3 first = normalize(Vec3(.3f, 0, 1)), by(0, .25f, 0);
  const Vec3 both = normalize(first + by);
  // Set modes take the vector for the normal, add modes for a change of it.
  for (int mode = 1; mode <= 8; ++mode) {
    const Vec3 written = mode >= 5 ? first : first * (1 / first.z) - kUp;
    SceneText scene;
    scene.environment("\"test_direction\" ()")
        .statement(fmt::format("shader \"lean\" \"test_lean\" ( \"by\" {} )", text_of(by)))
        .statement("shader \"moves\" \"test_tilt\" ( \"normal\" .3 0 1 )")
        .material("plain", fmt::format("{}, \"bump_mode\" {}, \"overall_bump\" {}, "
                                       "\"standard_bump\" = \"lean\"",
                                       kMirror, mode, text_of(written)))
        .material("moved", fmt::format("{}, \"bump_mode\" {}, \"overall_bump\" = \"moves\", "
                                       "\"standard_bump\" = \"lean\"",
                                       kMirror, mode))
        .square("plain", Vec3(0, 0, 0), 1, kUp)
        .square("moved", Vec3(5, 0, 0), 1, kUp);
    const Probe probe(scene.str(), registry());
    // What an add mode adds is the leaned normal itself.
    const Vec3 normal = mode >= 5 ? both : normalize(first + both);
    const Vec3 view(0, 0, -1), seen = view - normal * (2 * dot(view, normal));
    for (const float x : {0.0f, 5.0f}) {
      const Rgb shown = probe.onto(Vec3(x, 0, 0), kUp, 0, 64).mean;
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(2 * shown[k] - 1, seen[k], 4e-5f) << mode << ' ' << x;
    }
  }
}

// acceptance: B2
TEST(BumpInputs, DiffuseMayIgnoreTheSecond) {
  const Vec3 first = normalize(Vec3(.3f, 0, 1));
  SceneText scene;
  scene.statement("shader \"lean\" \"test_lean\" ( \"by\" 0 .8 0 )")
      .material("m", fmt::format("\"reflectivity\" 0, \"diffuse\" .5 .5 .5, \"bump_mode\" 5, "
                                 "\"overall_bump\" {}, \"standard_bump\" = \"lean\", "
                                 "\"no_diffuse_bump\" on",
                                 text_of(first)))
      .square("m", Vec3(0), 1, kUp)
      .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1 ) direction 0 0 -1");
  const Rgb mean = Probe(scene.str(), registry()).direct_only().onto(Vec3(0), kUp, 0, 64).mean;
  EXPECT_NEAR(mean.x, .5f * first.z, 1e-4f);
}

TEST(OpaqueSolids, ReflectTheSameWhicheverWayTheirNormalsPoint) {
  for (const float degrees : {0.0f, 30.0f, 50.0f, 70.0f}) {
    const float expected = bsdf::fresnel_dielectric(std::cos(degrees * kPi / 180), 1.5f);
    for (const Vec3& normal : {kUp, -kUp}) {
      SceneText scene;
      scene.uniform_sky(1)
          .material("m",
                    "\"reflectivity\" 1, \"diffuse_weight\" 0, \"brdf_fresnel\" on, "
                    "\"refr_ior\" 1.5, \"transparency\" 0")
          .square("m", Vec3(0), 2, normal);
      const Rgb mean = Probe(scene).onto(Vec3(0), kUp, degrees, 64).mean;
      EXPECT_NEAR(mean.x, expected, 1e-4f) << degrees << ' ' << normal.z;
    }
  }
}

/// Light on a floor below a plate of glass.
Rgb below_glass(const std::string& options, const std::string& glass, const std::string& light) {
  SceneText scene("trace depth 8 8 12 shadow segments " + options);
  scene.lambert("floor", .5f)
      .square("floor", Vec3(0), 20, kUp)
      .material("glass",
                "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_fresnel\" on, "
                "\"transparency\" 1, \"refr_ior\" 1.5, " +
                    glass)
      .box("glass", Vec3(-5, -5, 1), Vec3(5, 5, 1.2f))
      .light("lamp", light);
  return Probe(scene).onto(Vec3(0), kUp, 20, 256).mean;
}

// acceptance: T9
TEST(CausticsOfPaths, TransparentShadowsRemainWithoutPhotons) {
  const std::string lights[] = {
      "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1",
      "\"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 0 3",
      "\"physical_light\" ( \"color\" 40 40 40 ) origin 0 0 3 direction 0 0 -1 "
      "rectangle 1 0 0 0 1 0 3 3"};
  for (const std::string& light : lights) {
    const Rgb open = below_glass("", "\"do_refractive_caustics\" off", light);
    const Rgb caustic = below_glass("caustic on", "\"do_refractive_caustics\" on", light);
    EXPECT_GT(open.x, .01f) << light;
    EXPECT_NEAR(caustic.x / open.x, 1, .02f) << light;
  }
}

/// A plate with a visible light as highlight or reflection, viewed in the mirror direction.
SceneText lamp_on(const std::string& material, const std::string& options = "") {
  SceneText scene("trace depth 8 8 12 shadow segments " + options);
  scene
      .material("m",
                "\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_0_degree_refl\" 1, "
                "\"refl_gloss\" .4, " +
                    material)
      .plate("m")
      .light("lamp",
             "\"physical_light\" ( \"color\" 40 40 40 ) origin 0 0 3 direction 0 0 -1 "
             "rectangle 1 0 0 0 1 0 3 3",
             "visible on");
  return scene;
}

// acceptance: R5
TEST(VisibleAreaLights, KeepTheHighlightThatNoReflectionReplaces) {
  // From 30 degrees: the mirrored ray misses the light, a wide highlight does not.
  const auto seen = [](const std::string& material) {
    return Probe(lamp_on(material)).onto(Vec3(0), kUp, 30, 4096, 2).mean.x;
  };
  const float wanted = seen("\"refl_gloss_samples\" 0, \"no_visible_area_hl\" off");
  EXPECT_GT(wanted, .01f);
  EXPECT_NEAR(seen("\"refl_gloss_samples\" 0"), 0, 1e-6f) << "mirrored rays replace it";
  EXPECT_NEAR(seen("\"refl_gloss_samples\" 0, \"refl_hl_only\" on") / wanted, 1, .03f);
}

// acceptance: R7
TEST(VisibleAreaLights, KeepTheHighlightBeyondTheMaterialDepth) {
  // A mirror that shows the plate; at the plate, one reflection deep, the material stops.
  const auto seen = [](const std::string& material) {
    SceneText scene = lamp_on("\"refl_gloss_samples\" 0, " + material);
    scene.material("mirror", std::string(kMirror) + ", \"refl_depth\" 8")
        .square("mirror", Vec3(3, 0, 1), .5f, Vec3(-1, 0, 0));
    // Along x to the mirror, back down to the plate at about 60 degrees.
    return Probe(scene).ray(Vec3(1, 0, 2.155f), Vec3(1, 0, -.5774f), 4096).mean.x;
  };
  const float deep = seen("\"refl_depth\" 1"),
              wanted = seen("\"refl_depth\" 1, \"no_visible_area_hl\" off");
  EXPECT_GT(wanted, 1e-4f);
  EXPECT_NEAR(deep / wanted, 1, .05f);
  EXPECT_EQ(seen("\"refl_depth\" 5"), 0) << "there the mirror's ray is traced";
}

// acceptance: T4
TEST(ThinWalls, FadeTheTransmittedView) {
  for (const bool coloured : {false, true}) {
    SceneText scene;
    scene.emitter("glow", 2)
        .square("glow", Vec3(0, 0, -3), 9, kUp)
        .material("pane", fmt::format("\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" "
                                      "1, \"thin_walled\" on, \"refr_falloff_on\" on, "
                                      "\"refr_falloff_dist\" 4, \"refr_falloff_color_on\" {}, "
                                      "\"refr_falloff_color\" .25 .5 1",
                                      coloured ? "on" : "off"))
        .square("pane", Vec3(0), 9, kUp);
    const Rgb mean = Probe(scene).onto(Vec3(0), kUp, 0, 64).mean;
    const Rgb expected =
        coloured ? Rgb(2 * std::pow(.25f, .75f), 2 * std::pow(.5f, .75f), 2) : Rgb(2 * .25f);
    expect_near_color(mean, expected, 1e-4f, coloured ? "to a colour" : "to black");
    // The way to the pane does not count.
    const Rgb far = Probe(scene).onto(Vec3(0), kUp, 0, 64, 8).mean;
    expect_near_color(far, expected, 1e-4f, "from farther away");
  }
}

// acceptance: T10
TEST(TranslucentSolids, ShineThroughWithoutIndirectLight) {
  // Two Lambert transmissions of level .6 * .9 between wide faces: pi E enters, its square leaves.
  SceneText scene;
  scene
      .material("m",
                "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" .6, "
                "\"refr_translucency\" on, \"refr_trans_weight\" 1, \"refr_trans_color\" .9 .9 .9")
      .box("m", Vec3(-50, -50, -.5f), Vec3(50, 50, 0))
      .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 1");
  const Measured m = Probe(scene).direct_only().onto(Vec3(0), kUp, 0, 4096);
  EXPECT_NEAR(m.mean.x, .54f * .54f, 4 * m.error.x + .005f);
}

/// The weight of reflection inside glass at an angle.
float inner_reflection(float degrees, float ior, const std::string& more = "") {
  SceneText scene("trace depth 1 1 1 shadow segments");
  scene.uniform_sky(1)
      .material("m", fmt::format("\"diffuse_weight\" 0, \"reflectivity\" 1, \"brdf_fresnel\" on, "
                                 "\"transparency\" 1, \"refr_color\" 0 0 0, \"refr_ior\" {}{}",
                                 ior, more))
      .square("m", Vec3(0), 2, -kUp);
  return Probe(scene).onto(Vec3(0), kUp, degrees, 64).mean.x;
}

// acceptance: T7
TEST(SkipInsideRefl, LeavesOutWeakReflectionsOnly) {
  EXPECT_EQ(inner_reflection(0, 1.5f), 0);
  EXPECT_EQ(inner_reflection(25, 1.5f), 0);
  const auto exact = [](float degrees) {
    return bsdf::fresnel_dielectric(std::cos(degrees * kPi / 180), 1 / 1.5f);
  };
  EXPECT_NEAR(inner_reflection(0, 1.5f, ", \"skip_inside_refl\" off"), exact(0), 1e-4f);
  for (const float degrees : {40.5f, 41.5f, 50.0f})
    EXPECT_NEAR(inner_reflection(degrees, 1.5f), exact(degrees), 1e-3f) << degrees;
}

// acceptance: T12
TEST(PropagateAlpha, PassesInterpolatedGlass) {
  for (const bool interpolated : {false, true})
    for (const bool propagates : {false, true}) {
      SceneText scene;
      scene
          .material("m", fmt::format("\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" "
                                     ".75, \"thin_walled\" on, \"refr_gloss\" .9, "
                                     "\"refr_interpolate\" {}, \"propagate_alpha\" {}",
                                     interpolated ? "on" : "off", propagates ? "on" : "off"))
          .square("m", Vec3(0, 0, -1), 3, kUp)
          .camera("focal 1 aperture .2 aspect 1 resolution 12 12");
      const float alpha = RenderedScene(scene, {.budget = {.samples = 16}}).at(6, 6).a;
      EXPECT_NEAR(alpha, propagates ? .25f : 1, 1e-3f) << interpolated;
    }
}

/// A box of fog around the origin, seen from above against a glowing wall; a floor in `floor_at`.
SceneText fog_box(const std::string& hull, bool light_rays = false) {
  SceneText scene;
  return scene
      .statement(
          fmt::format("shader \"hull_s\" \"mia_material_x\" ( {} )\n"
                      "material \"hull\" = \"hull_s\" shadow = \"hull_s\" volume \"mib_volume\" ( "
                      "\"color\" .25 .5 1, \"max\" 4, \"lightrays\" {} ) end material",
                      hull, light_rays ? "on" : "off"))
      .box("hull", Vec3(-5, -5, -1), Vec3(5, 5, 1));
}

// acceptance: T14
TEST(VolumesOfMaterials, ActBetweenWhereRaysEnterAndLeave) {
  const std::string hulls[] = {"\"cutout_opacity\" 0",
                               "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, "
                               "\"thin_walled\" on",
                               "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, "
                               "\"refr_ior\" 1"};
  for (const std::string& hull : hulls) {
    SceneText scene = fog_box(hull);
    scene.emitter("glow", 2).square("glow", Vec3(0, 0, -3), 90, kUp);
    const Probe probe(scene);
    for (const float degrees : {0.0f, 60.0f}) {
      // Half the full density at half its distance.
      const float length = 2 / std::cos(degrees * kPi / 180);
      const float fog = std::min(1.0f, length / 4);
      const Rgb expected = Rgb(2) * (1 - fog) + Rgb(.25f, .5f, 1) * fog;
      for (const float distance : {.5f, 2.0f}) {
        const Rgb mean = probe.onto(Vec3(0, 0, 1), kUp, degrees, 64, distance).mean;
        expect_near_color(mean, expected, 1e-4f, hull);
      }
    }
    // From inside, up to the hull.
    const Rgb inside = probe.ray(Vec3(0, 0, 0), Vec3(0, 0, -1), 64).mean;
    expect_near_color(inside, Rgb(2) * .75f + Rgb(.25f, .5f, 1) * .25f, 1e-4f, "inside " + hull);
  }
}

// acceptance: T14
TEST(VolumesOfMaterials, DimLightThatPassesThem) {
  for (const bool on : {false, true}) {
    SceneText scene = fog_box("\"cutout_opacity\" 0", on);
    scene.lambert("floor", .5f)
        .square("floor", Vec3(0, 0, -3), 9, kUp)
        .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
    // From below the box, so that only the light passes it.
    const Rgb mean = Probe(scene).direct_only().onto(Vec3(0, 0, -3), kUp, 0, 64).mean;
    EXPECT_NEAR(mean.x, on ? .25f : .5f, 1e-4f);
  }
}

// acceptance: T14
TEST(VolumesOfMaterials, DimLightThatDoesNotLeaveThem) {
  // Ground and light are in the fog, one unit apart: a quarter of its full density.
  for (const bool on : {false, true}) {
    SceneText scene = fog_box("\"cutout_opacity\" 0", on);
    scene.lambert("floor", .5f)
        .square("floor", Vec3(0, 0, -.5f), 1, kUp)
        .light("lamp", "\"mib_light_point\" ( \"color\" 1 1 1, \"shadow\" on ) origin 0 0 .5");
    // From so near that the fog before the eye is nothing.
    const Rgb mean = Probe(scene).direct_only().onto(Vec3(0, 0, -.5f), kUp, 0, 64, 1e-3f).mean;
    EXPECT_NEAR(mean.x, on ? .375f : .5f, 1e-3f);
  }
}

// acceptance: T14
TEST(VolumesOfMaterials, AffectObjectsInside) {
  // Eye and wall lie inside of the fog, and no ray meets its hull before the wall.
  SceneText scene = fog_box("\"cutout_opacity\" 0");
  scene.emitter("glow", 2).square("glow", Vec3(0, 0, -.5f), 3, kUp);
  const Rgb mean = Probe(scene).ray(Vec3(0, 0, .5f), Vec3(0, 0, -1), 64).mean;
  expect_near_color(mean, Rgb(2) * .75f + Rgb(.25f, .5f, 1) * .25f, 1e-4f, "wall within");
  // Nor does a ray that only passes by outside.
  SceneText outside = fog_box("\"cutout_opacity\" 0");
  outside.emitter("glow", 2).square("glow", Vec3(0, 0, 2), 3, kUp);
  EXPECT_NEAR(Probe(outside).ray(Vec3(0, 0, 3), Vec3(0, 0, -1), 64).mean.x, 2, 1e-4f);
}

// acceptance: T14
TEST(VolumesOfMaterials, DimPhotons) {
  for (const bool on : {false, true}) {
    SceneText scene = fog_box("\"cutout_opacity\" 0", on);
    scene.light("lamp",
                "\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 40 direction 0 0 -1 "
                "spread .9999 energy 100 100 100 globillum photons 20000");
    const Probe probe(scene);
    PhotonSettings settings;
    settings.each = {.global = {.emit = 20000}};
    RayCounts counts;
    PhotonBalance balance;
    trace_photons(probe.world(), settings, counts, &balance);
    // Of 20000 photons the share has a standard error of .0035.
    EXPECT_NEAR(balance.escaped.y / balance.emitted.y, on ? .5 : 1, on ? .014 : 1e-4);
  }
}

/// A triangle in the plane z = 0 whose texture spaces are turned by those angles (turns).
std::string turned_spaces(const std::vector<float>& turns, const std::string& place) {
  const Vec2 corners[] = {Vec2(-2, -2), Vec2(2, -2), Vec2(0, 3)};
  std::string vectors, vertices;
  for (const Vec2& p : corners) vectors += fmt::format("{} {} 0\n", p.x, p.y);
  for (const float t : turns)
    for (const Vec2& p : corners) {
      const float c = std::cos(t * kTwoPi), s = std::sin(t * kTwoPi);
      vectors += fmt::format("{} {} 0\n", c * p.x + s * p.y, c * p.y - s * p.x);
    }
  for (std::size_t i = 0; i < 3; ++i) {
    vertices += fmt::format("v {}", i);
    for (std::size_t k = 0; k < turns.size(); ++k) vertices += fmt::format(" t {}", 3 + 3 * k + i);
    vertices += '\n';
  }
  return fmt::format(
      "object \"tri\" visible on trace on group\n{}{}c 0 1 2\nend group end object\n"
      "instance \"tri_i\" \"tri\" material \"m\" {} end instance\n",
      vectors, vertices, place);
}

// acceptance: A3
TEST(TextureDirection, IsTheGradientOfEachSpaceForAnyTransform) {
  // Alone the object is carried to world space, twice it stays in its own.
  for (const bool twice : {false, true}) {
    // World to object: a quarter turn about z.
    const std::string place = "transform 0 -1 0 0  1 0 0 0  0 0 1 0  0 0 0 1";
    SceneText scene;
    scene.lambert("m", .5f).statement(turned_spaces({.05f, .15f, .3f}, place)).member("tri_i");
    if (twice)
      scene
          .statement(
              "instance \"tri_j\" \"tri\" material \"m\" "
              "transform 1 0 0 0 0 1 0 0 0 0 1 0 30 0 0 1 end instance")
          .member("tri_j");
    const Probe probe(scene);
    const World& world = probe.world();
    geom::Ray ray;
    ray.org = Vec3(0, 0, 1);
    ray.dir = Vec3(0, 0, -1);
    geom::Hit hit;
    ASSERT_TRUE(world.accel->intersect(ray, hit));
    ShadingPoint point;
    fill_point(world, ray, hit, {}, RayKind::Eye, point);
    ASSERT_EQ(point.texture_spaces, 3);
    const float turns[] = {.05f, .15f, .3f};
    for (int k = 0; k < 3; ++k) {
      // The object's x axis points along world y.
      const float angle = (turns[k] + .25f) * kTwoPi;
      const Vec3 d = texture_direction(point, k);
      EXPECT_NEAR(d.x, std::cos(angle), 1e-5f) << k << twice;
      EXPECT_NEAR(d.y, std::sin(angle), 1e-5f) << k << twice;
    }
    EXPECT_EQ(texture_direction(point, 3), Vec3(0));
  }
}

}  // namespace material_modes_test
}  // namespace oriel::testing
