// SPDX-License-Identifier: Apache-2.0
// Colour mapping by lens shaders (exposures) and output shaders.
#pragma once

#include <string_view>

#include "runtime/world.h"

namespace oriel {

/// Sends a colour through shaders that map colours (exposures), as lens shaders do.
///
/// Inputs:  raster: as Camera::ray takes it.
Rgb map_color(const NodeList& shaders, const World& world, Vec2 raster, const Rgb& color);

/// Sends a colour of the picture through output shaders.
///
/// Model:   a shader of side_channel_mode 1 maps what the lens shader of the same side channel was
///          given, in place of the picture; of mode 2, it puts that back and maps nothing. Where no
///          lens shader fills the channel every mode is 0.
/// Inputs:  shown: after lens shaders; film: before them.
/// Source:  manual 3.1.2.1.
/// Checked: SideChannel.* in tests/analytic/exposure_test.cpp
Rgb map_output(const NodeList& shaders, const World& world, Vec2 raster, const Rgb& shown,
               const Rgb& film);

LensTraits lens_traits(const ShaderNode& node);
/// Whether a lens shader fills that side channel.
bool has_side_channel(const World& world, std::string_view name);
/// Makes the shader's preview, if it has one that can be read, the world's.
void note_preview(const ShaderNode& node, World& world);

}  // namespace oriel
