// SPDX-License-Identifier: Apache-2.0
// Closed outlines in the plane.
#pragma once

#include <array>
#include <vector>

namespace oriel::models {

/// Corners in order; the last one is connected to the first.
using Outline = std::vector<std::array<double, 2>>;

/// Area of an outline, positive if it is counter-clockwise.
double signed_area(const Outline& outline);

/// Rotated and moved; axes: the place of the origin, then the direction of x.
Outline placed(Outline outline, const std::array<double, 4>& axes);

/// One outline for an area with holes.
///
/// Model:   each hole is connected to the outline by its shortest bridge that crosses no edge. The
///          bridge is part of the outline in both directions, so that the outline encloses the area
///          outside the holes.
/// Inputs:  outlines in either direction, without intersections; holes inside the outer outline.
/// Returns: a counter-clockwise outline. It starts and ends at convex corners of the outer outline
///          where that has two neighbouring ones. A hole without a bridge is left out.
/// Source:  Eberly, Triangulation by Ear Clipping, 2002, section 3.
/// Checked: Outline.*
Outline with_holes(Outline outer, std::vector<Outline> holes);

}  // namespace oriel::models
