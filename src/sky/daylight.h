// SPDX-License-Identifier: Apache-2.0
// Components of the physical sky: illuminance integrals, disc and glow profiles, aerial
// perspective.
#pragma once

#include "base/vec.h"
#include "sky/preetham.h"

#include <algorithm>

namespace oriel::sky {

/// Illuminance of `sky` on a horizontal plane in lux per channel, exact to 0.1 %.
/// Checked: Preetham.HorizontalIlluminanceMatchesTable
Rgb horizontal_illuminance(const PreethamSky& sky);

/// The same illuminance from 25 directions: cell centres of a 5 x 5 grid on the square, mapped to
/// the disc by the concentric map. The result is 9 to 22 % too low at turbidity 2; it is required
/// for compatibility with the historic ground colour.
/// Source:  NVIDIA, MDL-SDK base.mdl.
/// Checked: PhysicalSky.GroundSkyIlluminanceMatchesTable
Rgb horizontal_illuminance_25(const PreethamSky& sky);

/// Profiles of the sun's disc and glow, as factors of the sun's illuminance in the pi convention.
///
/// Model:   not photometric: a physical disc would have pi over the sun's solid angle (46248). The
///          edge of the disc is near f = 0.9 and gets softer with haze; the glow has ten times the
///          radius of the disc.
/// Inputs:  f: 1 at the centre of the sun, 0 at the end of the glow, linear in angle; edge: see
///          below.
/// Source:  NVIDIA, MDL-SDK base.mdl.
/// Checked: PhysicalSky.DiscProfileMatchesTable
inline float glow_profile(float f) { return 2 * f * f * f; }
inline float disc_profile(float f, float edge) { return 100 * smoothstep(0.85f, edge, f); }

/// The f of full disc brightness; it grows with haze, which softens the edge.
inline float disc_softness_end(float haze) { return 0.95f + 0.002f * (std::max(haze, 0.0f) + 2); }

/// Factors such that disc and glow together have `disc_intensity` times the energy of the sun.
struct DiscScale {
  float disc = 1, glow = 1;
};

/// Model:   the glow keeps its energy up to half of the total; the disc gets the rest. The disc
///          counts as a cap of uniform brightness with its nominal radius.
/// Source:  NVIDIA's GLSL port of the sky (`physically_scaled_sun`).
/// Checked: PhysicalSky.PhysicallyScaledSunCarriesTheSunsEnergy
DiscScale physical_disc_scale(float disc_scale, float disc_intensity, float glow_intensity);

/// Half-angle of the cone of sunlight in radians: that of the real sun at softness 1 and haze 0,
/// 1.5 times as wide at haze 5 and 2.5 times at 15, for scattering in thick air.
/// Source:  the manual says that haze softens shadows; the amount is specific to Oriel.
/// Checked: Sun.HazeSoftensItsShadows
float sun_cone_angle(float shadow_softness, float haze);

/// Share of haze in front of an object at `distance`: 0.1 at `visibility_distance` for haze 0,
/// growing in proportion to 1 + haze; 0 if visibility_distance is not positive (disabled).
/// Source:  the manual defines the 10 % distance; the growth with haze is specific to Oriel.
/// Checked: AerialPerspective.*
float aerial_haze(float distance, float visibility_distance, float haze);

}  // namespace oriel::sky
