// SPDX-License-Identifier: Apache-2.0
// Area lights of formats that assimp does not give sizes of.
#pragma once

#include <string>
#include <string_view>

#include "base/diagnostic.h"

struct aiScene;

namespace oriel::models {

/// Turns lights into area lights: type aiLightSource_AREA, mSize the width and height in units of
/// the light's space; a height of 0 is a disc of that diameter. Light leaves along mDirection.
///
/// Model:   Collada: what Blender writes beside its point lights (technique "blender"; an ellipse
///          becomes the disc of the same area). FBX: lights of type 3, as rectangles. Files have no
///          size; 3ds Max and Maya use a square of 2 units that the node scales, Blender loses the
///          size, and the square of its default is used.
/// Inputs:  suffix: of the file; text: of the file, for Collada.
/// Errors:  OR-MD-025 one note where sizes are not known.
/// Checked: AreaLightsOfModels.*
void mend_area_lights(aiScene& model, const std::string& suffix, std::string_view text,
                      Diagnostics& diagnostics);

}  // namespace oriel::models
