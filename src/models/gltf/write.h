// SPDX-License-Identifier: Apache-2.0
// Scenes as glTF 2.0.
#pragma once

#include <string>

#include "base/diagnostic.h"
#include "scene/scene.h"

namespace oriel::models::gltf {

/// The bytes of a .glb file of a scene: the objects, lights and cameras below the root of its last
/// render statement, each with a node in world space.
///
/// Model:   polygons become triangles. mia_material and mia_material_x become metallic-roughness
///          materials, see write_material.h; other materials are grey. physical_light and
///          mib_light_point and _spot become lights in candela, mib_light_infinite in lux, and
///          emission is in cd/m2, by the unit of the scene (scene_unit.h).
///          The same scene gives the same bytes.
/// Inputs:  z_is_up: of the scene; glTF has y up.
/// Errors:  OR-MD-030 one note for each kind of thing that is approximated or left out.
/// Source:  glTF 2.0; KHR_lights_punctual, KHR_materials_{transmission,ior,volume,clearcoat,
///          emissive_strength,specular}.
/// Checked: GltfWrite.*
std::string write_glb(const scene::Scene& scene, Diagnostics& diagnostics, bool z_is_up = false);

}  // namespace oriel::models::gltf
