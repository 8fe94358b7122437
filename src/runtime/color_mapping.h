// SPDX-License-Identifier: Apache-2.0
// Colour mapping by lens shaders (exposures) and output shaders.
#pragma once

#include <string_view>

#include "runtime/world.h"

namespace oriel {

/// Maps a colour by colour-mapping lens shaders (exposures).
///
/// Inputs:  raster: as in Camera::ray.
Rgb map_color(const NodeList& shaders, const World& world, Vec2 raster, const Rgb& color);

/// Maps a colour of the picture by output shaders.
///
/// Model:   a shader of side_channel_mode 1 maps the input of the lens shader with the same side
///          channel instead of the picture; one of mode 2 restores that input and maps nothing. If
///          no lens shader fills the channel, every mode acts as 0.
///          lens shader fills the channel every mode is 0.
/// Inputs:  shown: after lens shaders; film: before them.
/// Source:  manual 3.1.2.1.
/// Checked: SideChannel.* in tests/analytic/camera/exposure_test.cpp
Rgb map_output(const NodeList& shaders, const World& world, Vec2 raster, const Rgb& shown,
               const Rgb& film);

LensTraits lens_traits(const ShaderNode& node);
/// Whether a lens shader fills the side channel.
bool has_side_channel(const World& world, std::string_view name);
/// Makes the shader's preview picture that of the world, if it has a readable one.
void note_preview(const ShaderNode& node, World& world);

}  // namespace oriel
