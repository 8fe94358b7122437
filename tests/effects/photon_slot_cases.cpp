// SPDX-License-Identifier: Apache-2.0
// Photon shaders in the slot `photon`: shaders/physics/dgs_material.cpp. Their effect on photons is
// tested by PhotonTrace.PhotonShaderReplacesTheSurface.
#include "cases.h"
#include "runtime/closure.h"
#include "runtime/material.h"

namespace oriel::effects {
namespace {

/// Scattering of light from 40 degrees, by the lobes of the surface and the medium inside.
struct Surface {
  std::vector<std::pair<LobeKind, Rgb>> levels;
  std::vector<float> numbers;  ///< widths, indices, directions, absorption
};

Surface surface_of(const std::string& material, bool by_photons) {
  SceneText scene;
  scene.statement("material \"m\" " + material + " end material")
      .square("m", Vec3(0), 1, Vec3(0, 0, 1));
  const Probe probe(scene.str(), known_shaders());
  ShadingPoint point;
  point.world = &probe.world();
  point.normal = point.geometric_normal = Vec3(0, 0, 1);
  point.ray_direction = normalize(Vec3(.8390996f, 0, -1));
  point.ray_origin = -point.ray_direction;
  point.dpdu = Vec3(0, 1, 0);
  point.dpdv = Vec3(-1, 0, 0);
  Closure closure;
  const Material& bound = probe.world().materials.front();
  by_photons ? shade_for_photons(bound, point, closure) : shade(bound, point, closure);
  Surface s;
  for (int i = 0; i < closure.count; ++i) {
    const Lobe& lobe = closure.lobes[i];
    s.levels.emplace_back(lobe.kind, lobe.weight);
    for (const float x : {lobe.alpha_x, lobe.alpha_y, lobe.eta, lobe.frame.s.x, lobe.frame.s.y,
                          lobe.frame.s.z, lobe.weight.x, lobe.weight.y, lobe.weight.z})
      s.numbers.push_back(x);
  }
  const Rgb& absorbed = closure.inside.absorption;
  s.numbers.insert(s.numbers.end(), {absorbed.x, absorbed.y, absorbed.z});
  return s;
}

/// Photons meet what the shader `surface` makes of the same parameters, whose own cases hold.
Case follows(const std::string& surface, const std::string& parameter, const std::string& others,
             const std::vector<std::string>& values) {
  const std::string shader = surface + "_photon";
  return shows(shader + "." + parameter, [=] {
    std::vector<Surface> met;
    for (const std::string& value : values) {
      const std::string list = others + ", " + parameter + " " + value;
      met.push_back(surface_of("\"mib_illum_lambert\" ( ) photon " + call_of(shader, list), true));
      const Surface wanted = surface_of(call_of(surface, list), false);
      EXPECT_EQ(met.back().levels, wanted.levels) << value;
      EXPECT_EQ(met.back().numbers, wanted.numbers) << value;
    }
    EXPECT_NE(met.front().numbers, met.back().numbers);
  });
}

/// A parameter of mib_photon_basic: the lobe and its level.
Case basic(const std::string& parameter, const std::string& others, LobeKind kind) {
  return shows("mib_photon_basic." + parameter, [=] {
    for (const auto& [value, level] : {std::pair(".5 .25 .125", Rgb(.5f, .25f, .125f)),
                                       std::pair(".1 .2 .4", Rgb(.1f, .2f, .4f))}) {
      const Surface met =
          surface_of("\"mib_illum_lambert\" ( ) photon " +
                         call_of("mib_photon_basic", others + ", " + parameter + " " + value),
                     true);
      EXPECT_EQ(met.levels, (std::vector<std::pair<LobeKind, Rgb>>{{kind, level}}));
    }
  });
}

}  // namespace

Cases photon_slot_cases() {
  Cases all;
  const std::string dgs = "glossy .3 .2 .1, shiny_u 20, shiny_v 60, transp .25, ior 1.4";
  for (const auto& [parameter, values] :
       {std::pair("diffuse", std::vector<std::string>{".1 .2 .3", ".4 .2 .1"}),
        std::pair("glossy", std::vector<std::string>{".1 .2 .3", ".4 .2 .1"}),
        std::pair("specular", std::vector<std::string>{".1 .2 .3", ".4 .2 .1"}),
        std::pair("shiny", std::vector<std::string>{"0", "10", "40"}),
        std::pair("shiny_u", std::vector<std::string>{"5", "50"}),
        std::pair("shiny_v", std::vector<std::string>{"5", "50"}),
        std::pair("transp", std::vector<std::string>{"0", ".5", "1"}),
        std::pair("ior", std::vector<std::string>{"1", "1.3", "1.6"})})
    all.push_back(follows("dgs_material", parameter, dgs, values));
  for (const auto& [parameter, values] :
       {std::pair("col", std::vector<std::string>{".9 .5 .2", "1 1 1"}),
        std::pair("ior", std::vector<std::string>{"1.3", "1.7"}),
        std::pair("ior_out", std::vector<std::string>{"1", "1.2"})})
    all.push_back(follows("dielectric_material", parameter, "col .8 .8 .8, ior 1.5", values));

  all.push_back(basic("diffuse", "", LobeKind::Diffuse));
  all.push_back(basic("specular", "", LobeKind::Mirror));
  all.push_back(both(basic("transp", "", LobeKind::ThinTransmission),
                     basic("transp", "ior_frac 1.5", LobeKind::ClearRefraction)));
  all.push_back(shows("mib_photon_basic.ior_frac", [] {
    for (const auto& [value, eta] : {std::pair("1.5", 1.5f), std::pair(".75", .75f)}) {
      const Surface met = surface_of(
          "\"mib_illum_lambert\" ( ) photon " +
              call_of("mib_photon_basic", std::string("transp 1 1 1, ior_frac ") + value),
          true);
      EXPECT_EQ(met.numbers.at(2), eta);
    }
  }));
  return all;
}

}  // namespace oriel::effects
