// SPDX-License-Identifier: Apache-2.0
// Outlines of the profiles of IFC files.
#pragma once

#include <optional>

#include "models/ifc_curves.h"

namespace oriel::models {

/// The outline of an area profile that assimp does not read, or reads wrongly.
///
/// Model:   arbitrary profiles with voids; hollow rectangles and circles; ellipses; shapes C, I, L,
///          T, U, Z and trapeziums. Fillets and slopes of flanges are left out. Holes are connected
///          to the outline: see with_holes. Positions of rectangles and circles may be absent.
/// Returns: unset for other entities, which remain as they are, and for curves that IfcCurves does
///          not evaluate.
/// Source:  IFC4 ADD2 TC1 (buildingSMART), IfcProfileResource; arguments are those of IFC2X3 TC1.
/// Checked: IfcProfiles.*
std::optional<Outline> profile_outline(const StepEntity& profile, const IfcCurves& curves);

}  // namespace oriel::models
