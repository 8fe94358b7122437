// SPDX-License-Identifier: Apache-2.0
// Ray types with which each shader of a scene is called.
#include <atomic>
#include <initializer_list>

#include "runtime/color_mapping.h"
#include "support/probe.h"
#include "transport/photon/photon_trace.h"

namespace oriel::testing {
namespace ray_kinds_test {

/// "test_kind": writes down by which kinds it is asked, apart by `slot`, and returns its colour; in
/// any place that a shader may stand in. Black to other kinds than `only`, where that is one.
struct TestKind {
  int slot, only;
  Rgba color;
};
constexpr ParamSpec kTestKindRows[] = {
    {ORIEL_PARAM(TestKind, slot)},
    {ORIEL_PARAM(TestKind, only), .fallback = {-1}},
    {ORIEL_PARAM(TestKind, color), .fallback = {1, 1, 1, 1}},
};
constexpr int kSlots = 4;
std::atomic<unsigned> asked[kSlots];

constexpr unsigned bit(RayKind kind) { return 1u << static_cast<unsigned>(kind); }
Rgba note(const Call& call) {
  const auto& p = call.as<TestKind>();
  asked[p.slot] |= bit(call.point.ray_kind);
  if (p.only >= 0 && p.only != static_cast<int>(call.point.ray_kind)) return Rgba(0, 0, 0, 1);
  // Environments that depend on the pixel are not tabulated.
  return call.point.environment ? p.color * (1 + 1e-6f * call.point.raster.x) : p.color;
}
constexpr ShaderSpec kTestKind = {
    .name = "test_kind",
    .library = "test",
    .apply = kApplyTexture | kApplyLight | kApplyEmitter | kApplyShadow | kApplyVolume,
    .params = kTestKindRows,
    .params_size = sizeof(TestKind),
    .value = [](const Call& call, void* result) { *static_cast<Rgba*>(result) = note(call); },
    .material = {
        .shadow = [](const Call& call, const Rgb& light) { return light * rgb(note(call)); },
        .may_transmit = [](const ShaderNode&) { return true; }},
    .light = {.evaluate = [](const Call& call,
                             const LightCall&) { return LightValue{rgb(note(call))}; }},
    .lens = {.map_color = [](const Call& call, const LensCall&,
                             const Rgb& c) { return c * rgb(note(call)); }},
    .volume = {
        .evaluate =
            [](const Call& call) {
              return VolumeValue{rgb(note(call)), Rgb(0)};
            },
        .dims_light = [](const ShaderNode&) { return true; },
    },
};

const Registry& registry() {
  static const Registry all = test_registry_with({&kTestKind});
  return all;
}

/// A prepared scene before any shader call.
Probe kind_probe_of(const SceneText& scene) {
  Probe probe(scene.str(), registry());
  for (auto& kinds : asked) kinds = 0;
  return probe;
}

::testing::AssertionResult was_asked_by(int slot, std::initializer_list<RayKind> kinds) {
  unsigned wanted = 0;
  for (const RayKind kind : kinds) wanted |= bit(kind);
  if (asked[slot] == wanted) return ::testing::AssertionSuccess();
  auto failure = ::testing::AssertionFailure() << "slot " << slot << " was asked by kinds";
  for (unsigned i = 0; i < 32; ++i)
    if (asked[slot] & (1u << i)) failure << ' ' << i;
  return failure;
}

/// A black surface "seen" with the probe shader of that slot as its emission.
SceneText with_target(int slot = 0, const char* options = "trace depth 8 8 12 shadow segments") {
  SceneText scene(options);
  return scene.statement(fmt::format("shader \"kind{0}\" \"test_kind\" ( \"slot\" {0} )", slot))
      .material("seen", fmt::format("\"reflectivity\" 0, \"diffuse\" 0 0 0, "
                                    "\"additional_color\" = \"kind{}\"",
                                    slot));
}
const char* const kMirror =
    "\"diffuse_weight\" 0, \"reflectivity\" 1, \"refl_gloss\" 1, \"brdf_fresnel\" off, "
    "\"brdf_0_degree_refl\" 1, \"brdf_90_degree_refl\" 1";
const char* const kPane =
    "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"thin_walled\" on";
const char* const kGlass =
    "\"diffuse_weight\" 0, \"reflectivity\" 0, \"transparency\" 1, \"refr_ior\" 1.5";

/// The target is above the plate that the eye looks at, or below it.
Measured seen_by(const char* plate, float height) {
  SceneText scene = with_target();
  scene.material("plate", plate)
      .square("plate", Vec3(0), 2, kUp)
      .square("seen", Vec3(0, 0, height), 50, height > 0 ? -kUp : kUp);
  return kind_probe_of(scene).onto(Vec3(0), kUp, 20, 256);
}

// acceptance: H5
TEST(RayKinds, AreNumberedAsMiRayType) {
  const RayKind kinds[] = {RayKind::Eye,
                           RayKind::Transparent,
                           RayKind::Reflect,
                           RayKind::Refract,
                           RayKind::Light,
                           RayKind::Shadow,
                           RayKind::Environment,
                           RayKind::None,
                           RayKind::PhotonAbsorb,
                           RayKind::PhotonLight,
                           RayKind::PhotonReflectSpecular,
                           RayKind::PhotonReflectGlossy,
                           RayKind::PhotonReflectDiffuse,
                           RayKind::PhotonTransmitSpecular,
                           RayKind::PhotonTransmitGlossy,
                           RayKind::PhotonTransmitDiffuse,
                           RayKind::Displace,
                           RayKind::Output,
                           RayKind::PhotonScatterVolume,
                           RayKind::PhotonTransparent,
                           RayKind::FinalGather,
                           RayKind::LightMapVertex,
                           RayKind::LightMapMesh,
                           RayKind::PhotonEmitGlobillum,
                           RayKind::PhotonEmitCaustic,
                           RayKind::Probe,
                           RayKind::Hull,
                           RayKind::PhotonHull};
  for (int i = 0; i < 28; ++i) {
    EXPECT_EQ(static_cast<int>(kinds[i]), i);
    const bool secondary = (i >= 1 && i <= 7) || i == 20 || i == 26;
    EXPECT_EQ(is_secondary(kinds[i]), secondary) << i;
    const bool photon = (i >= 8 && i <= 15) || i == 18 || i == 19 || i == 23 || i == 24 || i == 27;
    EXPECT_EQ(is_photon(kinds[i]), photon) << i;
  }
}

// acceptance: H5
TEST(RayKinds, SurfacesDistinguishRayTypes) {
  const SceneText direct = with_target().square("seen", Vec3(0), 2, kUp);
  expect_exact("eye", kind_probe_of(direct).onto(Vec3(0), kUp, 20, 64), 1.0f);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Eye}));
  expect_exact("mirror", seen_by(kMirror, 1), 1.0f, .01f);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Reflect}));
  expect_exact("pane", seen_by(kPane, -1), 1.0f, .01f);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Transparent}));
  EXPECT_GT(seen_by(kGlass, -1).mean.x, .8f);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Refract}));
  EXPECT_GT(seen_by("\"reflectivity\" 0, \"diffuse\" .5 .5 .5", 1).mean.x, .4f);
  EXPECT_TRUE(was_asked_by(0, {RayKind::FinalGather}));
}

