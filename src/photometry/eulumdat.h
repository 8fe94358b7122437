// SPDX-License-Identifier: Apache-2.0
// Photometric files of the format EULUMDAT (.ldt).
#pragma once

#include <string_view>

#include "photometry/profile_file.h"

namespace oriel::photometry {

// Conventions
//   C0 - C180 is across the luminaire, C90 - C270 along it; in IES files 0 - 180 is along it. In
//   the luminaire frame of light_profile.h gamma 0 is nadir (-z), C90 is +x and C0 is -y: C is
//   counter-clockwise seen from above, and C is the IES angle + 90.

/// Reads EULUMDAT files of every symmetry (Isym 0 ... 4).
///
/// Model:   intensity = value * lamp flux / 1000 * conversion factor, with the flux of the first
///          lamp set. One value per line; a comma is a decimal point.
/// Errors:  ProfileError.
/// Source:  Stockmar, "EULUMDAT - ein Leuchtendatenformat fuer den europaeischen
///          Beleuchtungsplaner", Licht '90, 1990.
/// Checked: EulumdatFile.*
ProfileData parse_eulumdat(std::string_view text);

}  // namespace oriel::photometry
