// SPDX-License-Identifier: Apache-2.0
// The parts the physical sky is put together from: illuminance integrals, disc and glow profiles,
// aerial perspective.
#pragma once

#include "base/vec.h"
#include "sky/preetham.h"

#include <algorithm>

namespace oriel::sky {

/// Illuminance of `sky` on a horizontal plane, lux per channel, exact to 0.1 %.
/// Checked: Preetham.HorizontalIlluminanceMatchesTable
Rgb horizontal_illuminance(const PreethamSky& sky);

/// The same from 25 directions, a 5 x 5 grid of cell centres on the square taken to the disc by
/// the concentric map. 9 to 22 % low at turbidity 2; kept because the historic ground has it.
/// Source:  NVIDIA, MDL-SDK base.mdl.
/// Checked: PhysicalSky.GroundSkyIlluminanceMatchesTable
Rgb horizontal_illuminance_25(const PreethamSky& sky);

/// Glow and disc, as factors of the sun's illuminance in the pi convention.
///
/// Model:   not photometric: a true disc would be pi over the sun's solid angle (46248). The edge
///          of the disc is near f = 0.9, haze softens it; the glow reaches ten disc radii.
/// Inputs:  f: 1 in the middle of the sun, 0 where the glow ends, linear in angle; edge: see below.
/// Source:  NVIDIA, MDL-SDK base.mdl.
/// Checked: PhysicalSky.DiscProfileMatchesTable
inline float glow_profile(float f) { return 2 * f * f * f; }
inline float disc_profile(float f, float edge) { return 100 * smoothstep(0.85f, edge, f); }

/// f at which the disc reaches its full brightness; it grows with haze, so the edge gets softer.
inline float disc_softness_end(float haze) { return 0.95f + 0.002f * (std::max(haze, 0.0f) + 2); }

/// Factors that make disc and glow together carry `disc_intensity` times the energy of the sun.
struct DiscScale {
  float disc = 1, glow = 1;
};

/// Model:   the glow keeps its own energy up to half of the total, the disc gets the rest; the
///          disc counts as a flat cap of its nominal radius.
/// Source:  NVIDIA's GLSL port of the sky (`physically_scaled_sun`).
/// Checked: PhysicalSky.PhysicallyScaledSunCarriesTheSunsEnergy
DiscScale physical_disc_scale(float disc_scale, float disc_intensity, float glow_intensity);

/// Half-angle of the cone that sunlight comes from, radians: that of the true sun at softness 1 and
/// haze 0, half as wide again at haze 5 and two and a half times at 15, as thick air spreads it.
/// Source:  that haze softens shadows is the manual's; how much is Oriel's.
/// Checked: Sun.HazeSoftensItsShadows
float sun_cone_angle(float shadow_softness, float haze);

/// Share of haze in front of something at `distance`: 0.1 at `visibility_distance` for haze 0,
/// stronger in proportion to 1 + haze; 0 where visibility_distance is not positive (switched off).
/// Source:  the 10 % distance is the manual's; the growth with haze is Oriel's.
/// Checked: AerialPerspective.*
float aerial_haze(float distance, float visibility_distance, float haze);

}  // namespace oriel::sky
