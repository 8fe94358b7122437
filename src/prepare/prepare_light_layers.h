// SPDX-License-Identifier: Apache-2.0
// Resolves patterns of names to the lights, emissive objects and environments of light groups.
#pragma once

#include <vector>

#include "base/diagnostic.h"
#include "lights/emission.h"
#include "runtime/world.h"
#include "scene/hierarchy.h"

namespace oriel {

/// Assigns lights to light layers.
///
/// Model:   a pattern is matched against the names of a light's or object's instance, of the groups
///          that contain it and of their instances; "environment" is the sky. A light that matches
///          several groups belongs to the first. Portals that show the scene's environment and
///          match no pattern belong to the environment.
/// Inputs:  leaves: those of the world; groups: with valid names; emits: emission by instance of
///          the world.
/// Errors:  OR-RN-057 a pattern without match; OR-RN-058 too many groups, the last ones are
///          ignored.
/// Checked: LightLayers.* in tests/analytic/lights/light_layers_test.cpp
LightLayers resolve_light_layers(const std::vector<scene::Leaf>& leaves,
                                 const std::vector<scene::LightGroup>& groups, const World& world,
                                 const std::vector<EmissionKind>& emits, Diagnostics& diagnostics);

}  // namespace oriel
