// SPDX-License-Identifier: Apache-2.0
// Layers of lights: do they sum to the picture, and the picture under other strengths of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "image/pixel_buffer.h"

namespace oriel {

/// Layers of lights are named `light.key`; together they are the beauty.
inline constexpr std::string_view kLightLayerPrefix = "light.";

/// The groups that the layers hold, in their order, without the prefix.
std::vector<std::string> light_layer_names(const std::vector<Layer>& layers);

/// What one group of lights is multiplied by.
struct LightGain {
  std::string name;
  Rgb factor{1};
};

/// A factor with a tint: positive is warmer, as red against blue by 4 for 1; the luminance of white
/// stays.
/// Checked: Relight.TintsKeepTheLuminance
Rgb tinted(float factor, float warmth);

/// Multiplies the layers of those groups and makes the sum of all the new beauty, whose alpha
/// stays. Layers that other lights would not leave as they are (variance, outputs...) are dropped;
/// depth, normal and albedo stay.
///
/// Errors:  std::runtime_error: there are no layers of lights, or no such group, or they differ in
///          shape from the beauty.
/// Checked: Relight.*
std::vector<Layer> relight(const std::vector<Layer>& layers, const std::vector<LightGain>& gains);

}  // namespace oriel
