// SPDX-License-Identifier: Apache-2.0
// Cameras and lights of glTF files, as assimp reads them correctly.
#pragma once

#include "models/gltf/json_read.h"

namespace oriel::models::gltf {

/// Copies cameras and lights that several nodes share, so that each node has its own, with a unique
/// name.
///
/// Model:   assimp finds the place of a camera or light by its node's name and knows one place for
///          each. Its horizontal angle is yfov times the aspect ratio; here yfov is changed so that
///          this product is the angle. The vertical angle is that of the file in pictures of any
///          shape.
/// Inputs:  file: cameras, lights and nodes; lights and cameras without a node are dropped.
///          aspect: of the picture; 0: that of the file, else kCameraAspect.
/// Source:  glTF 2.0, 5.14 (camera.perspective), 3.10.2; KHR_lights_punctual.
/// Checked: ModelCamera.*
void make_plain_views(json& file, float aspect);

}  // namespace oriel::models::gltf
