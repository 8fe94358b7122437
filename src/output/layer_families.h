// SPDX-License-Identifier: Apache-2.0
// Layers of EXR files whose number and names depend on the scene.
#pragma once

#include <vector>

#include "image/pixel_buffer.h"
#include "render/session.h"

namespace oriel {

/// `light_NAME` of each light group and `light_rest`, which sum to the beauty; also
/// `light_indirect` if some light has an unknown group.
void add_light_layers(const RenderSession& session, std::vector<Layer>& layers);

/// User buffers that shaders wrote: by name, or fbN by number. A name of another layer becomes
/// fb.NAME; a buffer with the name of a material output replaces that layer.
void add_user_buffer_layers(const RenderSession& session, std::vector<Layer>& layers);

/// Channel names of a user buffer that is the only content of a file.
std::vector<std::string> channels_alone(const Image& image);

}  // namespace oriel
