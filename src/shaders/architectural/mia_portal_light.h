// SPDX-License-Identifier: Apache-2.0
// mia_portal_light: area light in a window with the radiance of the environment behind it.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   Light shader of an area light whose rectangle covers the opening, in the x/y plane of the light
//   space, placed by its instance; it emits to +z, with `reverse` to -z. The instance should be
//   visible; it is treated as visible in any case.
// Model
//   Light of the environment through the rectangle becomes direct light with shadows, which adds
//   one bounce compared to final gathering alone. Final gather rays and diffuse path rays from
//   inside end at the rectangle, so outside objects illuminate the room only through mirrors and
//   glass. Rays from outside pass. The sun's disc and glow are excluded unless
//   `lookup_using_fg_rays` is off.
//   `use_custom_environment` without a shader is a white card; if it is off, the environment of the
//   camera is used, or black if there is none.
//   `cutoff_threshold` is compared with the colour of an equivalent conventional light: radiance
//   times area times cosine over pi times squared distance. If a window has several portals, each
//   is compared separately.
//   With `emit_direct_photons` it emits photons only, including first hits; rays then pass through.
//   The energy of the photons follows from the light; the energy of the element is ignored.
extern const ShaderSpec kMiaPortalLight;

}  // namespace oriel
