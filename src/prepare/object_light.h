// SPDX-License-Identifier: Apache-2.0
// Area lights that take their shape from an object of the scene.
#pragma once

#include "runtime/light.h"
#include "scene/object.h"

namespace oriel {

/// Gives the light the shape and place of the object's polygons.
///
/// Model:   one parallelogram becomes a rectangle, other flat objects a disc of the same area about
///          their centroid, everything else the smallest sphere about its centroid. Flat
///          ones shine to the side of the light's direction where it has one, else to their front.
/// Inputs:  to_world: of the object's instance.
/// Returns: false where the object has no polygons with area; the light is unchanged then.
/// Checked: ObjectLights.* in object_light_test.cpp
bool place_on_object(const scene::Object& object, const Mat4& to_world, Light& light);

}  // namespace oriel