// acceptance: H5
TEST(RayKinds, ShadersMayShowEachKindAnotherColour) {
  for (const RayKind shown : {RayKind::Eye, RayKind::Reflect, RayKind::Transparent})
    for (const RayKind seen : {RayKind::Eye, RayKind::Reflect, RayKind::Transparent}) {
      SceneText scene;
      scene
          .statement(fmt::format("shader \"kind0\" \"test_kind\" ( \"only\" {} )",
                                 static_cast<int>(shown)))
          .material("seen",
                    "\"reflectivity\" 0, \"diffuse\" 0 0 0, "
                    "\"additional_color\" = \"kind0\"")
          .material("plate", seen == RayKind::Reflect ? kMirror : kPane)
          .square("seen", Vec3(0, 0, seen == RayKind::Reflect ? 1 : -1), 50, kUp);
      if (seen != RayKind::Eye) scene.square("plate", Vec3(0), 2, kUp);
      expect_exact("seen", kind_probe_of(scene).onto(Vec3(0), kUp, 20, 256), seen == shown ? 1 : 0,
                   .01f);
    }
}

// acceptance: H5
TEST(RayKinds, LightsAreCalledForLightOrVisibility) {
  const auto lit = [](const char* flags, const char* plate) {
    SceneText scene;
    scene.material("plate", plate)
        .square("plate", Vec3(0), 2, kUp)
        .light("lamp", fmt::format("\"test_kind\" ( ) origin 0 0 1 direction 0 0 -1 "
                                   "rectangle 20 0 0 0 20 0 {}",
                                   flags));
    return kind_probe_of(scene);
  };
  const char* const lambert = "\"reflectivity\" 0, \"diffuse\" .5 .5 .5";
  EXPECT_GT(lit("", lambert).direct_only().onto(Vec3(0), kUp, 20, 256).mean.x, 0);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Light}));
  // Rays of a diffuse lobe find samples of it.
  lit("", lambert).onto(Vec3(0), kUp, 20, 256);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Light}));
  EXPECT_GT(lit("visible", lambert).ray(Vec3(0, 0, .5f), kUp, 64).mean.x, 0);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Eye}));
  EXPECT_GT(lit("visible", kMirror).onto(Vec3(0), kUp, 20, 64).mean.x, 0);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Reflect}));
  EXPECT_GT(lit("visible", kPane).onto(Vec3(0), -kUp, 20, 64).mean.x, 0);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Transparent}));
}

