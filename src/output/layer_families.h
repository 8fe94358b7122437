// SPDX-License-Identifier: Apache-2.0
// Layers of EXR files whose number and names depend on the scene.
#pragma once

#include <vector>

#include "image/pixel_buffer.h"
#include "render/session.h"

namespace oriel {

/// `light.NAME` of each light group and `light.rest`, which sum to the beauty; `light.indirect`
/// where some light does not know its group.
void add_light_layers(const RenderSession& session, std::vector<Layer>& layers);

/// User buffers: fbN by number, those with a name by it, if shaders wrote them. A name that another
/// layer has becomes fb.NAME; a buffer named as an output of materials replaces that layer.
void add_user_buffer_layers(const RenderSession& session, std::vector<Layer>& layers);

/// Channel names of a user buffer that is alone in a file.
std::vector<std::string> channels_alone(const Image& image);

}  // namespace oriel
