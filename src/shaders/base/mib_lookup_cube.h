// SPDX-License-Identifier: Apache-2.0
// mib_lookup_cube1, mib_lookup_cube6, mib_lookup_cylindrical: textures on boxes and cylinders
// around the scene.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

/// Model:   faces are seen from inside: the sides upright, top and bottom as seen when tilting the
///          view from -z. With a size the box is finite, centred at `point`, and intersected from
///          the ray origin.
/// Source:  the vendor's pages for order and names; the orientation of faces is inferred.
extern const ShaderSpec kMibLookupCube1;
extern const ShaderSpec kMibLookupCube6;
/// A cylinder of radius 1 about z, from z = -1 to 1 after `xform`, without caps.
/// Source:  the vendor's page.
extern const ShaderSpec kMibLookupCylindrical;

}  // namespace oriel