// acceptance: H5
TEST(RayKinds, BlockersAreCalledForShadowRays) {
  SceneText scene = with_target(1);
  scene.statement("shader \"kind2\" \"test_kind\" ( \"slot\" 2 )")
      .statement(
          "shader \"gel\" \"mia_material_x\" ( \"reflectivity\" 0, \"diffuse_weight\" 0, "
          "\"transparency\" 1, \"thin_walled\" on, \"refr_color\" = \"kind2\" )")
      .statement(
          "material \"filter\" \"mia_material_x\" ( \"reflectivity\" 0, \"diffuse\" 0 0 0, "
          "\"additional_color\" = \"kind1\" ) shadow \"test_kind\" ( ) = \"gel\" "
          "end material")
      .lambert("plate", .5f)
      .square("plate", Vec3(0), 2, kUp)
      .square("filter", Vec3(0, 0, 1), 50, kUp)
      .light("sun", "\"mib_light_infinite\" ( \"color\" 1 1 1, \"shadow\" on ) direction 0 0 -1");
  EXPECT_GT(kind_probe_of(scene).direct_only().onto(Vec3(0), kUp, 20, 64).mean.x, .4f);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Shadow}));
  EXPECT_TRUE(was_asked_by(2, {RayKind::Shadow}));
  // Diffuse rays see the surface, and pass it as shadow rays do.
  kind_probe_of(scene).onto(Vec3(0), kUp, 20, 256);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Shadow}));
  EXPECT_TRUE(was_asked_by(2, {RayKind::Shadow}));
  EXPECT_EQ(asked[1] & ~(bit(RayKind::FinalGather) | bit(RayKind::Shadow)), 0u);
}

// acceptance: H5
TEST(RayKinds, EnvironmentsAreCalledByRaysThatMiss) {
  const auto seen = [](const char* plate, const char* options = "trace depth 8 8 12",
                       float noise = .01f) {
    SceneText scene(options);
    scene.material("plate", plate)
        .square("plate", Vec3(0), 2, kUp)
        .environment("\"test_kind\" ( )");
    const Probe probe = kind_probe_of(scene);
    expect_exact(plate, probe.onto(Vec3(0), kUp, 20, 256), 1.0f, noise);
  };
  const Probe nothing = kind_probe_of(SceneText().environment("\"test_kind\" ( )"));
  nothing.ray(Vec3(0), kUp, 64);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Eye}));
  seen(kMirror);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Reflect}));
  seen(kPane);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Transparent}));
  seen("\"reflectivity\" 0, \"diffuse_weight\" 1, \"diffuse\" 1 1 1", "trace depth 8 8 12", .1f);
  EXPECT_TRUE(was_asked_by(0, {RayKind::FinalGather}));
  // No ray is traced where the depth is reached.
  seen(kMirror, "trace depth 0 8 8");
  EXPECT_TRUE(was_asked_by(0, {RayKind::Environment}));
}

