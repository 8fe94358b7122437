// SPDX-License-Identifier: Apache-2.0
// Geometry created by shaders, before the scene graph is flattened.
#pragma once

#include "runtime/shader_spec.h"
#include "scene/render_options.h"
#include "scene/scene.h"

namespace oriel {

/// Runs the geometry shaders of instances and replaces them by the created geometry.
///
/// Errors:  OR-RN-070 a shader that is not a geometry shader; OR-RN-071 one that created nothing.
///          The instance is left empty.
/// Checked: GeometryShaders.* in tests/user_shaders
void make_geometry(scene::Scene& scene, const scene::RenderOptions& options,
                   const Registry& registry, Diagnostics& diagnostics);

}  // namespace oriel
