// SPDX-License-Identifier: Apache-2.0
#include "shaders/architectural/mia_portal_light.h"

#include "runtime/portal.h"

namespace oriel {
namespace {

struct MiaPortalLightParams {
  bool on;
  float multiplier;
  Rgba tint_color;
  bool reverse;
  float cutoff_threshold;
  bool shadows, use_custom_environment;
  ShaderRef custom_environment;
  bool visible, lookup_using_fg_rays;
  float shadow_ray_extension;
  bool emit_direct_photons;
  Rgba transparency;
};

constexpr ParamSpec kMiaPortalLightRows[] = {
    {ORIEL_PARAM(MiaPortalLightParams, on), .fallback = {1}, .doc = "Turns the light on."},
    {ORIEL_PARAM(MiaPortalLightParams, multiplier), .fallback = {1}, .min = 0,
     .doc = "Scales the light; 1 = as much as comes through the opening."},
    {ORIEL_PARAM(MiaPortalLightParams, tint_color), .fallback = {1, 1, 1},
     .doc = "Colours the light."},
    {ORIEL_PARAM(MiaPortalLightParams, reverse), .doc = "Shines to -z of its space, else to +z."},
    {ORIEL_PARAM(MiaPortalLightParams, cutoff_threshold), .fallback = {.005f}, .min = 0,
     .doc = "Light that arrives weaker than this is dropped, and no shadow ray sent."},
    {ORIEL_PARAM(MiaPortalLightParams, shadows), .fallback = {1}, .doc = "Cast shadows."},
    {ORIEL_PARAM(MiaPortalLightParams, use_custom_environment),
     .doc = "Asks `custom_environment`, else the camera's; on without a shader: a white card."},
    {ORIEL_PARAM(MiaPortalLightParams, custom_environment), .doc = "Environment of this window.",
     .declared_default = false},
    {ORIEL_PARAM(MiaPortalLightParams, visible),
     .doc = "The camera, mirrors and glass see the surface."},
    {ORIEL_PARAM(MiaPortalLightParams, lookup_using_fg_rays), .fallback = {1},
     .doc = "Asks as final gather rays do: without the sun's disc and glow."},
    {ORIEL_PARAM(MiaPortalLightParams, shadow_ray_extension), .unit = "scene units",
     .doc = "Shadow rays begin this far outside, negative: inside."},
    {ORIEL_PARAM(MiaPortalLightParams, emit_direct_photons),
     .doc = "Gives photons and no direct light."},
    {ORIEL_PARAM(MiaPortalLightParams, transparency), .fallback = {1, 1, 1},
     .doc = "Scales what is seen of the surface, or through it; the light stays."},
};

bool portal(const void* params, PortalTraits& traits) {
  const MiaPortalLightParams& p = *static_cast<const MiaPortalLightParams*>(params);
  traits.own_environment = p.use_custom_environment;
  const ShaderNode* own = p.custom_environment.node;
  if (own && own->spec().value) traits.environment = own;
  traits.lookup = p.lookup_using_fg_rays ? RayKind::FinalGather : RayKind::Environment;
  traits.scale = rgb(p.tint_color) * p.multiplier;
  traits.reverse = p.reverse;
  traits.cutoff = p.cutoff_threshold;
  traits.shadows = p.shadows;
  traits.shadow_extension = p.shadow_ray_extension;
  traits.visible = p.visible;
  traits.transparency = rgb(p.transparency);
  traits.photons_only = p.emit_direct_photons;
  return p.on;
}

}  // namespace

const ShaderSpec kMiaPortalLight = {
    .name = "mia_portal_light",
    .library = "architectural",
    .version = 9,
    .apply = kApplyLight | kApplyEmitter,
    .doc = "A rectangle in a window that shines with the sky or environment behind it.",
    .params = kMiaPortalLightRows,
    .params_size = sizeof(MiaPortalLightParams),
    .light = {.portal = portal},
};

}  // namespace oriel