// acceptance: H5
TEST(RayKinds, LensesVolumesAndOutputsHaveTheirRayTypes) {
  SceneText scene;
  scene.emitter("glow", 1)
      .square("glow", Vec3(0, 0, -1), 5, kUp)
      .camera(
          "focal 1 aperture 1 aspect 1 resolution 8 8 lens \"test_kind\" ( ) "
          "volume \"test_kind\" ( \"slot\" 1, \"color\" .5 .5 .5 )");
  const Probe probe = kind_probe_of(scene);
  expect_exact("volume", probe.ray(Vec3(0), -kUp, 64), .5f);
  EXPECT_TRUE(was_asked_by(1, {RayKind::Eye}));
  const World& world = probe.world();
  map_color(world.lens, world, Vec2(4, 4), Rgb(1));
  EXPECT_TRUE(was_asked_by(0, {RayKind::Eye}));
  asked[0] = 0;
  map_output(world.lens, world, Vec2(4, 4), Rgb(1), Rgb(1));
  EXPECT_TRUE(was_asked_by(0, {RayKind::Output}));
}

// acceptance: H5
TEST(RayKinds, DisplacementsHaveTheirRayType) {
  for (auto& kinds : asked) kinds = 0;
  SceneText scene;
  scene
      .statement(
          "material \"m\" \"mib_illum_lambert\" ( ) displace \"test_kind\" ( \"slot\" 3, "
          "\"color\" .1 .1 .1 ) end material")
      .square("m", Vec3(0), 1, kUp);
  const Probe probe(scene.str(), registry());
  EXPECT_TRUE(was_asked_by(3, {RayKind::Displace}));
}

// acceptance: H5
TEST(RayKinds, CutOutsAreProbed) {
  SceneText scene;
  scene.statement("shader \"hole\" \"test_kind\" ( \"color\" 0 0 0 )")
      .statement(
          "shader \"open\" \"mib_amb_occlusion\" ( \"samples\" 4, \"spread\" .2, "
          "\"bright\" 1 1 1 )")
      .material("leaf", "\"cutout_opacity\" = \"hole\"")
      .material("plate", "\"reflectivity\" 0, \"diffuse\" 0 0 0, \"additional_color\" = \"open\"")
      .square("plate", Vec3(0), 2, kUp)
      .square("leaf", Vec3(0, 0, 1), 5, -kUp);
  expect_exact("open", kind_probe_of(scene).direct_only().onto(Vec3(0), kUp, 20, 64), 1.0f);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Probe}));
}

/// Sends photons of a spot down onto a plate in a room of the target.
PhotonMaps photons_on(const char* plate, bool caustics, const char* emitter = "") {
  SceneText scene = with_target(0, "trace depth 8 8 12 shadow segments caustic on");
  scene.method("scene")
      .material("plate", plate)
      .square("plate", Vec3(0), 2, kUp)
      .box("seen", Vec3(-3), Vec3(3), true)
      .light("spot", fmt::format("\"test_kind\" ( \"slot\" 1 ) {} origin 0 0 1 direction 0 0 -1 "
                                 "spread .9",
                                 emitter));
  const Probe probe = kind_probe_of(scene);
  PhotonSettings settings;
  settings.globillum = !caustics;
  settings.caustics = caustics;
  settings.each.global.emit = settings.each.caustic.emit = 2048;
  RayCounts counts;
  return trace_photons(probe.world(), settings, counts);
}

