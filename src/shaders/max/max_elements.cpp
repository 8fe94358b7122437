// SPDX-License-Identifier: Apache-2.0
// Fallback shaders for 3ds Max shaders that wrap a material; they show the material unchanged.
#include "runtime/shade_input.h"
#include "shaders/max/max_shaders.h"
#include "shaders/maya/host_rows.h"

namespace oriel {
namespace {

struct Wrapped {
  Rgba Material;
};
struct MaxBump {
  float Multiplier;
};

constexpr auto kWrappedRows = about({
    {ORIEL_PARAM(Wrapped, Material), .doc = "The material, under whatever name it is connected.",
     .declared_default = false, .takes_material = true},
});
constexpr auto kMaxBumpRows = about({
    {ORIEL_PARAM(MaxBump, Multiplier), .fallback = {1}, .doc = "Strength of the bumps.",
     .support = Support::Ignored},
});

constexpr ShaderSpec storing(const char* name) {
  return {.name = name,
          .library = "hosts",
          .apply = kApplyMaterial | kApplyShadow | kApplyPhoton,
          .doc = "Stand-in: shows its material; the render element is not stored.",
          .params = kWrappedRows,
          .params_size = sizeof(Wrapped),
          .material = {
              .fill =
                  [](const Call& call, Closure& closure) {
                    shade_input(call, offsetof(Wrapped, Material), call.as<Wrapped>().Material,
                                Rgb(1), closure);
                  },
              .may_transmit = [](const ShaderNode& node) { return node.inputs_may_transmit(); },
              .max_lobes = [](const ShaderNode&) { return 0; },
          },
          .fallback = {.is_fallback = true, .passes_through = true}};
}

constexpr ShaderSpec kNodes[] = {
    storing("max_mrStoreElement"),
    storing("max_mrStoreElements"),
    {.name = "max_Bump",
     .library = "hosts",
     .apply = kApplyTexture,
     .doc = "Stand-in for the host's bump: leaves the surface smooth.",
     .params = kMaxBumpRows,
     .params_size = sizeof(MaxBump),
     .result = ParamType::Vector,
     .result_size = sizeof(Vec3),
     .value = [](const Call&, void* result) { *static_cast<Vec3*>(result) = Vec3(0); },
     .fallback = {.is_fallback = true}},
};

}  // namespace

std::span<const ShaderSpec> max_elements() { return kNodes; }

}  // namespace oriel
