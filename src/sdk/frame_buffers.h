// SPDX-License-Identifier: Apache-2.0
// Frame buffers that shaders write to: which there are, by number and by name.
#pragma once

#include <string>

#include "scene/elements.h"

namespace oriel::sdk {

class Host;

/// The camera of the frame under way; null when it is not known.
const scene::Camera* scene_camera(const Host& host);

/// Number of a named buffer of the camera for mi_fb_put; -1.
int buffer_index(const Host& host, const std::string& name);

}  // namespace oriel::sdk