// acceptance: H5
TEST(RayKinds, PhotonsAreOfTheirLastScattering) {
  const std::string glass = std::string(kGlass) + ", \"do_refractive_caustics\" on";
  const std::string pane = std::string(kPane) + ", \"do_refractive_caustics\" on";
  const struct {
    std::string plate;
    RayKind kind;
  } kCases[] = {
      {"\"cutout_opacity\" 0", RayKind::PhotonTransparent},
      {kPane, RayKind::PhotonTransparent},
      {kMirror, RayKind::PhotonReflectSpecular},
      {std::string(kMirror) + ", \"refl_gloss\" .5", RayKind::PhotonReflectGlossy},
      {"\"reflectivity\" 0, \"diffuse\" 1 1 1, \"diffuse_weight\" 1",
       RayKind::PhotonReflectDiffuse},
      {pane, RayKind::PhotonTransmitSpecular},
      {glass, RayKind::PhotonTransmitSpecular},
      {pane + ", \"refr_gloss\" .5", RayKind::PhotonTransmitGlossy},
      {"\"reflectivity\" 0, \"diffuse_weight\" 0, \"transparency\" 1, \"refr_translucency\" on, "
       "\"refr_trans_weight\" 1, \"thin_walled\" on, \"refr_trans_color\" 1 1 1",
       RayKind::PhotonTransmitDiffuse},
  };
  for (const auto& c : kCases) {
    photons_on(c.plate.c_str(), false);
    EXPECT_TRUE(was_asked_by(0, {c.kind})) << c.plate;
  }
  // Straight from the light onto the target.
  SceneText scene = with_target();
  scene.box("seen", Vec3(-3), Vec3(3), true).light("lamp", "\"test_kind\" ( \"slot\" 1 )");
  const Probe probe = kind_probe_of(scene);
  PhotonSettings settings;
  settings.each.global.emit = 2048;
  RayCounts counts;
  trace_photons(probe.world(), settings, counts);
  EXPECT_TRUE(was_asked_by(0, {RayKind::PhotonLight}));
}

// acceptance: H5
TEST(RayKinds, VolumesAreCalledForLightAndPhotons) {
  const char* const camera = "focal 1 aperture 1 aspect 1 resolution 8 8 volume ";
  SceneText lit;
  lit.lambert("plate", .5f)
      .square("plate", Vec3(0), 2, kUp)
      .light("lamp", "\"mib_light_point\" ( \"color\" 1 1 1 ) origin 0 0 1")
      .camera(std::string(camera) + "\"test_kind\" ( )");
  kind_probe_of(lit).direct_only().onto(Vec3(0), kUp, 20, 64);
  EXPECT_TRUE(was_asked_by(0, {RayKind::Eye, RayKind::Light}));

  SceneText scene = with_target();
  scene.box("seen", Vec3(-3), Vec3(3), true)
      .light("lamp", "\"mib_light_point\" ( \"color\" 1 1 1 )")
      .camera(std::string(camera) + "\"parti_volume\" ( \"extinction\" .3, \"scatter\" 1 1 1 )");
  const Probe probe = kind_probe_of(scene);
  PhotonSettings settings;
  settings.each.global.emit = 2048;
  RayCounts counts;
  trace_photons(probe.world(), settings, counts);
  EXPECT_TRUE(was_asked_by(0, {RayKind::PhotonLight, RayKind::PhotonScatterVolume}));
}

// acceptance: H5
TEST(RayKinds, EmittersGetTheMapType) {
  const char* const emitter = "emitter \"test_kind\" ( \"slot\" 2, \"color\" 3 3 3 )";
  photons_on(kMirror, false, emitter);
  EXPECT_TRUE(was_asked_by(2, {RayKind::PhotonEmitGlobillum}));
  photons_on(kMirror, true, emitter);
  EXPECT_TRUE(was_asked_by(2, {RayKind::PhotonEmitCaustic}));
  EXPECT_TRUE(was_asked_by(1, {}));
  // Without an emitter, photons carry the direct light of the light shader.
  photons_on(kMirror, true);
  EXPECT_TRUE(was_asked_by(1, {RayKind::Light}));
}

}  // namespace ray_kinds_test
}  // namespace oriel::testing
