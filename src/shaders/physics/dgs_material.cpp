// SPDX-License-Identifier: Apache-2.0
#include "shaders/physics/dgs_material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "base/math.h"
#include "bsdf/fresnel.h"
#include "bsdf/gloss.h"
#include "runtime/bump.h"
#include "runtime/closure.h"
#include "runtime/shader_node.h"

namespace oriel {
namespace {

struct Dgs {
  Rgba diffuse, glossy, specular;
  float shiny, shiny_u, shiny_v;
  float transp, ior;
  ArrayView<LightRef> lights;
  int mode;
};
struct DielectricMaterial {
  Rgba col;
  float ior;
  Rgba col_out;
  float ior_out;
  bool ignore_normals;
  float phong_coef;
  ArrayView<LightRef> lights;
  int mode;
};
struct PhotonBasic {
  Rgba diffuse, specular, transp;
  float ior_frac;
};

constexpr const char* kMode =
    "Light selection: 0 list or linked or all, 1 the list, 2 all but the list, 4 "
    "linked or all.";

constexpr ParamSpec kDgsRows[] = {
    {ORIEL_PARAM(Dgs, diffuse), .doc = "Diffuse colour.", .declared_default = false},
    {ORIEL_PARAM(Dgs, glossy), .doc = "Colour of the glossy reflection.",
     .declared_default = false},
    {ORIEL_PARAM(Dgs, specular), .doc = "Reflection colour.", .declared_default = false},
    {ORIEL_PARAM(Dgs, shiny), .min = 0,
     .doc = "Exponent of the glossy reflection, like Phong's; 0 = shiny_u and shiny_v.",
     .support = Support::Approximated, .declared_default = false},
    {ORIEL_PARAM(Dgs, shiny_u), .min = 0, .doc = "Exponent along the u derivative of the surface.",
     .support = Support::Approximated, .declared_default = false},
    {ORIEL_PARAM(Dgs, shiny_v), .min = 0, .doc = "Exponent perpendicular to that.",
     .support = Support::Approximated, .declared_default = false},
    {ORIEL_PARAM(Dgs, transp), .min = 0, .max = 1,
     .doc = "Fraction of all three components that is transmitted.", .declared_default = false},
    {ORIEL_PARAM(Dgs, ior), .min = 0, .doc = "Index of refraction; 0 = 1.",
     .declared_default = false},
    {ORIEL_PARAM(Dgs, lights), .doc = "Light list.", .declared_default = false},
    {ORIEL_PARAM(Dgs, mode), .doc = kMode, .declared_default = false},
};
constexpr ParamSpec kDielectricMaterialRows[] = {
    {ORIEL_PARAM(DielectricMaterial, col), .unit = "per scene unit",
     .doc = "Transmittance per unit length inside.", .declared_default = false},
    {ORIEL_PARAM(DielectricMaterial, ior), .min = 0, .doc = "Index of refraction inside; 0 = 1.",
     .declared_default = false},
    {ORIEL_PARAM(DielectricMaterial, col_out), .unit = "per scene unit",
     .doc = "Transmittance per unit length outside; ignored, the surface that encloses the "
            "outside defines it.",
     .support = Support::Ignored, .declared_default = false},
    {ORIEL_PARAM(DielectricMaterial, ior_out), .min = 0,
     .doc = "Index of refraction outside; 0 = 1.", .declared_default = false},
    {ORIEL_PARAM(DielectricMaterial, ignore_normals),
     .doc = "Whether ray depth decides between inside and outside; ignored, the normal "
            "decides.",
     .support = Support::Ignored, .declared_default = false},
    {ORIEL_PARAM(DielectricMaterial, phong_coef), .min = 0,
     .doc = "Exponent of highlights of lights; 0 = none.", .support = Support::Approximated,
     .declared_default = false},
    {ORIEL_PARAM(DielectricMaterial, lights), .doc = "Light list.", .declared_default = false},
    {ORIEL_PARAM(DielectricMaterial, mode), .doc = kMode, .declared_default = false},
};
/// The rows of a photon shader; parameters that do not affect photons are ignored.
template <std::size_t N>
constexpr std::array<ParamSpec, N> photon_rows(const ParamSpec (&rows)[N]) {
  auto all = std::to_array(rows);
  for (ParamSpec& row : all)
    if (const std::string_view name = row.name;
        name == "lights" || name == "mode" || name == "phong_coef")
      row.support = Support::Ignored;
  return all;
}
constexpr auto kDgsPhotonRows = photon_rows(kDgsRows);
constexpr auto kDielectricMaterialPhotonRows = photon_rows(kDielectricMaterialRows);
constexpr ParamSpec kPhotonBasicRows[] = {
    {ORIEL_PARAM(PhotonBasic, diffuse), .doc = "Fraction scattered diffusely.",
     .declared_default = false},
    {ORIEL_PARAM(PhotonBasic, specular), .doc = "Fraction reflected specularly.",
     .declared_default = false},
    {ORIEL_PARAM(PhotonBasic, transp), .doc = "Fraction transmitted specularly.",
     .declared_default = false},
    {ORIEL_PARAM(PhotonBasic, ior_frac), .min = 0,
     .doc = "Ratio of indices of refraction, entered side over left side; 0 = 1.",
     .declared_default = false},
};

float index_or_one(float index) { return index > 0 ? index : 1; }

/// Index of the far side divided by that of the viewer's side, for a solid of index `inside` in
/// `outside`; clamped, because refracted directions degenerate beyond.
float ratio(const ShadingPoint& point, float inside, float outside = 1) {
  const float eta = index_or_one(inside) / index_or_one(outside);
  return clamp(point.back_side ? 1 / eta : eta, 0.1f, 10);
}

float roughness_of(float shiny) { return std::sqrt(2 / (4 * std::max(0.0f, shiny) + 2)); }

void add(LobeKind kind, LobeType type, const Rgb& level, const Frame& frame, Closure& closure) {
  if (is_black(level)) return;
  closure.add(kind, type, level, frame);
  closure.albedo += level;
}

void add_glossy(const Dgs& p, const ShadingPoint& point, const Vec3& normal, const Rgb& level,
                LobeKind kind, Closure& closure) {
  if (is_black(level)) return;
  const bool even = p.shiny != 0;
  Lobe& lobe = closure.add(
      kind, kind == LobeKind::GlossyReflection ? LobeType::Reflection : LobeType::Refraction, level,
      even ? Frame(normal) : Frame::along(normal, point.dpdu));
  const bsdf::Roughness roughness = bsdf::limited_roughness(
      roughness_of(even ? p.shiny : p.shiny_u), roughness_of(even ? p.shiny : p.shiny_v));
  lobe.alpha_x = roughness.ax;
  lobe.alpha_y = roughness.ay;
  closure.albedo += level;
}

void dgs(const Call& call, Closure& closure) {
  const auto& p = call.as<Dgs>();
  const ShadingPoint& point = call.point;
  closure.light_mode = p.mode;
  closure.lights = p.lights;
  const Vec3 normal = facing_viewer(point.normal, point);
  const Vec3 mirroring = reflecting_outward(normal, point);
  const float through = clamp01(p.transp);
  const Rgb diffuse = rgb(p.diffuse), glossy = rgb(p.glossy), specular = rgb(p.specular);
  add(LobeKind::Diffuse, LobeType::Diffuse, diffuse * (1 - through), Frame(normal), closure);
  add_glossy(p, point, mirroring, glossy * (1 - through), LobeKind::GlossyReflection, closure);
  add(LobeKind::Mirror, LobeType::Reflection, specular * (1 - through), Frame(mirroring), closure);
  if (through == 0) return;

  const float eta = ratio(point, p.ior);
  closure.thin_walled = eta == 1;
  const int first = closure.count;
  add(LobeKind::Translucency, LobeType::Translucency, diffuse * through, Frame(normal), closure);
  add_glossy(p, point, normal, glossy * through,
             eta == 1 ? LobeKind::GlossyThin : LobeKind::GlossyRefraction, closure);
  add(eta == 1 ? LobeKind::ThinTransmission : LobeKind::ClearRefraction, LobeType::Refraction,
      specular * through, Frame(normal), closure);
  for (int i = first; i < closure.count; ++i) closure.lobes[i].eta = eta;
}

int dgs_lobes(const ShaderNode& node) {
  const bool through = node.constants<Dgs>().transp > 0 || node.connected(offsetof(Dgs, transp));
  return through ? 6 : 3;
}

void dielectric_material(const Call& call, Closure& closure) {
  const auto& p = call.as<DielectricMaterial>();
  const ShadingPoint& point = call.point;
  closure.light_mode = p.mode;
  closure.lights = p.lights;
  closure.thin_walled = false;
  const Vec3 normal = facing_viewer(point.normal, point);
  const float eta = ratio(point, p.ior, p.ior_out);
  // A ray that entered without refraction meets the back face at the angle that it had at the
  // front, so the back reflects as much as the front.
  const float reflected = bsdf::fresnel_dielectric(dot(normal, point.wo()),
                                                   point.unbent && point.back_side ? 1 / eta : eta);
  add(LobeKind::Mirror, LobeType::Reflection, Rgb(reflected),
      Frame(reflecting_outward(normal, point)), closure);
  if (reflected < 1) {
    closure.add(LobeKind::ClearRefraction, LobeType::Refraction, Rgb(1 - reflected), Frame(normal))
        .eta = eta;
    closure.albedo += Rgb(1 - reflected);
  }
  if (p.phong_coef > 0 && reflected > 0) {
    Lobe& lobe =
        closure.add(LobeKind::PhongHighlight, LobeType::Reflection, Rgb(reflected), Frame(normal));
    lobe.roughness = p.phong_coef;
    lobe.controls.highlights_only = true;
  }
  // col^d = exp(-absorption d); black becomes opaque within a hundredth of a unit.
  constexpr float kDarkest = 1e-30f;
  const Rgb col = rgb(p.col);
  for (int k = 0; k < 3; ++k) closure.inside.absorption[k] = -math::log(clamp(col[k], kDarkest, 1));
}

void photon_basic(const Call& call, Closure& closure) {
  const auto& p = call.as<PhotonBasic>();
  const Vec3 normal = facing_viewer(call.point.normal, call.point);
  add(LobeKind::Diffuse, LobeType::Diffuse, rgb(p.diffuse), Frame(normal), closure);
  add(LobeKind::Mirror, LobeType::Reflection, rgb(p.specular),
      Frame(reflecting_outward(normal, call.point)), closure);
  const float eta = clamp(index_or_one(p.ior_frac), 0.1f, 10);
  const Rgb transp = rgb(p.transp);
  if (is_black(transp)) return;
  add(eta == 1 ? LobeKind::ThinTransmission : LobeKind::ClearRefraction, LobeType::Refraction,
      transp, Frame(normal), closure);
  closure.lobes[closure.count - 1].eta = eta;
  closure.thin_walled = eta == 1;
}

void pass_all(const Call&, Closure& closure) { closure.opacity = 0; }

bool always(const ShaderNode&) { return true; }

}  // namespace

const ShaderSpec kDgsMaterial = {
    .name = "dgs_material",
    .library = "physics",
    .version = 3,
    .apply = kApplyMaterial,
    .doc = "Material with diffuse, glossy and specular reflection and transmission.",
    .params = kDgsRows,
    .params_size = sizeof(Dgs),
    .material = {.fill = dgs, .max_lobes = dgs_lobes},
};

const ShaderSpec kDgsMaterialPhoton = {
    .name = "dgs_material_photon",
    .library = "physics",
    .version = 3,
    .apply = kApplyPhoton,
    .doc = "Photon shader of a material: scatters photons instead of the surface shader.",
    .params = kDgsPhotonRows,
    .params_size = sizeof(Dgs),
    .material = {.fill = dgs, .max_lobes = dgs_lobes},
};

const ShaderSpec kPathMaterial = {
    .name = "path_material",
    .library = "physics",
    .version = 2,
    .apply = kApplyMaterial,
    .doc = "Alias of dgs_material.",
    .params = kDgsRows,
    .params_size = sizeof(Dgs),
    .material = {.fill = dgs, .max_lobes = dgs_lobes},
};

const ShaderSpec kDielectricMaterial = {
    .name = "dielectric_material",
    .library = "physics",
    .version = 2,
    .apply = kApplyMaterial,
    .doc = "Dielectric with Fresnel reflection and refraction and absorption inside.",
    .params = kDielectricMaterialRows,
    .params_size = sizeof(DielectricMaterial),
    .material = {.fill = dielectric_material,
                 .may_transmit = always,
                 .max_lobes = [](const ShaderNode&) { return 3; }},
};

const ShaderSpec kDielectricMaterialPhoton = {
    .name = "dielectric_material_photon",
    .library = "physics",
    .version = 2,
    .apply = kApplyPhoton,
    .doc = "Photon shader of a material: scatters photons instead of the surface shader.",
    .params = kDielectricMaterialPhotonRows,
    .params_size = sizeof(DielectricMaterial),
    .material = {.fill = dielectric_material,
                 .may_transmit = always,
                 .max_lobes = [](const ShaderNode&) { return 3; }},
};

const ShaderSpec kTransmat = {
    .name = "transmat",
    .library = "physics",
    .apply = kApplyMaterial | kApplyShadow,
    .doc = "Fully transparent material.",
    .material = {.fill = pass_all,
                 .may_transmit = always,
                 .max_lobes = [](const ShaderNode&) { return 0; }},
};

const ShaderSpec kTransmatPhoton = {
    .name = "transmat_photon",
    .library = "physics",
    .apply = kApplyPhoton,
    .doc = "Photon shader of a material: scatters photons instead of the surface shader.",
    .material = {.fill = pass_all,
                 .may_transmit = always,
                 .max_lobes = [](const ShaderNode&) { return 0; }},
};

const ShaderSpec kMibPhotonBasic = {
    .name = "mib_photon_basic",
    .library = "base",
    .apply = kApplyPhoton,
    .doc = "Photon shader of a material: scatters photons instead of the surface shader.",
    .params = kPhotonBasicRows,
    .params_size = sizeof(PhotonBasic),
    .material = {.fill = photon_basic, .max_lobes = [](const ShaderNode&) { return 3; }},
};

}  // namespace oriel
