// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/math.h"
#include "runtime/bump.h"
#include "runtime/closure.h"
#include "runtime/shade_input.h"
#include "shaders/maya/host_rows.h"
#include "shaders/subsurface/subsurface.h"

namespace oriel {
namespace {

struct PhysicalScatter {
  Rgba material, transmission;
  float ior;
  Vec3 absorption_coeff, scattering_coeff;
  float scattering_anisotropy, scale_conversion, depth, max_radius;
  int max_samples, max_photons, mode;
  bool approx_diffusion, approx_single_scatter, approx_multiple_scatter;
};

// Defaults: SSS_Physical_Material of 3ds Max, where its reference names them.
constexpr auto kPhysicalScatterRows = about({
    {ORIEL_PARAM(PhysicalScatter, material), .doc = "Material whose light is added.",
     .declared_default = false, .takes_material = true},
    {ORIEL_PARAM(PhysicalScatter, transmission), .fallback = {1, 1, 1},
     .doc = "Colour factor of scattered light."},
    {ORIEL_PARAM(PhysicalScatter, ior), .fallback = {1.3f}, .min = 1,
     .doc = "Index of refraction."},
    {ORIEL_PARAM(PhysicalScatter, absorption_coeff), .fallback = {.1f, .1f, .1f},
     .unit = "per scene unit", .doc = "Absorption coefficient."},
    {ORIEL_PARAM(PhysicalScatter, scattering_coeff), .fallback = {1, 1, 1},
     .unit = "per scene unit", .doc = "Scattering coefficient."},
    {ORIEL_PARAM(PhysicalScatter, scattering_anisotropy), .min = -1, .max = 1,
     .doc = "Mean cosine of scattering."},
    {ORIEL_PARAM(PhysicalScatter, scale_conversion), .fallback = {1},
     .doc = "Scale of the coefficients.", .support = Support::Ignored},
    {ORIEL_PARAM(PhysicalScatter, depth), .fallback = {1}, .unit = "scene units",
     .doc = "Depth of the simulation.", .support = Support::Ignored},
    {ORIEL_PARAM(PhysicalScatter, max_samples), .doc = "Samples.", .support = Support::Ignored},
    {ORIEL_PARAM(PhysicalScatter, max_photons), .doc = "Photons of a look-up.",
     .support = Support::Ignored},
    {ORIEL_PARAM(PhysicalScatter, max_radius), .unit = "scene units", .doc = "Radius of a look-up.",
     .support = Support::Ignored},
    {ORIEL_PARAM(PhysicalScatter, approx_diffusion), .fallback = {1},
     .doc = "Whether deep scattering is included.", .support = Support::Ignored},
    {ORIEL_PARAM(PhysicalScatter, approx_single_scatter), .fallback = {1},
     .doc = "Whether single scattering is included.", .support = Support::Ignored},
    {ORIEL_PARAM(PhysicalScatter, approx_multiple_scatter), .fallback = {1},
     .doc = "Whether multiple scattering is included.", .support = Support::Ignored},
    {ORIEL_PARAM(PhysicalScatter, mode), .doc = "Light list mode.", .support = Support::Ignored},
});

void fill_physical(const Call& call, Closure& closure) {
  const auto& p = call.as<PhysicalScatter>();
  const float forward = clamp(p.scattering_anisotropy, -1, 1);
  Rgb reflectance(0);
  for (int k = 0; k < 3; ++k) {
    const float scattered = std::max(0.0f, p.scattering_coeff[k]) * (1 - forward);
    const float all = scattered + std::max(0.0f, p.absorption_coeff[k]);
    if (all > 0) reflectance[k] = diffusion_reflectance(scattered / all, p.ior);
  }
  const Rgb weight = clamped(p.transmission) * reflectance;
  closure.add(LobeKind::Diffuse, LobeType::Diffuse, weight,
              Frame(facing_viewer(call.point.normal, call.point)));
  closure.albedo += weight;
  if (call.node && call.node->material_input(offsetof(PhysicalScatter, material)))
    shade_input(call, offsetof(PhysicalScatter, material), p.material, Rgb(1), closure);
}

}  // namespace

float diffusion_reflectance(float reduced_albedo, float index) {
  constexpr float kMaxIndex = 3;  // the fit exceeds 1 from 5 on
  const float n = clamp(index, 1, kMaxIndex);
  // Diffuse Fresnel reflectance inside: the fit of W. Egan, T. Hilgeman (1979) for n > 1.
  const float inside = n > 1 ? -1.440f / (n * n) + .710f / n + .668f + .0636f * n : 0;
  const float boundary = (1 + inside) / (1 - inside);
  const float root = std::sqrt(3 * std::max(0.0f, 1 - reduced_albedo));
  return reduced_albedo / 2 * (1 + math::exp(-4 * boundary * root / 3)) * math::exp(-root);
}

const ShaderSpec kMisssPhysical = {
    .name = "misss_physical",
    .library = "hosts",
    .apply = kApplyMaterial | kApplyShadow | kApplyPhoton,
    .doc = "Fallback for the physical subsurface material: diffusion without scatter radius.",
    .params = kPhysicalScatterRows,
    .params_size = sizeof(PhysicalScatter),
    .material = {.fill = fill_physical,
                 .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); },
                 .max_lobes = [](const ShaderNode&) { return 1; }},
    .fallback = {.is_fallback = true, .aliases = "misss_physical_phen"},
};

}  // namespace oriel
