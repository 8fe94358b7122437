// SPDX-License-Identifier: Apache-2.0
// Emissive meshes: light sampling, rays alone, and closed forms agree.
#include "lights/light_sampler.h"
#include "support/probe.h"

namespace oriel::testing {
namespace glow_test {

constexpr float kRadiance = 10;

/// A grey floor at z = 0.
SceneText floor_scene(const std::string& floor = "\"reflectivity\" 0, \"diffuse\" .5 .5 .5") {
  SceneText scene;
  scene.material("floor", floor).square("floor", Vec3(0), 20, kUp).emitter("glow", kRadiance);
  return scene;
}

/// An n x n grid of squares in the plane z, front below.
void add_grid(SceneText& scene, const std::string& material, float x, float y, float z, float half,
              int n) {
  std::vector<Vec3> points;
  std::vector<std::vector<int>> faces;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const auto along = [&](int k) {
        return half * (2 * static_cast<float>(k) / static_cast<float>(n) - 1);
      };
      points.emplace_back(x + along(i), y + along(j), z);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int a = j * (n + 1) + i;
      faces.push_back({a, a + n + 1, a + n + 2, a + 1});
    }
  scene.mesh(material, points, faces, {});
}

/// Form factor from a surface element to a parallel rectangle with a corner above it.
/// Source: Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", B-4.
float corner_factor(float a, float b, float h) {
  const float x = a / h, y = b / h, p = std::sqrt(1 + x * x), q = std::sqrt(1 + y * y);
  return (x / p * std::atan(y / p) + y / q * std::atan(x / q)) / kTwoPi;
}

/// "test_step": white on one side of an edge in world x, black on the other.
struct TestStep {
  float edge;
};
constexpr ParamSpec kTestStepRows[] = {{ORIEL_PARAM(TestStep, edge)}};
constexpr ShaderSpec kTestStep = {
    .name = "test_step",
    .library = "test",
    .apply = kApplyTexture,
    .params = kTestStepRows,
    .params_size = sizeof(TestStep),
    .value =
        [](const Call& call, void* result) {
          const bool lit = call.point.position.x > call.as<TestStep>().edge;
          *static_cast<Rgba*>(result) = lit ? Rgba(kRadiance) : Rgba(0);
        },
};
const Registry& step_registry() {
  static const Registry all = test_registry_with({&kTestStep});
  return all;
}

/// Mesh lights exist, agree with rays alone and with the exact value, and have less error.
void expect_glow(const std::string& name, const SceneText& scene, float exact,
                 std::size_t triangles, float tolerance = 0) {
  Probe probe(scene);
  EXPECT_EQ(probe.world().light_sampler->mesh_lights().size(), triangles) << name;
  const Measured sampled = probe.onto(Vec3(0), kUp, 0, 1 << 13);
  const Measured by_rays = probe.mesh_lights(false).onto(Vec3(0), kUp, 0, 1 << 17);
  expect_same(name + " by rays", sampled, by_rays, .03f);
  EXPECT_NEAR(sampled.mean.x, exact, 4 * sampled.error.x + (tolerance + kRounding) * exact) << name;
  EXPECT_LT(sampled.error.x, by_rays.error.x) << name << ": with 16 times fewer samples";
  figure(name, exact, sampled.mean.x, sampled.error.x);
}

TEST(Emission, RectanglesMatchTheirFormFactor) {
  const float exact = .5f * kRadiance * 4 * corner_factor(.2f, .2f, 1);
  SceneText one = floor_scene();
  one.square("glow", Vec3(0, 0, 1), .2f, -kUp);
  expect_glow("rectangle", one, exact, 2);
  SceneText many = floor_scene();
  add_grid(many, "glow", 0, 0, 1, .2f, 71);
  expect_glow("rectangle of 10082 triangles", many, exact, 10082);
}

TEST(Emission, EqualsAnAreaLightOfEqualRadiance) {
  SceneText mesh = floor_scene();
  mesh.square("glow", Vec3(.5f, .3f, 1), .2f, -kUp);
  SceneText lamp = floor_scene();
  // Radiance of a physical_light: colour / (4 area).
  lamp.light("lamp", fmt::format("\"physical_light\" ( \"color\" {0} {0} {0} ) origin .5 .3 1 "
                                 "direction 0 0 -1 rectangle .4 0 0 0 .4 0",
                                 kRadiance * 4 * .16f));
  expect_same("mesh and lamp", Probe(mesh).onto(Vec3(0), kUp, 0, 1 << 14),
              Probe(lamp).onto(Vec3(0), kUp, 0, 1 << 14), .01f);
}

TEST(Emission, DiscsMatchTheirFormFactor) {
  SceneText scene = floor_scene();
  std::vector<Vec3> rim;
  for (int i = 0; i < 256; ++i) {
    const float phi = -kTwoPi * static_cast<float>(i) / 256;
    rim.emplace_back(.3f * std::cos(phi), .3f * std::sin(phi), 1.5f);
  }
  scene.polygon("glow", rim);
  expect_glow("disc", scene, .5f * kRadiance * .09f / (.09f + 2.25f), 254, 2e-4f);
}

TEST(Emission, SpheresMatchTheirFormFactor) {
  // As seen from the floor below the centre: (R / d)^2. A polyhedron is a little smaller.
  SceneText scene = floor_scene();
  scene.sphere("glow", Vec3(0, 0, 1), .1f, 48);
  expect_glow("sphere", scene, .5f * kRadiance * .01f, 48 * 96 * 2 - 2 * 96, 2e-3f);
}

TEST(Emission, TexturesKeepTheirLight) {
  // Brightness that runs along x, and is black beyond x = 0.
  SceneText ramp = floor_scene();
  ramp.statement("shader \"place\" \"test_place\" ( \"scale\" 8 8 0 )")
      .material("ramp",
                "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"place\"");
  add_grid(ramp, "ramp", .35f, .35f, 1, .3f, 5);
  const Probe probe(ramp);
  EXPECT_EQ(probe.world().light_sampler->mesh_lights().size(), 50u);
  const Measured sampled = probe.onto(Vec3(0), kUp, 0, 1 << 13);
  Probe rays(ramp);
  expect_same("ramp", sampled, rays.mesh_lights(false).onto(Vec3(0), kUp, 0, 1 << 17), .03f);
  // Half of a square emits, with an edge between the sample positions.
  for (const float edge : {.05f, .19f}) {
    SceneText half = floor_scene();
    half.statement(fmt::format("shader \"step\" \"test_step\" ( \"edge\" {} )", edge))
        .material("half",
                  "\"reflectivity\" 0, \"diffuse_weight\" 0, \"additional_color\" = \"step\"")
        .square("half", Vec3(0, 0, 1), .2f, -kUp);
    Probe with(half.str(), step_registry());
    const Measured found = with.onto(Vec3(0), kUp, 0, 1 << 16);
    expect_same(fmt::format("edge at {}", edge), found,
                with.mesh_lights(false).onto(Vec3(0), kUp, 0, 1 << 18), .2f);
    // Of the last hundredth none of the places sees anything: rays alone find it.
    EXPECT_EQ(with.world().light_sampler->mesh_lights().empty(), edge > .1f);
  }
}

TEST(Emission, EmitsFromBothSidesOrOne) {
  // A horizontal plate between two floors.
  const auto seen = [](const std::string& material, bool above, bool sampled) {
    SceneText scene = floor_scene();
    scene
        .statement(
            "material \"one\" \"mib_twosided\" ( \"front\" 5 5 5, \"back\" 0 0 0 ) end "
            "material")
        .square("floor", Vec3(0, 0, 2), 20, -kUp)
        .square(material, Vec3(0, 0, 1), .2f, -kUp);
    Probe probe(scene);
    EXPECT_EQ(probe.world().light_sampler->mesh_lights().size(), 2u) << material;
    return probe.mesh_lights(sampled).onto(Vec3(.5f, 0, above ? 2 : 0), above ? -kUp : kUp, 0,
                                           sampled ? 1 << 14 : 1 << 17, .2f);
  };
  for (const std::string material : {"glow", "one"})
    for (const bool above : {false, true})
      expect_same(material + (above ? " above" : " below"), seen(material, above, true),
                  seen(material, above, false), .08f);
}

/// The same mean with samples and without, for scenes that have things in the way.
void expect_unbiased(const std::string& name, const SceneText& scene, const Vec3& at = Vec3(0),
                     float degrees = 20) {
  Probe probe(scene);
  EXPECT_FALSE(probe.world().light_sampler->mesh_lights().empty()) << name;
  const Measured sampled = probe.onto(at, kUp, degrees, 1 << 15, .3f);
  const Measured by_rays = probe.mesh_lights(false).onto(at, kUp, degrees, 1 << 18, .3f);
  expect_same(name, sampled, by_rays, .05f);
  EXPECT_GT(sampled.mean.x, 1e-4f) << name;
}

TEST(Emission, GlossyFloorsReflectItOnce) {
  for (const char* gloss : {".2", ".6", ".9", "1"}) {
    SceneText scene = floor_scene(fmt::format(
        "\"diffuse\" .3 .3 .3, \"reflectivity\" .6, \"refl_gloss\" {}, \"brdf_fresnel\" off, "
        "\"brdf_0_degree_refl\" .6, \"brdf_90_degree_refl\" 1",
        gloss));
    scene.square("glow", Vec3(-.3f, 0, 1), .2f, -kUp);
    expect_unbiased(std::string("gloss ") + gloss, scene);
  }
}

TEST(Emission, GlassAndHolesBeforeItPassWhatRaysFind) {
  const auto with_pane = [](const std::string& pane, const std::string& options) {
    SceneText scene(options);
    scene
        .material("floor",
                  "\"diffuse\" .4 .4 .4, \"reflectivity\" .3, \"refl_gloss\" .5, "
                  "\"brdf_fresnel\" off, \"brdf_0_degree_refl\" .3")
        .square("floor", Vec3(0), 20, kUp)
        .emitter("glow", kRadiance)
        .square("glow", Vec3(0, 0, 1), .2f, -kUp)
        .material("pane", pane);
    // A slab of two sides.
    return scene.box("pane", Vec3(-2, -2, .6f), Vec3(2, 2, .65f));
  };
  const std::string glass =
      "\"diffuse_weight\" 0, \"reflectivity\" .1, \"transparency\" .8, \"refr_ior\" 1.4, "
      "\"refr_color\" 1 .7 .4, \"refr_falloff_on\" on, \"refr_falloff_dist\" .1, "
      "\"refr_falloff_color_on\" on, \"refr_falloff_color\" .5 .6 .7";
  for (const char* shadow : {"shadow segments", "shadow on"}) {
    const std::string options = std::string("trace depth 6 6 8 ") + shadow;
    expect_unbiased(std::string("glass, ") + shadow, with_pane(glass, options));
    expect_unbiased(
        std::string("holes, ") + shadow,
        with_pane("\"reflectivity\" 0, \"diffuse\" .2 .2 .2, \"cutout_opacity\" .4", options));
  }
}

TEST(Emission, ConstantsAndInputsOfTheSameValueAreTheSameLight) {
  const auto measured = [](const std::string& colour, const std::string& lamp, float height,
                           const std::string& between) {
    SceneText scene("trace depth 8 8 12 shadow segments");
    scene.material("floor", "\"reflectivity\" .2, \"refl_gloss\" .4, \"diffuse\" .5 .5 .5")
        .square("floor", Vec3(0), 20, kUp)
        .statement("shader \"ten\" \"mib_color_mix\" ( \"num\" 0, \"color_base\" 10 8 6 )")
        .material("glow", "\"reflectivity\" 0, \"diffuse_weight\" 0, " + lamp +
                              "\"additional_color\"" + colour)
        .square("glow", Vec3(.1f, 0, height), .3f, -kUp);
    if (!between.empty())
      scene.material("pane", between).box("pane", Vec3(-2, -2, .4f), Vec3(2, 2, .7f));
    return Probe(scene).onto(Vec3(0), kUp, 0, 1 << 12).mean;
  };
  const std::string glass =
      "\"transparency\" 1, \"reflectivity\" 1, \"refr_ior\" 1.5, \"diffuse_weight\" 0, "
      "\"brdf_fresnel\" on, ";
  const std::string fading =
      "\"refr_falloff_on\" on, \"refr_falloff_dist\" .5, \"refr_falloff_color_on\" on, "
      "\"refr_falloff_color\" .2 .5 .8, ";
  for (const std::string lamp : {"", "\"cutout_opacity\" .5, "})
    for (const float height : {1.0f, .55f})  // behind the pane, and in its glass
      for (const std::string& pane :
           {std::string(), glass + "\"refr_gloss\" 1", glass + fading + "\"refr_gloss\" 1",
            std::string("\"reflectivity\" 0, \"cutout_opacity\" .4")}) {
        const std::string name = fmt::format("{} {} {}", lamp, height, pane);
        const Rgb constant = measured(" 10 8 6", lamp, height, pane);
        EXPECT_GT(constant.x, 0) << name;
        EXPECT_EQ(constant, measured(" = \"ten\"", lamp, height, pane)) << name;
      }
}

TEST(Emission, FlagsAndInstancesApply) {
  for (const char* flag : {"finalgather 4", "finalgather 8", "reflection 4", "reflection 8",
                           "shadow off", "visible off"}) {
    SceneText scene = floor_scene(
        "\"diffuse\" .3 .3 .3, \"reflectivity\" .6, \"refl_gloss\" .4, \"brdf_fresnel\" off, "
        "\"brdf_0_degree_refl\" .6");
    scene.polygon("glow", {Vec3(-.2f, -.2f, 1), Vec3(-.2f, .2f, 1), Vec3(.2f, .2f, 1)}, flag);
    Probe probe(scene);
    const Measured sampled = probe.onto(Vec3(0), kUp, 20, 1 << 15);
    const Measured by_rays = probe.mesh_lights(false).onto(Vec3(0), kUp, 20, 1 << 18);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(sampled.mean[k], by_rays.mean[k],
                  4 * std::hypot(sampled.error[k], by_rays.error[k]) + 1e-6f)
          << flag;
  }
  // Two copies of one mesh, one of them turned over by a mirror and larger.
  SceneText copies = floor_scene();
  copies.polygon("glow", {Vec3(-.2f, -.2f, 1), Vec3(-.2f, .2f, 1), Vec3(.2f, .2f, 1)});
  std::string text = copies.str();
  const std::string copy =
      "instance \"copy\" \"shape1\" material \"glow\" transform -.5 0 0 0  0 .5 0 0  0 0 .5 0  "
      ".3 0 0 1 end instance\n";
  text.insert(text.find("camera \"cam\""), copy);
  text.insert(text.rfind(" end instgroup"), " \"copy\"");
  Probe probe(text);
  EXPECT_EQ(probe.world().light_sampler->mesh_lights().size(), 2u);
  const Measured sampled = probe.onto(Vec3(0), kUp, 0, 1 << 14);
  expect_same("copies", sampled, probe.mesh_lights(false).onto(Vec3(0), kUp, 0, 1 << 18), .02f);
}

/// Share of the samples for a point of which another part of the surface hides the emission.
float hidden_samples(const Probe& probe, const Vec3& at, const Vec3& normal) {
  const World& world = probe.world();
  int hidden = 0, all = 0;
  for (std::uint32_t i = 0; i < 4096; ++i) {
    sampling::Sampler sampler(1, 2, i);
    const Vec2 u_choice = sampler.next_2d(), u_place = sampler.next_2d();
    const auto s = world.light_sampler->sample_triangle({at, normal}, {}, 0, u_choice, u_place);
    if (!s) continue;
    geom::Ray ray;
    ray.org = at + normal * 1e-4f;
    ray.dir = s->wi;
    geom::Hit hit;
    ++all;
    hidden += world.accel->intersect(ray, hit) && hit.t < s->distance * .999f;
  }
  EXPECT_GT(all, 2048);
  return static_cast<float>(hidden) / static_cast<float>(all);
}

TEST(Emission, InsidesOfLampsAreRarelySampled) {
  // Spheres, whose material shines to both sides, with faces that look out or in.
  for (const bool turned : {false, true}) {
    SceneText scene = floor_scene();
    scene.sphere("glow", Vec3(0, 0, 1), .2f, 16, turned)
        .sphere("glow", Vec3(1, 0, 1), .1f, 8, turned);
    EXPECT_LT(hidden_samples(Probe(scene), Vec3(.4f, .3f, 0), kUp), .08f) << turned;
    expect_unbiased("spheres", scene);
    // Light from inside, where no samples are needed, arrives as well.
    SceneText open = floor_scene();
    open.box("glow", Vec3(-.2f, -.2f, -.1f), Vec3(.2f, .2f, .6f), turned);
    expect_unbiased("box", open);
  }
}

TEST(Emission, SidesCloseToAPlateAreRarelySampled) {
  // Two lamps, one of them with a plate close below it: only the lower side of the other counts.
  SceneText two = floor_scene();
  two.square("glow", Vec3(-1, 0, 1), .3f, kUp)
      .square("glow", Vec3(1, 0, 1), .3f, kUp)
      .square("floor", Vec3(1, 0, .99f), .4f, kUp)
      .square("floor", Vec3(0, 0, 2), 9, -kUp);
  EXPECT_LT(hidden_samples(Probe(two), Vec3(0), kUp), .1f);
  expect_unbiased("two lamps", two);
}

TEST(Emission, RoomsWithEmissiveWallsUseRaysOnly) {
  SceneText scene;
  scene.material("wall", "\"reflectivity\" 0, \"diffuse\" .5 .5 .5, \"additional_color\" 1 1 1")
      .box("wall", Vec3(-1, -1, -1), Vec3(1, 1, 1), true);
  const Probe probe(scene);
  EXPECT_TRUE(probe.world().light_sampler->mesh_lights().empty());
}

}  // namespace glow_test
}  // namespace oriel::testing
