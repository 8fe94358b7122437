// SPDX-License-Identifier: Apache-2.0
// Scenes and sources of values that cases of Maya's shaders share.
#pragma once

#include <fmt/format.h>

#include "effects.h"

namespace oriel::effects {

/// Sources to connect: "tint" is the colour and vector (.2, .4, .6), "half" the number .5.
inline const std::string kMayaSources =
    "shader \"tint\" \"maya_rgb_to_color\" ( \"r\" .2, \"g\" .4, \"b\" .6 )\n"
    "shader \"half\" \"maya_displace\" ( \"displacement\" .5 )\n";
inline const Rgb kMayaTint(.2f, .4f, .6f);

/// Adds a case, or joins it to the last one if that is of the same parameter.
inline void add_or_join(Cases& all, const Case& c) {
  if (!all.empty() && all.back().parameter == c.parameter)
    all.back() = both(all.back(), c);
  else
    all.push_back(c);
}

/// The place in the picture of value() and member() and member() that shows this texture
/// coordinate.
inline Vec2 place_of(float u, float v) {
  // The square is 20 units wide; the camera sees 5 by 3.75 of it.
  return Vec2(.5f + (u - .5f) * 20 / 5, .5f + (v - .5f) * 20 / 3.75f);
}

/// Sources to connect: the coordinate (.2, .4) as "there", placements that show the texture and
/// that leave every point outside of its frame as "inside" and "outside".
inline const std::string kMayaPlaces =
    "shader \"there\" \"maya_uvw_to_vector\" ( \"u\" .2, \"v\" .4 )\n"
    "shader \"inside\" \"maya_place2dtex\" ( )\n"
    "shader \"outside\" \"maya_place2dtex\" ( \"coverage\" .1 .1 0, \"wrapU\" off, \"wrapV\" off "
    ")\n";

}  // namespace oriel::effects
