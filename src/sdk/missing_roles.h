// SPDX-License-Identifier: Apache-2.0
// Shaders that change the whole picture and are missing because their library is.
#pragma once

#include "sdk/host.h"

namespace oriel::sdk {

/// Reports each lens, output and state shader of a frame that neither Oriel nor a loaded library
/// has, when a library of the scene is absent (not found, or not loadable). A picture without them
/// is not the one that was asked for, so it is an error: OR-SDK-006. Materials have a fallback and
/// are reported where they are bound.
///
/// Inputs:  camera: may be null; lens, output: whether these shaders are asked for at all.
/// Checked: MissingRoles.* in tests/user_shaders/load_failures_test.cpp
void report_missing_roles(const scene::Scene& scene, const scene::RenderCommand& command,
                          const scene::Camera* camera, bool lens, bool output, const Host& host,
                          Diagnostics& diagnostics);

}  // namespace oriel::sdk
