// SPDX-License-Identifier: Apache-2.0
// Frame buffers that shaders write to, by number and by name.
#pragma once

#include <string>

#include "scene/elements.h"

namespace oriel::sdk {

class Host;

/// The camera of the current frame; null if unknown.
const scene::Camera* scene_camera(const Host& host);

/// Number of a named buffer of the camera for mi_fb_put; -1 if there is none.
int buffer_index(const Host& host, const std::string& name);

}  // namespace oriel::sdk
