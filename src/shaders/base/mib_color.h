// SPDX-License-Identifier: Apache-2.0
// mib_color_*, mib_cie_d, mib_blackbody: colours made from colours, numbers and temperatures.
#pragma once

#include "runtime/shader_spec.h"

namespace oriel {

extern const ShaderSpec kMibColorAlpha;
extern const ShaderSpec kMibColorAverage;
extern const ShaderSpec kMibColorIntensity;
/// Source: the vendor's page "Data Conversion": weights are places of the inner colours.
extern const ShaderSpec kMibColorInterpolate;
/// Source: the same page; its "blend" is printed as A (1 - Ba) w + B w, which fades what lies
///         below a layer that is off. A (1 - Ba w) + B w is taken.
extern const ShaderSpec kMibColorMix;
extern const ShaderSpec kMibColorSpread;
/// Daylight and black bodies at luminance 1, times intensity.
extern const ShaderSpec kMibCieD;
extern const ShaderSpec kMibBlackbody;

}  // namespace oriel
