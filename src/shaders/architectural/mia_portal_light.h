// SPDX-License-Identifier: Apache-2.0
// mia_portal_light: a rectangle in a window that shines with the sky or environment behind it.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

// Use
//   As light shader of an area light whose rectangle covers the opening, in the x/y plane of the
//   light's own space and placed by its instance; it shines to +z, with `reverse` to -z. The
//   instance should be flagged visible; it counts as such either way.
// What it does
//   Light of the environment through the rectangle becomes direct light, with shadows and one
//   bounce more than final gathering alone would bring. Final gather rays, and diffuse rays of
//   paths, from inside end at it; things outside light the room no longer except through mirrors
//   and glass. Rays from outside pass. Neither the sun's disc nor its glow is in this light, unless
//   `lookup_using_fg_rays` is off.
//   `use_custom_environment` on without a shader makes a white card; off, what is seen is the
//   camera's environment, without one nothing.
//   `cutoff_threshold` compares with what the colour of a usual light shader would be: radiance
//   times area times cosine over pi times squared distance. Of a window in many parts, each part
//   is compared alone.
//   With `emit_direct_photons` it gives photons only, first hits included; rays pass then.
//   The energy of photons is that of its light, whatever the element says.
extern const ShaderSpec kMiaPortalLight;

}  // namespace oriel
