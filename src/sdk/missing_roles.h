// SPDX-License-Identifier: Apache-2.0
// Reports missing shaders that affect the whole picture.
#pragma once

#include "sdk/host.h"

namespace oriel::sdk {

/// Reports each lens, output and state shader of a frame that is neither built in nor in a loaded
/// library, if a library of the scene is missing (not found or not loadable). The picture would be
/// wrong without them, so it is an error: OR-SDK-006. Materials have a fallback and are reported
/// when they are bound.
///
/// Inputs:  camera: may be null; lens, output: whether these shaders are used.
/// Checked: MissingRoles.* in tests/user_shaders/load_failures_test.cpp
void report_missing_roles(const scene::Scene& scene, const scene::RenderCommand& command,
                          const scene::Camera* camera, bool lens, bool output, const Host& host,
                          Diagnostics& diagnostics);

}  // namespace oriel::sdk
