// SPDX-License-Identifier: Apache-2.0
// From patterns of names to the lights, emissive objects and environments of each group.
#pragma once

#include <vector>

#include "base/diagnostic.h"
#include "lights/emission.h"
#include "runtime/world.h"
#include "scene/hierarchy.h"

namespace oriel {

/// Whose light goes into which layer.
///
/// Model:   a pattern is held against the names of a light's or object's instance, of the groups
///          that it stands in and of their instances; "environment" is the sky. What several groups
///          match belongs to the first. Portals that show the scene's environment and that no
///          pattern matches go with the environment.
/// Inputs:  leaves: those the world was made of; groups: with sound names; emits: by instance of
///          the world, its emission.
/// Errors:  OR-RN-057 a pattern that matches nothing; OR-RN-058 too many groups, the last ones are
///          left out.
/// Checked: LightLayers.* in tests/analytic/lights/light_layers_test.cpp
LightLayers resolve_light_layers(const std::vector<scene::Leaf>& leaves,
                                 const std::vector<scene::LightGroup>& groups, const World& world,
                                 const std::vector<EmissionKind>& emits, Diagnostics& diagnostics);

}  // namespace oriel
