// SPDX-License-Identifier: Apache-2.0
// mib_color_*, mib_cie_d, mib_blackbody: colours made from colours, numbers and temperatures.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMibColorAlpha;
extern const ShaderSpec kMibColorAverage;
extern const ShaderSpec kMibColorIntensity;
/// Source:  the vendor's page "Data Conversion": weights are positions of the inner colours.
extern const ShaderSpec kMibColorInterpolate;
/// Source:  same page. Its formula for "blend" is A (1 - Ba) w + B w, by which a layer with weight
///          0 hides lower layers. A (1 - Ba w) + B w is used instead.
extern const ShaderSpec kMibColorMix;
extern const ShaderSpec kMibColorSpread;
/// Daylight and black bodies at luminance 1, times intensity.
extern const ShaderSpec kMibCieD;
extern const ShaderSpec kMibBlackbody;

}  // namespace oriel
