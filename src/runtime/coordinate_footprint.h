// SPDX-License-Identifier: Apache-2.0
// Over how much of a texture does a look-up blur whose coordinate another shader makes?
#pragma once

#include "image/texture.h"
#include "runtime/shader_node.h"

namespace oriel {

/// Change of what `coordinate` gives over the footprint of the ray; zero when that is unknown.
///
/// Model:   the shader is asked beside the point, along each half axis: position and all texture
///          spaces move (by texture_footprint()), so whatever it scales, turns or projects counts.
///          Where copies of a texture meet, the other side is asked; where both jump, nothing is
///          known of the shader and the footprint stays as it is in texture space 0.
/// Inputs:  coordinate: gives a value; here: what it gives at the point.
/// Source:  forward differences; Igehy, "Tracing Ray Differentials", SIGGRAPH 1999, 3.4.
/// Checked: BaseLookups.TheFilterGoesByTheCoordinate and
///          BaseLookups.FilterLookupBlursAlongTheFootprint in tests/shader_binding.
TextureFootprint coordinate_footprint(const ShaderNode& coordinate, const Vec3& here,
                                      ShadingPoint& point);

}  // namespace oriel
