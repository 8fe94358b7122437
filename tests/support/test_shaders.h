// SPDX-License-Identifier: Apache-2.0
// Test shaders with known values.
#pragma once

#include <initializer_list>

#include "shaders/registry.h"

namespace oriel::testing {

/// The built-in shaders and those of tests:
/// "test_sky" ( "above", "below", "up" ): one colour in the half space of `up`, another in the
/// other;
/// "test_direction" ( ): the direction of a ray as a colour around .5;
/// "test_place" ( "scale" ): the point in world space as a colour, so that a target shows where it
/// was hit;
/// "test_tilt" ( "normal" ): a bump shader, which turns the normal itself and returns nothing.
const Registry& test_registry();

/// test_registry() and further shaders.
Registry test_registry_with(std::initializer_list<const ShaderSpec*> more);

}  // namespace oriel::testing
