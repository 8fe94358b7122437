// SPDX-License-Identifier: Apache-2.0
// mib_texture_lookup2, mib_texture_filter_lookup, mib_texture_rotate.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// The first texture space times a factor, repeated; a factor of 0 means 1 (inferred).
extern const ShaderSpec kMibTextureLookup2;
/// An elliptical filter over the ray footprint.
///
/// Model:   the footprint is computed in texture space 0. With a remap shader, its effect on the
///          two axes is measured by evaluating it next to the point.
/// Source:  the vendor's page; disc_r is the radius of the projected disc in pixels.
extern const ShaderSpec kMibTextureFilterLookup;
/// Two unit vectors perpendicular to the normal, rotated about it: for anisotropic highlights.
///
/// Model:   rotation = angle (max - min) + min in full turns, counter-clockwise seen from outside;
///          min and max both 0 mean 0 and 0.25.
/// Source:  the vendor's page.
extern const ShaderSpec kMibTextureRotate;

}  // namespace oriel
