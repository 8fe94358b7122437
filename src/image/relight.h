// SPDX-License-Identifier: Apache-2.0
// Relighting: scales the light layers of a render and sums them to a new beauty.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "image/pixel_buffer.h"

namespace oriel {

/// Light layers are named `light_key`, in files of earlier versions `light.key`; their sum is the
/// beauty.
inline constexpr std::string_view kLightLayerPrefix = "light_";

/// The light layers in file order.
/// Checked: Relight.LayersOfEarlierVersionsAreFound
std::vector<const Layer*> light_layers(const std::vector<Layer>& layers);

/// The names of the light groups without the prefix, in file order.
std::vector<std::string> light_layer_names(const std::vector<Layer>& layers);

/// A factor for one light group.
struct LightGain {
  std::string name;
  Rgb factor{1};
};

/// A factor with a tint. Positive warmth raises red and lowers blue, with a ratio of 4 at 1; the
/// luminance of white is unchanged.
/// Checked: Relight.TintsKeepTheLuminance
Rgb tinted(float factor, float warmth);

/// Scales the layers of the given groups and replaces the beauty by their sum; alpha is unchanged.
/// Layers that depend on the lights (variance, outputs...) are dropped; depth, normal and albedo
/// are kept.
///
/// Errors:  std::runtime_error if there are no light layers, a group is unknown, or a light layer
///          differs in shape from the beauty.
/// Checked: Relight.*
std::vector<Layer> relight(const std::vector<Layer>& layers, const std::vector<LightGain>& gains);

}  // namespace oriel
