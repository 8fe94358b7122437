// SPDX-License-Identifier: Apache-2.0
// Search for the windows and doors of rooms that have no portals.
#pragma once

#include "lights/openings.h"

namespace oriel {

struct World;
class EnvironmentLight;

/// Rectangles through which the environment lights the surfaces near the camera; none if the scene
/// has portals, or is lit from most directions, or from few, or through no rectangles.
///
/// Model:   rays over the half sphere from surfaces that the camera sees, and from surfaces one
///          bounce further. Planes with many hits, and those of the box around all hits, are
///          candidates for the plane of an opening. Cells of a plane through which rays reach the
///          environment are connected to components; the rectangle around a component is an
///          opening. The component with the largest product of rays and rays per area is accepted
///          first. Objects that let light pass are ignored, and so is motion.
/// Inputs:  world: with its geometry, its environment and its lights; environment: of the world;
///          found: Openings::found() of a world with the same geometry and camera, which is used
///          instead of a search; may be null.
/// Returns: the same for any number of threads.
/// Checked: FindOpenings.*
Openings find_openings(const World& world, const EnvironmentLight& environment,
                       OpeningSearch found = nullptr);

}  // namespace oriel
