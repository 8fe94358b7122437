// SPDX-License-Identifier: Apache-2.0
// Photometric files of the Illuminating Engineering Society: LM-63.
#pragma once

#include <string>
#include <string_view>

#include "photometry/profile_file.h"

namespace oriel::photometry {

// Conventions
//   Frames (LM-63-2002, "Photometric zero", "Photometric horizontal", "Horizontal angles"), in the
//   luminaire's own frame of light_profile.h:
//   type C: vertical angle 0 is nadir (-z), 180 zenith; horizontal angle 0 is +x, 90 is +y,
//   counter-clockwise seen from above.
//   type B: (0, 0) is nadir; the planes share the horizontal axis y. Vertical angle 90 at
//   horizontal 0 is +x, horizontal 90 is -y: to the right if one looks along the beam with +x up.
//   type A: (0, 0) is +x; the planes share the vertical axis. Vertical -90 is nadir, 90 zenith,
//   horizontal 90 is -y: clockwise seen from above.

/// Reads LM-63 of 1986 (without a tag), 1991, 1995, 2002 and 2019.
///
/// Model:   intensity = table * candela multiplier * ballast factor, and before 2002 * ballast-lamp
///          factor. Numbers are separated by blanks, commas and line ends. For TILT, the factor at
///          0 degrees (usually 1) is used, since the file describes the luminaire as mounted for
///          the measurement.
/// Inputs:  folder: searched for a TILT file, by its base name; empty = no search.
/// Errors:  ProfileError.
/// Source:  ANSI/IESNA LM-63-02; ANSI/IES LM-63-19.
/// Checked: IesFile.*
ProfileData parse_ies(std::string_view text, const std::string& folder = {});

}  // namespace oriel::photometry
