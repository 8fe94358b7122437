// SPDX-License-Identifier: Apache-2.0
// mib_texture_lookup2, mib_texture_filter_lookup, mib_texture_rotate.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// The first texture space times a factor, repeated; a factor of 0 is 1 (inferred).
extern const ShaderSpec kMibTextureLookup2;
/// An elliptical filter over the footprint of the ray.
///
/// Model:   the footprint is measured in texture space 0; with a remap shader, what it does to the
///          footprint's two axes is measured by asking it beside the point.
/// Source:  the vendor's page; disc_r is the radius, in pixels, of the disc that is projected.
extern const ShaderSpec kMibTextureFilterLookup;
/// Two unit vectors across the normal, turned about it: for highlights that stretch.
///
/// Model:   turn = angle (max - min) + min, in whole turns, anticlockwise seen from outside; min
///          and max both 0 stand for 0 and 0.25.
/// Source:  the vendor's page.
extern const ShaderSpec kMibTextureRotate;

}  // namespace oriel
