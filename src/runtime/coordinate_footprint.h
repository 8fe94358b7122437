// SPDX-License-Identifier: Apache-2.0
// The texture footprint of a look-up whose coordinate is the result of a shader.
#pragma once

#include "image/texture.h"
#include "runtime/shader_node.h"

namespace oriel {

/// Change of the result of `coordinate` over the footprint of the ray; zero if unknown.
///
/// Model:   evaluates the shader at points offset along each half axis. Position and all texture
///          spaces are offset (by texture_footprint()), which includes scaling, rotation and
///          projection by the shader. At a discontinuity, where copies of a texture meet, the
///          opposite offset is evaluated; if both are discontinuous, the footprint of texture space
///          0 is used.
/// Inputs:  coordinate: returns a value; here: its value at the point.
/// Source:  forward differences; Igehy, "Tracing Ray Differentials", SIGGRAPH 1999, 3.4.
/// Checked: BaseLookups.TheFilterGoesByTheCoordinate and
///          BaseLookups.FilterLookupBlursAlongTheFootprint in tests/shader_binding.
TextureFootprint coordinate_footprint(const ShaderNode& coordinate, const Vec3& here,
                                      ShadingPoint& point);

}  // namespace oriel
