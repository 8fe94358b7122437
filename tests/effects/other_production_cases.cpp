// SPDX-License-Identifier: Apache-2.0
// Approximations of shaders of the production library: shaders/maya/production.cpp.
#include "cases.h"
#include "other_stages.h"
#include "runtime/color_mapping.h"
#include "transport/photon/photon_trace.h"

namespace oriel::effects {
namespace other_production {
namespace {

using namespace other_stages;

/// As a lens of the camera, of that colour.
Stage mapped(const Rgb& color) {
  return [=](const std::string& call) {
    SceneText scene;
    scene.camera("focal 1 aperture 1 aspect 1 resolution 32 32 lens " + call);
    const Probe probe(scene.str());
    Measured m;
    m.mean = map_color(probe.world().lens, probe.world(), Vec2(16), color);
    return m;
  };
}

void add_gamma_gain(Cases& all) {
  const std::string name = "mip_gamma_gain.";
  const Rgb color(.25f, .04f, .01f), root(.5f, .2f, .1f);
  const std::string input = "input .25 .04 .01 1";
  all.push_back(gives(name + "input", value(kTint), "gamma .5",
                      {{"1 .5 .25 1", Rgb(1, .25f, .0625f)},
                       {"2 0 1 1", Rgb(4, 0, 1)},
                       {"= \"tint\"", kTinted * kTinted}}));
  // As a shader of a colour, and as a lens of the picture.
  const auto add = [&](const char* parameter, const std::string& others,
                       const std::vector<Given>& values) {
    all.push_back(both(gives(name + parameter, value(), input + ", " + others, values),
                       gives(name + parameter, mapped(color), others, values)));
  };
  add("gamma", "", {{"1", color}, {"2", root}, {".5", color * color}});
  add("gain", "gamma 2", {{"1", root}, {"4", root * 2.f}, {"0", Rgb(0)}});
  add("reverse", "gamma 2, gain 4", {{"off", root * 2.f}, {"on", color * color / 4.f}});
}

/// A floor under a sun, in the shadow of a square or not; behind it light of .5.
Stage catching(bool shadowed) {
  return composed([=](SceneText& scene, const std::string& call) {
    add_material(scene, call);
    scene.square("m", Vec3(0), 10, kUp).uniform_sky(.5f).lambert("blocker", 0);
    if (shadowed) scene.square("blocker", Vec3(0, 0, 4), 4, -kUp);
    sun_above(scene);
  });
}

/// Its alpha.
Stage alpha_of(const Stage& stage) {
  return [=](const std::string& call) {
    Measured m = stage(call);
    m.mean = Rgb(m.alpha);
    m.error = Rgb(0);
    return m;
  };
}

void add_matte(Cases& all, const std::string& shader) {
  const std::string name = shader + ".";
  const Rgb background(.8f, .6f, .4f), shadows(.1f, .2f, .3f);
  const std::string ground = "background .8 .6 .4 1, ", dark = "shadows .1 .2 .3 1, ";
  const Stage lit = catching(false), dim = catching(true);
  all.push_back(
      both(gives(name + "background", lit, dark,
                 {{".8 .6 .4 1", background}, {"1 0 2 1", Rgb(1, 0, 2)}, {"= \"tint\"", kTinted}}),
           gives(name + "background", dim, dark, {{".8 .6 .4 1", shadows}, {"1 0 2 1", shadows}})));
  all.back() = both(all.back(), gives(name + "background", alpha_of(lit), "",
                                      {{"1 1 1 1", Rgb(1)}, {"1 1 1 .25", Rgb(.25f)}}));
  all.push_back(both(
      gives(name + "shadows", dim, ground,
            {{"0 0 0 1", Rgb(0)}, {".1 .2 .3 1", shadows}, {"= \"tint\"", kTinted}}),
      gives(name + "shadows", lit, ground, {{"0 0 0 1", background}, {".1 .2 .3 1", background}})));
  all.back() = both(all.back(), gives(name + "shadows", alpha_of(dim), "",
                                      {{"1 1 1 1", Rgb(1)}, {"1 1 1 .25", Rgb(.25f)}}));
  all.push_back(
      gives(name + "catch_shadows", dim, ground + dark, {{"on", shadows}, {"off", background}}));
  all.push_back(gives(name + "ambient", dim, ground + dark,
                      {{"0 0 0 1", shadows},
                       {".25 .5 1 1", Rgb(.25f * .8f + .75f * .1f, .4f, .4f)},
                       {"1 1 1 1", background}}));
  all.push_back(gives(
      name + "opacity",
      composed(
          [](SceneText& scene, const std::string& call) {
            add_material(scene, call);
            scene.square("m", Vec3(0), 10, kUp).uniform_sky(.5f);
          },
          {.samples = 4096}),
      ground, {{"1", background}, {".25", background * .25f + Rgb(.5f * .75f)}, {"0", Rgb(.5f)}}));
}

/// Two colours for the rays in question; all others see a third.
const std::string kOthers = [] {
  std::string list;
  for (const char* ray : {"eye", "transparent", "reflection", "refraction", "finalgather",
                          "environment", "shadow", "photon", "default"})
    list += std::string(ray) + " 9 9 9 1, ";
  return list;
}();
const std::vector<Given> kColors = {{".2 .4 .6 1", Rgb(.2f, .4f, .6f)}, {"1 0 2 1", Rgb(1, 0, 2)}};

/// What dgs_material of those parameters mirrors (of a square above the camera) or lets through (of
/// one below it).
Stage past(const std::string& surface, float height) {
  return composed([=](SceneText& scene, const std::string& call) {
    add_material(scene, call);
    scene.statement("material \"first\" \"dgs_material\" ( \"specular\" 1 1 1" + surface +
                    " ) end material");
    scene.square("first", Vec3(0), 5, kUp).square("m", Vec3(0, 0, height), 5, kUp);
  });
}

/// Blockers and floors with known transmittance or scattering.
const std::string kShares =
    "shader \"clear\" \"max_StandardMaterial\" ( \"Opacity\" 0 )\n"
    "shader \"quarter\" \"max_StandardMaterial\" ( \"Opacity\" .75 )\n"
    "shader \"opaque\" \"max_StandardMaterial\" ( )\n"
    "shader \"white\" \"mib_illum_lambert\" ( \"diffuse\" 1 1 1 )\n"
    "shader \"grey\" \"mib_illum_lambert\" ( \"diffuse\" .25 .25 .25 )\n";

/// Share of the photons' power that leaves a floor on which all of them fall.
Measured scattered_photons(const std::string& call) {
  SceneText scene;
  add_material(scene, call, kShares);
  scene.plate("m");
  scene.light("spot",
              "\"physical_light\" ( \"color\" 9 9 9, \"cone\" .95 ) origin 0 0 1 "
              "direction 0 0 -1 spread .9");
  constexpr int kPhotons = 20000;
  PhotonSettings settings;
  settings.each.global.emit = kPhotons;
  PhotonBalance balance;
  RayCounts counts;
  trace_photons(Probe(scene.str()).world(), settings, counts, &balance);
  const auto share = static_cast<float>(balance.escaped.y / balance.emitted.y);
  Measured m;
  m.mean = Rgb(share);
  m.error = Rgb(std::sqrt(share * (1 - std::min(share, 1.0f)) / kPhotons));
  return m;
}

void add_ray_switch(Cases& all) {
  const std::string name = "mip_rayswitch.";
  all.push_back(both(gives(name + "eye", value(), kOthers, kColors),
                     gives(name + "eye", square_in([](SceneText&) {}), kOthers, kColors)));
  all.push_back(gives(name + "transparent", past(", \"transp\" 1", -1), kOthers, kColors));
  all.push_back(gives(name + "reflection", past("", 2), kOthers, kColors));
  all.push_back(
      gives(name + "refraction", past(", \"transp\" 1, \"ior\" 1.5", -1), kOthers, kColors));
  // A white floor in a sphere that emits for diffuse bounces.
  all.push_back(gives(name + "finalgather",
                      composed(
                          [](SceneText& scene, const std::string& call) {
                            add_material(scene, call);
                            scene.lambert("white", 1).square("white", Vec3(0), 1, kUp);
                            scene.sphere("m", Vec3(0), 4, 8, true);
                          },
                          {.samples = 64}),
                      kOthers, kColors));
  // A mirror beyond the trace depth looks up the environment.
  all.push_back(gives(
      name + "environment",
      [](const std::string& call) {
        SceneText scene("trace depth 0 0 0");
        scene.statement("material \"mirror\" \"dgs_material\" ( \"specular\" 1 1 1 ) end material");
        scene.square("mirror", Vec3(0), 5, kUp).environment(call);
        return Probe(scene.str()).onto(Vec3(0), kUp, 0, 64);
      },
      kOthers, kColors));
  all.push_back(
      gives(name + "shadow",
            composed(
                [](SceneText& scene, const std::string& call) {
                  add_material(scene, call, kShares);
                  scene.lambert("floor", 1).square("floor", Vec3(0), 5, kUp);
                  scene.square("m", Vec3(0, 0, 1), 5, kUp);
                  sun_above(scene);
                },
                {.indirect = false}),
            "eye = \"clear\", default = \"clear\"",
            {{"= \"clear\"", Rgb(1)}, {"= \"quarter\"", Rgb(.25f)}, {"= \"opaque\"", Rgb(0)}}));
  all.push_back(gives(name + "photon", scattered_photons, "eye = \"white\", default = \"white\"",
                      {{"= \"white\"", Rgb(1)}, {"= \"grey\"", Rgb(.25f)}}));
  // Light shaders are called for no ray type in that list.
  all.push_back(gives(name + "default",
                      composed(
                          [](SceneText& scene, const std::string& call) {
                            scene.statement("shader \"s\" " + call).lambert("white", 1);
                            scene.square("white", Vec3(0), 5, kUp);
                            scene.light("l",
                                        "\"mib_light_point\" ( \"color\" = \"s\" ) origin 0 0 2");
                          },
                          {.indirect = false}),
                      kOthers, kColors));
}

Cases cases() {
  Cases all;
  add_gamma_gain(all);
  add_matte(all, "mip_matteshadow");
  add_matte(all, "mip_matteshadow_mtl");
  add_ray_switch(all);
  return all;
}

}  // namespace
}  // namespace other_production

Cases other_production_cases() { return other_production::cases(); }

}  // namespace oriel::effects
