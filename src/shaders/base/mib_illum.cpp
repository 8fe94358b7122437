// SPDX-License-Identifier: Apache-2.0
#include "shaders/base/mib_illum.h"

#include <algorithm>

#include "runtime/bump.h"
#include "runtime/closure.h"

namespace oriel {
namespace {

struct Lambert {
  Rgba ambience, ambient, diffuse;
  int mode;
  ArrayView<LightRef> lights;
};
struct Phong {
  Rgba ambience, ambient, diffuse, specular;
  float exponent;
  int mode;
  ArrayView<LightRef> lights;
};

constexpr const char* kAmbience = "Ambient light of the scene.";
constexpr const char* kAmbient = "Colour that ambience is multiplied with.";
constexpr const char* kMode =
    "Which lights: 0 list or linked or all, 1 the list, 2 all but it, 4 linked or all.";

constexpr ParamSpec kLambertRows[] = {
    {ORIEL_PARAM(Lambert, ambience), .doc = kAmbience, .declared_default = false},
    {ORIEL_PARAM(Lambert, ambient), .doc = kAmbient, .declared_default = false},
    {ORIEL_PARAM(Lambert, diffuse), .doc = "Diffuse colour.", .declared_default = false},
    {ORIEL_PARAM(Lambert, mode), .doc = kMode, .declared_default = false},
    {ORIEL_PARAM(Lambert, lights), .doc = "The list.", .declared_default = false},
};
constexpr ParamSpec kPhongRows[] = {
    {ORIEL_PARAM(Phong, ambience), .doc = kAmbience, .declared_default = false},
    {ORIEL_PARAM(Phong, ambient), .doc = kAmbient, .declared_default = false},
    {ORIEL_PARAM(Phong, diffuse), .doc = "Diffuse colour.", .declared_default = false},
    {ORIEL_PARAM(Phong, specular), .doc = "Colour of the highlight.", .declared_default = false},
    {ORIEL_PARAM(Phong, exponent), .doc = "Narrowness of the highlight.",
     .declared_default = false},
    {ORIEL_PARAM(Phong, mode), .doc = kMode, .declared_default = false},
    {ORIEL_PARAM(Phong, lights), .doc = "The list.", .declared_default = false},
};

template <class P>
Frame shade_diffuse(const P& p, const ShadingPoint& point, Closure& closure) {
  const Frame frame(facing_viewer(point.normal, point));
  closure.emission += rgb(p.ambience) * rgb(p.ambient);
  closure.light_mode = p.mode;
  closure.lights = p.lights;
  closure.albedo = rgb(p.diffuse);
  if (!is_black(closure.albedo))
    closure.add(LobeKind::Diffuse, Channel::Diffuse, closure.albedo, frame);
  return frame;
}

}  // namespace

const ShaderSpec kMibIllumLambert = {
    .name = "mib_illum_lambert",
    .library = "base",
    .version = 2,
    .apply = kApplyMaterial,
    .doc = "A perfectly diffuse surface.",
    .params = kLambertRows,
    .params_size = sizeof(Lambert),
    .material = [](const Call& call,
                   Closure& closure) { shade_diffuse(call.as<Lambert>(), call.point, closure); },
};

const ShaderSpec kMibIllumPhong = {
    .name = "mib_illum_phong",
    .library = "base",
    .version = 2,
    .apply = kApplyMaterial,
    .doc = "A diffuse surface with Phong's highlight of light sources.",
    .params = kPhongRows,
    .params_size = sizeof(Phong),
    .material =
        [](const Call& call, Closure& closure) {
          const auto& p = call.as<Phong>();
          const Frame frame = shade_diffuse(p, call.point, closure);
          const Rgb specular = rgb(p.specular);
          if (is_black(specular)) return;
          Lobe& lobe = closure.add(LobeKind::PhongHighlight, Channel::Reflection, specular, frame);
          lobe.roughness = std::max(0.0f, p.exponent);
          lobe.controls.highlights_only = true;
        },
};

}  // namespace oriel
