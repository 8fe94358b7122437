// SPDX-License-Identifier: Apache-2.0
// Geometry that shaders make before the scene is placed.
#pragma once

#include "runtime/shader_spec.h"
#include "scene/render_options.h"
#include "scene/scene.h"

namespace oriel {

/// Runs the geometry shaders of instances and puts what they make in their place.
///
/// Errors:  OR-RN-070 a shader that makes none; OR-RN-071 one that made nothing. The instance is
///          left empty.
/// Checked: GeometryShaders.* in tests/user_shaders
void make_geometry(scene::Scene& scene, const scene::RenderOptions& options,
                   const Registry& registry, Diagnostics& diagnostics);

}  // namespace oriel
