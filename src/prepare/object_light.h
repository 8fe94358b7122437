// SPDX-License-Identifier: Apache-2.0
// Area lights with the shape of an object.
#pragma once

#include "runtime/light.h"
#include "scene/object.h"

namespace oriel {

/// Sets shape and placement of the light from the object's polygons.
///
/// Model:   a single parallelogram becomes a rectangle, another flat object a disc of the same area
///          about its centroid, any other object the smallest sphere about its centroid. Flat
///          lights emit to the side of the light's direction, or without direction to the object's
///          front.
/// Inputs:  to_world: of the object's instance.
/// Returns: false if the object has no polygons with area; the light is then unchanged.
/// Checked: ObjectLights.* in object_light_test.cpp
bool place_on_object(const scene::Object& object, const Mat4& to_world, Light& light);

}  // namespace oriel
